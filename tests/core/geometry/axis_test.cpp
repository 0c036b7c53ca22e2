#include "core/geometry/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vlbeam::test {
namespace {

constexpr double epsilon = 2.220446049250313e-16;
constexpr double pi = std::numbers::pi;

/// Largest | |r - center| - R | over the elements of a chain.
template <int D>
double radius_error(const CubicChain<D>& chain, const std::vector<double>& x, const Vec<double, D>& center, double R) {
  double largest = 0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const NodalCubic<double, D> e{chain.r[k], chain.r_x[k], chain.r[k + 1], chain.r_x[k + 1]};
    const auto curve = RationalCubic<double, D>::from_nodal(e, x[k + 1] - x[k], chain.weights[k]);
    for (int i = 0; i <= 40; ++i) {
      largest = std::max(largest, std::abs((curve.evaluate(i / 40.0)[0] - center).norm() - R));
    }
  }
  return largest;
}

std::vector<double> equal_nodes(double length, int n) {
  std::vector<double> x;
  for (int k = 0; k <= n; ++k) x.push_back(length * k / n);
  return x;
}

TEST(Axis, AnArcIsExactOnAnyMesh) {
  const Vec<double, 2> center(0.3, -0.2);
  const double R = 2;
  const auto axis = Axis<2>::arc(center, R, pi, 2 * pi);
  EXPECT_NEAR(axis.length(), pi * R, 1e-14);
  for (const int n : {2, 3, 8, 64}) {
    const auto x = equal_nodes(axis.length(), n);
    EXPECT_LE(radius_error(exact_chain(axis, x), x, center, R), 64 * epsilon * R) << n;
  }
  // unequal angles: neighbours share their slope all the same
  const double L = axis.length();
  const std::vector<double> x{0, L / 16, L / 2, 3 * L / 4, L};
  const auto chain = exact_chain(axis, x);
  EXPECT_LE(radius_error(chain, x, center, R), 64 * epsilon * R);
  for (const auto& slope : chain.r_x) EXPECT_NEAR(slope.norm(), 1, 0.15);
}

TEST(Axis, ElementsOfEqualAngleHaveThePapersWeightsAndSlopes) {
  const auto axis = Axis<2>::arc({0, 0}, 1, 0, 1.2);
  const auto chain = exact_chain(axis, equal_nodes(1.2, 3));
  const double theta = 0.4, w = (1 + 2 * std::cos(theta / 2)) / 3;
  for (const auto& weights : chain.weights) {
    EXPECT_NEAR(weights[1] / weights[0], w, 1e-14);
    EXPECT_NEAR(weights[2] / weights[0], w, 1e-14);
    EXPECT_NEAR(weights[3] / weights[0], 1, 1e-14);
  }
  for (const auto& slope : chain.r_x) EXPECT_NEAR(slope.norm(), 2 * std::sin(theta / 2) / theta, 1e-14);
}

TEST(Axis, AnArcRunsFromItsFirstAngleToItsLastEitherWay) {
  const auto axis = Axis<3>::arc({1, 2, 3}, 0.5, pi / 2, -pi / 2);
  EXPECT_LE((axis.position(0) - Vec<double, 3>(1, 2.5, 3)).norm(), 1e-15);
  EXPECT_LE((axis.position(axis.length()) - Vec<double, 3>(1, 1.5, 3)).norm(), 1e-15);
  EXPECT_LE((axis.tangent(0) - Vec<double, 3>(1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((axis.tangent(axis.length()) - Vec<double, 3>(-1, 0, 0)).norm(), 1e-15);
  const auto half = axis.between(0, axis.length() / 2);
  EXPECT_LE((half.evaluate(1.0)[0] - Vec<double, 3>(1.5, 2, 3)).norm(), 1e-15);
}

TEST(Axis, AnElementMustTurnByLessThanPi) {
  const auto axis = Axis<2>::arc({0, 0}, 1, 0, 2 * pi);
  EXPECT_THROW(axis.between(0, pi), std::domain_error);
  EXPECT_NO_THROW(axis.between(0, 0.99 * pi));
}

TEST(Axis, ALineHasUnitWeightsAndSlopes) {
  const auto axis = Axis<3>::line({1, 1, 1}, {1, 4, 5});
  EXPECT_DOUBLE_EQ(axis.length(), 5);
  EXPECT_TRUE(axis.straight());
  const std::vector<double> x{0, 0.5, 3, 5};
  const auto chain = exact_chain(axis, x);
  for (const auto& slope : chain.r_x) EXPECT_LE((slope - Vec<double, 3>(0, 0.6, 0.8)).norm(), 1e-15);
  for (const auto& w : chain.weights) {
    for (const double wi : w) EXPECT_NEAR(wi, 1, 1e-14);
  }
}

/// A full circle of radius 1 as a quadratic NURBS with double knots (Piegl & Tiller, The NURBS Book, Ex. 7.2).
Nurbs<2> nurbs_circle() {
  const double h = std::sqrt(0.5);
  return {2,
          {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
          {1, h, 1, h, 1, h, 1, h, 1},
          {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
}

TEST(Axis, AHelixRisesByItsPitchInATurn) {
  const double R = 0.3, pitch = 0.2;
  for (const double to : {4 * pi, -4 * pi}) {
    const auto axis = Axis<3>::arc({1, 2, 3}, R, 0, to, pitch);
    EXPECT_NEAR(axis.length(), 2 * std::hypot(2 * pi * R, pitch), 1e-14);
    EXPECT_LE((axis.position(axis.length()) - Eigen::Vector3d(1 + R, 2, 3 + 2 * pitch)).norm(), 1e-14);
    const double x = 0.37 * axis.length(), h = 1e-5;
    const auto at = axis.derivatives(x), before = axis.derivatives(x - h), behind = axis.derivatives(x + h);
    EXPECT_NEAR(at[1].norm(), 1, 1e-15);
    for (std::size_t n = 0; n < 3; ++n) EXPECT_LE(((behind[n] - before[n]) / (2 * h) - at[n + 1]).norm(), 1e-8) << n;
    EXPECT_FALSE(axis.in_one_piece(x, x + h)) << "no rational cubic is a helix";
  }
}

TEST(Axis, ANurbsCircleIsExactWithNodesBetweenItsKnots) {
  const auto axis = Axis<2>::nurbs(nurbs_circle());
  EXPECT_NEAR(axis.length(), 2 * pi, 1e-13);
  ASSERT_EQ(axis.breaks().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(axis.breaks()[i], static_cast<double>(i) * pi / 2, 1e-13);
  std::vector<double> x;
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double share : {0.0, 0.2, 0.65}) x.push_back(axis.breaks()[i] + share * pi / 2);
  }
  x.push_back(axis.length());
  const auto chain = exact_chain(axis, x);
  EXPECT_LE(radius_error<2>(chain, x, {0, 0}, 1), 64 * epsilon);
  for (std::size_t k = 0; k < x.size(); ++k) {  // nodes stand at their arc lengths
    EXPECT_LE((chain.r[k] - Vec<double, 2>(std::cos(x[k]), std::sin(x[k]))).norm(), 1e-13);
  }
}

TEST(Axis, ItsDerivativesAreByArcLength) {
  const auto circle = Axis<2>::nurbs(nurbs_circle());  // rational, and so of uneven speed
  const auto arc = Axis<2>::arc({0, 0}, 1, 0, 2 * pi);
  for (const double x : {0.0, 0.3, 1.2, 2.9, 4.4, 6.2}) {
    const double c = std::cos(x), s = std::sin(x);
    const std::array<Vec<double, 2>, 4> exact{Vec<double, 2>(c, s), Vec<double, 2>(-s, c), Vec<double, 2>(-c, -s),
                                              Vec<double, 2>(s, -c)};
    const auto by_nurbs = circle.derivatives(x), by_arc = arc.derivatives(x);
    for (std::size_t n = 0; n < 4; ++n) {
      EXPECT_LE((by_nurbs[n] - exact[n]).norm(), 1e-12) << "derivative " << n << " at " << x;
      EXPECT_LE((by_arc[n] - exact[n]).norm(), 1e-15);
    }
  }
  // a curve whose curvature changes: each derivative is that of the one before
  const auto wave =
      Axis<2>::nurbs({3, {0, 0, 0, 0, 1, 2, 2, 2, 2}, {1, 2, 1, 0.5, 1}, {{0, 0}, {1, 2}, {3, 1}, {4, -1}, {6, 0}}});
  const double h = 1e-4 * wave.length();
  for (const double share : {0.11, 0.34, 0.77}) {
    const double x = share * wave.length();
    const auto at = wave.derivatives(x), before = wave.derivatives(x - h), behind = wave.derivatives(x + h);
    EXPECT_NEAR(at[1].norm(), 1, 1e-15);
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_LE((Vec<double, 2>((behind[n] - before[n]) / (2 * h)) - at[n + 1]).norm(), 1e-5);
    }
  }
}

TEST(Axis, EvenElementsOfAnArcPassThroughItsMiddles) {
  const auto arc = Axis<2>::arc({0, 0}, 1, 0, 2 * pi);
  double coarser = 0;
  for (const int n : {9, 18, 36}) {
    const auto x = equal_nodes(arc.length(), n);
    const auto even = even_chain(arc, x, true);
    const auto element =
        RationalCubic<double, 2>::from_nodal({even.r[0], even.r_x[0], even.r[1], even.r_x[1]}, x[1], even.weights[0]);
    EXPECT_NEAR(element.evaluate(0.5)[0].norm(), 1, 1e-14);
    EXPECT_EQ(even.r_x[1], arc.tangent(x[1]));
    const double error = radius_error<2>(even, x, {0, 0}, 1);
    if (n == 9) {
      EXPECT_LE(error, 9.4e-7);  // 40 degrees; unit weights 6.1e-4
    } else {
      EXPECT_NEAR(std::log2(coarser / error), 6, 0.1);
    }
    coarser = error;
  }
  EXPECT_EQ(even_chain(arc, equal_nodes(arc.length(), 9), false).weights[0], unit_weights);
}

}  // namespace
}  // namespace vlbeam::test
