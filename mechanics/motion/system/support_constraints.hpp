#pragma once

#include "mechanics/motion/system/constraint_set.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// What supports hold, as constraints: direction . (what it holds of a node - where it holds it) = 0. A multiplier is a
/// reaction over `unit`. Directions at a node are orthonormal. Of a beam with angles a clamp holds the node's angle,
/// too. Supports stand as CurrentBeam::supports() was looked at last.
template <int D>
class SupportConstraints final : public ConstraintSet<D> {
 public:
  /// `beam` must outlive this object. Supports are none of its constraints where they are `eliminated`.
  SupportConstraints(const CurrentBeam<D>& beam, bool eliminated) : beam_(beam), eliminated_(eliminated) {}

  void adopt() override {
    all_.clear();
    if (eliminated_) return;
    for (std::size_t i = 0; i < held().size(); ++i) {
      const Support<D>& support = held()[i].support;
      for (int c = 0; c < D; ++c) {
        if (support.free_position[c] == 0) all_.push_back({i, c, Of::position});
        if (support.free_slope[c] == 0) all_.push_back({i, c, Of::slope});
      }
      if (held()[i].holds_angle()) all_.push_back({i, 0, Of::angle});
    }
  }
  Eigen::Index count() const override { return static_cast<Eigen::Index>(all_.size()); }
  void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const override {
    for (const Constraint& one : all_) {
      runs.push_back({one.of == Of::position ? Field::multiplier : Field::slope_multiplier, first++});
    }
  }

  void add_forces(const double* /*q*/, const double* multipliers, double unit, double* r) const override {
    for (const Constraint& one : all_) {
      const double reaction = unit * *multipliers++;
      if (one.of == Of::angle) {
        r[by(one).angle] += reaction;
      } else {
        part(one, r) += reaction * direction(one);
      }
    }
  }
  void write_values(const double* q, double* values) const override {
    for (const Constraint& one : all_) *values++ = value(one, q);
  }
  void write_rates(const double* q, const double* v, double* rates) const override {
    for (const Constraint& one : all_) *rates++ = rate(one, q, v);
  }
  void add_tangent(const double* /*q*/, const double* /*multipliers*/, double /*unit*/, double scale,
                   BeamMatrix<D>& tangent) const override {
    for (const Constraint& one : all_) {
      auto& border = tangent.add_border(by(one).node);
      if (one.of == Of::angle) {
        if constexpr (D == 3) tangent.tie_angle(tangent.borders() - 1, 0, scale);
        continue;
      }
      auto column = border.column[0].template segment<D>(one.of == Of::slope ? D : 0);
      column = scale * direction(one);
      border.row[0] = border.column[0];
    }
  }

  /// The multipliers that take the place of what `lacking`, an array like q, has in their directions.
  void balance(const double* lacking, double unit, double* multipliers) const {
    for (const Constraint& one : all_) *multipliers++ = -along(one, lacking) / unit;
  }

 private:
  enum class Of { position, slope, angle };
  struct Constraint {
    std::size_t held;
    int component;  ///< in the frame of the support
    Of of;
  };

  const std::vector<HeldNode<D>>& held() const { return beam_.supports().nodes(); }
  const HeldNode<D>& by(const Constraint& one) const { return held()[one.held]; }
  template <class Array>
  auto part(const Constraint& one, Array* a) const {
    return one.of == Of::slope ? slope<D>(a, by(one).node) : position<D>(a, by(one).node);
  }
  /// What it holds, of an array like q.
  double along(const Constraint& one, const double* a) const {
    return one.of == Of::angle ? a[by(one).angle] : direction(one).dot(part(one, a));
  }
  Vec<double, D> direction(const Constraint& one) const { return by(one).support.frame.col(one.component); }
  double value(const Constraint& one, const double* q) const {
    const HeldNode<D>& at = by(one);
    if (one.of == Of::angle) return q[at.angle] - at.driven.angle.value;
    const Vec<double, D> there = one.of == Of::slope ? at.slope_now() : at.position_now();
    return direction(one).dot(part(one, q) - there);
  }
  double rate(const Constraint& one, const double* q, const double* v) const {
    const HeldNode<D>& at = by(one);
    if (one.of == Of::angle) return v[at.angle] - at.driven.angle.rate;
    const Vec<double, D> there = one.of == Of::slope ? at.driven.slope_rate(slope<D>(q, at.node)) : at.driven.rate;
    return direction(one).dot(part(one, v) - there);
  }

  const CurrentBeam<D>& beam_;
  bool eliminated_;
  std::vector<Constraint> all_;
};

}  // namespace vlbeam
