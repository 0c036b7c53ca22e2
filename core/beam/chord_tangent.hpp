#pragma once

#include "core/beam/node_map.hpp"

namespace vlbeam {

/// Adds a ChordTangent, stiffness(i, j), of the element between the first node and the next. Unknowns r_A, s_A, r_B,
/// s_B: r_A enters through minus the chord r_B - r_A, r_B through the chord.
template <int D, class Stiffness>
void add_chord_tangent(const Stiffness& stiffness, NodeTangent<D>* diagonal, NodeTangent<D>* upper,
                       NodeTangent<D>* lower) {
  auto add = [&](NodeTangent<D>& block, int row, int column, double sign, std::size_t chord_row,
                 std::size_t chord_column) {
    block.template block<D, D>(row * D, column * D) += sign * stiffness(chord_row, chord_column);
  };
  auto &aa = diagonal[0], &ab = upper[0], &ba = lower[1], &bb = diagonal[1];
  add(aa, 0, 0, 1, 0, 0), add(aa, 0, 1, -1, 0, 1), add(aa, 1, 0, -1, 1, 0), add(aa, 1, 1, 1, 1, 1);
  add(ab, 0, 0, -1, 0, 0), add(ab, 0, 1, -1, 0, 2), add(ab, 1, 0, 1, 1, 0), add(ab, 1, 1, 1, 1, 2);
  add(ba, 0, 0, -1, 0, 0), add(ba, 0, 1, 1, 0, 1), add(ba, 1, 0, -1, 2, 0), add(ba, 1, 1, 1, 2, 1);
  add(bb, 0, 0, 1, 0, 0), add(bb, 0, 1, 1, 0, 2), add(bb, 1, 0, 1, 2, 0), add(bb, 1, 1, 1, 2, 2);
}

}  // namespace vlbeam
