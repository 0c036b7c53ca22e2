#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

/// Two nodes a given distance apart: all of it, or, where they are tied, along a fixed direction.
template <int D>
struct NodeLink {
  int behind, ahead;                         ///< nodes
  double distance;                           ///< [m]
  std::optional<Vec<double, D>> along = {};  ///< a fixed direction of length 1; nothing: from the one to the other

  /// C [m] of the line from the one to the other: (|r|^2 - d^2)/(2 d), or along . r - d.
  double value(const Vec<double, D>& apart) const {
    return along ? along->dot(apart) - distance : (apart.squaredNorm() / distance - distance) / 2;
  }
  /// Its gradient, of length 1 where C = 0.
  Vec<double, D> line(const double* q) const { return along ? *along : Vec<double, D>(difference(q) / distance); }
  /// That times `size`.
  Vec<double, D> pull(const double* q, double size) const {
    return along ? Vec<double, D>(size * *along) : Vec<double, D>(size / distance * difference(q));
  }
  /// Of an array like q.
  Vec<double, D> difference(const double* q) const { return position<D>(q, ahead) - position<D>(q, behind); }
  /// C'' without accelerations [m/s^2].
  double turning(const double* rate) const { return along ? 0 : difference(rate).squaredNorm() / distance; }
};

/// Links as constraints C = 0 with a multiplier m each: `unit` m is the force with which their nodes pull at each
/// other.
template <int D>
class NodeLinks {
 public:
  void adopt(const std::vector<NodeLink<D>>& links) { all_ = links; }
  const std::vector<NodeLink<D>>& all() const { return all_; }
  Eigen::Index count() const { return static_cast<Eigen::Index>(all_.size()); }

  /// Adds the forces to r, an array like q.
  void add_forces(const double* q, const double* multipliers, double unit, double* r) const {
    for (const NodeLink<D>& link : all_) {
      const Vec<double, D> pull = link.pull(q, unit * *multipliers++);
      position<D>(r, link.behind) -= pull;
      position<D>(r, link.ahead) += pull;
    }
  }
  void write_values(const double* q, double* rows) const {
    for (const NodeLink<D>& link : all_) *rows++ = link.value(link.difference(q));
  }
  ConstraintResidual residual(const double* q, const double* v) const {
    ConstraintResidual largest;
    for (const NodeLink<D>& link : all_) {
      largest.position = std::max(largest.position, std::abs(link.value(link.difference(q))));
      largest.velocity = std::max(largest.velocity, std::abs(link.line(q).dot(link.difference(v))));
    }
    return largest;
  }
  /// Adds rows and columns of the multipliers, times `scale`, to the border, and what their forces add to the tangent.
  void add_tangent(const double* q, const double* multipliers, double unit, double scale,
                   BeamMatrix<D>& tangent) const {
    for (const NodeLink<D>& link : all_) {
      auto& border = tangent.add_border(link.behind);
      const Vec<double, D> line = link.pull(q, scale);
      border.column[0].template head<D>() = border.row[0].template head<D>() = -line;
      border.far = link.ahead;
      border.far_column.template head<D>() = border.far_row.template head<D>() = line;
      const double turns = unit * *multipliers++ / link.distance;
      if (link.along) continue;  // its direction stays
      const auto k = static_cast<std::size_t>(link.behind);
      const auto diagonal = [](auto& block) { return block.template topLeftCorner<D, D>().diagonal().array(); };
      diagonal(tangent.diagonal[k]) += turns;
      diagonal(tangent.diagonal[k + 1]) += turns;
      diagonal(tangent.upper[k]) -= turns;
      diagonal(tangent.lower[k + 1]) -= turns;
    }
  }

 private:
  std::vector<NodeLink<D>> all_;
};

}  // namespace vlbeam
