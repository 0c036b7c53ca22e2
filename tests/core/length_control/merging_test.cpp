#include "core/length_control/merging.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include <Eigen/LU>

#include "tests/core/support/arc.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

constexpr double length = 0.3;

/// A gently curved element.
template <int D>
NodalCubic<double, D> gentle_curve(Random& random) {
  const Eigen::Matrix<double, D, D> Q = random.rotation<D>();
  const Vec<double, D> along = Q.col(0);
  const Vec<double, D> start = random.vector<D>();
  return {start, along + random.vector<D>(0.2), start + length * along + random.vector<D>(0.02),
          along + random.vector<D>(0.2)};
}

template <int D>
Vec<double, D> position_at(const NodalCubic<double, D>& e, const Weights<double>& w, double u) {
  return RationalCubic<double, D>::from_nodal(e, length, w).evaluate(u)[0];
}

template <class Dimension>
class PointFit : public ::testing::Test {
 protected:
  Random random_{9};
};
TYPED_TEST_SUITE(PointFit, Dimensions, DimensionNames);

TYPED_TEST(PointFit, PassesThroughTheDeletedNode) {
  constexpr int D = TypeParam::value;
  for (int k = 0; k < 20; ++k) {
    const auto e = gentle_curve<D>(this->random_);
    const double u = this->random_.uniform(0.3, 0.7);
    const auto deleted = position_at(e, {1.2, 0.9, 1.1, 1}, u);  // a place some positive weights reach
    const auto merged = point_fit<D>(e, length, u, deleted);
    ASSERT_FALSE(merged.unit_fallback);
    EXPECT_LE((position_at(e, merged.weights(), u) - deleted).norm(), 1e-14);
  }
}

TYPED_TEST(PointFit, OfAPolynomialCurveIsUnitWeights) {
  constexpr int D = TypeParam::value;
  for (int k = 0; k < 20; ++k) {
    const auto e = gentle_curve<D>(this->random_);
    const double u = this->random_.uniform(0.3, 0.7);
    const auto merged = point_fit<D>(e, length, u, position_at(e, unit_weights, u));
    for (const double weight : merged.weights()) EXPECT_NEAR(weight, 1, 1e-11);
  }
}

TYPED_TEST(PointFit, OfAStraightElementIsUnitWeightsInAnyDirection) {
  constexpr int D = TypeParam::value;
  for (int k = 0; k < 50; ++k) {
    const Vec<double, D> tangent = this->random_.template rotation<D>().col(0),
                         start = this->random_.template vector<D>();
    const NodalCubic<double, D> e{start, tangent, start + length * tangent, tangent};
    const double u = this->random_.uniform(0.3, 0.7);
    const auto merged = point_fit<D>(e, length, u, start + u * length * tangent);
    EXPECT_FALSE(merged.unit_fallback);
    for (const double weight : merged.weights()) EXPECT_NEAR(weight, 1, 1e-12);
  }
}

TYPED_TEST(PointFit, BringsBackASegmentedConic) {
  constexpr int D = TypeParam::value;
  for (const double theta : {0.3, 1.0, 2.0}) {
    for (const double skew : {1.0, 0.85}) {
      const auto Q = this->random_.template rotation<D>();
      const auto arc = circular_arc<D>(length / theta, theta, Q, skew);
      for (const double u : {0.3, 0.5}) {
        const auto merged = point_fit<D>(arc.e, length, u, position_at(arc.e, arc.w, u));
        for (int i = 0; i <= 20; ++i) {
          EXPECT_LE((position_at(arc.e, merged.weights(), i / 20.0) - position_at(arc.e, arc.w, i / 20.0)).norm(),
                    1e-14)
              << "curve and parametrization; the weights themselves may differ";
        }
      }
    }
  }
}

TYPED_TEST(PointFit, TakesTheLeastOfAllWeightsThatPassThroughTheNode) {
  constexpr int D = TypeParam::value;
  const auto e = gentle_curve<D>(this->random_);
  const double u = 0.45;
  const auto deleted = position_at(e, {1.2, 0.9, 1.1, 1}, u);
  const auto merged = point_fit<D>(e, length, u, deleted);
  // W(u) (r(u) - deleted) is linear in the weights: the kernel of its linear part holds the other ways through the node
  auto miss = [&](const Eigen::Vector3d& k) -> Vec<double, D> {
    const auto b = RationalCubic<double, D>::bernstein(u);
    const std::array<double, 4> c{k[0] * b[0][0], k[1] * b[1][0], k[2] * b[2][0], b[3][0]};
    const Vec<double, D> handles = length / 3 * (k[0] * b[1][0] * e.s_a - b[2][0] * e.s_b);
    return (c[0] + c[1]) * (e.r_a - deleted) + (c[2] + c[3]) * (e.r_b - deleted) + handles;
  };
  Eigen::MatrixXd linear(D, 3);
  for (int i = 0; i < 3; ++i) linear.col(i) = miss(Eigen::Vector3d::Unit(i)) - miss(Eigen::Vector3d::Zero());
  const Eigen::Vector3d k(merged.k[0], merged.k[1], merged.k[2]);
  ASSERT_LE(miss(k).norm(), 1e-15);
  EXPECT_GT((k - Eigen::Vector3d::Ones()).norm(), 1e-3) << "unit weights would test nothing";
  if (D == 3) return;  // three conditions in space leave no freedom
  const Eigen::MatrixXd kernel = Eigen::FullPivLU<Eigen::MatrixXd>(linear).kernel();
  ASSERT_EQ(kernel.cols(), 1);
  const Eigen::Vector3d other = kernel.col(0).normalized();
  ASSERT_LE(miss(k + 0.1 * other).norm(), 1e-15);
  EXPECT_LE(std::abs(other.dot(k - Eigen::Vector3d::Ones())), 1e-13);
}

TYPED_TEST(PointFit, TurnsWithTheBody) {
  constexpr int D = TypeParam::value;
  const auto e = gentle_curve<D>(this->random_);
  const auto deleted = position_at(e, {1.2, 0.9, 1.1, 1}, 0.4);
  const auto Q = this->random_.template rotation<D>();
  const auto a = point_fit<D>(e, length, 0.4, deleted);
  const auto b = point_fit<D>({Q * e.r_a, Q * e.s_a, Q * e.r_b, Q * e.s_b}, length, 0.4, Q * deleted);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a.k[i], b.k[i], 1e-10);
}

TYPED_TEST(PointFit, TakesUnitWeightsWhereNoPositiveOnesWouldDo) {
  constexpr int D = TypeParam::value;
  const Vec<double, D> x = Vec<double, D>::Unit(0), y = Vec<double, D>::Unit(1);
  const NodalCubic<double, D> e{0 * x, x, length * x, x};
  const auto merged = point_fit<D>(e, length, 0.5, length / 2 * x + length * y);  // far beside a straight element
  EXPECT_TRUE(merged.unit_fallback);
  EXPECT_EQ(merged.weights(), unit_weights);
}

// A decomposition of what is not finite would read memory that nobody has written.
TYPED_TEST(PointFit, RefusesAShapeThatIsNotFinite) {
  constexpr int D = TypeParam::value;
  const Vec<double, D> x = Vec<double, D>::Unit(0);
  for (const double broken : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const NodalCubic<double, D> e{0 * x, x, length * x, broken * x};
    EXPECT_THROW(point_fit<D>(e, length, 0.5, length / 2 * x), std::domain_error);
    EXPECT_THROW(point_fit<D>({0 * x, x, length * x, x}, length, 0.5, broken * x), std::domain_error);
  }
}

TEST(PointFit, IsTheSameForAPlanarCurveInSpace) {
  Random random(10);
  for (int k = 0; k < 200; ++k) {
    const auto e = gentle_curve<2>(random);
    const auto deleted = position_at(e, {1.2, 0.9, 1.1, 1}, 0.4);
    const auto Q = random.rotation<3>();
    auto in_space = [&](const Vec<double, 2>& a) -> Vec<double, 3> { return Q.leftCols<2>() * a; };
    const auto planar = point_fit<2>(e, length, 0.4, deleted);
    const auto spatial = point_fit<3>({in_space(e.r_a), in_space(e.s_a), in_space(e.r_b), in_space(e.s_b)}, length, 0.4,
                                      in_space(deleted));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(planar.k[i], spatial.k[i], 1e-9);
  }
}

}  // namespace
}  // namespace vlbeam::test
