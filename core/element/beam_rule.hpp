#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/geometry/weights.hpp"

namespace vlbeam {

/// Where the axial strain of an element is summed.
enum class AxialStrain {
  full,     ///< at the points of all else: a bent, nearly inextensible element has no freedom left, it locks
  lobatto,  ///< at both nodes and in the middle (Simpson's rule): neighbours share a condition, as many as there are
            ///< unknowns along the axis
};

/// What of the beam a point of a rule stands for.
enum class Feels { everything, stretch, all_but_stretch };

/// A quadrature point on [0, 1] of one element of a beam.
struct BeamPoint {
  double u;
  double weight;
  Feels feels = Feels::everything;
};

using BeamRule = std::vector<BeamPoint>;

/// The points of a rule that feel mass and loads; those of the axial strain alone stand behind them.
inline std::span<const BeamPoint> with_mass(const BeamRule& rule) {
  const auto end = std::find_if(rule.begin(), rule.end(), [](const auto& at) { return at.feels == Feels::stretch; });
  return {rule.begin(), end};
}

/// Gauss points of an element, 3..25 of them; with `lobatto` those of the axial strain behind them.
/// Throws std::out_of_range for any other number.
BeamRule beam_rule(int points, AxialStrain axial_strain = AxialStrain::full);

/// The rules of a beam's elements. An element whose weights are 1 is a polynomial, and needs fewer points.
struct BeamRules {
  BeamRule polynomial, rational;

  BeamRules(const BeamRule& of_all) : polynomial(of_all), rational(of_all) {}  // NOLINT(google-explicit-constructor)
  BeamRules(int polynomial_points, int rational_points, AxialStrain axial_strain)
      : polynomial(beam_rule(polynomial_points, axial_strain)), rational(beam_rule(rational_points, axial_strain)) {}

  const BeamRule& of(const Weights<double>& weights) const { return nearly_unit(weights) ? polynomial : rational; }
};

}  // namespace vlbeam
