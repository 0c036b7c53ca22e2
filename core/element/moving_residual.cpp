#include "core/element/moving_residual.hpp"

#include "core/element/active.hpp"
#include "core/element/moving_lanes.hpp"

namespace vlbeam {
namespace {

/// Whether lanes know such an element; joints beside each other are rare.
template <MovingEnds Ends, int D>
bool in_lanes_of(const MovingLaw<D>& law) {
  return Ends != MovingEnds::both && law.rest == nullptr && law.transport == WeightTransport::frozen &&
         !law.section.damped();
}

}  // namespace

template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_of(const MovingCoordinates<double, D>& q,
                                            const MovingCoordinates<double, D>& rate,
                                            const MovingCoordinates<double, D>& a, const WeightFunction& weights,
                                            const PointTables& tables, const MovingLaw<D>& law, double& dissipation) {
  if constexpr (Ends != MovingEnds::both) {
    if (in_lanes_of<Ends>(law)) return residual_in_lanes<Ends, D>(q, rate, a, weights, tables.four, law);
  }
  return moving_residual<Ends, double, D>(q, rate, a, weights, tables.one, law, &dissipation);
}

template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_by_end(int e, const MovingCoordinates<double, D>& q,
                                                const MovingCoordinates<double, D>& rate,
                                                const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                                const WeightFunction& weights, const PointTables& tables,
                                                const MovingLaw<D>& law) {
  if constexpr (Ends != MovingEnds::both) {
    if (in_lanes_of<Ends>(law)) return residual_in_lanes_by_end<Ends, D>(q, rate, a, by, weights, tables.four, law);
  }
  using Real = Active<1>;
  const auto active = [](double value, double scale) {
    Real x(value);
    x.derivatives()[0] = scale;
    return x;
  };
  return take<Ends, Real, D>(
      moving_residual<Ends, Real, D>(along_end<Ends, Real, D>(e, q, by.q, active),
                                     along_end<Ends, Real, D>(e, rate, by.v, active),
                                     along_end<Ends, Real, D>(e, a, by.a, active), weights, tables.one, law),
      [](const Real& x) { return x.derivatives()[0]; });
}

#define VLBEAM_MOVING_RESIDUAL(ENDS, D)                                                                              \
  template MovingResidual<double, D, ENDS> residual_of<ENDS, D>(                                                     \
      const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, \
      const WeightFunction&, const PointTables&, const MovingLaw<D>&, double&);                                      \
  template MovingResidual<double, D, ENDS> residual_by_end<ENDS, D>(                                                 \
      int, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&,                                 \
      const MovingCoordinates<double, D>&, const TangentWeights&, const WeightFunction&, const PointTables&,         \
      const MovingLaw<D>&)
VLBEAM_MOVING_RESIDUAL(MovingEnds::a, 2);
VLBEAM_MOVING_RESIDUAL(MovingEnds::b, 2);
VLBEAM_MOVING_RESIDUAL(MovingEnds::both, 2);
VLBEAM_MOVING_RESIDUAL(MovingEnds::a, 3);
VLBEAM_MOVING_RESIDUAL(MovingEnds::b, 3);
VLBEAM_MOVING_RESIDUAL(MovingEnds::both, 3);
#undef VLBEAM_MOVING_RESIDUAL

}  // namespace vlbeam
