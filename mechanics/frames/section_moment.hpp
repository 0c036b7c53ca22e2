#pragma once

#include <functional>

#include "mechanics/frames/frame_element.hpp"

namespace vlbeam {

/// A moment on the section at a node of a beam with frames, as a function of time. Its axis, a unit vector, stays in
/// space; or it follows the section, and has its components along the tangent, y and z of that.
struct SectionMoment {
  int node = 0;  ///< negative ones count from the last, -1
  Vec<double, 3> direction;
  bool follows = false;
  std::function<double(double t)> size = {};  ///< [N m]
};

/// What a moment does to the slope [N m] and the angle [N m] of a node.
template <class Real>
struct MomentForce {
  Vec<Real, 3> on_slope;
  Real on_angle;
};

/// A virtual motion that changes the slope by ds and the angle by dphi turns the section by t x dt about axes across
/// the tangent t and by dphi + A.ds about it, see TriadReference. So a moment m does m.t on the angle, and on the slope
/// A m.t + m x t/|s|. Derived: docs/theory/frames.md.
template <class Real>
MomentForce<Real> moment_force(const SectionMoment& moment, double size, const TriadReference& from,
                               const Vec<Real, 3>& s, const Real& phi) {
  using std::sqrt;
  const Real length = sqrt(s.dot(s));
  const Vec<Real, 3> t = s / length, m = (size * moment.direction).template cast<Real>();
  if (!moment.follows) {
    const Real along = m.dot(t);
    return {from.spin_by_slope<Real>(s) * along + m.cross(t) / length, along};
  }
  const Vec<Real, 3> y = from.direction<Real>(s, phi), z = t.cross(y);
  return {from.spin_by_slope<Real>(s) * m[0] + (y * m[2] - z * m[1]) / length, m[0]};
}

/// Its derivatives by slope and angle; the last row is that of the force on the angle.
inline Eigen::Matrix4d moment_tangent(const SectionMoment& moment, double size, const TriadReference& from,
                                      const Vec<double, 3>& s, double phi) {
  Vec<Active<4>, 3> slope;
  for (int c = 0; c < 3; ++c) slope[c] = Active<4>(s[c], c);
  const auto force = moment_force<Active<4>>(moment, size, from, slope, Active<4>(phi, 3));
  Eigen::Matrix4d result;
  for (int c = 0; c < 3; ++c) result.row(c) = force.on_slope[c].derivatives().transpose();
  result.row(3) = force.on_angle.derivatives().transpose();
  return result;
}

}  // namespace vlbeam
