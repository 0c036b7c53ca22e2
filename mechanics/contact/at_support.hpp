#pragma once

namespace vlbeam {

/// What becomes of a sliding mass that reaches an end of the beam which it cannot leave.
enum class AtSupport {
  stop,     ///< the computation ends there
  rest,     ///< an inelastic impact: the mass stays until the contact force turns
  rebound,  ///< an impact that turns its relative velocity, times the restitution
};

/// An impact on a support at an end of the beam.
struct Impact {
  AtSupport law = AtSupport::stop;
  double restitution = 1;  ///< of a rebound: relative velocity after it over that before, in [0, 1]
};

}  // namespace vlbeam
