#pragma once

#include <optional>
#include <vector>

#include "core/geometry/prescribed.hpp"

namespace vlbeam {

/// Material coordinates of the nodes of a chain as functions of time: those of some nodes are given, the ones between
/// them divide the distance in fixed proportions, and so move with them.
class MeshMotion {
 public:
  struct Guide {
    int node;
    TimeFunction x;  ///< [m]
  };

  MeshMotion() = default;
  /// `guides` in increasing order of their nodes, the first and the last node among them; elements between two
  /// neighbouring guides are of equal length. Throws ModelError where the nodes do not increase from 0.
  explicit MeshMotion(std::vector<Guide> guides);

  int last() const { return guides_.empty() ? 0 : guides_.back().node; }  ///< index of the last node
  /// Material coordinate of the first node at time t.
  Prescribed first(double t) const { return guides_.front().x(t); }
  /// Writes the material coordinates of all nodes at time t.
  void at(double t, std::vector<Prescribed>& nodes) const;

  /// An instant at which an element is shorter than `shortest` [m].
  struct Tangle {
    double t;
    int element;
    double length;
  };
  /// The first such instant in [from, to], to 1e-9 of the interval; elements that are too short for less than a 2000th
  /// of it may be missed.
  std::optional<Tangle> tangle(double from, double to, double shortest) const;

 private:
  /// Length of an element between guides k and k + 1 at time t.
  double length(std::size_t k, double t) const;

  std::vector<Guide> guides_;
};

}  // namespace vlbeam
