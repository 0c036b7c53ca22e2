#include "core/element/moving_lanes.hpp"

#include "core/element/active_pack.hpp"

namespace vlbeam {

template <MovingEnds Ends, int D>
[[gnu::flatten]] MovingResidual<double, D, Ends> residual_in_lanes(const MovingCoordinates<double, D>& q,
                                                                   const MovingCoordinates<double, D>& rate,
                                                                   const MovingCoordinates<double, D>& a,
                                                                   const WeightFunction& weights,
                                                                   const PackTabulation& table,
                                                                   const MovingLaw<D>& law) {
  const auto lanes = moving_residual<Ends, Pack, D>(constants<Pack, D>(q), constants<Pack, D>(rate),
                                                    constants<Pack, D>(a), weights, table, law);
  return take<Ends, Pack, D>(lanes, [](const Pack& x) { return x.sum(); });
}

template <MovingEnds Ends, int D>
[[gnu::flatten]] MovingResidual<double, D, Ends> residual_in_lanes_by_end(
    const MovingCoordinates<double, D>& q, const MovingCoordinates<double, D>& rate,
    const MovingCoordinates<double, D>& a, const TangentWeights& by, const WeightFunction& weights,
    const PackTabulation& table, const MovingLaw<D>& law) {
  const auto active = [](double value, double scale) { return ActivePack(Pack(value), Pack(scale)); };
  const auto lanes = moving_residual<Ends, ActivePack, D>(
      along_end<Ends, ActivePack, D>(0, q, by.q, active), along_end<Ends, ActivePack, D>(0, rate, by.v, active),
      along_end<Ends, ActivePack, D>(0, a, by.a, active), weights, table, law);
  return take<Ends, ActivePack, D>(lanes, [](const ActivePack& x) { return x.by().sum(); });
}

#define VLBEAM_MOVING_LANES(ENDS, D)                                                                                 \
  template MovingResidual<double, D, ENDS> residual_in_lanes<ENDS, D>(                                               \
      const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, \
      const WeightFunction&, const PackTabulation&, const MovingLaw<D>&);                                            \
  template MovingResidual<double, D, ENDS> residual_in_lanes_by_end<ENDS, D>(                                        \
      const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, \
      const TangentWeights&, const WeightFunction&, const PackTabulation&, const MovingLaw<D>&)
VLBEAM_MOVING_LANES(MovingEnds::a, 2);
VLBEAM_MOVING_LANES(MovingEnds::b, 2);
VLBEAM_MOVING_LANES(MovingEnds::a, 3);
VLBEAM_MOVING_LANES(MovingEnds::b, 3);
#undef VLBEAM_MOVING_LANES

}  // namespace vlbeam
