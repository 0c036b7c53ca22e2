#include "core/element/slack_law.hpp"

#include <gtest/gtest.h>

#include "core/element/rest_tangent.hpp"
#include "core/pack.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

TEST(SlackLaw, IsAPotentialWithItsPullAndStiffness) {
  constexpr double d = 0.02;
  for (const double eps : {-0.5, -0.0201, -0.0199, -0.01, 0.0, 0.003, 0.0199, 0.0201, 0.7}) {
    const SlackLaw<Dual<double>> moving({eps, 1}, d);
    const SlackLaw<double> law(eps, d);
    EXPECT_NEAR(moving.energy.rate, law.pull, 1e-15) << eps;
    EXPECT_NEAR(moving.pull.rate, law.stiffness, 1e-13) << eps;
  }
}

TEST(SlackLaw, PullsAsAnyRopeWhereTautAndNotAtAllWhereSlack) {
  for (const double eps : {0.02, 0.021, 3.0}) EXPECT_NEAR(SlackLaw<double>(eps, 0.02).pull, eps, 1e-15);
  for (const double eps : {-0.02, -0.021, -3.0}) {
    EXPECT_NEAR(SlackLaw<double>(eps, 0.02).pull, 0, 1e-17);
    EXPECT_NEAR(SlackLaw<double>(eps, 0.02).energy, 0, 1e-18);
  }
  // its stiffness is continuous, too
  for (const double edge : {-0.02, 0.02}) {
    EXPECT_NEAR(SlackLaw<double>(edge - 1e-9, 0.02).stiffness, SlackLaw<double>(edge + 1e-9, 0.02).stiffness, 1e-12);
  }
}

TEST(SlackLaw, IsTheSameInEachLaneOfAPack) {
  const Pack eps(-0.03, -0.01, 0.01, 0.03);
  const SlackLaw<Pack> packed(eps, 0.02);
  for (int i = 0; i < Pack::width; ++i) {
    const SlackLaw<double> one(eps[i], 0.02);
    EXPECT_EQ(packed.energy[i], one.energy);
    EXPECT_EQ(packed.pull[i], one.pull);
    EXPECT_EQ(packed.stiffness[i], one.stiffness);
  }
}

// What a rest shape adds to the stresses of a straight rope makes them those of the strain from rest.
TEST(SlackLaw, CountsStrainFromTheRestShape) {
  Random random(3);
  BeamSection rope;
  rope.stiffness = {1000, 0, StrainLaw::green, 0.1};
  for (int i = 0; i < 20; ++i) {
    const Vec<double, 3> rx = random.vector<3>() / 3 + Vec<double, 3>::UnitX(), rxx = random.vector<3>();
    const RestStrain<double> rest{random.uniform(-0.1, 0.1), 0, {}, {}, {}};
    const ElasticStress<double, 3> straight(rx, rxx, rope.stiffness);
    const RestStress<double, 3> from_rest(rx, rxx, rest, rope);
    const SlackLaw<double> law((rx.squaredNorm() - 1) / 2 - rest.axial, 0.1);
    EXPECT_LE((straight.p + from_rest.p - 1000 * law.pull * rx).norm(), 1e-12 * 1000);
    EXPECT_NEAR(from_rest.axial, 1000 * law.energy, 1e-12 * 1000);
    EXPECT_NEAR(from_rest.tension, 1000 * law.pull, 1e-12 * 1000);
  }
}

}  // namespace
}  // namespace vlbeam::test
