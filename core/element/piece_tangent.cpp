#include "core/element/piece_tangent.hpp"

#include "core/element/active.hpp"

namespace vlbeam {

template <int D>
Eigen::Matrix<double, 4 * D + 2, 4 * D + 2> piece_tangent(const MovingCoordinates<double, D>& q,
                                                          const MovingCoordinates<double, D>& rate,
                                                          const MovingCoordinates<double, D>& a,
                                                          const TangentWeights& weigh, const WeightFunction& weights,
                                                          const ShapeTabulation& table, const MovingLaw<D>& law) {
  constexpr int N = 4 * D + 2;
  using Real = Active<N>;
  const auto seeded = [](const MovingCoordinates<double, D>& from, double seed) {
    int next = 0;
    const auto number = [&](double value) {
      Real result(value);
      result.derivatives()[next++] = seed;
      return result;
    };
    const auto vector = [&](const Vec<double, D>& values) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) result[c] = number(values[c]);
      return result;
    };
    MovingCoordinates<Real, D> result;
    result.e.r_a = vector(from.e.r_a);
    result.e.s_a = vector(from.e.s_a);
    result.e.r_b = vector(from.e.r_b);
    result.e.s_b = vector(from.e.s_b);
    result.x_a = number(from.x_a);
    result.x_b = number(from.x_b);
    return result;
  };
  const auto eq = moving_sums<Real, D, MovingEnds::both>(seeded(q, weigh.q), seeded(rate, weigh.v), seeded(a, weigh.a),
                                                         weights, table, law);
  Eigen::Matrix<double, N, N> tangent;
  int row = 0;
  for (const auto& force : eq.force) {
    for (int c = 0; c < D; ++c) tangent.row(row++) = -force[c].derivatives().transpose();
  }
  tangent.row(row++) = -eq.force_a.derivatives().transpose();
  tangent.row(row) = -eq.force_b.derivatives().transpose();
  return tangent;
}

template Eigen::Matrix<double, 10, 10> piece_tangent(const MovingCoordinates<double, 2>&,
                                                     const MovingCoordinates<double, 2>&,
                                                     const MovingCoordinates<double, 2>&, const TangentWeights&,
                                                     const WeightFunction&, const ShapeTabulation&,
                                                     const MovingLaw<2>&);
template Eigen::Matrix<double, 14, 14> piece_tangent(const MovingCoordinates<double, 3>&,
                                                     const MovingCoordinates<double, 3>&,
                                                     const MovingCoordinates<double, 3>&, const TangentWeights&,
                                                     const WeightFunction&, const ShapeTabulation&,
                                                     const MovingLaw<3>&);

}  // namespace vlbeam
