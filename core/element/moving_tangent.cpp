#include "core/element/moving_tangent.hpp"

#include "core/element/moving_kernels.hpp"
#include "core/element/moving_tangent_sums.hpp"
#include "core/element/piece_tangent.hpp"

namespace vlbeam {

template <MovingEnds Ends, int D, int Unknown>
MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                               const MovingCoordinates<double, D>& rate,
                                               const MovingCoordinates<double, D>& a, const TangentWeights& weigh,
                                               const WeightFunction& weights, const ShapeTabulation& table,
                                               const MovingLaw<D>& law) {
  if (law.pieces != nullptr) {
    const MovingLaw<D> here = law_between(law, q.x_a, q.x_b);
    if (here.pieces == nullptr) return moving_tangent<Ends, D, Unknown>(q, rate, a, weigh, weights, table, here);
    const auto whole = piece_tangent<D>(q, rate, a, weigh, weights, table, here);
    MovingTangent<Ends, D, Unknown> tangent;
    const auto of = [](int i) { return i < 4 * D ? i : 4 * D + (is_end_a<Ends>(i - 4 * D) ? 0 : 1); };
    for (int i = 0; i < 4 * D + Unknown; ++i) {
      for (int j = 0; j < 4 * D + Unknown; ++j) tangent(i, j) = whole(of(i), of(j));
    }
    return tangent;
  }
  if (law.rest == nullptr && !law.section.damped()) {
    const auto& kernels = fastest_moving_kernels<D, Ends>();
    if constexpr (Unknown == 1) return kernels.tangent(q, rate, a, weigh, weights, table, law);
    if constexpr (Unknown == 0) return kernels.driven_tangent(q, rate, a, weigh, weights, table, law);
  }
  return tangent_sums<Ends, D, Unknown, double>(q, rate, a, weigh, weights, table, law);
}

template MovingTangent<MovingEnds::a, 2> moving_tangent<MovingEnds::a, 2>(const MovingCoordinates<double, 2>&,
                                                                          const MovingCoordinates<double, 2>&,
                                                                          const MovingCoordinates<double, 2>&,
                                                                          const TangentWeights&, const WeightFunction&,
                                                                          const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::b, 2> moving_tangent<MovingEnds::b, 2>(const MovingCoordinates<double, 2>&,
                                                                          const MovingCoordinates<double, 2>&,
                                                                          const MovingCoordinates<double, 2>&,
                                                                          const TangentWeights&, const WeightFunction&,
                                                                          const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::both, 2> moving_tangent<MovingEnds::both, 2>(
    const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::both, 2, 0> moving_tangent<MovingEnds::both, 2, 0>(
    const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&, const MovingCoordinates<double, 2>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<2>&);
template MovingTangent<MovingEnds::a, 3> moving_tangent<MovingEnds::a, 3>(const MovingCoordinates<double, 3>&,
                                                                          const MovingCoordinates<double, 3>&,
                                                                          const MovingCoordinates<double, 3>&,
                                                                          const TangentWeights&, const WeightFunction&,
                                                                          const ShapeTabulation&, const MovingLaw<3>&);
template MovingTangent<MovingEnds::b, 3> moving_tangent<MovingEnds::b, 3>(const MovingCoordinates<double, 3>&,
                                                                          const MovingCoordinates<double, 3>&,
                                                                          const MovingCoordinates<double, 3>&,
                                                                          const TangentWeights&, const WeightFunction&,
                                                                          const ShapeTabulation&, const MovingLaw<3>&);
template MovingTangent<MovingEnds::both, 3> moving_tangent<MovingEnds::both, 3>(
    const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<3>&);
template MovingTangent<MovingEnds::both, 3, 0> moving_tangent<MovingEnds::both, 3, 0>(
    const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&, const MovingCoordinates<double, 3>&,
    const TangentWeights&, const WeightFunction&, const ShapeTabulation&, const MovingLaw<3>&);

}  // namespace vlbeam
