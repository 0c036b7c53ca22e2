#pragma once

#include "core/element/beam_rule.hpp"
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

  /// As a point of a rule feels it.
  BeamSection as_felt(Feels what) const {
    BeamSection felt = *this;
    if (what == Feels::stretch) felt.rhoA = felt.stiffness.EI = 0;
    if (what == Feels::all_but_stretch) felt.stiffness.EA = 0;
    return felt;
  }
};

/// A section as felt at each kind of point.
struct FeltSections {
  BeamSection everything, stretch, all_but_stretch;

  explicit FeltSections(const BeamSection& section)
      : everything(section),
        stretch(section.as_felt(Feels::stretch)),
        all_but_stretch(section.as_felt(Feels::all_but_stretch)) {}
  const BeamSection& operator[](Feels what) const {
    return what == Feels::everything ? everything : what == Feels::stretch ? stretch : all_but_stretch;
  }
};

}  // namespace vlbeam
