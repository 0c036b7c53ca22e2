#pragma once

#include <memory>

#include "core/dynamics/second_order.hpp"
#include "core/dynamics/stepper.hpp"

namespace vlbeam {

/// Options of the generalized-alpha method.
struct GeneralizedAlphaOptions {
  double step = 1e-3;               ///< [s]
  double rho_inf = 0.9;             ///< spectral radius at infinity, 0 (strongest damping) to 1 (none)
  double newton_tolerance = 1e-10;  ///< of the correction relative to the coordinates' size
  int newton_iterations = 12;       ///< beyond which the step is halved
};

/// Generalized-alpha method for M(q) q'' = Q (Arnold & Bruels 2007) with a modified Newton iteration: the tangent of a
/// step's predictor is kept until the iteration slows down. Second order; steps of fixed length unless Newton stalls.
std::unique_ptr<Stepper> make_generalized_alpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options);

}  // namespace vlbeam
