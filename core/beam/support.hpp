#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/vec.hpp"

namespace vlbeam {

/// What a support leaves free at an end node, component by component in an orthonormal frame of its own:
/// 1 a free component of position or slope, 0 a fixed one.
template <int D>
struct Support {
  using Components = Eigen::Array<double, D, 1>;

  Eigen::Matrix<double, D, D> frame = Eigen::Matrix<double, D, D>::Identity();  ///< columns are the frame's axes
  bool aligned = true;                                                          ///< the frame is the global one
  Components free_position = Components::Ones();
  Components free_slope = Components::Ones();

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
    return support;
  }

  /// Position fixed, slope free along `tangent`, which need not have unit length.
  static Support direction_clamp(const Vec<double, D>& tangent) {
    Support support = clamp();
    support.free_slope[0] = 1;
    const Vec<double, D> t = tangent.normalized();
    support.aligned = t == Vec<double, D>::UnitX();
    support.frame.col(0) = t;
    if constexpr (D == 2) {
      support.frame.col(1) << -t[1], t[0];
    } else {
      support.frame.col(1) = t.unitOrthogonal();
      support.frame.col(2) = t.cross(support.frame.col(1));
    }
    if (support.aligned) support.frame.setIdentity();
    return support;
  }

  Vec<double, D> into_frame(const Vec<double, D>& a) const { return aligned ? a : frame.transpose() * a; }
  Vec<double, D> out_of_frame(const Vec<double, D>& a) const { return aligned ? a : frame * a; }
};

}  // namespace vlbeam
