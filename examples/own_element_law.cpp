// An element law of one's own on the library's shape functions and quadrature: a cable of a hardening material,
//   W = EA (eps^2/2 + beta eps^4/4),   eps = (r_x.r_x - 1)/2,
// put through what every element of vlbeam is put through: its force is minus the gradient of its energy, rigid motion
// costs nothing, a rotation turns the force along, and the displacement of a hanging cable converges with order 4.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include <vlbeam/core/element/quadrature.hpp>
#include <vlbeam/core/element/shape_functions.hpp>

namespace {

using namespace vlbeam;
constexpr int D = 2, size = 4 * D;  // r_A, s_A, r_B, s_B
using Column = Eigen::Matrix<double, size, 1>;
using Matrix = Eigen::Matrix<double, size, size>;

struct Cable {
  double EA, beta;

  /// Strain energy [J] of an element of length l [m], its gradient and its tangent; null for what is not wanted.
  double energy(const Column& q, double l, Column* gradient = nullptr, Matrix* tangent = nullptr) const {
    if (gradient) gradient->setZero();
    if (tangent) tangent->setZero();
    double sum = 0;
    for (const auto& [u, weight] : gauss_legendre(5)) {
      const ShapeTable<double> f = hermite_shape(u);
      const std::array<double, 4> s_x{f[0][1] / l, f[1][1], f[2][1] / l, f[3][1]};  // of r_A, s_A, r_B, s_B
      Eigen::Matrix<double, D, size> S = Eigen::Matrix<double, D, size>::Zero();
      for (int i = 0; i < 4; ++i) S.middleCols<D>(D * i).diagonal().setConstant(s_x[static_cast<std::size_t>(i)]);
      const Eigen::Matrix<double, D, 1> r_x = S * q;
      const double eps = (r_x.squaredNorm() - 1) / 2, along = EA * eps * (1 + beta * eps * eps);
      sum += weight * l * EA * eps * eps * (0.5 + 0.25 * beta * eps * eps);
      const Column strain_gradient = S.transpose() * r_x;
      if (gradient) *gradient += weight * l * along * strain_gradient;
      if (tangent) {
        const double stiffness = EA * (1 + 3 * beta * eps * eps);
        *tangent +=
            weight * l * (stiffness * strain_gradient * strain_gradient.transpose() + along * S.transpose() * S);
      }
    }
    return sum;
  }
};

/// Elongation [m] of a cable of length L that hangs from its start under the weight w [N/m], by `count` elements.
double hang(const Cable& cable, double L, double w, int count) {
  const double l = L / count;
  const Eigen::Index n = 2 * D * (count + 1);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(n);
  for (int k = 0; k <= count; ++k) {
    q[2 * D * k + 1] = -l * k;  // hanging down: r = (0, -x)
    q[2 * D * k + 3] = -1;
  }
  const std::vector<Eigen::Index> held{0, 1};
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(n, n);
    for (int k = 0; k < count; ++k) {
      Column gradient;
      Matrix block;
      cable.energy(q.segment<size>(2 * D * k), l, &gradient, &block);
      // The weight's nodal forces: integrals of the cubic shape functions.
      gradient[1] += w * l / 2;
      gradient[3] += w * l * l / 12;
      gradient[5] += w * l / 2;
      gradient[7] -= w * l * l / 12;
      residual.segment<size>(2 * D * k) += gradient;
      tangent.block<size, size>(2 * D * k, 2 * D * k) += block;
    }
    for (const Eigen::Index i : held) {
      residual[i] = 0;
      tangent.row(i).setZero();
      tangent.col(i).setZero();
      tangent(i, i) = 1;
    }
    const Eigen::VectorXd step = tangent.ldlt().solve(residual);
    q -= step;
    if (step.norm() < 1e-14 * q.norm()) break;
  }
  return -q[n - 2 * D + 1] - L;
}

/// The same by integrating the stretch that carries the weight below: EA eps (1 + beta eps^2) sqrt(1 + 2 eps) = w (L -
/// x).
double exact(const Cable& cable, double L, double w) {
  const int pieces = 200;
  double sum = 0;
  for (int k = 0; k < pieces; ++k) {
    for (const auto& [u, weight] : gauss_legendre(5)) {
      const double force = w * L * (1 - (k + u) / pieces);
      double stretch = 1;
      for (int iteration = 0; iteration < 60; ++iteration) {
        const double eps = (stretch * stretch - 1) / 2, along = cable.EA * eps * (1 + cable.beta * eps * eps);
        const double slope = cable.EA * (1 + 3 * cable.beta * eps * eps) * stretch * stretch + along;
        stretch -= (along * stretch - force) / slope;
      }
      sum += weight * (stretch - 1) * L / pieces;
    }
  }
  return sum;
}

int failures = 0;
void check(const char* what, double value, double bound) {
  const bool holds = value <= bound;
  failures += !holds;
  std::cout << (holds ? "holds  " : "FAILS  ") << what << ": " << value << " <= " << bound << '\n';
}

}  // namespace

int main() {
  const Cable cable{2.1, 0.6};
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  const double l = 0.7;
  double by_difference = 0, by_turning = 0, rigid = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Column q, gradient, turned_gradient;
    q << 0, 0, 1, 0, l, 0, 1, 0;
    const double angle = 10 * uniform(engine);
    Eigen::Matrix<double, size, size> turn = Eigen::Matrix<double, size, size>::Zero();
    for (int i = 0; i < 4; ++i) turn.block<D, D>(D * i, D * i) = Eigen::Rotation2Dd(angle).toRotationMatrix();
    cable.energy(turn * q, l, &gradient);
    rigid = std::max({rigid, cable.energy(turn * q, l), gradient.norm()});

    for (int i = 0; i < size; ++i) q[i] += uniform(engine);
    cable.energy(q, l, &gradient);
    cable.energy(turn * q, l, &turned_gradient);
    by_turning = std::max(by_turning, (turned_gradient - turn * gradient).norm());
    for (int i = 0; i < size; ++i) {
      const double h = 1e-5;
      Column ahead = q, behind = q;
      ahead[i] += h;
      behind[i] -= h;
      const double difference = (cable.energy(ahead, l) - cable.energy(behind, l)) / (2 * h);
      by_difference = std::max(by_difference, std::abs(difference - gradient[i]));
    }
  }
  check("the force is minus the gradient of the energy", by_difference, 1e-8);
  check("a rotation turns it along", by_turning, 1e-12);
  check("rigid motion costs nothing", rigid, 1e-12);

  const double reference = exact(cable, 1, 0.8);
  std::vector<double> errors;
  for (const int count : {2, 4, 8, 16}) errors.push_back(std::abs(hang(cable, 1, 0.8, count) - reference));
  std::cout << "elongation " << reference << " m, errors";
  for (const double error : errors) std::cout << ' ' << error;
  std::cout << ", orders";
  double least = 10;  // of all pairs of meshes: never the best of them
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const double order = std::log2(errors[i - 1] / errors[i]);
    std::cout << ' ' << order;
    least = std::min(least, order);
  }
  std::cout << '\n';
  check("4 minus the least order observed", 4 - least, 0.3);
  return failures;
}
