#pragma once

#include "core/geometry/rotation.hpp"
#include "core/length_control/chain_state.hpp"

namespace vlbeam {

/// An element cut in two at the material coordinate `x`. Curve and parametrization stay (Ding & Ouyang 2022, Eq.
/// 21-28); the new node is fixed to its material point. If the beam is curved at rest, the new node stands on the rest
/// curve in the rest shape. The old rest shape was a little off that curve; the node of the beam is moved by the same
/// distance, turned as the beam is, so that strains stay.
template <int D>
struct Segmentation {
  double x;
  Vec<double, D> r, r_x;  ///< position and slope of the new node
  Vec<double, D> v, v_x;  ///< their rates: the material velocity and its derivative along the beam
  WeightFunction left, right;
  Vec<double, D> rest_r, rest_r_x;  ///< the new node in the rest shape, where there is one
};

/// The rotation that brings the rest shape of element k nearest to its present shape.
template <int D>
Eigen::Matrix<double, D, D> rotation_from_rest(const ChainState<D>& chain, int k) {
  const auto q = chain.coordinates(k);
  const double third = (q.x_b - q.x_a) / 3;
  auto points = [third](const NodalCubic<double, D>& e) {
    Eigen::MatrixXd of(D, 4);
    of << e.r_a, e.r_a + third * e.s_a, e.r_b - third * e.s_b, e.r_b;
    return of;
  };
  return best_rotation<D>(points(chain.rest_nodes(k)), points(q.e));
}

/// Cuts element k of `chain` at `x`. Beyond its ends, its curve and its motion are continued to there.
template <int D>
Segmentation<D> segment(const ChainState<D>& chain, int k, double x, WeightTransport transport) {
  const auto q = chain.coordinates(k), rate = chain.rates(k);
  const WeightFunction& weights = chain.mesh.weights[static_cast<std::size_t>(k)];
  const MovingKinematics<double, D> kinematics(q, rate, transport, weights);
  const double u = (x - q.x_a) / (q.x_b - q.x_a);
  const auto& w = kinematics.weights();
  const auto at = kinematics.at(u, rational_shape(w, u));
  Segmentation<D> result{x, at.r, at.r_x, at.v, at.v_x, {unit_weights, q.x_a, x}, {unit_weights, x, q.x_b}, {}, {}};
  if (weights.w != unit_weights) {
    result.left.w = restrict_cubic(w, 0.0, u);
    result.right.w = restrict_cubic(w, u, 1.0);
  }
  if (chain.curved_at_rest()) {
    const auto off = chain.rest_nodes(k);
    const auto on = chain.rest_curve->derivatives(x);
    const auto rotation = rotation_from_rest(chain, k);
    result.rest_r = on[0];
    result.rest_r_x = on[1];
    result.r += rotation * (on[0] - combine_nodes(at.s, off));
    result.r_x += rotation * (on[1] - combine_nodes(at.s_x, off));
  }
  return result;
}

}  // namespace vlbeam
