#pragma once

#include "core/beam/chain_view.hpp"
#include "core/element/active.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/parts/point_matrix.hpp"

namespace vlbeam {

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
  if (const JointPlace* a = beam.joint_at(k)) out[a->mark] += f.on_r.dot(at.y_a) + f.on_slope.dot(at.y_a_x);
  if (const JointPlace* b = beam.joint_at(k + 1)) out[b->mark] += f.on_r.dot(at.y_b) + f.on_slope.dot(at.y_b_x);
}

/// A number with its derivatives by the coordinates of an element.
template <int D>
using ElementReal = Active<point_coordinates<D>>;

/// Coordinates of element k, or their rates, each with `seed` for its derivative by itself.
template <int D>
MovingCoordinates<ElementReal<D>, D> active_coordinates(const ChainView<D>& beam, int k,
                                                        const MovingCoordinates<double, D>& from, double seed) {
  using Real = ElementReal<D>;
  const auto part = [&](const Vec<double, D>& value, int first) {
    Vec<Real, D> result;
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
  if (beam.joint_at(k) != nullptr) result.x_a.derivatives()[point_coordinates<D> - 2] = seed;
  if (beam.joint_at(k + 1) != nullptr) result.x_b.derivatives()[point_coordinates<D> - 1] = seed;
  return result;
}

/// Element k with derivatives by its coordinates and their rates.
template <int D>
MovingKinematics<ElementReal<D>, D> active_element(const ChainView<D>& beam, int k, const TangentWeights& by) {
  return {active_coordinates(beam, k, beam.coordinates(k), by.q), active_coordinates(beam, k, beam.rates(k), by.v),
          beam.at_joint(k) ? beam.transport : WeightTransport::frozen, beam.weights(k)};
}

/// Adds the derivatives of minus N^T F to a matrix of element k.
template <int D>
void add_point_tangent(const ChainView<D>& beam, int k, const PointMotion<ElementReal<D>, D>& at,
                       const PointForce<ElementReal<D>, D>& f, PointMatrix<D>& tangent) {
  using Real = ElementReal<D>;
  for (int i = 0; i < 4; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vec<Real, D> nodal = f.on_r * at.s[n] + f.on_slope * at.s_x[n];
    for (int c = 0; c < D; ++c) tangent.row(D * i + c) -= nodal[c].derivatives().transpose();
  }
  if (beam.joint_at(k) != nullptr) {
    const Real on_a = f.on_r.dot(at.y_a) + f.on_slope.dot(at.y_a_x);
    tangent.row(point_coordinates<D> - 2) -= on_a.derivatives().transpose();
  }
  if (beam.joint_at(k + 1) != nullptr) {
    const Real on_b = f.on_r.dot(at.y_b) + f.on_slope.dot(at.y_b_x);
    tangent.row(point_coordinates<D> - 1) -= on_b.derivatives().transpose();
  }
}

/// Tangent of minus such a force by the element's coordinates, by automatic differentiation. `force(at, acceleration)`
/// gives it, of the point's motion and acceleration; `a` is an array like q.
template <int D, class Force>
PointMatrix<D> point_tangent(const ChainView<D>& beam, int k, double x, const double* a, const TangentWeights& by,
                             const Force& force) {
  using Real = ElementReal<D>;
  using Vector = Vec<Real, D>;
  const bool a_moves = beam.joint_at(k) != nullptr, b_moves = beam.joint_at(k + 1) != nullptr;
  ChainView<D> accelerations = beam;
  accelerations.rate = a;
  const auto second = active_coordinates(beam, k, accelerations.rates(k), by.a);
  const PointMotion<Real, D> at = point_at<Real, D>(active_element(beam, k, by), x);
  Vector acceleration =
      at.remainder + second.e.r_a * at.s[0] + second.e.s_a * at.s[1] + second.e.r_b * at.s[2] + second.e.s_b * at.s[3];
  if (a_moves) acceleration += at.y_a * second.x_a;
  if (b_moves) acceleration += at.y_b * second.x_b;
  const PointForce<Real, D> f = force(at, acceleration);
  PointMatrix<D> tangent = PointMatrix<D>::Zero();
  add_point_tangent(beam, k, at, f, tangent);
  return tangent;
}

}  // namespace vlbeam
