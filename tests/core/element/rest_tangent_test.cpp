#include "core/element/rest_tangent.hpp"

#include <gtest/gtest.h>

#include "core/pack.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

BeamSection some_section(Random& random, StrainLaw law, bool bends, double slack_over) {
  BeamSection beam;
  beam.stiffness = {random.uniform(10, 1000), bends ? random.uniform(0.1, 10) : 0, law, slack_over};
  beam.curvature_regularization = 0.1;
  return beam;
}

/// The derivatives of the stresses that a rest shape adds, and of their work on a change of that, along (x, xx) against
/// the tangent's, relative to its size.
template <int D>
void expect_derivative_of_the_stresses(Random& random, const BeamSection& beam) {
  const Vec<double, D> rx = random.vector<D>() / 3 + Vec<double, D>::UnitX(), rxx = random.vector<D>(3);
  const Vec<double, D> x = random.vector<D>(), xx = random.vector<D>();
  const RestStrain<double> rest{random.uniform(-0.1, 0.1), random.uniform(0.5, 2), {}, {}, {}};
  const StrainChange<double> change{random.uniform(-1, 1), random.uniform(-1, 1)};
  const RestTangent<double, D> tangent(rx, rxx, rest, beam);
  const RestStress<Dual<double>, D> moving(in_motion(rx, x), in_motion(rxx, xx),
                                           {rest.axial, rest.curvature, {}, {}, {}}, beam);
  const double size = beam.stiffness.EA + tangent.pp.norm() + tangent.pm.norm() + tangent.mm.norm();
  EXPECT_LE((tangent.p - value_of(moving.p)).norm(), 1e-14 * size);
  EXPECT_LE((tangent.m - value_of(moving.m)).norm(), 1e-14 * size);
  EXPECT_LE((tangent.pp * x + tangent.pm * xx - rate_of(moving.p)).norm(), 1e-14 * size);
  EXPECT_LE((tangent.pm.transpose() * x + tangent.mm * xx - rate_of(moving.m)).norm(), 1e-14 * size);
  const auto work = tangent.work(change);
  EXPECT_NEAR(work.by_slope.dot(x) + work.by_second.dot(xx), moving.work({change.axial, change.curvature}).rate,
              1e-14 * (work.by_slope.norm() + work.by_second.norm()));
}

template <int D>
void expect_for_both_laws(unsigned seed) {
  Random random(seed);
  for (int i = 0; i < 20; ++i) {
    for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
      for (const bool bends : {true, false}) {
        expect_derivative_of_the_stresses<D>(random, some_section(random, law, bends, 0));
        expect_derivative_of_the_stresses<D>(random, some_section(random, law, bends, 0.6));
      }
    }
  }
}

TEST(RestTangent, IsTheDerivativeOfTheStressesInThePlane) { expect_for_both_laws<2>(1); }
TEST(RestTangent, IsTheDerivativeOfTheStressesInSpace) { expect_for_both_laws<3>(2); }

TEST(RestTangent, IsTheSameInEachLaneOfAPack) {
  Random random(3);
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    const BeamSection beam = some_section(random, law, true, 0.6);
    Vec<Pack, 2> rx, rxx;
    for (int lane = 0; lane < Pack::width; ++lane) {
      for (int c = 0; c < 2; ++c) {
        rx[c].set(lane, random.uniform(0.5, 1));
        rxx[c].set(lane, random.uniform(-3, 3));
      }
    }
    const RestTangent<Pack, 2> packed(rx, rxx, {Pack(0.1), Pack(0.7), {}, {}, {}}, beam);
    for (int lane = 0; lane < Pack::width; ++lane) {
      const Vec<double, 2> x(rx[0][lane], rx[1][lane]), xx(rxx[0][lane], rxx[1][lane]);
      const RestTangent<double, 2> one(x, xx, {0.1, 0.7, {}, {}, {}}, beam);
      for (int c = 0; c < 2; ++c) {
        for (int d = 0; d < 2; ++d) {
          EXPECT_EQ(packed.pp(c, d)[lane], one.pp(c, d));
          EXPECT_EQ(packed.pm(c, d)[lane], one.pm(c, d));
        }
      }
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
