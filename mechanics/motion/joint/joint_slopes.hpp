#pragma once

namespace vlbeam {

/// What ties the beam's slopes on the two sides of a sliding joint (Ding & Ouyang 2022, Eq. 39-40; the operator of its
/// "discontinuous slopes" is lost in print and may be that of `tangent` or of `equal_stretch`).
enum class JointSlopes {
  continuous,     ///< one slope vector
  tangent,        ///< one direction, two magnitudes: r_x- x r_x+ = 0
  equal_stretch,  ///< a kink between slopes of one magnitude, |r_x-| = |r_x+|: a frictionless slider on a cable
  free,           ///< independent slopes: a hinge that moves and carries no moment
};

}  // namespace vlbeam
