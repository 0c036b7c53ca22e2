#include "core/element/beam_rule.hpp"

#include "core/element/quadrature.hpp"

namespace vlbeam {

BeamRule beam_rule(int points, AxialStrain axial_strain) {
  const bool apart = axial_strain == AxialStrain::lobatto;
  BeamRule rule;
  for (const auto& [u, weight] : gauss_legendre(points)) {
    rule.push_back({u, weight, apart ? Feels::all_but_stretch : Feels::everything});
  }
  if (apart) {
    for (const auto& [u, weight] : {QuadraturePoint{0, 1.0 / 6}, {0.5, 4.0 / 6}, {1, 1.0 / 6}}) {
      rule.push_back({u, weight, Feels::stretch});
    }
  }
  return rule;
}

}  // namespace vlbeam
