#pragma once

namespace vlbeam {

/// A lumped mass that sits on a material point of the beam.
struct PointMass {
  double x;     ///< material coordinate [m]
  double mass;  ///< [kg]
};

}  // namespace vlbeam
