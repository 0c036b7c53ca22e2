#include "core/geometry/rational_cubic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/core/support/arc.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

template <class Dimension>
class RationalCubicCurve : public ::testing::Test {
 protected:
  using Curve = RationalCubic<double, Dimension::value>;

  Curve random_curve() {
    Curve curve;
    for (auto& point : curve.points) point = random.vector<Dimension::value>();
    curve.weights = random.weights(5);
    return curve;
  }

  /// The same curve for another scalar type.
  template <class Real>
  static RationalCubic<Real, Dimension::value> lift(const Curve& curve) {
    RationalCubic<Real, Dimension::value> lifted;
    for (std::size_t i = 0; i < 4; ++i) {
      lifted.points[i] = curve.points[i].template cast<Real>();
      lifted.weights[i] = Real(curve.weights[i]);
    }
    return lifted;
  }

  Random random{1};
};

TYPED_TEST_SUITE(RationalCubicCurve, Dimensions, DimensionNames);

TYPED_TEST(RationalCubicCurve, PositionIsTheRationalBezierSum) {
  const auto curve = this->random_curve();
  for (const double u : {-0.2, 0.0, 0.3, 0.5, 0.8, 1.0, 1.2}) {
    const std::array<double, 4> b{std::pow(1 - u, 3), 3 * u * std::pow(1 - u, 2), 3 * u * u * (1 - u), u * u * u};
    auto sum = curve.points[0];
    sum.setZero();
    double W = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += b[i] * curve.weights[i] * curve.points[i];
      W += b[i] * curve.weights[i];
    }
    EXPECT_LE((curve.evaluate(u)[0] - sum / W).norm(), 16 * eps) << "u = " << u;
  }
}

TYPED_TEST(RationalCubicCurve, DerivativesAreThoseOfThePosition) {
  using First = Dual<double>;
  using Third = Dual<Dual<First>>;
  for (int k = 0; k < 10; ++k) {
    const auto curve = this->random_curve();
    const double u = this->random.uniform(-0.1, 1.1);
    const auto exact = TestFixture::template lift<Third>(curve).evaluate(Third(Dual<First>(First(u, 1), 1), 1))[0];
    const auto value = curve.evaluate(u);
    for (int c = 0; c < TypeParam::value; ++c) {
      EXPECT_NEAR(value[1][c], exact[c].value.value.rate, 1e-13 * value[1].norm());
      EXPECT_NEAR(value[2][c], exact[c].value.rate.rate, 1e-13 * value[2].norm());
      EXPECT_NEAR(value[3][c], exact[c].rate.rate.rate, 1e-13 * value[3].norm());
    }
  }
}

TYPED_TEST(RationalCubicCurve, RestrictionIsTheSameCurveInsideAndBeyondItsInterval) {
  const auto curve = this->random_curve();
  const std::array<std::array<double, 2>, 5> intervals{{{0, 1}, {0, 0.3}, {0.25, 0.75}, {-0.1, 0.9}, {0.4, 1.15}}};
  for (const auto& [a, b] : intervals) {
    const auto part = curve.restrict(a, b);
    for (const double s : {0.0, 0.2, 0.7, 1.0}) {
      const auto expected = curve.evaluate(a + s * (b - a)), value = part.evaluate(s);
      double scale = 1;
      for (std::size_t n = 0; n < 4; ++n, scale *= b - a) {
        EXPECT_LE((value[n] - scale * expected[n]).norm(), 1e-12 * (1 + scale * expected[n].norm()))
            << "derivative " << n << " on [" << a << ", " << b << "] at " << s;
      }
    }
  }
}

TYPED_TEST(RationalCubicCurve, ReversedIntervalReversesTheCurve) {
  const auto curve = this->random_curve();
  const auto reversed = curve.restrict(1.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LE((reversed.points[i] - curve.points[3 - i]).norm(), 4 * eps);
    EXPECT_DOUBLE_EQ(reversed.weights[i], curve.weights[3 - i]);
  }
}

TYPED_TEST(RationalCubicCurve, NodalCoordinatesAreEndPointsAndEndSlopes) {
  const auto curve = this->random_curve();
  const double l = 0.37;
  const auto e = curve.to_nodal(l);
  const auto start = curve.evaluate(0.0), end = curve.evaluate(1.0);
  EXPECT_LE((e.r_a - start[0]).norm(), 8 * eps);
  EXPECT_LE((e.r_b - end[0]).norm(), 8 * eps);
  EXPECT_LE((e.s_a - start[1] / l).norm(), 32 * eps * e.s_a.norm());
  EXPECT_LE((e.s_b - end[1] / l).norm(), 32 * eps * e.s_b.norm());
}

TYPED_TEST(RationalCubicCurve, ControlPointsSurviveTheWayThroughNodalCoordinates) {
  const auto curve = this->random_curve();
  const double l = 0.37;
  const auto back = std::decay_t<decltype(curve)>::from_nodal(curve.to_nodal(l), l, curve.weights);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE((back.points[i] - curve.points[i]).norm(), 16 * eps);
}

TYPED_TEST(RationalCubicCurve, CommonFactorOfTheWeightsChangesNothing) {
  const auto curve = this->random_curve();
  auto scaled = curve;
  for (double& w : scaled.weights) w *= 2.7;
  const auto a = curve.evaluate(0.4), b = scaled.evaluate(0.4);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_LE((a[n] - b[n]).norm(), 32 * eps * (1 + a[n].norm()));
}

TYPED_TEST(RationalCubicCurve, CircularArcIsExact) {
  constexpr int D = TypeParam::value;
  for (const double degrees : {1.0, 20.0, 45.0, 90.0, 135.0, 179.0}) {
    for (const double skew : {1.0, 0.8, 1.3}) {
      const double R = 2, theta = degrees * std::numbers::pi / 180;
      const auto arc = arc_curve<D>(R, theta, this->random.template rotation<D>(), skew);
      double error = 0;
      for (int i = 0; i <= 50; ++i) error = std::max(error, std::abs(arc.evaluate(i / 50.0)[0].norm() - R));
      EXPECT_LE(error, 64 * eps * R) << degrees << " degrees, skew " << skew;
    }
  }
}

TYPED_TEST(RationalCubicCurve, ArcRestrictedToASubIntervalOrBeyondStaysOnTheCircle) {
  constexpr int D = TypeParam::value;
  const double R = 2;
  const auto arc = arc_curve<D>(R, 1.1, this->random.template rotation<D>());
  const std::array<std::array<double, 2>, 3> intervals{{{0.1, 0.45}, {-0.1, 0.5}, {0.2, 1.3}}};
  for (const auto& [a, b] : intervals) {
    const auto part = arc.restrict(a, b);
    for (int i = 0; i <= 20; ++i) EXPECT_NEAR(part.evaluate(i / 20.0)[0].norm(), R, 64 * eps * R);
  }
}

TEST(Weights, RestrictionOfAWeightFunctionIsThatFunction) {
  const Weights<double> w{1, 0.7, 1.3, 1.1};
  auto value = [](const Weights<double>& c, double u) {
    return c[0] * std::pow(1 - u, 3) + 3 * c[1] * u * std::pow(1 - u, 2) + 3 * c[2] * u * u * (1 - u) +
           c[3] * u * u * u;
  };
  for (const double b : {0.2, 0.9, 1.4}) {
    const auto part = restrict_cubic(w, -0.3, b);
    for (const double s : {0.0, 0.5, 1.0}) EXPECT_NEAR(value(part, s), value(w, -0.3 + s * (b + 0.3)), 16 * eps);
  }
}

}  // namespace
}  // namespace vlbeam::test
