#pragma once

#include <algorithm>
#include <array>

#include "core/beam/support.hpp"
#include "core/geometry/elementary.hpp"
#include "core/geometry/prescribed.hpp"

namespace vlbeam {

/// What a support prescribes of its point, with the first two derivatives: in global components. If it turns by the
/// angle theta, what it holds of the slope s turns with it, F^T s = F_0^T s_0 on the fixed components of its frame F:
///   s' = theta' J s,   s'' = theta'' J s + 2 theta' J s' + theta'^2 s   on these,   J a right angle.
template <int D>
struct DrivenPoint {
  Vec<double, D> value = Vec<double, D>::Zero();         ///< displacement since t = 0 [m]
  Vec<double, D> rate = Vec<double, D>::Zero();          ///< [m/s]
  Vec<double, D> acceleration = Vec<double, D>::Zero();  ///< [m/s^2]
  Prescribed angle;                                      ///< [rad] by which it has turned since t = 0

  /// Of `part`, a slope or its rate, what a support fixes that has turned already.
  static Vec<double, D> held(const Support<D>& turned, const Vec<double, D>& part) {
    return turned.out_of_frame((turned.into_frame(part).array() * (1 - turned.free_slope)).matrix());
  }
  /// Where the slope `anchor` that it held at t = 0 is now.
  Vec<double, D> turned(const Vec<double, D>& anchor) const {
    if (D != 2 || angle.value == 0) return anchor;
    return portable::cos(angle.value) * anchor + portable::sin(angle.value) * quarter_turn<D>(anchor);
  }
  Vec<double, D> slope_rate(const Vec<double, D>& slope) const { return angle.rate * quarter_turn<D>(slope); }
  Vec<double, D> slope_acceleration(const Vec<double, D>& slope, const Vec<double, D>& turning) const {
    return angle.acceleration * quarter_turn<D>(slope) + 2 * angle.rate * quarter_turn<D>(turning) +
           angle.rate * angle.rate * slope;
  }
};

/// Displacement of a support's point, `direction` times a function of time and one along each axis, and its angle about
/// this point, all counted from where it is at t = 0. Without a function the support stands still.
template <int D>
struct SupportMotion {
  Vec<double, D> direction = Vec<double, D>::Zero();  ///< [-]
  TimeFunction displacement;                          ///< [m]
  TimeFunction angle = {};                            ///< [rad], in the plane
  std::array<TimeFunction, D> along = {};             ///< beside it, along each axis [m]

  explicit operator bool() const {
    return displacement || angle || std::ranges::any_of(along, [](const TimeFunction& f) { return bool(f); });
  }
  bool turns() const { return static_cast<bool>(angle); }

  /// Of the components that `support` fixes; the others it does not drive.
  DrivenPoint<D> at(const Support<D>& support, double t) const {
    DrivenPoint<D> point;
    if (angle) {
      point.angle = angle(t);
      point.angle.value -= angle(0).value;
    }
    const auto add = [&](const TimeFunction& way, const Vec<double, D>& axis) {
      if (!way) return;
      const Vec<double, D> held =
          support.out_of_frame((support.into_frame(axis).array() * (1 - support.free_position)).matrix());
      const Prescribed now = way(t);
      point.value += (now.value - way(0).value) * held;
      point.rate += now.rate * held;
      point.acceleration += now.acceleration * held;
    };
    add(displacement, direction);
    for (int c = 0; c < D; ++c) add(along[static_cast<std::size_t>(c)], Vec<double, D>::Unit(c));
    return point;
  }
};

}  // namespace vlbeam
