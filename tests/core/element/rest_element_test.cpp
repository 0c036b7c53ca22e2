#include "core/element/rest_element.hpp"

#include <gtest/gtest.h>

#include "core/element/moving_tangent.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_under_test.hpp"

namespace vlbeam::test {
namespace {

/// A curve that goes roughly one way, by its coefficients.
template <int D>
std::array<Vec<double, D>, 4> random_curve(Random& random) {
  const Eigen::Matrix<double, D, D> Q = random.rotation<D>();
  return {random.vector<D>(), Q.col(0) + random.vector<D>(0.2), random.vector<D>(0.3), random.vector<D>(0.2)};
}

template <int D>
RestEnd<D> end_on(const std::array<Vec<double, D>, 4>& c, double x) {
  return {x,
          {c[0] + x * (c[1] + x * (c[2] + x * c[3])), c[1] + x * (2 * c[2] + 3 * x * c[3]), 2 * c[2] + 6 * x * c[3],
           6 * c[3]}};
}

template <class Dimension>
class RestElements : public ElementUnderTest<Dimension> {
 protected:
  static constexpr int dim = Dimension::value;
  static constexpr double regularization = dim == 3 ? 0.4 : 0;

  /// Gives the oracle a rest shape and makes it one for the element.
  RestElement<dim> draw_rest_shape() {
    this->oracle_.rest = random_curve<dim>(this->random_);
    this->oracle_.section.curvature_regularization = regularization;
    return rest_element();
  }
  RestElement<dim> rest_element() const {
    return {end_on<dim>(*this->oracle_.rest, this->q_[4 * dim]),
            end_on<dim>(*this->oracle_.rest, this->q_[4 * dim + 1])};
  }
  MovingLaw<dim> law(Formulation formulation, const RestElement<dim>& rest) const {
    return {this->oracle_.section, formulation, this->oracle_.transport, this->oracle_.gravity, &rest};
  }
  MovingEquations<double, dim> equations_with(const MovingLaw<dim>& law, const ElementColumn<double, dim>& rate) const {
    return element_equations<dim>(coordinates<double, dim>(this->q_), coordinates<double, dim>(rate),
                                  this->oracle_.stored, this->oracle_.rule, law);
  }
};
TYPED_TEST_SUITE(RestElements, Dimensions, DimensionNames);

TYPED_TEST(RestElements, VariationalEquationsAreLagrangesOfTheDiscreteLagrangian) {
  this->for_each_element(2, [this](const auto&) {
    const auto rest = this->draw_rest_shape();
    const auto eq = dense(this->equations_with(this->law(Formulation::variational, rest), this->rate_));
    const auto exact = this->oracle_.variational(this->q_, this->rate_);
    EXPECT_LE(relative_difference(eq.mass, exact.mass), rounding);
    EXPECT_LE(relative_difference(eq.force, exact.force), rounding);
  });
}

TYPED_TEST(RestElements, VirtualWorkIsThatOfTheStrainsAtFixedMaterialPoints) {
  this->for_each_element(2, [this](const auto&) {
    const auto rest = this->draw_rest_shape();
    const auto eq = dense(this->equations_with(this->law(Formulation::virtual_work, rest), this->rate_));
    const auto exact = this->oracle_.virtual_work(this->q_, this->rate_);
    EXPECT_LE(relative_difference(eq.mass, exact.mass), rounding);
    EXPECT_LE(relative_difference(eq.force, exact.force), rounding);
  });
}

TYPED_TEST(RestElements, AnElementInItsRestShapeIsFreeOfStress) {
  constexpr int D = TypeParam::value;
  this->for_each_element(1, [this](const auto&) {
    auto& oracle = this->oracle_;
    const auto rest = this->draw_rest_shape();
    oracle.gravity.setZero();
    this->q_ << rest.a.curve[0], rest.a.curve[1], rest.b.curve[0], rest.b.curve[1], rest.a.x, rest.b.x;
    const auto eq = this->equations_with(this->law(Formulation::variational, rest), ElementColumn<double, D>::Zero());
    for (const auto& force : eq.force) EXPECT_LE(force.norm(), 1e-12);
    EXPECT_NEAR(eq.force_a, 0, 1e-12);
    EXPECT_NEAR(eq.force_b, 0, 1e-12);
  });
}

/// Strains count from those at rest, which an element has others of wherever its ends are: none of its matter is
/// strained where these run along a beam that rests.
TYPED_TEST(RestElements, NothingDampsAnElementWhoseEndsFollowTheRestCurve) {
  constexpr int D = TypeParam::value;
  this->for_each_element(2, [this](const auto&) {
    const auto rest = this->draw_rest_shape();
    this->q_ << rest.a.curve[0], rest.a.curve[1], rest.b.curve[0], rest.b.curve[1], rest.a.x, rest.b.x;
    const double x_a = 1.3, x_b = -0.7;
    ElementColumn<double, D> rate;
    rate << x_a * rest.a.curve[1], x_a * rest.a.curve[2], x_b * rest.b.curve[1], x_b * rest.b.curve[2], x_a, x_b;
    auto law = this->law(Formulation::virtual_work, rest);
    const auto undamped = dense(this->equations_with(law, rate));
    law.section.damping = 0.3;
    const auto damped = this->equations_with(law, rate);
    EXPECT_LE(damped.dissipation, 1e-24);
    EXPECT_LE((dense(damped).force - undamped.force).norm(), 1e-11);
  });
}

TYPED_TEST(RestElements, DampingTakesThePowerThatItsForceLoses) {
  this->for_each_element(2, [this](const auto&) {
    const auto rest = this->draw_rest_shape();
    auto law = this->law(Formulation::virtual_work, rest);
    const auto undamped = dense(this->equations_with(law, this->rate_));
    law.section.damping = 0.3;
    const auto damped = this->equations_with(law, this->rate_);
    EXPECT_GT(damped.dissipation, 0);
    EXPECT_NEAR((undamped.force - dense(damped).force).dot(this->rate_), damped.dissipation,
                1e-11 * (damped.dissipation + undamped.force.norm()));
  });
}

TYPED_TEST(RestElements, TangentIsTheDerivativeOfTheResidual) {
  constexpr int D = TypeParam::value;
  using Real = Dual<double>;
  const TangentWeights by{0.7, 30, 900};
  double damping = 0.02;
  this->for_each_element(2, [&](const auto& kind) {
    if (kind.law != StrainLaw::green) return;
    const auto rest = this->draw_rest_shape();
    this->oracle_.section.damping = damping;
    damping = 0.02 - damping;  // every other time
    std::array<ElementColumn<double, D>, 3> state{this->q_, this->rate_, this->random_.template vector<4 * D + 2>()};
    state[1][4 * D] = state[2][4 * D] = 0;
    const ShapeTabulation table(this->oracle_.rule, this->oracle_.stored.w);
    for (const Formulation formulation : formulations) {
      const auto law = this->law(formulation, rest);
      const auto tangent =
          moving_tangent<MovingEnds::b, D>(coordinates<double, D>(state[0]), coordinates<double, D>(state[1]),
                                           coordinates<double, D>(state[2]), by, this->oracle_.stored, table, law);
      for (int j = 0; j < 4 * D + 1; ++j) {
        const ElementColumn<double, D> unit = ElementColumn<double, D>::Unit(j < 4 * D ? j : 4 * D + 1);
        const std::array<double, 3> scale{by.q, by.v, by.a};
        auto moving = [&](std::size_t i) {
          return coordinates<Real, D>(in_motion<double, element_size<D>>(state[i], scale[i] * unit));
        };
        const auto r =
            moving_residual<MovingEnds::b, Real, D>(moving(0), moving(1), moving(2), this->oracle_.stored, table, law);
        Eigen::Matrix<double, 4 * D + 1, 1> expected;
        for (int i = 0; i < 4; ++i) {
          expected.template segment<D>(i * D) = rate_of<double, D>(r.nodes[static_cast<std::size_t>(i)]);
        }
        expected[4 * D] = r.ends[0].rate;
        EXPECT_LE((tangent.col(j) - expected).norm(), rounding * tangent.norm()) << "column " << j;
      }
    }
  });
}

}  // namespace
}  // namespace vlbeam::test
