#pragma once

#include <memory>
#include <vector>

#include "mechanics/time/second_order.hpp"
#include "mechanics/time/stepper.hpp"

namespace vlbeam {

/// Options of the generalized-alpha method.
struct GeneralizedAlphaOptions {
  double step = 1e-3;    ///< [s]; the longest, and the first, where the step adapts
  double rho_inf = 0.9;  ///< spectral radius at infinity, 0 (strongest damping) to 1 (none)
  NewtonKind newton = NewtonKind::modified;
  /// Of the estimated error relative to the step's own increment (NewtonStop); 0: 3e-4 of the error that the
  /// method itself makes in a step, and 1e-5 at most.
  double newton_tolerance = 0;
  int newton_iterations = 15;                         ///< beyond which the step is halved
  bool adaptive = false;                              ///< the step follows the tolerances
  Tolerances tolerances;                              ///< of an adaptive step
  ErrorEstimate error_estimate = ErrorEstimate::all;  ///< of an adaptive step
  double first_step = 0;                              ///< [s]; 0: the longest
  /// [rad] of SecondOrderSystem::turning() in an adaptive step, over the root of 1 + what has turned so far; 0: any.
  double most_turn = 0;
  bool checkpoints = false;  ///< it may be asked for what it keeps (Stepper::exchange)
};

/// Generalized-alpha method for M(q) q'' = Q (Arnold & Bruels 2007). Second order, also where the length of the step
/// changes: the method's own acceleration, that of the instant t + (alpha_m - alpha_f) h, is carried over to the new h.
/// A Newton iteration that stalls halves the step. An adaptive step estimates the error of the positions,
/// h^2 (beta + (alpha_m - alpha_f)/2 - 1/6) (a_1 - a_0), after Hulbert & Jang (1995). Filtered, the estimate e becomes
/// T^-1 (dr/da) by_a e with the tangent T = dr/dq + by_v dr/dv + by_a dr/da of the step: a mode of frequency w keeps
/// 1/(1 + w^2/by_a) of it, so that what the method will damp by itself does not limit the step.
/// `system` is the stepper's own: it keeps a factored matrix in it. `counters` may be null, and must outlive the
/// stepper otherwise.
std::unique_ptr<Stepper> make_generalized_alpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options,
                                                NewtonCounters* counters = nullptr);

}  // namespace vlbeam
