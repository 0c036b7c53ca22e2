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

}  // namespace
}  // namespace vlbeam::test
