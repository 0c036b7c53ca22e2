// Jacobian of the equations of motion in first order, from the exact tangent of their residual r = M a - Q:
//   d(q')/dt = a(q, q'),   da/dq = -M^-1 dr/dq,   da/dq' = -M^-1 dr/dq'.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/system/implicit_beam.hpp"

namespace vlbeam {
namespace {

// The tangent is dr/dq + by_v dr/dv + by_a dr/da: a factor this large leaves nothing else of it, and a power of two is
// taken out again without rounding.
constexpr double dominant = 0x1p100;

}  // namespace

template <int D>
void ImplicitBeam<D>::jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) {
  refresh();
  const Eigen::Index n = coordinates();
  Eigen::VectorXd exact = y;
  system_.impose(exact, t);
  const Eigen::VectorXd q = exact.head(n), v = exact.segment(n, n);
  a_.resize(n);
  acceleration(q, v, t, a_);

  auto tangent = [&](double by_v, Eigen::MatrixXd& dense) {
    assemble(q, v, a_, t, by_v, 0);
    dense.setZero(n, n);
    tangent_.expand(dense);
    for (Eigen::Index k = 0; k < n; ++k) project(dense.col(k).data());
  };
  tangent(0, stiffness_);
  tangent(dominant, damping_);

  dfdy.setZero();
  dfdy.block(0, n, n, n).setIdentity();
  if (!linearize(q, v, a_, t, 0, dominant)) {  // outside the domain, as rhs() says it
    dfdy.setConstant(std::numeric_limits<double>::quiet_NaN());
    dfdt.setZero();
    return;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    column_ = stiffness_.col(k);
    solve(column_);
    dfdy.block(n, k, n, 1) = -dominant * column_;
    column_ = damping_.col(k);
    solve(column_);
    dfdy.block(n, n + k, n, 1) = -column_;
  }
  if (system_.model().dissipates()) add_dissipation_row(exact, t, dfdy);

  dfdt.setZero();
  if (driven()) {
    add_drive(exact, t, dfdy, dfdt);
    return;
  }
  const double ramp = system_.model().gravity_ramp;
  if (t < ramp) {  // time is in the share of gravity alone, and f is affine in that
    weightless_.resize(y.size());
    system_.rhs(y, weightless_, 0);
    system_.rhs(y, dfdt, ramp);
    dfdt = smooth_ramp(t, ramp).rate * (dfdt - weightless_);
  }
}

/// By differences: nothing depends on the dissipated energy, so that this row only serves its own accuracy.
template <int D>
void ImplicitBeam<D>::add_dissipation_row(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy) {
  const Eigen::Index n = coordinates(), last = 2 * n;
  Eigen::VectorXd q = y.head(n), v = y.segment(n, n);
  column_.resize(n);
  auto power = [&] { return residual(q, v, a_, t, column_); };
  for (Eigen::Index k = 0; k < 2 * n; ++k) {
    const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * std::max(1.0, std::abs(y[k]));
    double& entry = k < n ? q[k] : v[k - n];
    entry = y[k] + step;
    const double more = power();
    entry = y[k] - step;
    dfdy(last, k) = (more - power()) / (2 * step);
    entry = y[k];
  }
}

/// Nothing depends on driven entries of the state, everything on time. The work of the supports and the derivative by
/// time are differenced: a function of time comes with two derivatives only, and accelerations take them both.
template <int D>
void ImplicitBeam<D>::add_drive(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) {
  const Eigen::Index n = coordinates(), last = y.size() - 1;
  const double share = std::cbrt(std::numeric_limits<double>::epsilon());
  Eigen::VectorXd at = y, more(y.size()), less(y.size());
  for (Eigen::Index k = 0; k < 2 * n; ++k) {
    const double step = share * std::max(1.0, std::abs(y[k]));
    at[k] = y[k] + step;
    system_.rhs(at, more, t);
    at[k] = y[k] - step;
    system_.rhs(at, less, t);
    at[k] = y[k];
    dfdy(last, k) = (more[last] - less[last]) / (2 * step);
  }
  const auto& model = system_.model();
  for (const bool start : {true, false}) {
    if (!(start ? model.start_motion : model.end_motion)) continue;
    const Support<D>& support = start ? model.start : model.end;
    const Eigen::Matrix<double, D, D> keep =
        support.frame * support.free_position.matrix().asDiagonal() * support.frame.transpose();
    const Eigen::Index position = start ? 0 : Eigen::Index{B} * (nodes() - 1);
    for (const Eigen::Index first : {position, n + position}) {
      dfdy.middleCols<D>(first) = (dfdy.middleCols<D>(first) * keep).eval();
    }
  }
  constexpr double instant = 1e-6;  // [s], far below the period of anything a beam is shaken with
  system_.rhs(y, more, t + instant);
  system_.rhs(y, less, t - instant);
  dfdt = (more - less) / (2 * instant);
}

template void ImplicitBeam<2>::add_drive(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);
template void ImplicitBeam<3>::add_drive(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);
template void ImplicitBeam<2>::add_dissipation_row(const Eigen::VectorXd&, double, Eigen::MatrixXd&);
template void ImplicitBeam<2>::jacobian(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);
template void ImplicitBeam<3>::add_dissipation_row(const Eigen::VectorXd&, double, Eigen::MatrixXd&);
template void ImplicitBeam<3>::jacobian(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);

}  // namespace vlbeam
