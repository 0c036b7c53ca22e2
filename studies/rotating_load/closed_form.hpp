#pragma once

#include <complex>

namespace vlbeam {

/// A simply supported beam at rest under a load that comes onto it at t = 0, moves along it at the
/// speed v and turns about it at the rate omega: EJ U'''' + rhoA U_tt = P exp(i omega t) delta(z - v t), U = U_1 + i
/// U_2. With lengths over l, times over l/v and deflections over P l^3/(48 EJ) an Euler-Bernoulli beam depends on the
/// first two numbers only. A circular shaft whose sections have rotary inertia, and spin (Rayleigh's beam with
/// gyroscopic terms, Katz 2001), adds - rhoJ U''_tt + i rhoI_p Omega U''_t on the left, and with them the other two.
struct RotatingLoad {
  double a;                ///< v/v_cr, v_cr = (pi/l) sqrt(EJ/rhoA)
  double k_omega;          ///< turns of the load on its way, omega l/(2 pi v)
  double slenderness = 0;  ///< radius over l, for rotary inertia
  double spin = 0;         ///< angle by which the shaft turns while the load is on its way, Omega l/v
};

/// Deflection at z/l while the load is at `load`/l, by its modes.
std::complex<double> closed_form(const RotatingLoad& set, double load, double z);

}  // namespace vlbeam
