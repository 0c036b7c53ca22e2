#pragma once

#include <algorithm>

#include "core/geometry/arc.hpp"
#include "core/length_control/chain_state.hpp"

namespace vlbeam {

/// Weights of MergeShape::rest_arc for element k of `chain`, which lies along `curve` at rest. They are those of an
/// arc with even parametrization that turns as much as the curve does there; beside a joint, as much as over the
/// `longest` length that the element reaches before it is cut. Why the longest: weights that are not symmetric about
/// the element's middle displace all its matter to one side, by theta^4 of its length. Transported weights are
/// symmetric at one length only; there it matters most.
template <int D>
WeightFunction rest_arc(const Axis<D>& curve, const ChainState<D>& chain, int k, double longest) {
  const auto i = static_cast<std::size_t>(k);
  double x_a = chain.mesh.x[i], x_b = chain.mesh.x[i + 1];
  const bool a_moves = chain.joint_at(k) != nullptr, b_moves = chain.joint_at(k + 1) != nullptr;
  if (b_moves && !a_moves) x_b = std::max(x_b, std::min(x_a + longest, curve.length()));
  if (a_moves && !b_moves) x_a = std::min(x_a, std::max(x_b - longest, 0.0));
  return {even_arc_weights<D>(curve.tangent(x_a), curve.tangent(x_b)), x_a, x_b};
}

}  // namespace vlbeam
