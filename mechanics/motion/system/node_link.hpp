#pragma once

#include <optional>

#include "core/beam/node_map.hpp"

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

}  // namespace vlbeam
