#pragma once

#include <Eigen/Core>

namespace vlbeam {

// A node has two unknowns a component: position and slope. Blocks of the mass matrix between nodes are 2 x 2 for each
// component, the components differing only through what a support fixes in its frame.

/// Symmetric 2 x 2 block of a node with itself, component by component.
template <int D>
struct NodeBlock {
  using Components = Eigen::Array<double, D, 1>;
  Components rr = Components::Zero(), rs = Components::Zero(), ss = Components::Zero();

  /// Inverse on the free unknowns, zero on the fixed ones (masks of 1 and 0).
  NodeBlock inverse(const Components& free_r, const Components& free_s) const {
    NodeBlock result;
    for (int c = 0; c < D; ++c) {
      if (free_r[c] != 0 && free_s[c] != 0) {
        const double scale = 1 / (rr[c] * ss[c] - rs[c] * rs[c]);
        result.rr[c] = ss[c] * scale;
        result.rs[c] = -rs[c] * scale;
        result.ss[c] = rr[c] * scale;
      } else if (free_r[c] != 0) {
        result.rr[c] = 1 / rr[c];
      } else if (free_s[c] != 0) {
        result.ss[c] = 1 / ss[c];
      }
    }
    return result;
  }

  bool operator==(const NodeBlock& other) const {
    return (rr == other.rr).all() && (rs == other.rs).all() && (ss == other.ss).all();
  }
};

/// General 2 x 2 block: row (position, slope) of one node, column of another.
template <class Entry>
struct CouplingBlock {
  Entry rr, rs, sr, ss;

  bool operator==(const CouplingBlock& other) const {
    return (rr == other.rr).all() && (rs == other.rs).all() && (sr == other.sr).all() && (ss == other.ss).all();
  }
};

}  // namespace vlbeam
