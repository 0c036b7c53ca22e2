#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/geometry/elementary.hpp"
#include "core/geometry/vec.hpp"

namespace vlbeam {

/// Vectors of the plane, columns of `a`, turned by a right angle; in space none are turned.
template <int D, class Columns>
auto quarter_turn(const Columns& a) {
  typename Columns::PlainObject turned = Columns::PlainObject::Zero(a.rows(), a.cols());
  if constexpr (D == 2) {
    turned.row(0) = -a.row(1);
    turned.row(1) = a.row(0);
  }
  return turned;
}

/// What a support leaves free at an end node, component by component in an orthonormal frame of its own:
/// 1 a free component of position or slope, 0 a fixed one.
template <int D>
struct Support {
  using Components = Eigen::Array<double, D, 1>;

  Eigen::Matrix<double, D, D> frame = Eigen::Matrix<double, D, D>::Identity();  ///< columns are the frame's axes
  bool aligned = true;                                                          ///< the frame is the global one
  Components free_position = Components::Ones();
  Components free_slope = Components::Ones();
  bool free_angle = true;  ///< about the tangent, where nodes have an angle

  static Support free_end() { return {}; }

  static Support pin() {
    Support support;
    support.free_position.setZero();
    return support;
  }

  /// Position and slope vector fixed.
  static Support clamp() {
    Support support = pin();
    support.free_slope.setZero();
    support.free_angle = false;
    return support;
  }

  /// Position fixed, slope free along `tangent`, which need not have unit length.
  static Support direction_clamp(const Vec<double, D>& tangent) {
    Support support = clamp();
    support.free_slope[0] = 1;
    support.turn(tangent);
    return support;
  }

  /// Position free along `direction`, which need not have unit length: a spherical joint on a slide.
  static Support slide(const Vec<double, D>& direction) {
    Support support = pin();
    support.free_position[0] = 1;
    support.turn(direction);
    return support;
  }

  /// The same, turned in the plane by `angle` [rad] about its point; in space nothing turns.
  Support turned(double angle) const {
    Support support = *this;
    if (D != 2 || angle == 0) return support;
    support.frame = quarter_turn<D>(frame) * portable::sin(angle) + frame * portable::cos(angle);
    support.aligned = false;
    return support;
  }

  Vec<double, D> into_frame(const Vec<double, D>& a) const { return aligned ? a : frame.transpose() * a; }
  Vec<double, D> out_of_frame(const Vec<double, D>& a) const { return aligned ? a : frame * a; }

 private:
  /// Turns the frame's first axis into `direction`.
  void turn(const Vec<double, D>& direction) {
    const Vec<double, D> t = direction.normalized();
    aligned = t == Vec<double, D>::UnitX();
    frame.col(0) = t;
    if constexpr (D == 2) {
      frame.col(1) << -t[1], t[0];
    } else {
      frame.col(1) = t.unitOrthogonal();
      frame.col(2) = t.cross(frame.col(1));
    }
    if (aligned) frame.setIdentity();
  }
};

}  // namespace vlbeam
