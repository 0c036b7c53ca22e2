#pragma once

#include "core/element/moving_element.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {

/// Coordinates of one element as a column: r_A, s_A, r_B, s_B, x_A, x_B.
template <int D>
inline constexpr int element_size = 4 * D + 2;
template <class Real, int D>
using ElementColumn = Eigen::Matrix<Real, element_size<D>, 1>;

template <class Real, int D>
MovingCoordinates<Real, D> coordinates(const ElementColumn<Real, D>& q) {
  return {
      {q.template segment<D>(0), q.template segment<D>(D), q.template segment<D>(2 * D), q.template segment<D>(3 * D)},
      q[4 * D],
      q[4 * D + 1]};
}

template <class Real, int D>
ElementColumn<Real, D> column(const MovingCoordinates<Real, D>& q) {
  ElementColumn<Real, D> result;
  result << q.e.r_a, q.e.s_a, q.e.r_b, q.e.s_b, q.x_a, q.x_b;
  return result;
}

/// An element in some stretched and curved configuration, its slopes well away from zero.
template <int D>
ElementColumn<double, D> random_element(Random& random) {
  const double x_a = random.uniform(0.2, 0.6), x_b = x_a + random.uniform(0.5, 1);
  const Eigen::Matrix<double, D, D> Q = random.rotation<D>();
  const Vec<double, D> along = Q.col(0);
  ElementColumn<double, D> q;
  q << random.vector<D>(), along + random.vector<D>(0.3), Vec<double, D>::Zero(), along + random.vector<D>(0.3), x_a,
      x_b;
  q.template segment<D>(2 * D) = q.template segment<D>(0) + (x_b - x_a) * (along + random.vector<D>(0.2));
  return q;
}

template <int D>
ElementColumn<double, D> random_rates(Random& random) {
  return random.vector<element_size<D>>();
}

/// Mass matrix and force column of the element's equations of motion.
template <int D>
struct DenseEquations {
  Eigen::Matrix<double, element_size<D>, element_size<D>> mass;
  ElementColumn<double, D> force;
};

template <int D>
DenseEquations<D> dense(const MovingEquations<double, D>& eq) {
  DenseEquations<D> result;
  auto& M = result.mass;
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (int j = 0; j < 4; ++j) {
      M.template block<D, D>(i * D, j * D) =
          eq.mass[k][static_cast<std::size_t>(j)] * Eigen::Matrix<double, D, D>::Identity();
    }
    M.template block<D, 1>(i * D, 4 * D) = eq.mass_a[k];
    M.template block<D, 1>(i * D, 4 * D + 1) = eq.mass_b[k];
    M.template block<1, D>(4 * D, i * D) = eq.mass_a[k].transpose();
    M.template block<1, D>(4 * D + 1, i * D) = eq.mass_b[k].transpose();
    result.force.template segment<D>(i * D) = eq.force[k];
  }
  M.template block<2, 2>(4 * D, 4 * D) << eq.mass_aa, eq.mass_ab, eq.mass_ab, eq.mass_bb;
  result.force[4 * D] = eq.force_a;
  result.force[4 * D + 1] = eq.force_b;
  return result;
}

/// Largest entry of a - b over the largest of b.
inline constexpr double rounding = 1e-12;  // of what is computed in two ways, relative

template <class A, class B>
double relative_difference(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace vlbeam::test
