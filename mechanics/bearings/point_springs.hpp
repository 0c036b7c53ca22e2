#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/motion/parts/material_point.hpp"
#include "mechanics/motion/parts/part.hpp"

namespace vlbeam {

/// A spring and a damper between a material point of the beam and the ground. Along a direction they resist to the way
/// from `place` along it; without one, to the distance from `place`, whose free length is `length`, 0 in all
/// directions.
template <int D>
struct PointSpring {
  double x = 0;                                   ///< material coordinate of the point [m]
  Vec<double, D> place = Vec<double, D>::Zero();  ///< [m]
  std::optional<Vec<double, D>> along = {};       ///< of length 1
  double stiffness = 0;                           ///< [N/m]
  double damping = 0;                             ///< [N s/m]
  double length = 0;                              ///< of the distance at which it bears nothing [m]
  bool tension_only = false;                      ///< it goes slack where it would push

  /// Where the point is and how it moves.
  template <class Real>
  struct State {
    Vec<Real, D> line;  ///< along which it pulls the point, of length 1
    Real stretch, rate;
  };
  template <class Real>
  State<Real> state(const Vec<Real, D>& r, const Vec<Real, D>& v) const {
    using std::sqrt;
    const Vec<Real, D> apart = r - place.template cast<Real>();
    if (along) {
      const Vec<Real, D> line = along->template cast<Real>();
      return {line, Real(line.dot(apart)), Real(line.dot(v))};
    }
    const Real far = sqrt(Real(apart.squaredNorm()));
    const Vec<Real, D> line = apart * Real(Real(1) / far);
    return {line, Real(far - Real(length)), Real(line.dot(v))};
  }
  bool isotropic() const { return !along && length == 0 && !tension_only; }
  /// Force on the point.
  template <class Real>
  Vec<Real, D> force(const Vec<Real, D>& r, const Vec<Real, D>& v) const {
    if (isotropic()) return Vec<Real, D>((place.template cast<Real>() - r) * Real(stiffness) - v * Real(damping));
    const State<Real> now = state<Real>(r, v);
    const Real pull = now.stretch * Real(stiffness) + now.rate * Real(damping);
    if (tension_only && !(now.stretch > Real(0) && pull > Real(0))) return Vec<Real, D>::Zero();
    return now.line * Real(-pull);
  }
  /// Of that the derivative of a potential, without damping.
  Vec<double, D> elastic(const Vec<double, D>& r) const {
    if (isotropic()) return stiffness * (place - r);
    const State<double> now = state<double>(r, Vec<double, D>::Zero());
    if (tension_only && now.stretch <= 0) return Vec<double, D>::Zero();
    return -stiffness * now.stretch * now.line;
  }
};

/// Springs as a part of the equations. What they store is booked as work of loads.
template <int D>
class PointSprings final : public Part<D> {
 public:
  explicit PointSprings(std::vector<PointSpring<D>> springs) : springs_(std::move(springs)) {}

  const std::vector<PointSpring<D>>& all() const { return springs_; }
  EnergyBalance add_force(const Motion<D>& motion, double* force) const override;
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override;

 private:
  std::vector<PointSpring<D>> springs_;
};

extern template class PointSprings<2>;
extern template class PointSprings<3>;

}  // namespace vlbeam
