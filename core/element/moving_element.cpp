#include "core/element/moving_element.hpp"

namespace vlbeam {

template MovingEquations<double, 2> moving_equations<double, 2, MovingEnds::a>(const MovingCoordinates<double, 2>&,
                                                                               const MovingCoordinates<double, 2>&,
                                                                               const WeightFunction&,
                                                                               const ShapeTabulation&,
                                                                               const MovingLaw<2>&);
template MovingEquations<double, 2> moving_equations<double, 2, MovingEnds::b>(const MovingCoordinates<double, 2>&,
                                                                               const MovingCoordinates<double, 2>&,
                                                                               const WeightFunction&,
                                                                               const ShapeTabulation&,
                                                                               const MovingLaw<2>&);
template MovingEquations<double, 2> moving_equations<double, 2, MovingEnds::both>(const MovingCoordinates<double, 2>&,
                                                                                  const MovingCoordinates<double, 2>&,
                                                                                  const WeightFunction&,
                                                                                  const ShapeTabulation&,
                                                                                  const MovingLaw<2>&);
template MovingEquations<double, 3> moving_equations<double, 3, MovingEnds::a>(const MovingCoordinates<double, 3>&,
                                                                               const MovingCoordinates<double, 3>&,
                                                                               const WeightFunction&,
                                                                               const ShapeTabulation&,
                                                                               const MovingLaw<3>&);
template MovingEquations<double, 3> moving_equations<double, 3, MovingEnds::b>(const MovingCoordinates<double, 3>&,
                                                                               const MovingCoordinates<double, 3>&,
                                                                               const WeightFunction&,
                                                                               const ShapeTabulation&,
                                                                               const MovingLaw<3>&);
template MovingEquations<double, 3> moving_equations<double, 3, MovingEnds::both>(const MovingCoordinates<double, 3>&,
                                                                                  const MovingCoordinates<double, 3>&,
                                                                                  const WeightFunction&,
                                                                                  const ShapeTabulation&,
                                                                                  const MovingLaw<3>&);

}  // namespace vlbeam
