#pragma once

#include "core/system/beam_system.hpp"

namespace vlbeam {

/// Columns, orthonormal: the directions in which supports, a ring or a sleeve let the coordinates move.
template <int D>
Eigen::MatrixXd free_directions(const BeamSystem<D>& system) {
  const Eigen::Index n = system.coordinates();
  Eigen::MatrixXd directions = Eigen::MatrixXd::Identity(n, n);
  Eigen::ArrayXd free = Eigen::ArrayXd::Ones(n);
  const auto hold = [&](Eigen::Index node, const Support<D>& support) {
    for (const Eigen::Index at : {node, node + D}) {
      directions.template block<D, D>(at, at) = support.frame;
      free.template segment<D>(at) = at == node ? support.free_position : support.free_slope;
    }
  };
  hold(0, system.model().start);
  hold(Eigen::Index{node_size<D>} * system.mesh().last(), system.model().end);
  for (const auto& [node, support] : system.model().held_nodes) hold(Eigen::Index{node_size<D>} * node, support);
  for (std::size_t i = 0; i < system.places().size(); ++i) {
    const Support<D>* held = system.held(i);
    if (held == nullptr) continue;
    const JointPlace& place = system.places()[i];
    hold(Eigen::Index{node_size<D>} * place.node, *held);
    if (place.behind < 0) continue;
    directions.template block<D, D>(place.behind, place.behind) = held->frame;
    free.template segment<D>(place.behind) = held->free_slope;
  }
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (free[k] > 0) directions.col(kept++) = directions.col(k);
  }
  return directions.leftCols(kept);
}

}  // namespace vlbeam
