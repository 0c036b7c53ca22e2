#pragma once

#include "tests/core/support/element_state.hpp"

namespace vlbeam::test {

/// The element's equations of motion, strain law and bending chosen at run time.
template <int D>
MovingEquations<double, D> element_equations(const MovingCoordinates<double, D>& q,
                                             const MovingCoordinates<double, D>& rate, const WeightFunction& weights,
                                             const BeamRule& rule, const MovingLaw<D>& moving);

extern template MovingEquations<double, 2> element_equations(const MovingCoordinates<double, 2>&,
                                                             const MovingCoordinates<double, 2>&, const WeightFunction&,
                                                             const BeamRule&, const MovingLaw<2>&);
extern template MovingEquations<double, 3> element_equations(const MovingCoordinates<double, 3>&,
                                                             const MovingCoordinates<double, 3>&, const WeightFunction&,
                                                             const BeamRule&, const MovingLaw<3>&);

}  // namespace vlbeam::test
