#pragma once

#include <memory>

#include "mechanics/time/integrate.hpp"
#include "mechanics/time/second_order.hpp"
#include "mechanics/time/stepper.hpp"

namespace vlbeam {

/// Options of the energy-momentum method.
struct EnergyMomentumOptions {
  double step = 1e-3;          ///< [s]
  int newton_iterations = 30;  ///< beyond which the step is halved
};

/// Implicit method that keeps the system's total energy, whatever the step: q_1 = q_0 + h (v_0 + v_1)/2 and a change of
/// momentum by the discrete gradient of the Lagrangian (ConservingStep). Second order, symmetric in time; steps of
/// fixed length unless Newton stalls.
///
/// An iteration that stops early would change the energy. So Newton's iteration runs until rounding stops it. Its
/// unknowns are velocities, so that rounding of q_1 - q_0 changes no energy. Its matrix is the tangent of the equations
/// of motion in the middle of the step, which differs from the residual's derivative by terms of first order in the
/// step's change of shape; it is kept from step to step while the iteration contracts.
/// `system` is the stepper's own, an ImplicitBeam: it keeps a factored matrix in it.
std::unique_ptr<Stepper> make_energy_momentum(SecondOrderSystem& system, const EnergyMomentumOptions& options);

/// The same as a method of IntegrationOptions, of type energy_momentum.
OtherMethod energy_momentum(const EnergyMomentumOptions& options);

}  // namespace vlbeam
