#pragma once

#include "core/element/moving_element.hpp"
#include "core/tangent_weights.hpp"

namespace vlbeam {

// A variable-length element as an implicit method sees it.

template <MovingEnds Ends>
inline constexpr int moving_ends = Ends == MovingEnds::both ? 2 : 1;
/// Whether the moving end `e`, of those there are, is end A.
template <MovingEnds Ends>
constexpr bool is_end_a(int e) {
  return Ends == MovingEnds::a || (Ends == MovingEnds::both && e == 0);
}

/// Residual M a - Q of a variable-length element: (r_A, s_A, r_B, s_B) and that of the moving ends.
template <class Real, int D, MovingEnds Ends>
struct MovingResidual {
  std::array<Vec<Real, D>, 4> nodes;
  std::array<Real, moving_ends<Ends>> ends;
};

/// Adds the power lost to damping to `dissipation` [W], where there is one. Points are accelerated as the coordinates
/// say: no mass matrix is needed. `table` is a ShapeTabulation, or a PackTabulation for numbers in lanes; these are
/// partial sums then.
template <MovingEnds Ends, class Real, int D, class Table>
MovingResidual<Real, D, Ends> moving_residual(const MovingCoordinates<Real, D>& q,
                                              const MovingCoordinates<Real, D>& rate,
                                              const MovingCoordinates<Real, D>& a, const WeightFunction& weights,
                                              const Table& table, const MovingLaw<D>& law,
                                              Real* dissipation = nullptr) {
  using Vector = Vec<Real, D>;
  using Kinematics = MovingKinematics<Real, D, Ends>;
  using Rest = RestKinematics<Real, D, Ends>;
  std::array<Vector, 4> force;
  force.fill(Vector::Zero());
  Real on_a(0), on_b(0), lost(0);

  const Kinematics kinematics(q, rate, law.transport, weights);
  const bool reshaped = law.transport == WeightTransport::transported && weights.w != unit_weights;
  const FeltSections sections(law.section);
  const Vector gravity = law.gravity.template cast<Real>();
  std::optional<Rest> at_rest;
  if constexpr (!in_lanes<Real>) {
    if (law.rest) at_rest.emplace(*law.rest, q.x_a, q.x_b, law.transport, weights, law.section);
  }
  const auto motion = [&](const auto& u, const auto& shape) { return kinematics.at(u, shape); };
  for_each_point(kinematics, table, reshaped, at_rest ? &*at_rest : nullptr, motion,
                 [&](const auto& point, const auto& at, const auto* rest) {
                   const BeamSection& section = sections[point.feels];
                   Vector acceleration = combine_nodes<Real, D>(at.s, a.e) + at.remainder;
                   if constexpr (Kinematics::a_moves) acceleration += at.y_a * a.x_a;
                   if constexpr (Kinematics::b_moves) acceleration += at.y_b * a.x_b;
                   const auto [f0, f1, f2] = point_forces<Ends, Real, D>(point, at, rest, section, law.formulation,
                                                                         gravity, acceleration, on_a, on_b, lost);
                   for (std::size_t i = 0; i < 4; ++i) force[i] += f0 * at.s[i] + f1 * at.s_x[i];
                   if constexpr (Kinematics::a_moves) on_a += f0.dot(at.y_a) + f1.dot(at.y_a_x);
                   if constexpr (Kinematics::b_moves) on_b += f0.dot(at.y_b) + f1.dot(at.y_b_x);
                   if (!section.bends()) return;
                   for (std::size_t i = 0; i < 4; ++i) force[i] += f2 * at.s_xx[i];
                   if constexpr (Kinematics::a_moves) on_a += f2.dot(at.y_a_xx);
                   if constexpr (Kinematics::b_moves) on_b += f2.dot(at.y_b_xx);
                 });
  MovingResidual<Real, D, Ends> r;
  for (std::size_t i = 0; i < 4; ++i) r.nodes[i] = -force[i];
  for (int e = 0; e < moving_ends<Ends>; ++e) r.ends[static_cast<std::size_t>(e)] = -(is_end_a<Ends>(e) ? on_a : on_b);
  if (dissipation) *dissipation += lost;
  return r;
}

/// That of a run: four points at a time where the beam is straight and not damped and its weights are frozen.
template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_of(const MovingCoordinates<double, D>& q,
                                            const MovingCoordinates<double, D>& rate,
                                            const MovingCoordinates<double, D>& a, const WeightFunction& weights,
                                            const PointTables& tables, const MovingLaw<D>& law, double& dissipation);

/// Its derivative by the material coordinate of the moving end `e`: by.q dr/dx + by.v dr/dx' + by.a dr/dx''.
template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_by_end(int e, const MovingCoordinates<double, D>& q,
                                                const MovingCoordinates<double, D>& rate,
                                                const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                                const WeightFunction& weights, const PointTables& tables,
                                                const MovingLaw<D>& law);

}  // namespace vlbeam
