#pragma once

#include <optional>

#include "core/beam/node_map.hpp"
#include "core/geometry/prescribed.hpp"
#include "mechanics/motion/parts/material_point.hpp"

namespace vlbeam {

/// A condition C = 0 on a beam. Two nodes keep a distance: all of it, or, where they are tied, along a fixed direction.
/// Or a material point keeps its place along a fixed direction, C = along . r(x) - distance, in whichever element it
/// is: joints pass over it.
template <int D>
struct BeamLink {
  using Vector = Vec<double, D>;

  int behind = -1, ahead = -1;       ///< nodes; of a material point there are none
  double distance = 0;               ///< [m]
  std::optional<Vector> along = {};  ///< a fixed direction of length 1; nothing: from the one node to the other
  std::optional<double> place = {};  ///< material coordinate of the point [m]
  /// Of a mass m that the beam carries along the direction: its force is -m C'', and C is nothing that holds.
  double mobility = 0;  ///< 1/m [1/kg]
  Prescribed way = {};  ///< material coordinate of the point that travels

  /// What holds a material point where `at` is, along a direction of length 1.
  static BeamLink holding(double x, const Vector& at, const Vector& direction) {
    BeamLink link;
    link.distance = direction.dot(at);
    link.along = direction;
    link.place = x;
    return link;
  }

  /// A mass that the beam carries along a direction of length 1, where it is now.
  static BeamLink carrying(double mass, const Prescribed& x, const Vector& direction) {
    BeamLink link;
    link.along = direction;
    link.place = x.value;
    link.mobility = 1 / mass;
    link.way = x;
    return link;
  }

  /// C [m].
  double value(const ChainView<D>& beam) const {
    if (place) return along->dot(point(beam).r) - distance;
    const Vector apart = difference(beam.q);
    return along ? along->dot(apart) - distance : (apart.squaredNorm() / distance - distance) / 2;
  }
  /// dC/dt [m/s], of the material point there.
  double rate(const ChainView<D>& beam) const {
    return place ? along->dot(point(beam).v) : line(beam.q).dot(difference(beam.rate));
  }
  /// dC/dq times an array like q.
  double dot(const ChainView<D>& beam, const double* array) const {
    if (!place) return line(beam.q).dot(difference(array));
    const int k = beam.element_at(*place);
    const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), *place);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      sum += at.s[static_cast<std::size_t>(i)] * along->dot(Eigen::Map<const Vector>(array + beam.vector(k, i)));
    }
    if (const JointPlace* a = beam.joint_at(k)) sum += along->dot(at.y_a) * array[a->mark];
    if (const JointPlace* b = beam.joint_at(k + 1)) sum += along->dot(at.y_b) * array[b->mark];
    return sum;
  }
  /// C'' without accelerations [m/s^2].
  double turning(const ChainView<D>& beam) const {
    if (place) {
      const PointMotion<double, D> at = point(beam);
      const double v = way.rate;
      return along->dot(at.remainder + 2 * v * at.v_x + v * v * at.r_xx + way.acceleration * at.r_x);
    }
    return along ? 0 : difference(beam.rate).squaredNorm() / distance;
  }
  /// Adds dC/dq times `size` to an array like q: the force of a multiplier of that size.
  void add_force(const ChainView<D>& beam, double size, double* out) const {
    if (place) {
      const int k = beam.element_at(*place);
      return add_point_force(beam, k, point_at<double, D>(beam.kinematics(k), *place),
                             PointForce<double, D>{size * *along, Vector::Zero()}, out);
    }
    const Vector pull = along ? Vector(size * *along) : Vector(size / distance * difference(beam.q));
    position<D>(out, behind) -= pull;
    position<D>(out, ahead) += pull;
  }

  /// From the one node to the other, of an array like q.
  Vector difference(const double* q) const { return position<D>(q, ahead) - position<D>(q, behind); }
  /// The gradient by the position of the node ahead, of length 1 where C = 0.
  Vector line(const double* q) const { return along ? *along : Vector(difference(q) / distance); }

 private:
  PointMotion<double, D> point(const ChainView<D>& beam) const {
    return point_at<double, D>(beam.kinematics(beam.element_at(*place)), *place);
  }
};

}  // namespace vlbeam
