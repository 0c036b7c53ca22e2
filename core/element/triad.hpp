#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/geometry/elementary.hpp"
#include "core/geometry/vec.hpp"

namespace vlbeam {

/// `v`, which is across the unit vector `from`, turned by the smallest rotation that takes `from` to the unit vector
/// `to`. Not defined where these are opposite.
template <class Real>
Vec<Real, 3> carried(const Vec<Real, 3>& from, const Vec<Real, 3>& to, const Vec<Real, 3>& v) {
  const Real along = to.dot(v);
  return v - (from + to) * Real(along / (Real(1) + from.dot(to)));
}

/// What a node's angle is counted from: a direction d across a tangent t, which the smallest rotation takes along with
/// the tangent. The section there has the direction d(s, phi), across the slope s, turned about it by phi.
///
/// As it turns by dphi and its slope by ds, its spin about the tangent is dphi + A.ds,
///   A = -(t x s)/(|s| (|s| + t.s)),
/// the own spin of the smallest rotation; a torque X about the tangent so acts on phi with X and on s with A X. A is
/// no gradient: its curl, s/|s|^3 with a sign, knows neither t nor d, as physics does not.
struct TriadReference {
  Vec<double, 3> t, d;

  Vec<double, 3> direction(const Vec<double, 3>& s, double phi) const {
    const Vec<double, 3> now = s.normalized(), from = carried<double>(t, now, d);
    return from * portable::cos(phi) + now.cross(from) * portable::sin(phi);
  }
  /// A [1].
  Vec<double, 3> spin_by_slope(const Vec<double, 3>& s) const {
    const double size = s.norm();
    return -t.cross(s) / (size * (size + t.dot(s)));
  }
  /// dA/ds: row i is the gradient of A_i.
  Eigen::Matrix3d spin_by_slope_gradient(const Vec<double, 3>& s) const {
    const double size = s.norm(), along = t.dot(s), below = size * (size + along);
    const Vec<double, 3> by = s * (2 + along / size) + t * size;  // gradient of what is below
    Eigen::Matrix3d cross;
    cross << 0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0;
    return -cross / below + t.cross(s) * by.transpose() / (below * below);
  }
  /// The same section seen from the present slope: the angle stays what it is.
  TriadReference at(const Vec<double, 3>& s) const {
    const Vec<double, 3> now = s.normalized();
    Vec<double, 3> from = carried<double>(t, now, d);
    from -= now * now.dot(from);
    return {now, from.normalized()};
  }
};

/// Minus the curl of A, which is all of it that a motion feels [1].
inline Vec<double, 3> spin_curl(const Vec<double, 3>& s) {
  const double size = s.norm();
  return s / (size * size * size);
}

}  // namespace vlbeam
