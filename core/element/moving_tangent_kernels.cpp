// Compiled once for each instruction set, as moving_kernels.cpp is.
#include "core/element/moving_kernels.hpp"
#include "core/element/moving_tangent_sums.hpp"
#include "core/element/pack_lanes.hpp"

namespace vlbeam::VLBEAM_KERNELS {

template <int D, MovingEnds Ends, int Unknown>
[[gnu::flatten]] MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                                                const MovingCoordinates<double, D>& rate,
                                                                const MovingCoordinates<double, D>& a,
                                                                const TangentWeights& by, const WeightFunction& weights,
                                                                const ShapeTabulation& table, const MovingLaw<D>& law) {
  const auto lanes = tangent_sums<Ends, D, Unknown, Pack>(in_all_lanes<D>(q), in_all_lanes<D>(rate), in_all_lanes<D>(a),
                                                          by, weights, table, law);
  MovingTangent<Ends, D, Unknown> sum;
  for (Eigen::Index i = 0; i < sum.size(); ++i) sum.data()[i] = total(lanes.data()[i]);
  return sum;
}

template MovingTangent<MovingEnds::a, 2, 1> moving_tangent<2, MovingEnds::a, 1>(
    const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::b, 2, 1> moving_tangent<2, MovingEnds::b, 1>(
    const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::both, 2, 0> moving_tangent<2, MovingEnds::both, 0>(
    const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::a, 3, 1> moving_tangent<3, MovingEnds::a, 1>(
    const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<3>&);
template MovingTangent<MovingEnds::b, 3, 1> moving_tangent<3, MovingEnds::b, 1>(
    const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<3>&);
template MovingTangent<MovingEnds::both, 3, 0> moving_tangent<3, MovingEnds::both, 0>(
    const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<3>&);

}  // namespace vlbeam::VLBEAM_KERNELS
