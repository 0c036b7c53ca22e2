#include "tests/core/support/element_equations.hpp"

namespace vlbeam::test {

template <int D>
MovingEquations<double, D> element_equations(const MovingCoordinates<double, D>& q,
                                             const MovingCoordinates<double, D>& rate, const WeightFunction& weights,
                                             const BeamRule& rule, const MovingLaw<D>& moving) {
  const ShapeTabulation table(rule, weights.w);
  return moving_equations<double, D>(q, rate, weights, table, moving);
}

template MovingEquations<double, 2> element_equations(const MovingCoordinates<double, 2>&,
                                                      const MovingCoordinates<double, 2>&, const WeightFunction&,
                                                      const BeamRule&, const MovingLaw<2>&);
template MovingEquations<double, 3> element_equations(const MovingCoordinates<double, 3>&,
                                                      const MovingCoordinates<double, 3>&, const WeightFunction&,
                                                      const BeamRule&, const MovingLaw<3>&);

}  // namespace vlbeam::test
