#pragma once

namespace vlbeam {

/// How the section's angle runs between the nodes.
enum class AngleField {
  linear,   ///< one unknown a node; the twist jumps there
  hermite,  ///< cubic, angle and twist at each node
};

}  // namespace vlbeam
