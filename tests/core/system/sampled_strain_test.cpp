#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// Natural frequencies [Hz] of a straight beam of 1 m that nothing holds, in order, but for its rigid motions: bending
/// (b/L)^2 sqrt(EI/rhoA)/2 pi, cos b cosh b = 1, in one plane or two, and stretching n sqrt(EA/rhoA)/2 L.
std::vector<double> exact_frequencies(double EA, double EI, int planes) {
  std::vector<double> all;
  for (const double b : {4.730040744862704, 7.853204624095838, 10.99560783800167, 14.13716549125746}) {
    all.insert(all.end(), static_cast<std::size_t>(planes), b * b * std::sqrt(EI) / (2 * std::numbers::pi));
  }
  for (int n = 1; n <= 4; ++n) all.push_back(n * std::sqrt(EA) / 2);
  std::ranges::sort(all);
  return all;
}

/// Three points an element are few: no motion but rigid ones may be left without energy, and none with too little.
TEST(SampledStrain, LeavesNoMotionTooSoft) {
  constexpr double EI = 1;
  for (const int dimension : {2, 3}) {
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      for (const double EA : {30.0, 1e4}) {
        for (const int elements : {2, 4, 8}) {
          Scene scene = at_rest(elements, EA, EI);
          scene.dimension = dimension;
          scene.beam.element = element;
          scene.beam.axial_strain = AxialStrain::lobatto;
          scene.statics = {.steps = 1, .frequencies = dimension == 2 ? 6 : 9};
          const RunResult run = completed(scene);
          const auto exact = exact_frequencies(EA, EI, dimension - 1);
          std::size_t rigid = 0;
          while (rigid < run.frequencies.size() && std::abs(run.frequencies[rigid]) < 0.01 * exact[0]) ++rigid;
          EXPECT_EQ(rigid, dimension == 2 ? 3U : 5U) << elements;
          for (std::size_t i = rigid; i < run.frequencies.size(); ++i) {
            EXPECT_GE(run.frequencies[i], 0.99 * exact[i - rigid]) << elements << " elements, mode " << i - rigid;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
