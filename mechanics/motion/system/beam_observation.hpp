#pragma once

#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/motion/system/observation.hpp"

namespace vlbeam {

/// Energies and momenta of the elements `first` to `last` - 1 of a chain, point masses on them included, by `points`
/// Gauss points an element, or own_points; the model is that of the beam. Extremes of strains where `strains` asks for
/// them.
template <int D>
Observation<D> observe_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                                int points, bool strains);

/// Energies alone of the same.
template <int D>
Energy energies_of_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                            int points);

/// Energies, momenta and length of the whole at the state y, but for the work of gravity that grows.
template <int D>
Observation<D> observe_beam(const CurrentBeam<D>& beam, const Eigen::VectorXd& y, double t, int points, bool strains);

}  // namespace vlbeam
