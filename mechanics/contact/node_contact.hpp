#pragma once

#include "mechanics/contact/at_support.hpp"
#include "mechanics/motion/system/beam_link.hpp"

namespace vlbeam {

/// Two nodes, the one next to the other, that strike each other once they are near enough, or rest against each other:
/// of joints, or of a joint and an end of the beam.
template <int D>
struct NodeContact : BeamLink<D> {
  std::size_t which = 0;  ///< of the joints on the beam: the first of the two
  int support = 0;        ///< -1: that at the start, 1: at the end, 0: another joint
  Impact impact = {};
  bool rests = false;
};

}  // namespace vlbeam
