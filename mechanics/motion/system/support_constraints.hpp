#pragma once

#include "mechanics/motion/system/held.hpp"
#include "mechanics/time/fields.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

/// What supports hold, as constraints C = 0 with a multiplier m each, a reaction over `unit`: direction . (what it
/// holds of a node - where it holds it) = 0. Directions at a node are orthonormal. Of a beam with frames a clamp holds
/// the node's angle, too.
template <int D>
class SupportConstraints {
 public:
  void clear() { all_.clear(); }
  /// After each change of the mesh.
  void adopt(const std::vector<HeldNode<D>>& held) {
    all_.clear();
    for (std::size_t i = 0; i < held.size(); ++i) {
      for (int c = 0; c < D; ++c) {
        if (held[i].support.free_position[c] == 0) all_.push_back({i, c, Of::position});
        if (held[i].support.free_slope[c] == 0) all_.push_back({i, c, Of::slope});
      }
      if (held[i].holds_angle()) all_.push_back({i, 0, Of::angle});
    }
  }
  Eigen::Index count() const { return static_cast<Eigen::Index>(all_.size()); }
  void add_fields(Eigen::Index at, std::vector<FieldRun>& runs) const {
    for (const Constraint& one : all_) {
      runs.push_back({one.of == Of::position ? Field::multiplier : Field::slope_multiplier, at++});
    }
  }

  // `held` are the nodes as they stand at the instant.

  /// Adds the reactions to r, an array like q, and writes the constraints into `rows`.
  void add_residual(const std::vector<HeldNode<D>>& held, const double* q, const double* multipliers, double unit,
                    double* r, double* rows) const {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const double reaction = unit * multipliers[i];
      if (all_[i].of == Of::angle) {
        r[held[all_[i].held].angle] += reaction;
      } else {
        part(all_[i], held, r) += reaction * direction(all_[i], held);
      }
      rows[i] = value(all_[i], held, q);
    }
  }
  void rates(const std::vector<HeldNode<D>>& held, const double* q, const double* v, double* rows) const {
    for (const Constraint& one : all_) *rows++ = rate(one, held, q, v);
  }
  ConstraintResidual residual(const std::vector<HeldNode<D>>& held, const double* q, const double* v) const {
    ConstraintResidual largest;
    for (const Constraint& one : all_) {
      largest.position = std::max(largest.position, std::abs(value(one, held, q)));
      largest.velocity = std::max(largest.velocity, std::abs(rate(one, held, q, v)));
    }
    return largest;
  }
  /// The multipliers that take the place of what `lacking`, an array like q, has in their directions.
  void balance(const std::vector<HeldNode<D>>& held, const double* lacking, double unit, double* multipliers) const {
    for (const Constraint& one : all_) *multipliers++ = -along(one, held, lacking) / unit;
  }
  /// Adds rows and columns of the multipliers, times `scale`, to the border.
  void add_rows(const std::vector<HeldNode<D>>& held, double scale, BeamMatrix<D>& tangent) const {
    for (const Constraint& one : all_) {
      auto& border = tangent.add_border(held[one.held].node);
      if (one.of == Of::angle) {
        if constexpr (D == 3) tangent.tie_angle(tangent.borders() - 1, 0, scale);
        continue;
      }
      auto column = border.column[0].template segment<D>(one.of == Of::slope ? D : 0);
      column = scale * direction(one, held);
      border.row[0] = border.column[0];
    }
  }

 private:
  enum class Of { position, slope, angle };
  struct Constraint {
    std::size_t held;
    int component;  ///< in the frame of the support
    Of of;
  };

  template <class Array>
  static auto part(const Constraint& one, const std::vector<HeldNode<D>>& held, Array* a) {
    const int node = held[one.held].node;
    return one.of == Of::slope ? slope<D>(a, node) : position<D>(a, node);
  }
  /// What it holds, of an array like q.
  static double along(const Constraint& one, const std::vector<HeldNode<D>>& held, const double* a) {
    return one.of == Of::angle ? a[held[one.held].angle] : direction(one, held).dot(part(one, held, a));
  }
  static Vec<double, D> direction(const Constraint& one, const std::vector<HeldNode<D>>& held) {
    return held[one.held].support.frame.col(one.component);
  }
  static double value(const Constraint& one, const std::vector<HeldNode<D>>& held, const double* q) {
    const HeldNode<D>& by = held[one.held];
    if (one.of == Of::angle) return q[by.angle] - by.driven.angle.value;
    const Vec<double, D> there = one.of == Of::slope ? by.slope_now() : by.position_now();
    return direction(one, held).dot(part(one, held, q) - there);
  }
  static double rate(const Constraint& one, const std::vector<HeldNode<D>>& held, const double* q, const double* v) {
    const HeldNode<D>& by = held[one.held];
    if (one.of == Of::angle) return v[by.angle] - by.driven.angle.rate;
    const Vec<double, D> there = one.of == Of::slope ? by.driven.slope_rate(slope<D>(q, by.node)) : by.driven.rate;
    return direction(one, held).dot(part(one, held, v) - there);
  }

  std::vector<Constraint> all_;
};

}  // namespace vlbeam
