#include "mechanics/statics/linear_motion.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"

namespace vlbeam {
namespace {

constexpr double oscillating = 1e-6;  // imaginary part over modulus, above which a pair oscillates

}  // namespace

std::vector<std::complex<double>> eigenvalues(const LinearMotion& motion) {
  const Eigen::Index n = motion.M.rows();
  std::vector<std::complex<double>> values;
  if (n == 0) return values;
  // of nu = 1/lambda, nu^2 K + nu C + M: its large eigenvalues, the slow motions, come out to rounding, whatever the
  // stiffness of the fast ones
  const Eigen::PartialPivLU<Eigen::MatrixXd> stiffness(motion.K);
  const Eigen::MatrixXd mass = stiffness.solve(motion.M), damping = stiffness.solve(motion.C);
  if (!mass.allFinite() || !damping.allFinite()) {
    throw ComputationFailed("the linearised motion has a singular stiffness, as at a critical speed or load", 0);
  }
  const double time = std::sqrt(mass.norm());  // the unit that makes both halves of the companion matrix alike
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -mass / (time * time);
  companion.bottomRightCorner(n, n) = -damping / time;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
  if (solver.info() != Eigen::Success) throw ComputationFailed("the eigenvalue solver does not converge", 0);
  for (Eigen::Index i = 0; i < 2 * n; ++i) values.push_back(1.0 / (time * solver.eigenvalues()[i]));
  std::ranges::sort(values, {}, [](const std::complex<double>& z) { return portable::abs(z); });
  return values;
}

std::vector<double> frequencies(const std::vector<std::complex<double>>& eigenvalues) {
  std::vector<double> result;
  for (const auto& z : eigenvalues) {
    if (z.imag() > oscillating * portable::abs(z)) result.push_back(z.imag() / (2 * std::numbers::pi));
  }
  std::ranges::sort(result);
  return result;
}

double growth_rate(const std::vector<std::complex<double>>& eigenvalues) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& z : eigenvalues) largest = std::max(largest, z.real());
  return largest;
}

}  // namespace vlbeam
