#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/length_control/chain_state.hpp"

namespace vlbeam {

/// Weights of element k as they are: at the joint, with transported weights, restricted to its current interval.
template <int D>
Weights<double> current_weights(const ChainState<D>& chain, int k, WeightTransport of_joint) {
  const auto i = static_cast<std::size_t>(k);
  const auto& weights = chain.mesh.weights[i];
  const bool restricted = chain.moves(k) && of_joint == WeightTransport::transported && weights.w != unit_weights;
  return restricted ? weights.on(chain.mesh.x[i], chain.mesh.x[i + 1]) : weights.w;
}

/// Kinematics of element k.
template <int D>
MovingKinematics<double, D> kinematics_of(const ChainState<D>& chain, int k, WeightTransport of_joint) {
  return {chain.coordinates(k), chain.rates(k), chain.moves(k) ? of_joint : WeightTransport::frozen,
          chain.mesh.weights[static_cast<std::size_t>(k)]};
}

/// Motion of the material point x of an element.
template <int D>
PointMotion<double, D> motion_at(const MovingKinematics<double, D>& element, double x) {
  const double u = (x - element.coordinates().x_a) / element.length();
  return element.at(u, rational_shape(element.weights(), u));
}

/// Motion of the material point x, in element k of `chain`.
template <int D>
PointMotion<double, D> motion_at(const ChainState<D>& chain, int k, double x, WeightTransport of_joint) {
  return motion_at(kinematics_of(chain, k, of_joint), x);
}

/// The intervals between neighbouring nodes of either mesh, from `start` to `end`.
inline std::vector<double> common_pieces(const Mesh& a, const Mesh& b, double start, double end) {
  const auto from = [start](const std::vector<double>& x) { return std::lower_bound(x.begin(), x.end(), start); };
  const auto to = [end](const std::vector<double>& x) { return std::upper_bound(x.begin(), x.end(), end); };
  std::vector<double> pieces;
  std::set_union(from(a.x), to(a.x), from(b.x), to(b.x), std::back_inserter(pieces));
  return pieces;
}

}  // namespace vlbeam
