#pragma once

#include "core/length_control/chain_state.hpp"

namespace vlbeam {

/// An element cut in two at the material coordinate `x`: curve and parametrization stay what they were
/// (Ding & Ouyang 2022, Eq. 21-28); the new node is fixed and moves with the material point it sits on. The rest shape
/// is cut as the curve is, so that strains stay what they were, too.
template <int D>
struct Segmentation {
  double x;
  Vec<double, D> r, r_x;  ///< position and slope of the new node
  Vec<double, D> v, v_x;  ///< their rates: the material velocity and its derivative along the beam
  WeightFunction left, right;
  Vec<double, D> rest_r, rest_r_x;  ///< the new node in the rest shape, where there is one
};

/// Cuts element k of `chain` at `x`, strictly between its ends.
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
    const auto rest = chain.rest_nodes(k);
    result.rest_r = combine_nodes(at.s, rest);
    result.rest_r_x = combine_nodes(at.s_x, rest);
  }
  return result;
}

}  // namespace vlbeam
