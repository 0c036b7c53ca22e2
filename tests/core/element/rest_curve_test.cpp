#include "core/element/rest_curve.hpp"

#include <gtest/gtest.h>

#include "core/element/moving_tangent.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_under_test.hpp"

namespace vlbeam::test {
namespace {

constexpr double tolerance = 1e-12;

/// A rest shape of three pieces whose strains jump twice inside the element `q`.
template <int D>
std::vector<typename RestCurve<D>::Piece> three_pieces(Random& random, const ElementColumn<double, D>& q) {
  const double a = q[4 * D], l = q[4 * D + 1] - a;
  const std::array<double, 4> ends{a - 0.3, a + 0.25 * l, a + 0.8 * l, a + l + 0.2};
  std::vector<typename RestCurve<D>::Piece> pieces;
  for (std::size_t i = 0; i < 3; ++i) {
    pieces.push_back({ends[i], ends[i + 1], coordinates<double, D>(random_element<D>(random)).e, random.weights(2)});
  }
  return pieces;
}

template <class Dimension>
class RestCurves : public ElementUnderTest<Dimension> {
 protected:
  static constexpr int dim = Dimension::value;
  static constexpr double regularization = dim == 3 ? 0.4 : 0;

  /// Gives the oracle a rest shape and makes it one for the element.
  RestCurve<dim> draw_rest_shape() {
    this->oracle_.rest = three_pieces<dim>(this->random_, this->q_);
    this->oracle_.section.curvature_regularization = regularization;
    return {this->oracle_.rest, this->oracle_.section.stiffness.law, regularization};
  }
  MovingLaw<dim> law(Formulation formulation, const RestCurve<dim>& rest) const {
    return {this->oracle_.section, formulation, this->oracle_.transport, this->oracle_.gravity, &rest};
  }
  MovingEquations<double, dim> equations_with(const MovingLaw<dim>& law, const ElementColumn<double, dim>& rate) const {
    return element_equations<dim>(coordinates<double, dim>(this->q_), coordinates<double, dim>(rate),
                                  this->oracle_.stored, this->oracle_.rule, law);
  }
};
TYPED_TEST_SUITE(RestCurves, Dimensions, DimensionNames);

TYPED_TEST(RestCurves, VariationalEquationsAreLagrangesOfTheDiscreteLagrangian) {
  this->for_each_element(2, [this](const auto&) {
    const auto rest = this->draw_rest_shape();
    const auto eq = dense(this->equations_with(this->law(Formulation::variational, rest), this->rate_));
    const auto exact = this->oracle_.variational(this->q_, this->rate_);
    EXPECT_LE(relative_difference(eq.mass, exact.mass), tolerance);
    EXPECT_LE(relative_difference(eq.force, exact.force), tolerance);
  });
}

TYPED_TEST(RestCurves, NodalForcesAtRestAreTheSameInBothFormulations) {
  constexpr int D = TypeParam::value;
  this->for_each_element(1, [this](const auto&) {
    const auto rest = this->draw_rest_shape();
    const ElementColumn<double, D> still = ElementColumn<double, D>::Zero();
    const auto a = this->equations_with(this->law(Formulation::variational, rest), still);
    const auto b = this->equations_with(this->law(Formulation::virtual_work, rest), still);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(relative_difference(a.force[i], b.force[i]), tolerance);
  });
}

TYPED_TEST(RestCurves, AnElementInItsRestShapeIsFreeOfStress) {
  constexpr int D = TypeParam::value;
  this->for_each_element(1, [this](const auto& kind) {
    if (kind.transport == WeightTransport::transported && kind.rational) return;  // its weights are a restriction
    auto& oracle = this->oracle_;
    oracle.section.curvature_regularization = this->regularization;
    oracle.gravity.setZero();
    oracle.rest = {{this->q_[4 * D], this->q_[4 * D + 1], coordinates<double, D>(this->q_).e, oracle.stored.w}};
    const RestCurve<D> rest(oracle.rest, oracle.section.stiffness.law, this->regularization);
    const auto eq = this->equations_with(this->law(Formulation::variational, rest), ElementColumn<double, D>::Zero());
    for (const auto& force : eq.force) EXPECT_LE(force.norm(), 1e-13);
    EXPECT_NEAR(eq.force_a, 0, 1e-13);
    EXPECT_NEAR(eq.force_b, 0, 1e-13);
  });
}

TYPED_TEST(RestCurves, TangentIsTheDerivativeOfTheResidual) {
  constexpr int D = TypeParam::value;
  using Real = Dual<double>;
  const double by_v = 30, by_a = 900;
  this->for_each_element(1, [&](const auto& kind) {
    if (kind.law != StrainLaw::green) return;
    const auto rest = this->draw_rest_shape();
    std::array<ElementColumn<double, D>, 3> state{this->q_, this->rate_, this->random_.template vector<4 * D + 2>()};
    state[1][4 * D] = state[2][4 * D] = 0;
    const ShapeTabulation table(this->oracle_.rule, this->oracle_.stored.w);
    for (const Formulation formulation : formulations) {
      const auto law = this->law(formulation, rest);
      const auto tangent = moving_tangent<MovingEnds::b, D>(
          coordinates<double, D>(state[0]), coordinates<double, D>(state[1]), coordinates<double, D>(state[2]), by_v,
          by_a, this->oracle_.stored, table, law);
      for (int j = 0; j < 4 * D + 1; ++j) {
        const ElementColumn<double, D> unit = ElementColumn<double, D>::Unit(j < 4 * D ? j : 4 * D + 1);
        const std::array<double, 3> scale{1, by_v, by_a};
        auto moving = [&](std::size_t i) {
          return coordinates<Real, D>(in_motion<double, element_size<D>>(state[i], scale[i] * unit));
        };
        const auto r =
            moving_residual<MovingEnds::b, Real, D>(moving(0), moving(1), moving(2), this->oracle_.stored, table, law);
        Eigen::Matrix<double, 4 * D + 1, 1> expected;
        for (int i = 0; i < 4; ++i) {
          expected.template segment<D>(i * D) = rate_of<double, D>(r.nodes[static_cast<std::size_t>(i)]);
        }
        expected[4 * D] = r.end.rate;
        EXPECT_LE((tangent.col(j) - expected).norm(), tolerance * tangent.norm()) << "column " << j;
      }
    }
  });
}

}  // namespace
}  // namespace vlbeam::test
