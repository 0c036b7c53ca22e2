#pragma once

#include <array>
#include <cstddef>

#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/motion/system/energy.hpp"

namespace vlbeam {

/// The elements whose shape an event changes, from `lowest` to before `highest`, of the chain before it.
struct EventReach {
  int lowest, highest;
};

/// How energies change in an event of the mesh that may change velocities on the whole beam, but the shape of the
/// elements in `reach` alone: summed there by so many Gauss points an element, or own_points. On the others, only the
/// kinetic energy changes, by (v_1 - v_0) . (v_1 + v_0)/2: so a small change next to a large energy keeps its digits.
template <int D, std::size_t Rules>
std::array<Energy, Rules> energy_jumps(const CurrentBeam<D>& beam, const ChainState<D>& before,
                                       const ChainState<D>& after, const EventReach& reach, double t,
                                       const std::array<int, Rules>& points);

template <int D>
Energy energy_jump(const CurrentBeam<D>& beam, const ChainState<D>& before, const ChainState<D>& after,
                   const EventReach& reach, double t, int points) {
  return energy_jumps(beam, before, after, reach, t, std::array{points}).front();
}

}  // namespace vlbeam
