#pragma once

#include <cmath>
#include <optional>

#include "core/geometry/vec.hpp"
#include "core/joint/axial_friction.hpp"

namespace vlbeam {

// Friction along the beam between it and the mass on it. The mass moves over the material at the joint with the
// relative velocity r_x x', for the material point there has the velocity r' - r_x x'. A force F t on the mass and -F t
// on that point, t = r_x/|r_x|, do the virtual work F t.(dr - (dr - r_x dx)) = F |r_x| dx: friction acts on the joint's
// material coordinate alone. Where the slopes of the two sides differ, r_x is their mean, that of the two relative
// velocities.

/// The beam as the mass on it feels it.
template <class Real, int D>
struct Contact {
  Vec<Real, D> tangent;
  Real stretch;  ///< |r_x|

  explicit Contact(const Vec<Real, D>& slope) {
    using std::sqrt;
    stretch = sqrt(slope.dot(slope));
    tangent = slope * (Real(1) / stretch);
  }
  Vec<Real, D> normal_part(const Vec<Real, D>& force) const { return force - tangent * Real(tangent.dot(force)); }
};

/// The normal force N of N = |p - c N p_1|, where p is the normal contact force without friction, p_1 what a unit of
/// friction adds to it, and c N the friction. Empty where friction jams (c |p_1| >= 1: it presses the mass on harder
/// than it resists, and no or several N are solutions).
template <int D>
std::optional<double> normal_force(const Vec<double, D>& p, const Vec<double, D>& p_1, double c) {
  const double square = p.squaredNorm(), a = 1 - c * c * p_1.squaredNorm(), b = c * p.dot(p_1);
  if (!(a > 0)) return std::nullopt;
  if (square == 0) return 0;
  const double root = std::sqrt(b * b + a * square);
  return b > 0 ? square / (b + root) : (root - b) / a;
}

/// Generalized force of friction on the joint's material coordinate, and the power it takes, at given accelerations.
template <class Real>
struct FrictionForce {
  Real force, dissipation;  ///< [N], [W]
};

/// `pull` is the acceleration of the mass [kg] less gravity, `slope` the mean r_x at the joint.
template <class Real, int D>
FrictionForce<Real> friction_force(const AxialFriction& friction, double mass, const Vec<Real, D>& pull,
                                   const Vec<Real, D>& slope, const Real& x_rate) {
  using std::sqrt;
  const Contact<Real, D> contact(slope);
  const Vec<Real, D> normal = contact.normal_part(pull) * Real(mass);
  const Real square = normal.dot(normal);
  if (!(square > 0)) return {Real(0), Real(0)};
  const Real v = contact.stretch * x_rate;
  const Real force = friction.share(v) * sqrt(square);
  return {-force * contact.stretch, force * v};
}

}  // namespace vlbeam
