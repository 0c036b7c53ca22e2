#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "core/geometry/dense.hpp"
#include "mechanics/motion/joint/slope_conditions.hpp"

namespace vlbeam {

/// Slopes on the two sides of a joint, of an array like q; where the beam has no kink there they are one.
template <int D>
Eigen::Matrix<double, 2 * D, 1> slopes_at(const JointPlace& place, const double* q) {
  Eigen::Matrix<double, 2 * D, 1> slopes;
  const double* const before = q + Eigen::Index{node_size<D>} * place.node + D;
  slopes << Eigen::Map<const Vec<double, D>>(before),
      Eigen::Map<const Vec<double, D>>(place.behind < 0 ? before : q + place.behind);
  return slopes;
}

/// The conditions C = 0 on the slopes at joints where the beam may be kinked. Each has a multiplier m, whose force on
/// the slopes z is unit m dC/dz.
template <int D>
class Kinks {
 public:
  using Conditions = SlopeConditions<D>;
  using Slopes = typename Conditions::Slopes;

  /// Of one joint.
  struct Kink {
    std::size_t joint;  ///< of those on the beam
    JointPlace place;
    JointSlopes slopes;
    int omitted_axis = 0;    ///< of tangent slopes in space
    bool suspended = false;  ///< the multipliers are then 0
    Conditions of = {slopes, omitted_axis};
  };

  /// After each change of the mesh: those of the joints on the beam. Where supports are eliminated, both slopes at a
  /// sleeve are along it, and tangent ones need no condition.
  template <class System>
  void adopt(const System& system, bool eliminated) {
    const auto old = std::move(kinks_);
    kinks_.clear();
    for (std::size_t i = 0; i < system.places().size(); ++i) {
      if (!system.kinked(i)) continue;
      const JointSlopes slopes = system.joint(i).law.slopes;
      const Support<D>* held = system.held(i);
      const bool sleeve = held != nullptr && (held->free_slope == 0).any();
      if (sleeve && eliminated && slopes == JointSlopes::tangent) continue;
      const int omitted = kinks_.size() < old.size() ? old[kinks_.size()].omitted_axis : 0;
      const Kink kink{.joint = i, .place = system.places()[i], .slopes = slopes, .omitted_axis = omitted};
      if (kink.of.count() > 0) kinks_.push_back(kink);
    }
  }
  const std::vector<Kink>& all() const { return kinks_; }
  std::vector<Kink>& all() { return kinks_; }
  int count() const {
    int count = 0;
    for (const Kink& kink : kinks_) count += kink.of.count();
    return count;
  }
  /// Of those that are not suspended.
  int active() const {
    int count = 0;
    for (const Kink& kink : kinks_) count += kink.suspended ? 0 : kink.of.count();
    return count;
  }
  void omit(Kink& kink, int axis) const {
    kink.omitted_axis = axis;
    kink.of = {kink.slopes, axis};
  }
  /// In space the components of the cross product change over only where the slope has turned far away: they change the
  /// multipliers' meaning. Calls changed(first multiplier, how many).
  template <class Function>
  void choose(const double* q, const Function& changed) {
    Eigen::Index at = 0;
    for (Kink& kink : kinks_) {
      const Vec<double, D> before = slope<D>(q, kink.place.node);
      if (D == 3 && std::abs(before[kink.omitted_axis]) < 0.4 * before.norm()) {
        omit(kink, longest_axis<D>(before));
        changed(at, kink.of.count());
      }
      at += kink.of.count();
    }
  }

  /// Adds the forces of the multipliers to r, an array like q.
  void add_forces(const double* q, const double* multipliers, double unit, double* r) const {
    at_each([&](const Kink& kink, int i, Eigen::Index at) {
      if (kink.suspended) return;
      const Slopes force = unit * multipliers[at] * kink.of.gradient(i, slopes_at<D>(kink.place, q));
      slope<D>(r, kink.place.node) += force.template head<D>();
      Eigen::Map<Vec<double, D>>(r + kink.place.behind) += force.template tail<D>();
    });
  }
  /// Writes how far the slopes are from the conditions [-]; of suspended ones, the multipliers.
  void write_values(const double* q, const double* multipliers, double* values) const {
    at_each([&](const Kink& kink, int i, Eigen::Index at) {
      values[at] = kink.suspended ? multipliers[at] : kink.of.value(i, slopes_at<D>(kink.place, q));
    });
  }
  void write_rates(const double* q, const double* v, double* rates) const {
    at_each([&](const Kink& kink, int i, Eigen::Index at) {
      rates[at] = kink.of.rate(i, slopes_at<D>(kink.place, q), slopes_at<D>(kink.place, v));
    });
  }
  /// Adds what the multipliers change of the coordinates' own tangent.
  void add_curvature(const double* multipliers, double unit, BeamMatrix<D>& tangent) const {
    at_each([&](const Kink& kink, int i, Eigen::Index at) {
      if (!kink.suspended) add_form(kink, unit * multipliers[at] * kink.of.form(i), tangent);
    });
  }
  /// Adds rows and columns of the multipliers, times `scale`, to the border.
  void add_rows(const double* q, double scale, BeamMatrix<D>& tangent) const {
    at_each([&](const Kink& kink, int i, Eigen::Index /*at*/) {
      tangent.add_border(std::max(0, kink.place.node - 1));
      const Eigen::Index own = tangent.nodal() + tangent.borders() - 1;
      if (kink.suspended) {
        tangent.entry(own, own) = 1;
        return;
      }
      const Slopes gradient = scale * kink.of.gradient(i, slopes_at<D>(kink.place, q));
      for (int c = 0; c < 2 * D; ++c) {
        tangent.entry(own, place(kink, c)) = tangent.entry(place(kink, c), own) = gradient[c];
      }
    });
  }
  /// The multipliers whose forces are next to `force`, of an array like q.
  Eigen::VectorXd nearest(const double* q, const double* force, double unit) const {
    Eigen::VectorXd multipliers(count());
    Eigen::Index at = 0;
    for (const Kink& kink : kinks_) {
      const int count = kink.of.count();
      const Slopes slopes = slopes_at<D>(kink.place, q);
      Eigen::MatrixXd gradients(2 * D, count);
      for (int i = 0; i < count; ++i) gradients.col(i) = kink.of.gradient(i, slopes);
      multipliers.segment(at, count) =
          solve_symmetric(gradients.transpose() * gradients, gradients.transpose() * slopes_at<D>(kink.place, force)) /
          unit;
      at += count;
    }
    return multipliers;
  }
  /// Adds `factor` times the second derivative of condition i to a matrix of the coordinates.
  void add_second_derivative(Eigen::Index which, double factor, Eigen::MatrixXd& dense) const {
    at_each([&](const Kink& kink, int i, Eigen::Index at) {
      if (at != which) return;
      for (int a = 0; a < 2 * D; ++a) {
        for (int b = 0; b < 2 * D; ++b) dense(place(kink, a), place(kink, b)) += factor * kink.of.form(i)(a, b);
      }
    });
  }
  /// Normals of the conditions among `coordinates` coordinates, a column each that is not suspended.
  Eigen::MatrixXd normals(const double* q, Eigen::Index coordinates) const {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(coordinates, active());
    Eigen::Index column = 0;
    at_each([&](const Kink& kink, int i, Eigen::Index /*at*/) {
      if (kink.suspended) return;
      const Slopes gradient = kink.of.gradient(i, slopes_at<D>(kink.place, q));
      for (int c = 0; c < 2 * D; ++c) columns(place(kink, c), column) = gradient[c];
      ++column;
    });
    return columns;
  }

 private:
  /// Calls function(kink, which of its conditions, which of all).
  template <class Function>
  void at_each(const Function& function) const {
    Eigen::Index at = 0;
    for (const Kink& kink : kinks_) {
      for (int i = 0; i < kink.of.count(); ++i) function(kink, i, at++);
    }
  }
  /// Where component c of both slopes stands.
  static Eigen::Index place(const Kink& kink, int c) {
    return c < D ? Eigen::Index{node_size<D>} * kink.place.node + D + c : kink.place.behind + c - D;
  }
  static void add_form(const Kink& kink, const typename Conditions::Form& form, BeamMatrix<D>& tangent) {
    for (int a = 0; a < 2 * D; ++a) {
      for (int b = 0; b < 2 * D; ++b) tangent.entry(place(kink, a), place(kink, b)) += form(a, b);
    }
  }

  std::vector<Kink> kinks_;
};

}  // namespace vlbeam
