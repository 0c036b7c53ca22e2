#pragma once

#include "core/geometry/vec.hpp"

namespace vlbeam {

/// What turns as the beam runs over it without slip, by its moment of inertia over radius^2: a wheel, or a drum. With
/// the speed |r_x| x' of the beam on it, and d'Alembert's principle,
///   m(x) |r_x| d(|r_x| x')/dt
/// is what it needs on x: the inertia of what is wound up leaves with the beam that runs off, at the same speed.
/// Derived: docs/theory/joints.md, Drums.
struct Turning {
  double inertia = 0;      ///< [kg], at `from`
  double by_length = 0;    ///< what it grows by along x: of beam that is wound up [kg/m]
  double from = 0;         ///< material coordinate [m]
  bool stretched = false;  ///< the beam on it is stretched as the beam beside it, else unstretched

  bool present() const { return inertia != 0 || by_length != 0; }
  double at(double x) const { return inertia + by_length * (x - from); }
  /// Against x'' [kg].
  template <int D>
  double against(double x, const Vec<double, D>& slope) const {
    return stretched ? at(x) * slope.squaredNorm() : at(x);
  }
  /// What its inertia needs on x besides [N].
  template <int D>
  double lag(double x, double rate, const Vec<double, D>& slope, const Vec<double, D>& slope_rate) const {
    return stretched ? at(x) * slope.dot(slope_rate) * rate : 0;
  }
};

}  // namespace vlbeam
