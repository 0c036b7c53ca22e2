#include "core/element/moving_tangent.hpp"

#include "core/element/driven_residual.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_state.hpp"

namespace vlbeam::test {
namespace {

struct Choice {
  Formulation formulation;
  WeightTransport transport;
  bool rational;
  double damping;
};

constexpr std::array<Choice, 6> choices{{{Formulation::variational, WeightTransport::frozen, false, 0},
                                         {Formulation::variational, WeightTransport::frozen, true, 0},
                                         {Formulation::variational, WeightTransport::transported, true, 0},
                                         {Formulation::virtual_work, WeightTransport::frozen, true, 0},
                                         {Formulation::virtual_work, WeightTransport::transported, true, 0.02},
                                         {Formulation::variational, WeightTransport::frozen, true, 0.02}}};

/// moving_residual as a column, its coordinates (r_A, s_A, r_B, s_B, x_A, x_B) moving along columns of rates.
template <MovingEnds Ends, int D>
Eigen::Matrix<double, 4 * D + moving_ends<Ends>, 1> rate_of_residual(
    const std::array<ElementColumn<double, D>, 3>& state, const std::array<ElementColumn<double, D>, 3>& rate,
    const WeightFunction& weights, const ShapeTabulation& table, const MovingLaw<D>& law) {
  using Real = Dual<double>;
  auto moving = [&](std::size_t i) {
    return coordinates<Real, D>(in_motion<double, element_size<D>>(state[i], rate[i]));
  };
  const auto r = moving_residual<Ends, Real, D>(moving(0), moving(1), moving(2), weights, table, law);
  Eigen::Matrix<double, 4 * D + moving_ends<Ends>, 1> result;
  for (int i = 0; i < 4; ++i) {
    result.template segment<D>(i * D) = rate_of<double, D>(r.nodes[static_cast<std::size_t>(i)]);
  }
  for (int e = 0; e < moving_ends<Ends>; ++e) result[4 * D + e] = r.ends[static_cast<std::size_t>(e)].rate;
  return result;
}

/// That the residual, which accelerates points one by one or four at a time, is M a - Q of the element's matrices.
template <MovingEnds Ends, int D>
void expect_equations_of_motion(const std::array<ElementColumn<double, D>, 3>& state, const WeightFunction& weights,
                                const PointTables& tables, const MovingLaw<D>& law) {
  const auto q = coordinates<double, D>(state[0]), rate = coordinates<double, D>(state[1]),
             a = coordinates<double, D>(state[2]);
  const auto eq = moving_equations<double, D, Ends>(q, rate, weights, tables.one, law);
  const auto nodes = nodal_residual(eq, a);
  const auto ends = guiding_forces(eq, a);
  double dissipation = 0;
  const auto r = residual_of<Ends, D>(q, rate, a, weights, tables, law, dissipation);
  double scale = std::abs(ends[0]) + std::abs(ends[1]);
  for (const auto& node : nodes) scale += node.norm();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE((r.nodes[i] - nodes[i]).norm(), 1e-13 * scale);
  for (int e = 0; e < moving_ends<Ends>; ++e) {
    EXPECT_NEAR(r.ends[static_cast<std::size_t>(e)], ends[is_end_a<Ends>(e) ? 0 : 1], 1e-13 * scale);
  }
  EXPECT_NEAR(dissipation, eq.dissipation, 1e-13 * eq.dissipation);
}

template <MovingEnds Ends, int D>
void expect_derivative(const Choice& choice, Random& random, StrainLaw strain_law, bool bends) {
  constexpr int N = 4 * D + moving_ends<Ends>;
  const TangentWeights by{0.7, 30, 900};
  std::array<ElementColumn<double, D>, 3> state{random_element<D>(random), random_rates<D>(random),
                                                random_rates<D>(random)};
  for (std::size_t i = 1; i < 3; ++i) {
    if (Ends == MovingEnds::a) state[i][4 * D + 1] = 0;
    if (Ends == MovingEnds::b) state[i][4 * D] = 0;
  }
  const auto q = coordinates<double, D>(state[0]);
  const WeightFunction weights{choice.rational ? random.weights(3) : unit_weights, q.x_a - 0.1, q.x_b + 0.05};
  const PointTables tables(beam_rule(random.uniform(0, 1) < 0.5 ? 4 : 5,
                                     random.uniform(0, 1) < 0.5 ? AxialStrain::full : AxialStrain::lobatto),
                           weights.w);
  MovingLaw<D> law;
  law.section = {.rhoA = 1.7,
                 .stiffness = {120, bends ? 3.0 : 0.0, strain_law},
                 .damping = choice.damping,
                 .curvature_regularization = 0.3};
  law.formulation = choice.formulation;
  law.transport = choice.transport;
  law.gravity = random.vector<D>(9.81);

  const auto tangent = moving_tangent<Ends, D>(q, coordinates<double, D>(state[1]), coordinates<double, D>(state[2]),
                                               by, weights, tables, law);
  for (int j = 0; j < N; ++j) {
    const int direction = j < 4 * D ? j : is_end_a<Ends>(j - 4 * D) ? 4 * D : 4 * D + 1;
    const ElementColumn<double, D> unit = ElementColumn<double, D>::Unit(direction);
    const auto expected =
        rate_of_residual<Ends, D>(state, {by.q * unit, by.v * unit, by.a * unit}, weights, tables.one, law);
    EXPECT_LE((tangent.col(j) - expected).norm(), 1e-12 * tangent.norm()) << "column " << j;
  }
  expect_equations_of_motion<Ends, D>(state, weights, tables, law);
}

template <int D>
void expect_for_all_choices(unsigned seed) {
  Random random(seed);
  for (const auto& choice : choices) {
    expect_derivative<MovingEnds::a, D>(choice, random, StrainLaw::green, true);
    expect_derivative<MovingEnds::b, D>(choice, random, StrainLaw::green, true);
    expect_derivative<MovingEnds::a, D>(choice, random, StrainLaw::engineering, true);
    expect_derivative<MovingEnds::b, D>(choice, random, StrainLaw::green, false);
    expect_derivative<MovingEnds::both, D>(choice, random, StrainLaw::green, true);
    expect_derivative<MovingEnds::both, D>(choice, random, StrainLaw::engineering, false);
  }
}

TEST(MovingTangent, IsTheDerivativeOfTheResidualInThePlane) { expect_for_all_choices<2>(1); }
TEST(MovingTangent, IsTheDerivativeOfTheResidualInSpace) { expect_for_all_choices<3>(2); }

}  // namespace
}  // namespace vlbeam::test
