// Jacobian of the equations of motion in first order, from the exact tangent of their residual r = M a - Q:
//   d(q')/dt = a(q, q'),   da/dq = -M^-1 dr/dq,   da/dq' = -M^-1 dr/dq'.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "mechanics/motion/system/implicit_beam.hpp"

namespace vlbeam {
template <int D>
void ImplicitBeam<D>::jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) {
  if (of_unknowns_) {
    throw ModelError("integrator", "\"rosenbrock4\"",
                     "its Jacobian knows no angles of sections: take any other integrator");
  }
  refresh();
  const Eigen::Index n = coordinates();
  Eigen::VectorXd exact = y;
  beam_.impose(exact, t);
  const Eigen::VectorXd q = exact.head(n), v = exact.segment(n, n);
  a_.resize(n);
  acceleration(q, v, t, a_);

  auto tangent = [&](const TangentWeights& by, Eigen::MatrixXd& dense) {
    equations_.assemble(q, v, a_, t, by, tangent_);
    dense.setZero(n, n);
    tangent_.expand(dense);
    for (Eigen::Index k = 0; k < n; ++k) supports().project(dense.col(k).data());
  };
  tangent({1, 0, 0}, stiffness_);
  tangent({0, 1, 0}, damping_);

  dfdy.setZero();
  dfdy.block(0, n, n, n).setIdentity();
  if (!linearize(q, v, a_, t, {0, 0, 1})) {  // outside the domain, as rhs() says it
    dfdy.setConstant(std::numeric_limits<double>::quiet_NaN());
    dfdt.setZero();
    return;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    column_ = stiffness_.col(k);
    solve(column_);
    dfdy.block(n, k, n, 1) = -column_;
    column_ = damping_.col(k);
    solve(column_);
    dfdy.block(n, n + k, n, 1) = -column_;
  }
  if (y.size() > 2 * n) add_tallies(exact, t, dfdy);

  dfdt.setZero();
  const auto& model = beam_.model();
  const bool rubs = model.rubs();
  if (model.driven() || beam_.prescribed_mesh() != nullptr || model.balance().loads ||
      (rubs && t < model.gravity_ramp)) {
    add_drive(exact, t, dfdy, dfdt);
  } else if (t < model.gravity_ramp) {  // time is in the share of gravity alone, and f is affine in that
    weightless_.resize(y.size());
    accelerations_.rates(y, weightless_, 0);
    accelerations_.rates(y, dfdt, model.gravity_ramp);
    dfdt = smooth_ramp(t, model.gravity_ramp).rate * (dfdt - weightless_);
  }
}

/// By differences: nothing depends on the energies that the state counts, so that their rows only serve their own
/// accuracy. The step is a share of an element, of a slope, and of the speed of axial waves: powers are quadratic in
/// velocities, however large, but for friction, which has a velocity of its own.
template <int D>
void ImplicitBeam<D>::add_tallies(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy) {
  const Eigen::Index n = coordinates(), balance = y.size() - 2 * n;
  double sliding = std::numeric_limits<double>::infinity();  // velocity at which friction fades
  for (const auto& joint : beam_.model().joints) {
    if (joint.law.friction) sliding = std::min(sliding, joint.law.friction->velocity);
  }
  Eigen::VectorXd more(y.size());
  auto difference = [&](Eigen::Index k, double size) {
    rhs_difference(y, t, k, size, more);
    dfdy.col(k).tail(balance) = more.tail(balance);
  };
  for_each_coordinate(beam_.dofs().fields(beam_.unknowns()), [&](Field field, Eigen::Index k) {
    const double size = field == Field::slope ? 1 : element_length();
    difference(k, size);
    difference(n + k, field == Field::mark && std::isfinite(sliding) ? sliding : size / wave_time());
  });
}

/// Central, of the right-hand side by the entry k of y, which is of the given size.
template <int D>
void ImplicitBeam<D>::rhs_difference(const Eigen::VectorXd& y, double t, Eigen::Index k, double size,
                                     Eigen::VectorXd& result) {
  const double step = portable::cbrt(std::numeric_limits<double>::epsilon()) * size;
  Eigen::VectorXd at = y, less(y.size());
  at[k] = y[k] + step;
  const double above = at[k];
  accelerations_.rates(at, result, t);
  at[k] = y[k] - step;
  accelerations_.rates(at, less, t);
  result = (result - less) / (above - at[k]);
}

template <int D>
double ImplicitBeam<D>::element_length() const {
  return beam_.mesh().length() / beam_.mesh().elements();
}

template <int D>
double ImplicitBeam<D>::wave_time() const {
  const BeamSection& section = beam_.model().section;
  return element_length() * std::sqrt(section.rhoA / section.stiffness.EA);
}

/// Nothing depends on driven entries of the state. The derivative by time is differenced: a support's function of time
/// comes with two derivatives only, and accelerations take them both.
template <int D>
void ImplicitBeam<D>::add_drive(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) {
  at_guides([&](std::size_t i) {
    dfdy.col(places()[i].mark).setZero();
    dfdy.col(coordinates() + places()[i].mark).setZero();
  });
  for (const HeldNode<D>& held : supports().nodes()) {
    if (held.motion == nullptr) continue;
    const Support<D>& support = *held.built;  // its frame does not matter for its point
    const Eigen::Matrix<double, D, D> keep =
        support.frame * support.free_position.matrix().asDiagonal() * support.frame.transpose();
    const Eigen::Index position = Eigen::Index{B} * held.node;
    for (const Eigen::Index first : {position, coordinates() + position}) {
      dfdy.middleCols<D>(first) = (dfdy.middleCols<D>(first) * keep).eval();
    }
    if (!held.turns()) continue;
    Eigen::VectorXd column(y.size());  // what turns depends on the slope that it turns
    for (Eigen::Index k = position + D; k < position + 2 * D; ++k) {
      rhs_difference(y, t, k, 1, column);
      dfdy.col(k) = column;
      rhs_difference(y, t, coordinates() + k, 1 / wave_time(), column);
      dfdy.col(coordinates() + k) = column;
    }
  }
  const double instant = 1e-3 * wave_time();  // far below the period of anything that the mesh follows
  struct Look {
    int step;
    double weight;
  };
  const std::vector<Look> around{{-2, 1.0 / 12}, {-1, -2.0 / 3}, {1, 2.0 / 3}, {2, -1.0 / 12}};
  const std::vector<Look> ahead{{0, -25.0 / 12}, {1, 4}, {2, -3}, {3, 4.0 / 3}, {4, -0.25}};  // none before t = 0
  Eigen::VectorXd there(y.size());
  for (const auto& [step, weight] : t < 2 * instant ? ahead : around) {
    accelerations_.rates(y, there, t + step * instant);
    dfdt += weight / instant * there;
  }
}

template double ImplicitBeam<2>::element_length() const;
template double ImplicitBeam<2>::wave_time() const;
template void ImplicitBeam<2>::add_drive(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);
template double ImplicitBeam<3>::element_length() const;
template double ImplicitBeam<3>::wave_time() const;
template void ImplicitBeam<3>::add_drive(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);
template void ImplicitBeam<2>::rhs_difference(const Eigen::VectorXd&, double, Eigen::Index, double, Eigen::VectorXd&);
template void ImplicitBeam<2>::add_tallies(const Eigen::VectorXd&, double, Eigen::MatrixXd&);
template void ImplicitBeam<2>::jacobian(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);
template void ImplicitBeam<3>::rhs_difference(const Eigen::VectorXd&, double, Eigen::Index, double, Eigen::VectorXd&);
template void ImplicitBeam<3>::add_tallies(const Eigen::VectorXd&, double, Eigen::MatrixXd&);
template void ImplicitBeam<3>::jacobian(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&);

}  // namespace vlbeam
