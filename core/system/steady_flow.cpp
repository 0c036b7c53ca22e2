#include "core/system/steady_flow.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "core/system/implicit_flow.hpp"

namespace vlbeam {
namespace {

constexpr int most_iterations = 50;
constexpr double converged = 1e-13;   // Newton's correction over the size of the coordinates
constexpr double oscillating = 1e-6;  // imaginary part over modulus, above which a pair oscillates

}  // namespace

double stretch_under(double force, double EA, StrainLaw law) {
  if (law == StrainLaw::engineering) return 1 + force / EA;
  if (!(force > -EA / (3 * std::numbers::sqrt3))) {
    std::ostringstream text;
    text << force;
    throw InvalidInput("/force", text.str(),
                       "a force above -EA/(3 sqrt 3) [N]: below, a beam of the green law collapses");
  }
  double stretch = 1;
  for (int i = 0; i < most_iterations; ++i) {
    stretch -= ((stretch * stretch - 1) * stretch / 2 - force / EA) / (1.5 * stretch * stretch - 0.5);
  }
  return stretch;
}

template <int D>
Eigen::VectorXd steady_state(FlowingBeam<D>& beam, const Eigen::VectorXd& guess, double t, bool unstable) {
  ImplicitFlow<D> flow(beam);
  const Eigen::Index n = beam.coordinates();
  Eigen::VectorXd q = guess.head(n), r(n);
  const Eigen::VectorXd v = guess.segment(n, n), a = Eigen::VectorXd::Zero(n);
  const std::vector<FieldRun> fields = flow.fields();
  const auto nodes = beam.nodes_at(t);
  const double length = nodes.back().value - nodes.front().value;
  FieldNorms natural;  // sizes below which a field's rounding is no error
  natural.fill(1);
  natural[static_cast<std::size_t>(Field::position)] = length;
  natural[static_cast<std::size_t>(Field::twist)] = 1 / length;
  double last = 1;
  for (int i = 0;; ++i) {
    flow.residual(q, v, a, t, r);
    if (!r.allFinite() || !flow.linearize(q, v, a, t, 0, 0)) {
      throw ComputationFailed("no steady state: the tangent is singular, as at a critical speed or load", t);
    }
    flow.solve(r);
    q -= r;
    const FieldNorms corrections = field_norms(fields, r), sizes = field_norms(fields, q);
    double correction = 0;
    for (std::size_t f = 0; f < field_count; ++f) {
      correction = std::max(correction, corrections[f] / std::max(sizes[f], natural[f]));
    }
    if (correction <= converged || (correction < 1e-10 && correction >= last)) break;
    if (!r.allFinite() || i == most_iterations) {
      throw ComputationFailed("no steady state: Newton's method does not converge", t);
    }
    last = correction;
  }
  if (!unstable) {
    const auto K = flow.free_tangent(q, v, a, t, {1, 0, 0});
    auto positive = [](const Eigen::MatrixXd& k) {
      return k.size() == 0 || Eigen::LLT<Eigen::MatrixXd>((k + k.transpose()) / 2).info() == Eigen::Success;
    };
    if (!positive(K.axis) || !positive(K.angles)) {
      throw ComputationFailed(
          "no stable steady state: the beam flows at or above its critical speed, or is loaded beyond buckling", t);
    }
  }
  Eigen::VectorXd y = guess;
  y.head(n) = q;
  return y;
}

template <int D>
LinearFlows linear_flows(FlowingBeam<D>& beam, const Eigen::VectorXd& y, double t) {
  ImplicitFlow<D> flow(beam);
  const Eigen::Index n = beam.coordinates();
  const Eigen::VectorXd q = y.head(n), v = y.segment(n, n), a = Eigen::VectorXd::Zero(n);
  const auto K = flow.free_tangent(q, v, a, t, {1, 0, 0});
  const auto C = flow.free_tangent(q, v, a, t, {0, 1, 0});
  const auto M = flow.free_tangent(q, v, a, t, {0, 0, 1});
  return {{M.axis, C.axis, K.axis}, {M.angles, C.angles, K.angles}};
}

std::vector<std::complex<double>> eigenvalues(const LinearFlow& flow) {
  const Eigen::Index n = flow.M.rows();
  std::vector<std::complex<double>> values;
  if (n == 0) return values;
  // of nu = 1/lambda, nu^2 K + nu C + M: its large eigenvalues, the slow motions, come out to rounding, whatever the
  // stiffness of the fast ones
  const Eigen::PartialPivLU<Eigen::MatrixXd> stiffness(flow.K);
  const Eigen::MatrixXd mass = stiffness.solve(flow.M), damping = stiffness.solve(flow.C);
  if (!mass.allFinite() || !damping.allFinite()) {
    throw ComputationFailed("the linearised flow has a singular stiffness, as at a critical speed or load", 0);
  }
  const double time = std::sqrt(mass.norm());  // the unit that makes both halves of the companion matrix alike
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -mass / (time * time);
  companion.bottomRightCorner(n, n) = -damping / time;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
  if (solver.info() != Eigen::Success) throw ComputationFailed("the eigenvalue solver does not converge", 0);
  for (Eigen::Index i = 0; i < 2 * n; ++i) values.push_back(1.0 / (time * solver.eigenvalues()[i]));
  std::ranges::sort(values, {}, [](const std::complex<double>& z) { return std::abs(z); });
  return values;
}

std::vector<double> frequencies(const std::vector<std::complex<double>>& eigenvalues) {
  std::vector<double> result;
  for (const auto& z : eigenvalues) {
    if (z.imag() > oscillating * std::abs(z)) result.push_back(z.imag() / (2 * std::numbers::pi));
  }
  std::ranges::sort(result);
  return result;
}

double growth_rate(const std::vector<std::complex<double>>& eigenvalues) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& z : eigenvalues) largest = std::max(largest, z.real());
  return largest;
}

template Eigen::VectorXd steady_state(FlowingBeam<2>&, const Eigen::VectorXd&, double, bool);
template Eigen::VectorXd steady_state(FlowingBeam<3>&, const Eigen::VectorXd&, double, bool);
template LinearFlows linear_flows(FlowingBeam<2>&, const Eigen::VectorXd&, double);
template LinearFlows linear_flows(FlowingBeam<3>&, const Eigen::VectorXd&, double);

}  // namespace vlbeam
