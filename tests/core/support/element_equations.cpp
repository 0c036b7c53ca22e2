#include "tests/core/support/element_equations.hpp"

namespace vlbeam::test {

template <int D>
MovingEquations<double, D> element_equations(StrainLaw law, bool bending, const MovingCoordinates<double, D>& q,
                                             const MovingCoordinates<double, D>& rate, const WeightFunction& weights,
                                             const QuadratureRule& rule, const MovingLaw<D>& moving) {
  const ShapeTabulation table(rule, weights.w);
  auto with = [&]<StrainLaw Law>() {
    return bending ? moving_equations<Law, true, double, D>(q, rate, weights, table, moving)
                   : moving_equations<Law, false, double, D>(q, rate, weights, table, moving);
  };
  return law == StrainLaw::green ? with.template operator()<StrainLaw::green>()
                                 : with.template operator()<StrainLaw::engineering>();
}

template MovingEquations<double, 2> element_equations(StrainLaw, bool, const MovingCoordinates<double, 2>&,
                                                      const MovingCoordinates<double, 2>&, const WeightFunction&,
                                                      const QuadratureRule&, const MovingLaw<2>&);
template MovingEquations<double, 3> element_equations(StrainLaw, bool, const MovingCoordinates<double, 3>&,
                                                      const MovingCoordinates<double, 3>&, const WeightFunction&,
                                                      const QuadratureRule&, const MovingLaw<3>&);

}  // namespace vlbeam::test
