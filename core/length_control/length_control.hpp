#pragma once

#include <algorithm>
#include <vector>

#include "core/length_control/merge_shape.hpp"

namespace vlbeam {

/// How the elements beside a moving node are kept near the standard length.
struct LengthControl {
  bool enabled = true;
  double standard_length = 0;  ///< L_std [m]
  double upper = 1.5;          ///< an element longer than upper (1 + hysteresis) L_std is cut
  double hysteresis = 1e-3;
  MergeShape merge = MergeShape::point_fit;
  MergeRule rule = {};   ///< with the policy `own`
  bool rational = true;  ///< merged elements may have weights other than 1
  VelocityTransfer velocities = VelocityTransfer::nodal;
  /// The last element, shorter than this share of L_std, loses its moving node; 0: never.
  double end_merge = 0;
  /// An element beside a joint, shorter than this share of L_std, is merged with the next one; 0: never by itself.
  double lower = 0;
  /// Material coordinates that a cut of an element takes for its new node, where it holds one [m]: there the section
  /// changes.
  std::vector<double> kept = {};
  /// Of a beam of more elements than this, with one joint, events look at the part around it, and hand over that.
  int most_whole = 200;

  /// Where what rides inside the last element gets a node again, so that no other event is due at once.
  double end_cut() const { return std::max(end_merge, 2 - upper) + 0.01; }
  double trigger_length() const { return upper * (1 + hysteresis) * standard_length; }
  /// Whether elements have the weights of rest_arc().
  bool takes_rest_arc() const { return merge == MergeShape::rest_arc && rational; }
  double merge_length() const { return lower * standard_length; }
};

/// Which way a moving node goes relative to the fixed ones.
enum class Direction { forward, backward };

/// What an event does on the two sides of a joint that moves forward (backward is the mirror image).
struct Remeshing {
  bool cut = true;    ///< the element behind it, at L_std from its far end, or at a kept place; between two joints in
                      ///< its middle
  bool merge = true;  ///< the node ahead is deleted: the two elements there become one
};

}  // namespace vlbeam
