#pragma once

#include <optional>

#include "core/geometry/elementary.hpp"
#include "mechanics/contact/one_sided.hpp"
#include "mechanics/motion/joint/axial_friction.hpp"
#include "mechanics/motion/parts/acting_point_masses.hpp"
#include "mechanics/motion/parts/part.hpp"
#include "mechanics/ropes/line_force.hpp"

namespace vlbeam {

/// A floor that bears the beam from below. At a depth p under its level it pushes with N = k S(p), OneSided, per
/// unstretched length; it damps the velocity along `up` by c S'(p) and rubs against the one across it, v_t, with
/// mu N v_t/sqrt(v_t^2 + v_0^2). N is the derivative of a potential, what it stores is booked as work of loads.
template <int D>
struct FloorLaw {
  Vec<double, D> up = Vec<double, D>::UnitY();  ///< unit vector
  double level = 0;                             ///< along `up` [m]
  double stiffness = 0;                         ///< k [N/m^2]
  double depth = 0;                             ///< d, over which the push sets in [m]
  double damping = 0;                           ///< c [N s/m^2]
  std::optional<AxialFriction> friction = {};   ///< mu, and v_0 below which it fades

  OneSided spring() const { return {stiffness, depth}; }
  bool acts(const Vec<double, D>& r) const { return up.dot(r) < level; }

  template <class Real>
  Vec<Real, D> force(const LinePoint<Real, D>& at) const {
    const Vec<Real, D> along = up.template cast<Real>();
    const Real p = Real(level) - at.r.dot(along), speed = at.v.dot(along);
    const OneSided floor = spring();
    const Real push = floor.push(p);
    Vec<Real, D> f = along * Real(push - Real(damping) * floor.share(p) * speed);
    if (friction) {
      const Vec<Real, D> across = at.v - along * speed;
      const Real size2 = across.squaredNorm() + Real(friction->velocity * friction->velocity);
      f -= across * Real(Real(friction->coefficient) * push / sqrt(size2));
    }
    return f;
  }
};

/// The floor as a part of the equations. It bears a lumped mass as it bears as much of the beam.
template <int D>
class Ground final : public Part<D> {
 public:
  /// `rhoA` is the beam's mass per length [kg/m].
  Ground(const FloorLaw<D>& law, int quadrature_points, const PointMasses<D>& masses = {}, double rhoA = 1)
      : law_(law), points_(quadrature_points), masses_(masses), rhoA_(rhoA) {}
  EnergyBalance add_force(const Motion<D>& motion, double* force) const override;
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override;

 private:
  /// Length of beam that has the mass of the `i`-th lumped one [m].
  double as_length(std::size_t i) const { return masses_.points[i].mass / rhoA_; }

  FloorLaw<D> law_;
  int points_;
  PointMasses<D> masses_;
  double rhoA_;
};

extern template class Ground<2>;
extern template class Ground<3>;

}  // namespace vlbeam
