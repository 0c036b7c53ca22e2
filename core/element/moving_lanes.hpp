#pragma once

#include "core/element/moving_residual.hpp"

namespace vlbeam {

// The residual of an element between a joint and a resting node, four points at a time: of a straight beam without
// damping, its weights frozen.

template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_in_lanes(const MovingCoordinates<double, D>& q,
                                                  const MovingCoordinates<double, D>& rate,
                                                  const MovingCoordinates<double, D>& a, const WeightFunction& weights,
                                                  const PackTabulation& table, const MovingLaw<D>& law);

/// Its derivative by the material coordinate of the joint.
template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_in_lanes_by_end(const MovingCoordinates<double, D>& q,
                                                         const MovingCoordinates<double, D>& rate,
                                                         const MovingCoordinates<double, D>& a,
                                                         const TangentWeights& by, const WeightFunction& weights,
                                                         const PackTabulation& table, const MovingLaw<D>& law);

/// An element's coordinates as other numbers.
template <class Real, int D>
MovingCoordinates<Real, D> constants(const MovingCoordinates<double, D>& of) {
  const auto cast = [](const Vec<double, D>& v) {
    Vec<Real, D> result;
    for (int c = 0; c < D; ++c) result[c] = Real(v[c]);
    return result;
  };
  return {{cast(of.e.r_a), cast(of.e.s_a), cast(of.e.r_b), cast(of.e.s_b)}, Real(of.x_a), Real(of.x_b)};
}

/// The same with one end's material coordinate a variable that changes by `scale`, made by `active(value, scale)`.
template <MovingEnds Ends, class Real, int D, class Active>
MovingCoordinates<Real, D> along_end(int e, const MovingCoordinates<double, D>& from, double scale,
                                     const Active& active) {
  MovingCoordinates<Real, D> result = constants<Real, D>(from);
  const bool at_a = is_end_a<Ends>(e);
  (at_a ? result.x_a : result.x_b) = active(at_a ? from.x_a : from.x_b, scale);
  return result;
}

/// `part` of each number of a residual.
template <MovingEnds Ends, class Real, int D, class Part>
MovingResidual<double, D, Ends> take(const MovingResidual<Real, D, Ends>& from, const Part& part) {
  MovingResidual<double, D, Ends> r;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int c = 0; c < D; ++c) r.nodes[i][c] = part(from.nodes[i][c]);
  }
  for (std::size_t e = 0; e < r.ends.size(); ++e) r.ends[e] = part(from.ends[e]);
  return r;
}

}  // namespace vlbeam
