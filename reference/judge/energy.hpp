// The physics: energies per unit of the reference coordinate xi in [-1, 1] of a stretch of beam with moving ends. It is
// all that the judge shares with the program, and it shares it on paper only.
//
//   x = (a + b)/2 + h xi, h = (b - a)/2      material coordinate of a place xi; a and b move
//   r(xi, t)                                 where it is; r', r'' are derivatives by xi
//   v = dr/dt - (r'/h) dx/dt                 velocity of the material that is there
//   eps = (|r'|^2/h^2 - 1)/2                 axial strain (Green)
//   kappa = r' x r''/|r'|^3                  curvature of the axis, signed
#pragma once

namespace judge {

struct Section {
  double EA = 0, EI = 0, rhoA = 0;  ///< [N, N m^2, kg/m]
  double kappa0 = 0;                ///< curvature at rest, the same everywhere [1/m]
};

/// dr/dt and dx/dt at fixed xi, r' and h.
template <class Real>
Real kinetic_density(const Section& s, const Real& rate_x, const Real& rate_y, const Real& flow, const Real& dx,
                     const Real& dy, const Real& h) {
  const Real passing = flow / h;
  const Real vx = rate_x - dx * passing, vy = rate_y - dy * passing;
  return (0.5 * s.rhoA) * (h * (vx * vx + vy * vy));
}

template <class Real>
Real axial_density(const Section& s, const Real& dx, const Real& dy, const Real& h) {
  const Real strain = 0.5 * ((dx * dx + dy * dy) / (h * h) - 1.0);
  return (0.5 * s.EA) * (h * (strain * strain));
}

template <class Real>
Real bending_density(const Section& s, const Real& dx, const Real& dy, const Real& ddx, const Real& ddy,
                     const Real& h) {
  using std::sqrt;
  const Real g = dx * dx + dy * dy;
  const Real kappa = (dx * ddy - dy * ddx) / (g * sqrt(g)) - s.kappa0;
  return (0.5 * s.EI) * (h * (kappa * kappa));
}

template <class Real>
Real gravity_density(const Section& s, double gx, double gy, const Real& x, const Real& y, const Real& h) {
  return (-s.rhoA) * (h * (gx * x + gy * y));
}

}  // namespace judge
