#pragma once

#include <optional>
#include <vector>

#include "core/beam/chain_view.hpp"
#include "core/geometry/prescribed.hpp"
#include "mechanics/motion/parts/material_point.hpp"

namespace vlbeam {

/// A wheel that rolls along the beam as prescribed, and what stands on it: a mass on a spring and a damper that moves
/// along `up` alone, and a force. Before it comes onto the beam and after it has left it rolls on a road as high as the
/// end of the beam there, as it is drawn.
struct Axle {
  TimeFunction x;          ///< material coordinate of the wheel, on the beam or off it [m]
  double force = 0;        ///< down, on the wheel [N]
  double mass = 0;         ///< of the wheel [kg]
  double sprung_mass = 0;  ///< [kg]
  double stiffness = 0;    ///< of its spring [N/m]
  double damping = 0;      ///< beside it [N s/m]

  bool sprung() const { return sprung_mass > 0; }
};

/// All axles on one beam.
template <int D>
struct Axles {
  using Vector = Vec<double, D>;

  std::vector<Axle> all = {};
  Vector up = Vector::UnitY();    ///< of length 1
  double before = 0, behind = 0;  ///< height of the road at either end [m], along `up`

  /// Where one is on the beam; nothing while it is off it.
  std::optional<Prescribed> on_beam(std::size_t which, const ChainView<D>& beam, double t) const {
    const Prescribed at = all[which].x(t);
    return beam.contains(at.value) ? std::optional(at) : std::nullopt;
  }
  /// How high the road is where one is off the beam [m].
  double road(std::size_t which, const ChainView<D>& beam, double t) const {
    return all[which].x(t).value < beam.mark_of(beam.mesh.last()) / 2 ? before : behind;
  }
};

/// A wheel on the beam at one instant: as high as the beam is there.
template <class Real, int D>
struct WheelMotion {
  Real height, rate;  ///< [m], [m/s]
  Real convective;    ///< acceleration without those of coordinates [m/s^2]

  WheelMotion(const PointMotion<Real, D>& at, const Vec<Real, D>& up, const Prescribed& x) {
    height = up.dot(at.r);
    rate = up.dot(at.v) + Real(x.rate) * up.dot(at.r_x);
    convective = up.dot(at.remainder) + Real(2 * x.rate) * up.dot(at.v_x) + Real(x.rate * x.rate) * up.dot(at.r_xx) +
                 Real(x.acceleration) * up.dot(at.r_x);
  }
};

}  // namespace vlbeam
