#include "core/element/beam_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace vlbeam::test {
namespace {

TEST(BeamRule, FullIsOneRuleForAll) {
  const BeamRule rule = beam_rule(5);
  ASSERT_EQ(rule.size(), 5U);
  EXPECT_EQ(with_mass(rule).size(), 5U);
  for (const BeamPoint& point : rule) EXPECT_EQ(point.feels, Feels::everything);
}

TEST(BeamRule, LobattoTakesTheStretchAtNodesAndMiddle) {
  const BeamRule rule = beam_rule(4, AxialStrain::lobatto);
  ASSERT_EQ(rule.size(), 7U);
  const auto rest = with_mass(rule);
  ASSERT_EQ(rest.size(), 4U);
  for (const BeamPoint& point : rest) EXPECT_EQ(point.feels, Feels::all_but_stretch);
  for (int degree = 0; degree <= 3; ++degree) {  // Simpson's rule is exact for these
    double sum = 0;
    for (std::size_t i = 4; i < rule.size(); ++i) {
      EXPECT_EQ(rule[i].feels, Feels::stretch);
      sum += rule[i].weight * std::pow(rule[i].u, degree);
    }
    EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-15);
  }
  EXPECT_EQ(rule[4].u, 0);
  EXPECT_EQ(rule[6].u, 1);
}

TEST(BeamRule, RefusesMorePointsThanThereAre) { EXPECT_THROW(beam_rule(26, AxialStrain::lobatto), std::out_of_range); }

}  // namespace
}  // namespace vlbeam::test
