#pragma once

#include <unsupported/Eigen/AutoDiff>

#include "core/beam/chain_view.hpp"

namespace vlbeam {

/// Coordinates of an element of a chain: its nodal vectors and the mark of a joint.
template <int D>
inline constexpr int point_coordinates = 4 * D + 1;
template <int D>
using PointMatrix = Eigen::Matrix<double, point_coordinates<D>, point_coordinates<D>>;

/// The material point x of an element.
template <class Real, int D>
PointMotion<Real, D> point_at(const MovingKinematics<Real, D>& element, double x) {
  const Real u = (x - element.coordinates().x_a) / element.length();
  return element.at(u, rational_shape(element.weights(), u));
}

/// What acts on a material point: conjugate to its position [N] and to the slope there [N m].
template <class Real, int D>
struct PointForce {
  Vec<Real, D> on_r = Vec<Real, D>::Zero(), on_slope = Vec<Real, D>::Zero();
};

/// Adds N^T F of a material point of element k, N = [S, y_A, y_B], to an array like q.
template <int D>
void add_point_force(const ChainView<D>& beam, int k, const PointMotion<double, D>& at, const PointForce<double, D>& f,
                     double* out) {
  for (int i = 0; i < 4; ++i) {
    const auto n = static_cast<std::size_t>(i);
    Eigen::Map<Vec<double, D>>(out + beam.vector(k, i)) += at.s[n] * f.on_r + at.s_x[n] * f.on_slope;
  }
  if (!beam.at_joint(k)) return;
  const bool a_moves = k == beam.joint;
  out[beam.mark] += f.on_r.dot(a_moves ? at.y_a : at.y_b) + f.on_slope.dot(a_moves ? at.y_a_x : at.y_b_x);
}

/// Derivatives of minus such a force by the element's coordinates, by_v times those by velocities and by_a times those
/// by accelerations, by automatic differentiation. `force(at, acceleration)` gives it, of the point's motion and
/// acceleration; `a` is an array like q.
template <int D, class Force>
PointMatrix<D> point_tangent(const ChainView<D>& beam, int k, double x, const double* a, double by_v, double by_a,
                             const Force& force) {
  constexpr int N = point_coordinates<D>, X = N - 1;
  using Real = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;
  using Vector = Vec<Real, D>;
  const bool moves = beam.at_joint(k), a_moves = k == beam.joint;
  const auto active = [&](const MovingCoordinates<double, D>& from, double seed) {
    const auto part = [&](const Vec<double, D>& value, int first) {
      Vector result;
      for (int c = 0; c < D; ++c) {
        result[c] = Real(value[c]);
        result[c].derivatives()[first + c] = seed;
      }
      return result;
    };
    MovingCoordinates<Real, D> result{
        {part(from.e.r_a, 0), part(from.e.s_a, D), part(from.e.r_b, 2 * D), part(from.e.s_b, 3 * D)},
        Real(from.x_a),
        Real(from.x_b)};
    if (moves) (a_moves ? result.x_a : result.x_b).derivatives()[X] = seed;
    return result;
  };
  ChainView<D> accelerations = beam;
  accelerations.rate = a;
  const auto q = active(beam.coordinates(k), 1), rate = active(beam.rates(k), by_v),
             second = active(accelerations.rates(k), by_a);
  const MovingKinematics<Real, D> element(q, rate, moves ? beam.transport : WeightTransport::frozen, beam.weights(k));
  const PointMotion<Real, D> at = point_at<Real, D>(element, x);
  Vector acceleration =
      at.remainder + second.e.r_a * at.s[0] + second.e.s_a * at.s[1] + second.e.r_b * at.s[2] + second.e.s_b * at.s[3];
  if (moves) acceleration += a_moves ? Vector(at.y_a * second.x_a) : Vector(at.y_b * second.x_b);
  const PointForce<Real, D> f = force(at, acceleration);
  PointMatrix<D> tangent = PointMatrix<D>::Zero();
  for (int i = 0; i < 4; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vector nodal = f.on_r * at.s[n] + f.on_slope * at.s_x[n];
    for (int c = 0; c < D; ++c) tangent.row(D * i + c) = -nodal[c].derivatives().transpose();
  }
  if (moves) {
    const Real on_mark = f.on_r.dot(a_moves ? at.y_a : at.y_b) + f.on_slope.dot(a_moves ? at.y_a_x : at.y_b_x);
    tangent.row(X) = -on_mark.derivatives().transpose();
  }
  return tangent;
}

}  // namespace vlbeam
