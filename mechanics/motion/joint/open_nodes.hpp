#pragma once

#include <Eigen/Core>

#include "core/beam/node_map.hpp"
#include "core/beam/span_between.hpp"
#include "core/element/moving_element.hpp"

namespace vlbeam {

/// What ties two neighbouring joints: M of (r, slope, x) of the one and of the other, and the forces that come with it.
/// Slopes are those on the sides that face each other. The numbers of `mass` stand for multiples of the identity.
template <int D>
struct JointTie {
  Eigen::Matrix4d mass;                    ///< of r and slope of the one, r and slope of the other
  Eigen::Matrix<double, 4, D> by_a, by_b;  ///< coupling of those with x of the one and of the other
  double aa, ab, bb;
};

/// The open nodes of a run of resting elements between two joints, one where the run has no element, else two. With
/// them eliminated, the run and the variable-length elements beside it are a tie of the two joints.
template <int D>
class OpenNodes {
 public:
  using Two = Eigen::Matrix2d;
  using Node = Eigen::Matrix<double, 2, D>;  ///< position and slope, as rows

  /// `before` is the element from the one joint to the run, `behind` that from the run to the other.
  OpenNodes(const SpanBetween<D>& run, const MovingEquations<double, D>& before,
            const MovingEquations<double, D>& behind)
      : low_(run.low()), high_(run.high()) {
    const Two at_low = part(before.mass, 2, 2), at_high = part(behind.mass, 0, 0);
    if (low_ == high_) {
      ll_ = lh_ = hh_ = inverse(at_low + at_high);
    } else {
      const auto& l = run.low_low();
      const auto& c = run.low_high();
      const auto& h = run.high_high();
      const Two low = inverse(at_low + two(l.rr, l.rs, l.sr, l.ss)), coupling = two(c.rr, c.rs, c.sr, c.ss);
      const Two next = low * coupling;
      hh_ = inverse(at_high + two(h.rr[0], h.rs[0], h.rs[0], h.ss[0]) - coupling.transpose() * next);
      lh_ = -next * hh_;
      ll_ = low - lh_ * next.transpose();
    }
    to_a_ = part(before.mass, 2, 0);
    to_b_ = part(behind.mass, 0, 2);
    to_x_a_ << before.mass_a[2].transpose(), before.mass_a[3].transpose();
    to_x_b_ << behind.mass_b[0].transpose(), behind.mass_b[1].transpose();
  }

  /// The tie that is left, with the elements `before` and `behind`.
  void condense(const MovingEquations<double, D>& before, const MovingEquations<double, D>& behind,
                JointTie<D>& tie) const {
    const Two a_l = to_a_.transpose() * ll_, a_h = to_a_.transpose() * lh_, b_l = to_b_.transpose() * lh_.transpose(),
              b_h = to_b_.transpose() * hh_;
    tie.mass.template topLeftCorner<2, 2>() = part(before.mass, 0, 0) - a_l * to_a_;
    tie.mass.template topRightCorner<2, 2>() = -a_h * to_b_;
    tie.mass.template bottomRightCorner<2, 2>() = part(behind.mass, 2, 2) - b_h * to_b_;
    tie.by_a << before.mass_a[0].transpose(), before.mass_a[1].transpose(), Node::Zero();
    tie.by_b << Node::Zero(), behind.mass_b[2].transpose(), behind.mass_b[3].transpose();
    tie.by_a.template topRows<2>() -= a_l * to_x_a_;
    tie.by_a.template bottomRows<2>() -= b_l * to_x_a_;
    tie.by_b.template topRows<2>() -= a_h * to_x_b_;
    tie.by_b.template bottomRows<2>() -= b_h * to_x_b_;
    const Node to_b = lh_ * to_x_b_;
    tie.aa = before.mass_aa - to_x_a_.cwiseProduct(ll_ * to_x_a_).sum();
    tie.ab = -to_x_a_.cwiseProduct(to_b).sum();
    tie.bb = behind.mass_bb - to_x_b_.cwiseProduct(hh_ * to_x_b_).sum();
  }

  /// What the forces on the open nodes leave on a joint: on r and slope, and on x.
  struct Force {
    Node nodal;
    double x;
  };
  void reduce(const double* force, Force& on_a, Force& on_b) {
    const Node low = at(force, low_);
    y_l_ = ll_ * low;
    y_h_ = y_l_;
    if (low_ != high_) {
      const Node high = at(force, high_);
      y_h_ = lh_.transpose() * low + hh_ * high;
      y_l_ += lh_ * high;
    }
    on_a = {-to_a_.transpose() * y_l_, -to_x_a_.cwiseProduct(y_l_).sum()};
    on_b = {-to_b_.transpose() * y_h_, -to_x_b_.cwiseProduct(y_h_).sum()};
  }

  /// Accelerations of the open nodes by those of the joints, r and slope, and x.
  void substitute(const Node& a, double x_a, const Node& b, double x_b, double* force) const {
    const Node by_a = to_a_ * a + to_x_a_ * x_a, by_b = to_b_ * b + to_x_b_ * x_b;
    at(force, low_) = y_l_ - ll_ * by_a - lh_ * by_b;
    if (low_ != high_) at(force, high_) = y_h_ - lh_.transpose() * by_a - hh_ * by_b;
  }

 private:
  using InRows = Eigen::Matrix<double, 2, D, Eigen::RowMajor>;
  static Eigen::Map<InRows> at(double* nodes, int k) { return Eigen::Map<InRows>(nodes + node_size<D> * k); }
  static Eigen::Map<const InRows> at(const double* nodes, int k) {
    return Eigen::Map<const InRows>(nodes + node_size<D> * k);
  }
  static Two two(double rr, double rs, double sr, double ss) {
    Two block;
    block << rr, rs, sr, ss;
    return block;
  }
  static Two part(const std::array<std::array<double, 4>, 4>& m, std::size_t i, std::size_t j) {
    return two(m[i][j], m[i][j + 1], m[i + 1][j], m[i + 1][j + 1]);
  }
  static Two inverse(const Two& a) {
    return two(a(1, 1), -a(0, 1), -a(0, 1), a(0, 0)) * (1 / (a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1)));
  }

  int low_, high_;
  Two ll_, lh_, hh_;      ///< inverse of the mass of the open nodes
  Two to_a_, to_b_;       ///< coupling of the low node with the one joint, of the high one with the other
  Node to_x_a_, to_x_b_;  ///< with their x
  Node y_l_, y_h_;        ///< accelerations while the joints rest
};

}  // namespace vlbeam
