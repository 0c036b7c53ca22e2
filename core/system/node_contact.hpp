#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "core/dynamics/solver_counters.hpp"
#include "core/joint/at_support.hpp"

namespace vlbeam {

/// Two nodes, the one next to the other, that strike each other once they are near enough, or rest against each other:
/// of joints, or of a joint and an end of the beam.
template <int D>
struct NodeContact {
  int behind, ahead;  ///< nodes
  std::size_t which;  ///< of the joints on the beam: the first of the two
  int support;        ///< -1: that at the start, 1: at the end, 0: another joint
  Impact impact;
  double distance;  ///< where they touch [m]
  bool rests;

  /// C [m] of the line from the one to the other.
  double value(const Vec<double, D>& apart) const { return (apart.squaredNorm() / distance - distance) / 2; }
  /// Its gradient, of length 1 at rest.
  Vec<double, D> line(const double* q) const { return difference(q) / distance; }
  /// Of an array like q.
  Vec<double, D> difference(const double* q) const { return position<D>(q, ahead) - position<D>(q, behind); }
};

/// What rests, as constraints C = (|r|^2 - d^2)/(2 d) = 0 for the line r between two nodes and their distance d, with a
/// multiplier m each: `unit` m is the force with which they pull at each other.
template <int D>
class RestingContacts {
 public:
  void adopt(const std::vector<NodeContact<D>>& resting) { all_ = resting; }
  const std::vector<NodeContact<D>>& all() const { return all_; }
  Eigen::Index count() const { return static_cast<Eigen::Index>(all_.size()); }

  /// Adds the forces to r, an array like q.
  void add_forces(const double* q, const double* multipliers, double unit, double* r) const {
    for (const NodeContact<D>& contact : all_) {
      const Vec<double, D> pull = unit * *multipliers++ / contact.distance * contact.difference(q);
      position<D>(r, contact.behind) -= pull;
      position<D>(r, contact.ahead) += pull;
    }
  }
  void write_values(const double* q, double* rows) const {
    for (const NodeContact<D>& contact : all_) *rows++ = contact.value(contact.difference(q));
  }
  ConstraintResidual residual(const double* q, const double* v) const {
    ConstraintResidual largest;
    for (const NodeContact<D>& contact : all_) {
      const Vec<double, D> line = contact.difference(q);
      largest.position = std::max(largest.position, std::abs(contact.value(line)));
      largest.velocity = std::max(largest.velocity, std::abs(line.dot(contact.difference(v)) / contact.distance));
    }
    return largest;
  }
  /// Adds rows and columns of the multipliers, times `scale`, to the border, and what their forces add to the tangent.
  void add_tangent(const double* q, const double* multipliers, double unit, double scale,
                   BeamMatrix<D>& tangent) const {
    for (const NodeContact<D>& contact : all_) {
      auto& border = tangent.add_border(contact.behind);
      const Vec<double, D> line = scale / contact.distance * contact.difference(q);
      border.column[0].template head<D>() = border.row[0].template head<D>() = -line;
      border.column[1].template head<D>() = border.row[1].template head<D>() = line;
      const auto k = static_cast<std::size_t>(contact.behind);
      const double turns = unit * *multipliers++ / contact.distance;
      const auto diagonal = [](auto& block) { return block.template topLeftCorner<D, D>().diagonal().array(); };
      diagonal(tangent.diagonal[k]) += turns;
      diagonal(tangent.diagonal[k + 1]) += turns;
      diagonal(tangent.upper[k]) -= turns;
      diagonal(tangent.lower[k + 1]) -= turns;
    }
  }

 private:
  std::vector<NodeContact<D>> all_;
};

}  // namespace vlbeam
