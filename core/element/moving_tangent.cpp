#include "core/element/moving_tangent.hpp"

#include "core/element/moving_kernels.hpp"
#include "core/element/moving_tangent_sums.hpp"
#include "core/element/piece_tangent.hpp"

namespace vlbeam {

namespace {

/// The tangent of an element whose ends both move and are unknown: an end that rests has no rate. One for all, for each
/// takes the compiler seconds, and only elements with a rest shape, damping or pieces come here.
template <MovingEnds Ends, int D>
MovingTangent<MovingEnds::both, D> whole_tangent(MovingCoordinates<double, D> q, MovingCoordinates<double, D> rate,
                                                 MovingCoordinates<double, D> a, const TangentWeights& weigh,
                                                 const WeightFunction& weights, const ShapeTabulation& table,
                                                 const MovingLaw<D>& law) {
  if constexpr (Ends == MovingEnds::a) rate.x_b = a.x_b = 0;
  if constexpr (Ends == MovingEnds::b) rate.x_a = a.x_a = 0;
  if (law.pieces != nullptr) return piece_tangent<D>(q, rate, a, weigh, weights, table, law);
  return tangent_sums<MovingEnds::both, D, 2, double>(q, rate, a, weigh, weights, table, law);
}

}  // namespace

template <MovingEnds Ends, int D, int Unknown>
MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                               const MovingCoordinates<double, D>& rate,
                                               const MovingCoordinates<double, D>& a, const TangentWeights& weigh,
                                               const WeightFunction& weights, const ShapeTabulation& table,
                                               const MovingLaw<D>& law) {
  if (law.pieces != nullptr) {
    const MovingLaw<D> here = law_between(law, q.x_a, q.x_b);
    if (here.pieces == nullptr) return moving_tangent<Ends, D, Unknown>(q, rate, a, weigh, weights, table, here);
  } else if (law.rest == nullptr && !law.section.damped()) {
    const auto& kernels = fastest_moving_kernels<D, Ends>();
    if constexpr (Unknown == 1) return kernels.tangent(q, rate, a, weigh, weights, table, law);
    if constexpr (Unknown == 0) return kernels.driven_tangent(q, rate, a, weigh, weights, table, law);
  }
  const auto whole = whole_tangent<Ends, D>(q, rate, a, weigh, weights, table, law);
  const auto of = [](int i) { return i < 4 * D || is_end_a<Ends>(i - 4 * D) ? i : 4 * D + 1; };
  MovingTangent<Ends, D, Unknown> tangent;
  for (int i = 0; i < 4 * D + Unknown; ++i) {
    for (int j = 0; j < 4 * D + Unknown; ++j) tangent(i, j) = whole(of(i), of(j));
  }
  return tangent;
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
