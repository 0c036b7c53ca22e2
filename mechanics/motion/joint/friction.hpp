#pragma once

#include <cmath>
#include <optional>

#include "core/geometry/elementary.hpp"
#include "core/geometry/vec.hpp"
#include "mechanics/motion/joint/axial_friction.hpp"

namespace vlbeam {

// Friction along the beam between it and what slides on it. A joint moves over the material with the relative velocity
// r_x x', for the material point there has the velocity r' - r_x x'. A force F t on the joint and -F t on that point,
// t = r_x/|r_x|, do the virtual work F t.(dr - (dr - r_x dx)) = F |r_x| dx: friction acts on the joint's material
// coordinate alone. Where the slopes of the two sides are parallel, r_x is their mean, that of the two relative
// velocities; where the beam turns by an angle phi, it lies around the joint as around a drum too small to be seen, and
// friction grows along the arc (capstan): |r_x| is then the mean of both.

/// Share of the whole contact force R that friction takes where the beam turns by an angle phi. The force |T_+ t_+ -
/// T_- t_-| between tensions T_+ = T_- e^(mu phi) is R, so that with tau = tanh(mu phi/2) and k = sin^2(phi/2) F = T_+
/// - T_- = R tau/sqrt(tau^2 + k (1 - tau^2)); for phi = 0 it is the F = mu N of R^2 = N^2 + F^2. `mu` has the sign of
/// the sliding.
template <class Real>
Real capstan_share(const Real& mu, const Real& k) {
  using portable::asin;
  using portable::tanh;
  using std::sqrt;
  constexpr double slight = 1e-8, full = 1 - 1e-14;  // of k: where series are exact, and where asin has no derivative
  Real tau;                                          // over sqrt(k)
  if (k < slight) {
    const Real z = mu * Real(1 + k / 6);
    tau = z * Real(1 - z * z * k / 3);
  } else {
    const Real root = sqrt(k);
    const Real half_turn = k < full ? Real(asin(root)) : Real(portable::asin(1.0));
    tau = tanh(Real(mu * half_turn)) / root;
  }
  return tau / sqrt(Real(1 + (1 - k) * tau * tau));
}

/// The beam as what slides on it feels it.
template <class Real, int D>
class Contact {
 public:
  explicit Contact(const Vec<Real, D>& slope) : Contact(slope, slope, false) {}
  /// Slopes before and behind the joint; the beam may turn there.
  Contact(const Vec<Real, D>& before, const Vec<Real, D>& behind, bool turns) : turns_(turns) {
    using std::sqrt;
    const auto length = [](const Vec<Real, D>& a) { return Real(sqrt(a.dot(a))); };
    if (turns) {
      const Real first = length(before), second = length(behind);
      const Vec<Real, D> bend = (behind * Real(1 / second) - before * Real(1 / first)) * Real(0.5);
      bend_ = bend.dot(bend);
      stretch_ = (first + second) / 2;
    } else {
      const Vec<Real, D> slope = (before + behind) * Real(0.5);
      stretch_ = length(slope);
      tangent_ = slope * (Real(1) / stretch_);
    }
  }

  const Real& stretch() const { return stretch_; }  ///< |r_x|
  /// What friction is a share of: of a contact force the normal part, or all of it where the beam turns.
  Vec<Real, D> pressing(const Vec<Real, D>& force) const {
    return turns_ ? force : Vec<Real, D>(force - tangent_ * Real(tangent_.dot(force)));
  }
  /// That share, of the sign of x'.
  Real share(const AxialFriction& friction, const Real& x_rate) const {
    const Real mu = friction.share(Real(stretch_ * x_rate));
    return turns_ ? capstan_share(mu, bend_) : mu;
  }

 private:
  bool turns_;
  Vec<Real, D> tangent_ = Vec<Real, D>::Zero();
  Real stretch_, bend_ = Real(0);  ///< `bend_` is sin^2 of half the turn
};

/// The pressing force N of N = |p - c N p_1|, where p is that without friction, p_1 what a unit of friction adds to it,
/// and c N the friction. Empty where friction jams (c |p_1| >= 1: it presses harder than it resists, and no or several
/// N are solutions).
template <int D>
std::optional<double> pressing_force(const Vec<double, D>& p, const Vec<double, D>& p_1, double c) {
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

/// `pull` is the force of the beam on what slides [N].
template <class Real, int D>
FrictionForce<Real> friction_force(const AxialFriction& friction, const Vec<Real, D>& pull,
                                   const Contact<Real, D>& contact, const Real& x_rate) {
  using std::sqrt;
  const Vec<Real, D> pressing = contact.pressing(pull);
  const Real square = pressing.dot(pressing);
  if (!(square > 0)) return {Real(0), Real(0)};
  const Real force = contact.share(friction, x_rate) * sqrt(square) * contact.stretch();
  return {-force, force * x_rate};
}

}  // namespace vlbeam
