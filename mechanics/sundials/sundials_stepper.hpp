#pragma once

#include <memory>

#include "mechanics/time/generalized_alpha.hpp"
#include "mechanics/time/integrate.hpp"
#include "mechanics/time/stepper.hpp"

namespace vlbeam {

enum class SundialsMethod { ida, cvode, arkode };

/// Whether SUNDIALS is built in (VLBEAM_SUNDIALS).
bool have_sundials();

/// A method of SUNDIALS, by tolerances. A step of length dt may be several of its own; the one proposed is the next of
/// its own, so that usually both agree.
///
/// cvode: BDF of orders 1 to 5 with the dense Jacobian of the equations; arkode: an explicit Runge-Kutta method of
/// order 5. Both take the first-order form. ida: BDF on M v' + C_q^T lambda = Q with multipliers, in the stabilised
/// form of index 2 (Gear, Gupta & Leimkuhler 1985): q' = v - C_q^T mu, C = 0 and C_q v = 0. Both constraint residuals
/// are in `counters`, which may be null. Its Jacobian is dense and exact. Only where have_sundials().
std::unique_ptr<Stepper> make_sundials_stepper(SundialsMethod type, const Tolerances& tolerances,
                                               SecondOrderSystem* system, NewtonCounters* counters);

/// The same as a method of IntegrationOptions, of that type.
OtherMethod method_of_sundials(SundialsMethod type);

}  // namespace vlbeam
