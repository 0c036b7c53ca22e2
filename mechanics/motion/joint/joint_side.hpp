#pragma once

#include "core/beam/span.hpp"
#include "core/element/moving_element.hpp"

namespace vlbeam {

/// One side of a sliding joint: the open node of a span, tied to the joint by a variable-length element. Eliminating
/// that node leaves a mass and a force on the joint's own unknowns: r, one or two slopes of which this side's stands at
/// `Slope`, and x.
template <int D, int Unknowns, int Slope>
class JointSide {
 public:
  using Vector = Vec<double, D>;
  using Components = typename Span<D>::Components;
  static constexpr int unknowns = Unknowns, x = Unknowns - 1;
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
    add_block(mass, 0, Slope, m[j_][j_ + 1] - (c_.rr * next_.rs + c_.sr * next_.ss));
    add_block(mass, Slope, Slope, m[j_ + 1][j_ + 1] - (c_.rs * next_.rs + c_.ss * next_.ss));
    auto out = [&](const Components& a) { return support.out_of_frame(a.matrix()); };
    mass.template block<D, 1>(0, x) += border[j_] - out(c_.rr * next_x_r_ + c_.sr * next_x_s_);
    mass.template block<D, 1>(Slope, x) += border[j_ + 1] - out(c_.rs * next_x_r_ + c_.ss * next_x_s_);
    mass(x, x) += (j_ == 2 ? eq_.mass_bb : eq_.mass_aa) - (h_r * next_x_r_).sum() - (h_s * next_x_s_).sum();
    rhs.template segment<D>(0) -= out(c_.rr * y_r_ + c_.sr * y_s_);
    rhs.template segment<D>(Slope) -= out(c_.rs * y_r_ + c_.ss * y_s_);
    rhs(x) -= (h_r * y_r_).sum() + (h_s * y_s_).sum();
  }

  /// Acceleration of the open node, given the joint's, in place of its force.
  void substitute(const Column& joint, double* force) const {
    const auto& support = span_.support();
    const Components a_r = support.into_frame(joint.template segment<D>(0)).array();
    const Components a_s = support.into_frame(joint.template segment<D>(Slope)).array();
    const double a_x = joint(x);
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

}  // namespace vlbeam
