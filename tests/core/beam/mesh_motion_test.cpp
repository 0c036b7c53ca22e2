#include "mechanics/flow/mesh_motion.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace vlbeam::test {
namespace {

TEST(MeshMotion, NodesBetweenGuidesDivideTheirDistance) {
  const MeshMotion motion({{0, steadily(-1, 0)},
                           {2,
                            [](double t) {
                              return Prescribed{t * t, 2 * t, 2};
                            }},
                           {5, steadily(9, 3)}});
  ASSERT_EQ(motion.last(), 5);
  std::vector<Prescribed> nodes;
  motion.at(2, nodes);
  ASSERT_EQ(nodes.size(), 6);
  const double x[] = {-1, 1.5, 4, 23.0 / 3, 34.0 / 3, 15}, rate[] = {0, 2, 4, 11.0 / 3, 10.0 / 3, 3};
  const double acceleration[] = {0, 1, 2, 4.0 / 3, 2.0 / 3, 0};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(nodes[k].value, x[k], 1e-14);
    EXPECT_NEAR(nodes[k].rate, rate[k], 1e-14);
    EXPECT_NEAR(nodes[k].acceleration, acceleration[k], 1e-14);
  }
}

TEST(SmoothRamp, IsZeroBeforeAndOneBehind) {
  for (const double duration : {0.0, 0.5}) {
    for (const double t : {-1.0, -1e-9}) {
      const Prescribed before = smooth_ramp(t, duration);
      EXPECT_EQ(before.value, 0) << t;
      EXPECT_EQ(before.rate, 0) << t;
      EXPECT_EQ(before.acceleration, 0) << t;
    }
    EXPECT_EQ(smooth_ramp(0.5, duration).value, 1);
  }
  EXPECT_EQ(smooth_ramp(0, 0).value, 1);
  EXPECT_NEAR(smooth_ramp(0.25, 0.5).value, 0.5, 1e-15);
}

TEST(MeshMotion, FindsWhenNodesTangle) {
  // node 1 overtakes node 2 at t = 0.25
  const MeshMotion motion({{0, steadily(0, 0)}, {1, steadily(0.5, 2)}, {3, steadily(1, 0)}});
  EXPECT_FALSE(motion.tangle(0, 0.24, 0));
  const auto tangle = motion.tangle(0, 1, 0);
  ASSERT_TRUE(tangle);
  EXPECT_NEAR(tangle->t, 0.25, 1e-9);
  EXPECT_EQ(tangle->element, 1);
  EXPECT_NEAR(motion.tangle(0, 1, 0.05)->t, 0.2, 1e-9);
}

TEST(MeshMotion, NeedsTheEndsInOrder) {
  EXPECT_THROW(MeshMotion({{1, steadily(0, 0)}, {2, steadily(1, 0)}}), InvalidInput);
  EXPECT_THROW(MeshMotion({{0, steadily(0, 0)}, {2, steadily(1, 0)}, {2, steadily(2, 0)}}), InvalidInput);
  EXPECT_THROW(MeshMotion({{0, steadily(0, 0)}}), InvalidInput);
}

TEST(SmoothRamp, GrowsFromNothingToOne) {
  EXPECT_EQ(smooth_ramp(0, 0).value, 1);
  EXPECT_EQ(smooth_ramp(0, 2).value, 0);
  EXPECT_EQ(smooth_ramp(2, 2).value, 1);
  EXPECT_NEAR(smooth_ramp(0.6, 2).value, 0.126036, 1e-15);  // 0.3^4 (35 - 84 0.3 + 70 0.3^2 - 20 0.3^3)
  EXPECT_LE(smooth_ramp(2e-3, 2).value, 35e-12);
  EXPECT_LE(1 - smooth_ramp(2 - 2e-3, 2).value, 35e-12);
  const double h = 1e-5;
  const Prescribed at = smooth_ramp(0.6, 2), before = smooth_ramp(0.6 - h, 2), after = smooth_ramp(0.6 + h, 2);
  EXPECT_NEAR(at.rate, (after.value - before.value) / (2 * h), 1e-9);
  EXPECT_NEAR(at.acceleration, (after.rate - before.rate) / (2 * h), 1e-9);
}

}  // namespace
}  // namespace vlbeam::test
