#pragma once

#include "core/element/strain.hpp"

namespace vlbeam {

/// What one metre of the beam is made of.
struct BeamSection {
  double rhoA = 0;                      ///< mass per length [kg/m]
  Stiffness stiffness{0, 0};            ///< EA [N], EI [N m^2]
  double damping = 0;                   ///< Kelvin-Voigt time c [s]
  double curvature_regularization = 0;  ///< kappa_reg [1/m], bending damping in space only

  bool bends() const { return stiffness.bends(); }
  bool damped() const { return damping != 0; }
};

}  // namespace vlbeam
