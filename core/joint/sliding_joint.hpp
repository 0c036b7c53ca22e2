#pragma once

#include <Eigen/Cholesky>

#include "core/beam/span.hpp"
#include "core/element/moving_element.hpp"

namespace vlbeam {

/// A lumped mass [kg] that slides along the beam: the node it sits on moves with it, r and r_x shared by both sides.
struct SlidingJoint {
  double mass;
};

namespace detail {

/// One side of a sliding joint: the open node of a span, tied to the joint by a variable-length element. Eliminating
/// that node leaves a mass and a force on the joint's own unknowns (r, r_x, x).
template <int D>
class JointSide {
 public:
  using Vector = Vec<double, D>;
  using Components = typename Span<D>::Components;
  static constexpr int unknowns = 2 * D + 1;
  using Matrix = Eigen::Matrix<double, unknowns, unknowns>;
  using Column = Eigen::Matrix<double, unknowns, 1>;

  /// `joint_end` is 0 where the joint is the element's end A, 2 where it is its end B.
  JointSide(const Span<D>& span, const MovingEquations<double, D>& eq, std::size_t joint_end)
      : span_(span), j_(joint_end), i_(2 - joint_end), eq_(eq) {
    const auto& m = eq.mass;
    NodeBlock<D> block = span.open_mass();
    block.rr += m[i_][i_];
    block.rs += m[i_][i_ + 1];
    block.ss += m[i_ + 1][i_ + 1];
    inverse_ = block.inverse(span.open_free_position(), span.open_free_slope());
    c_ = {m[i_][j_], m[i_][j_ + 1], m[i_ + 1][j_], m[i_ + 1][j_ + 1]};
  }

  /// Adds what this side leaves on the joint; `force` is the nodal array with the span already reduced.
  void eliminate(const double* force, Matrix& mass, Column& rhs) {
    const auto& support = span_.support();
    const auto& m = eq_.mass;
    const auto& border = j_ == 2 ? eq_.mass_b : eq_.mass_a;
    const Components h_r = support.into_frame(border[i_]).array(), h_s = support.into_frame(border[i_ + 1]).array();
    const Components f_r = support.into_frame(position<D>(force, span_.open())).array();
    const Components f_s = support.into_frame(slope<D>(force, span_.open())).array();
    next_ = {inverse_.rr * c_.rr + inverse_.rs * c_.sr, inverse_.rr * c_.rs + inverse_.rs * c_.ss,
             inverse_.rs * c_.rr + inverse_.ss * c_.sr, inverse_.rs * c_.rs + inverse_.ss * c_.ss};
    next_x_r_ = inverse_.rr * h_r + inverse_.rs * h_s;
    next_x_s_ = inverse_.rs * h_r + inverse_.ss * h_s;
    y_r_ = inverse_.rr * f_r + inverse_.rs * f_s;
    y_s_ = inverse_.rs * f_r + inverse_.ss * f_s;

    add_block(mass, 0, 0, m[j_][j_] - (c_.rr * next_.rr + c_.sr * next_.sr));
    add_block(mass, 0, D, m[j_][j_ + 1] - (c_.rr * next_.rs + c_.sr * next_.ss));
    add_block(mass, D, D, m[j_ + 1][j_ + 1] - (c_.rs * next_.rs + c_.ss * next_.ss));
    auto out = [&](const Components& a) { return support.out_of_frame(a.matrix()); };
    mass.template block<D, 1>(0, 2 * D) += border[j_] - out(c_.rr * next_x_r_ + c_.sr * next_x_s_);
    mass.template block<D, 1>(D, 2 * D) += border[j_ + 1] - out(c_.rs * next_x_r_ + c_.ss * next_x_s_);
    mass(2 * D, 2 * D) += (j_ == 2 ? eq_.mass_bb : eq_.mass_aa) - (h_r * next_x_r_).sum() - (h_s * next_x_s_).sum();
    rhs.template segment<D>(0) -= out(c_.rr * y_r_ + c_.sr * y_s_);
    rhs.template segment<D>(D) -= out(c_.rs * y_r_ + c_.ss * y_s_);
    rhs(2 * D) -= (h_r * y_r_).sum() + (h_s * y_s_).sum();
  }

  /// Acceleration of the open node, given the joint's, in place of its force.
  void substitute(const Column& joint, double* force) const {
    const auto& support = span_.support();
    const Components a_r = support.into_frame(joint.template segment<D>(0)).array();
    const Components a_s = support.into_frame(joint.template segment<D>(D)).array();
    const double a_x = joint(2 * D);
    const Components x_r = y_r_ - (next_.rr * a_r + next_.rs * a_s) - next_x_r_ * a_x;
    const Components x_s = y_s_ - (next_.sr * a_r + next_.ss * a_s) - next_x_s_ * a_x;
    position<D>(force, span_.open()) = support.out_of_frame(x_r.matrix());
    slope<D>(force, span_.open()) = support.out_of_frame(x_s.matrix());
  }

 private:
  void add_block(Matrix& mass, int row, int column, const Components& diagonal) const {
    const auto& support = span_.support();
    if (support.aligned) {
      mass.template block<D, D>(row, column).diagonal() += diagonal.matrix();
    } else {
      mass.template block<D, D>(row, column) +=
          support.frame * diagonal.matrix().asDiagonal() * support.frame.transpose();
    }
  }

  const Span<D>& span_;
  std::size_t j_, i_;
  const MovingEquations<double, D>& eq_;
  NodeBlock<D> inverse_;
  CouplingBlock<double> c_;
  CouplingBlock<Components> next_;
  Components next_x_r_, next_x_s_, y_r_, y_s_;
};

}  // namespace detail

/// Solves M a = f of two spans joined by a sliding joint at node left.open() + 1. On entry `force` is the nodal array
/// of forces and `force_x` that on the joint's material coordinate; on return they are the accelerations.
/// Cost: one sweep over each span and a dense system of 2 D + 1 unknowns. Returns false where the joint's mass matrix
/// is not positive definite (a massless joint where curvature is continuous).
template <int D>
bool solve_with_joint(const Span<D>& left, const Span<D>& right, const MovingEquations<double, D>& left_element,
                      const MovingEquations<double, D>& right_element, const SlidingJoint& joint, double* force,
                      double& force_x) {
  using Side = detail::JointSide<D>;
  const int node = left.open() + 1;
  left.reduce(force);
  right.reduce(force);
  typename Side::Matrix mass = Side::Matrix::Zero();
  typename Side::Column rhs;
  rhs << position<D>(force, node), slope<D>(force, node), force_x;
  mass.diagonal().template head<D>().array() += joint.mass;
  Side left_side(left, left_element, 2), right_side(right, right_element, 0);
  left_side.eliminate(force, mass, rhs);
  right_side.eliminate(force, mass, rhs);
  const Eigen::LLT<typename Side::Matrix, Eigen::Upper> factor(mass);
  if (factor.info() != Eigen::Success) return false;
  const typename Side::Column a = factor.solve(rhs);
  left_side.substitute(a, force);
  right_side.substitute(a, force);
  position<D>(force, node) = a.template segment<D>(0);
  slope<D>(force, node) = a.template segment<D>(D);
  force_x = a(2 * D);
  left.substitute(force);
  right.substitute(force);
  return true;
}

/// Solves M a = f of two spans that share their open node, in place.
template <int D>
void solve_without_joint(const Span<D>& left, const Span<D>& right, double* force) {
  constexpr int unknowns = 2 * D;
  left.reduce(force);
  right.reduce(force);
  Eigen::Matrix<double, unknowns, unknowns> mass = Eigen::Matrix<double, unknowns, unknowns>::Zero();
  for (const Span<D>* span : {&left, &right}) {
    const auto& frame = span->support().frame;
    const auto& block = span->open_mass();
    mass.template block<D, D>(0, 0) += frame * block.rr.matrix().asDiagonal() * frame.transpose();
    mass.template block<D, D>(0, D) += frame * block.rs.matrix().asDiagonal() * frame.transpose();
    mass.template block<D, D>(D, D) += frame * block.ss.matrix().asDiagonal() * frame.transpose();
  }
  Eigen::Map<Eigen::Matrix<double, unknowns, 1>> at_node(force + node_size<D> * left.open());
  at_node = mass.template selfadjointView<Eigen::Upper>().llt().solve(at_node.eval());
  left.substitute(force);
  right.substitute(force);
}

}  // namespace vlbeam
