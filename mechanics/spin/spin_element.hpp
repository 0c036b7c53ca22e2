#pragma once

#include <array>

#include "core/element/moving_element.hpp"

namespace vlbeam {

// The section's rotation theta about the axis of the beam, as a further field of a variable-length element: linear
// between the ends A and B at x_A(t), x_B(t) (the variable-length beam-shaft element VLBSE, Latin American Journal of
// Solids and Structures, 2017). It couples to the axis through the material coordinates of the ends only.
//
// With twist tau = dtheta/dx = (theta_B - theta_A)/l the spin of a material point is linear in u too,
//   omega = (1 - u) omega_A + u omega_B,   omega_i = theta_i' - tau x_i',
// so that all integrals over the element are known in closed form.

/// What one metre of the shaft is made of as it turns.
struct SpinSection {
  double rhoIp = 0;    ///< moment of inertia per length about the axis, rho pi r^4/2 [kg m]
  double GIp = 0;      ///< torsional stiffness [N m^2]
  double damping = 0;  ///< Kelvin-Voigt time c [s]
};

/// Coordinates of one element's spin, or their rates.
template <class Real>
struct SpinCoordinates {
  Real theta_a, theta_b;  ///< [rad]
  Real x_a, x_b;          ///< [m]
};

/// Spin of the material point at either end, [rad/s], the twist [rad/m] and its rate at a fixed material point.
template <class Real>
struct SpinMotion {
  Real l, l_rate, tau, omega_a, omega_b, tau_rate;

  SpinMotion(const SpinCoordinates<Real>& q, const SpinCoordinates<Real>& rate)
      : l(q.x_b - q.x_a),
        l_rate(rate.x_b - rate.x_a),
        tau((q.theta_b - q.theta_a) / l),
        omega_a(rate.theta_a - tau * rate.x_a),
        omega_b(rate.theta_b - tau * rate.x_b),
        tau_rate((omega_b - omega_a) / l) {}

  Real kinetic_energy(const SpinSection& section) const {
    return l * (omega_a * omega_a + omega_a * omega_b + omega_b * omega_b) * Real(section.rhoIp / 6);
  }
  Real torsion_energy(const SpinSection& section) const { return l * tau * tau * Real(section.GIp / 2); }
  Real momentum(const SpinSection& section) const { return l * (omega_a + omega_b) * Real(section.rhoIp / 2); }
};

/// Equations of motion of one element's spin, as those of a field of one component whose slopes are no coordinates:
/// their rows are empty.
///
/// `variational` is Lagrange's equations of  integral of rho I_p omega^2/2 - G I_p tau^2/2 dx  over the moving element.
/// Summed at a node that moves at x' they hold the momentum flux rho I_p x'^2 (tau+ - tau-) by themselves: theta has a
/// kink there, and without this flux the term x'^2 theta_xx of the rod's equation is lost.
/// `virtual_work` takes the acceleration at fixed material points, and loses it.
template <class Real>
MovingEquations<Real, 1> spin_equations(const SpinCoordinates<Real>& q, const SpinCoordinates<Real>& rate,
                                        Formulation formulation, const SpinSection& section) {
  const SpinMotion<Real> at(q, rate);
  auto one = [](const Real& value) -> Vec<Real, 1> { return Vec<Real, 1>::Constant(value); };
  const Real zero(0), m = at.l * (section.rhoIp / 6), twice = at.l * (section.rhoIp / 3);
  MovingEquations<Real, 1> eq;
  eq.mass = {{{twice, zero, m, zero}, {zero, zero, zero, zero}, {m, zero, twice, zero}, {zero, zero, zero, zero}}};
  eq.mass_a = {one(-at.tau * twice), one(zero), one(-at.tau * m), one(zero)};
  eq.mass_b = {one(-at.tau * m), one(zero), one(-at.tau * twice), one(zero)};
  eq.mass_aa = eq.mass_bb = at.tau * at.tau * twice;
  eq.mass_ab = at.tau * at.tau * m;
  const Real torque = at.tau * section.GIp, viscous = at.tau_rate * (section.damping * section.GIp);
  eq.dissipation = at.l * viscous * at.tau_rate;

  // what the rates add to the momentum's change at either end, the angles' accelerations apart
  Real change_a, change_b, theta_a = torque + viscous, theta_b = -torque - viscous;
  if (formulation == Formulation::variational) {
    const Real momentum_a = m * (at.omega_a * 2.0 + at.omega_b), momentum_b = m * (at.omega_a + at.omega_b * 2.0);
    const Real grows = at.l_rate * (section.rhoIp / 6);
    change_a = grows * (at.omega_a * 2.0 + at.omega_b) - m * at.tau_rate * (rate.x_a * 2.0 + rate.x_b);
    change_b = grows * (at.omega_a + at.omega_b * 2.0) - m * at.tau_rate * (rate.x_a + rate.x_b * 2.0);
    const Real flux = (momentum_a * rate.x_a + momentum_b * rate.x_b) / at.l;
    const Real per_length = at.kinetic_energy(section) / at.l + flux * at.tau + torque * at.tau * 0.5;
    theta_a += flux;
    theta_b -= flux;
    eq.force_a = at.tau_rate * momentum_a - per_length;
    eq.force_b = at.tau_rate * momentum_b + per_length;
  } else {
    change_a = -m * at.tau_rate * (rate.x_a * 4.0 + rate.x_b * 2.0);
    change_b = -m * at.tau_rate * (rate.x_a * 2.0 + rate.x_b * 4.0);
    eq.force_a = -torque * at.tau;
    eq.force_b = torque * at.tau;
  }
  eq.force = {one(theta_a - change_a), one(zero), one(theta_b - change_b), one(zero)};
  eq.force_a += at.tau * (change_a - viscous);
  eq.force_b += at.tau * (change_b + viscous);
  return eq;
}

}  // namespace vlbeam
