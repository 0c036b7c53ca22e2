#include "core/element/elastic_tangent.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

/// The stresses' derivative along (x, xx) against the tangent's, relative to the tangent's size.
template <int D>
void expect_derivative_of_the_stresses(Random& random, StrainLaw law, bool bends, double slack_over = 0) {
  const double EA = random.uniform(10, 1000), EI = random.uniform(0.1, 10);
  const Stiffness stiffness{EA, bends ? EI : 0, law, slack_over};
  const double stretch = slack_over > 0 ? 1 : 2;  // a rope neither slack nor taut
  const Vec<double, D> rx = random.vector<D>() / (3 - stretch) + stretch * Vec<double, D>::UnitX();
  const Vec<double, D> rxx = random.vector<D>(3);
  const Vec<double, D> x = random.vector<D>(), xx = random.vector<D>();
  const ElasticTangent<double, D> tangent(rx, rxx, stiffness);
  const ElasticStress<Dual<double>, D> moving(in_motion(rx, x), in_motion(rxx, xx), stiffness);
  const double size = tangent.pp.norm() + tangent.pm.norm() + tangent.mm.norm();
  EXPECT_LE((tangent.pp * x + tangent.pm * xx - rate_of(moving.p)).norm(), 1e-14 * size);
  if (bends) {
    EXPECT_LE((tangent.pm.transpose() * x + tangent.mm * xx - rate_of(moving.m)).norm(), 1e-14 * size);
  }
}

template <int D>
void expect_for_both_laws(unsigned seed) {
  Random random(seed);
  for (int i = 0; i < 20; ++i) {
    for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
      for (const bool bends : {true, false}) expect_derivative_of_the_stresses<D>(random, law, bends);
      expect_derivative_of_the_stresses<D>(random, law, false, 0.6);
    }
  }
}

TEST(ElasticTangent, IsTheDerivativeOfTheStressesInThePlane) { expect_for_both_laws<2>(1); }
TEST(ElasticTangent, IsTheDerivativeOfTheStressesInSpace) { expect_for_both_laws<3>(2); }

}  // namespace
}  // namespace vlbeam::test
