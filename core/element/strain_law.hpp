#pragma once

namespace vlbeam {

/// How stretch and curvature are measured.
enum class StrainLaw {
  green,        ///< eps = (r_x.r_x - 1)/2, kappa = |r_x x r_xx|/|r_x|^3 (Ding & Ouyang 2022, after Eq. 19)
  engineering,  ///< eps = |r_x| - 1, kappa = |r_x x r_xx|/|r_x|^2
};

/// n of kappa^2 = F.F / (r_x.r_x)^n, F = r_x x r_xx.
constexpr double curvature_power(StrainLaw law) { return law == StrainLaw::green ? 3 : 2; }

}  // namespace vlbeam
