#pragma once

#include "core/system/current_beam.hpp"
#include "core/system/energy.hpp"

namespace vlbeam {

/// The elements whose shape an event changes, from `lowest` to before `highest`, of the mesh before it.
struct EventReach {
  int lowest, highest;
};

/// How energies change in an event of the mesh that may change velocities on the whole beam, but the shape of the
/// elements in `reach` alone: summed there by `points` Gauss points an element, or own_points. On the others, only the
/// kinetic energy changes, by (v_1 - v_0) . (v_1 + v_0)/2: so a small change next to a large energy keeps its digits.
template <int D>
Energy energy_jump(const CurrentBeam<D>& beam, const ChainState<D>& before, const ChainState<D>& after,
                   const EventReach& reach, double t, int points);

}  // namespace vlbeam
