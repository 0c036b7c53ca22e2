#pragma once

#include "core/beam/mesh_motion.hpp"
#include "core/beam/support.hpp"

namespace vlbeam {

/// What a support prescribes of its point, with the first two derivatives: in global components.
template <int D>
struct DrivenPoint {
  Vec<double, D> value = Vec<double, D>::Zero();         ///< displacement since t = 0 [m]
  Vec<double, D> rate = Vec<double, D>::Zero();          ///< [m/s]
  Vec<double, D> acceleration = Vec<double, D>::Zero();  ///< [m/s^2]
};

/// Displacement of a support's point, `direction` times a function of time, counted from where it is at t = 0. Without
/// a function the support stands still.
template <int D>
struct SupportMotion {
  Vec<double, D> direction = Vec<double, D>::Zero();  ///< [-]
  TimeFunction displacement;                          ///< [m]

  explicit operator bool() const { return static_cast<bool>(displacement); }

  /// Of the components that `support` fixes; the others it does not drive.
  DrivenPoint<D> at(const Support<D>& support, double t) const {
    if (!displacement) return {};
    const Vec<double, D> held =
        support.out_of_frame((support.into_frame(direction).array() * (1 - support.free_position)).matrix());
    const Prescribed now = displacement(t);
    return {(now.value - displacement(0).value) * held, now.rate * held, now.acceleration * held};
  }
};

}  // namespace vlbeam
