#pragma once

#include <optional>

#include "mechanics/motion/joint/axial_friction.hpp"
#include "mechanics/motion/joint/joint_slopes.hpp"
#include "mechanics/motion/joint/turning.hpp"

namespace vlbeam {

/// What slides along the beam, a lumped mass unless it is held: the node it sits on moves with it, r shared by both
/// sides.
struct SlidingJoint {
  double mass;  ///< [kg]
  JointSlopes slopes = JointSlopes::continuous;
  std::optional<AxialFriction> friction = std::nullopt;
  Turning turning = {};  ///< a wheel or a drum that the beam turns

  /// The beam has two slopes at the joint.
  bool kinked() const { return slopes != JointSlopes::continuous; }
  /// The beam may have two directions there.
  bool turns() const { return slopes == JointSlopes::equal_stretch || slopes == JointSlopes::free; }
};

}  // namespace vlbeam
