#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/small_angle.hpp"
#include "core/geometry/vec.hpp"

namespace vlbeam {

/// `v`, which is across the unit vector `from`, turned by the smallest rotation that takes `from` to the unit vector
/// `to`. Not defined where these are opposite.
template <class Real>
Vec<Real, 3> carried(const Vec<Real, 3>& from, const Vec<Real, 3>& to, const Vec<Real, 3>& v) {
  const Real along = to.dot(v);
  return v - (from + to) * Real(along / (Real(1) + from.dot(to)));
}

/// How the section at a node stands: the direction of its y axis, and the spin about the tangent [rad/s]; at a node
/// that moves along the beam that of the directions there. `ahead` is the twist from there to the next node, to within
/// half a turn, `angle` how far what holds the section has turned it since t = 0 [rad].
struct SectionState {
  Vec<double, 3> direction;
  double spin = 0, ahead = 0, angle = 0;
};

/// The direction from which a node's angle counts: d, across a tangent t. When the tangent turns, the smallest rotation
/// turns d with it. The section there has the direction d(s, phi), across the slope s, turned about it by phi.
///
/// As it turns by dphi and its slope by ds, its spin about the tangent is dphi + A.ds,
///   A = -(t x s)/(|s| (|s| + t.s)),
/// the own spin of the smallest rotation; a torque X about the tangent so acts on phi with X and on s with A X. A is
/// no gradient: its curl, s/|s|^3 with a sign, knows neither t nor d, as physics does not.
struct TriadReference {
  Vec<double, 3> t, d;

  template <class Real>
  Vec<Real, 3> direction(const Vec<Real, 3>& s, const Real& phi) const {
    using std::sqrt;
    const Vec<Real, 3> now = s / Real(sqrt(s.dot(s)));
    const Vec<Real, 3> from = carried<Real>(t.cast<Real>(), now, d.cast<Real>());
    const auto [sine, cosine] = sine_cosine(phi);
    return from * cosine + now.cross(from) * sine;
  }
  /// A [1].
  template <class Real>
  Vec<Real, 3> spin_by_slope(const Vec<Real, 3>& s) const {
    using std::sqrt;
    const Vec<Real, 3> from = t.cast<Real>();
    const Real size = sqrt(s.dot(s));
    return s.cross(from) / Real(size * (size + from.dot(s)));
  }
  /// dA/ds: row i is the gradient of A_i.
  template <class Real>
  Eigen::Matrix<Real, 3, 3> spin_by_slope_gradient(const Vec<Real, 3>& s) const {
    using std::sqrt;
    const Vec<Real, 3> from = t.cast<Real>();
    const Real size = sqrt(s.dot(s)), along = from.dot(s), below = size * (size + along);
    const Vec<Real, 3> by = (s * Real(Real(2) + along / size) + from * size) / Real(below * below), own = from.cross(s);
    Eigen::Matrix<Real, 3, 3> result;
    for (int c = 0; c < 3; ++c) result.col(c) = Vec<Real, 3>::Unit(c).cross(from) / below + own * by[c];
    return result;
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
