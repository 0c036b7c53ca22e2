#include "tools/sought.hpp"

#include <algorithm>
#include <charconv>

#include "core/error.hpp"

namespace vlbeam {

Sought::Sought(Scene& scene, const std::string& name) : name_(name), unit_("Hz") {
  const std::string frequencies = "frequencies.";
  if (!name.starts_with(frequencies)) {
    scene = keeping(scene, name);
    sampled_ = find_quantity(scene, name);
    name_ = sampled_->name;
    unit_ = sampled_->unit;
    return;
  }
  constexpr std::size_t most = 100;
  const char* const first = name.data() + frequencies.size();
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(first, end, frequency_);
  if (read.ec != std::errc() || read.ptr != end || frequency_ >= most) {
    throw InvalidInput("--quantity", "\"" + name + "\"", "behind the point must stand a number from 0 to 99");
  }
  if (scene.analysis != Analysis::statics) {
    throw InvalidInput("--quantity", "\"" + name + "\"",
                       "natural frequencies are about an equilibrium: the scene must have \"analysis\": \"statics\"");
  }
  scene.statics.frequencies = std::max(scene.statics.frequencies, static_cast<int>(frequency_) + 1);
}

std::vector<double> Sought::values(const RunResult& result) const {
  std::vector<double> values;
  if (!sampled_) {
    if (frequency_ < result.frequencies.size()) values.push_back(result.frequencies[frequency_]);
    return values;
  }
  values.reserve(result.samples.size());
  for (const Sample& sample : result.samples) values.push_back(sampled_->of(sample));
  return values;
}

}  // namespace vlbeam
