#include "scene/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vlbeam {

void Extremes::add(const Sample& sample) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::size_t i = 0;
  for (const SampleQuantity& quantity : quantities_) {
    if (quantity.path == "t") continue;
    const std::size_t count = quantity.columns.size();
    values_.assign(count, nan);
    if (count > 0 && !quantity.values(sample, values_.data())) values_.assign(count, nan);
    for (const double value : values_) {
      if (i == all_.size()) all_.push_back({nan, nan, nan, nan});
      Extreme& extreme = all_[i++];
      if (!std::isfinite(value)) continue;
      if (!(extreme.largest >= value)) {
        extreme.largest = value;
        extreme.at_largest = sample.t;
      }
      if (!(extreme.least <= value)) {
        extreme.least = value;
        extreme.at_least = sample.t;
      }
    }
  }
}

}  // namespace vlbeam
