#include "core/element/moving_tangent.hpp"
#include "mechanics/flow/driven_residual.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_under_test.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class DrivenTangent : public ElementUnderTest<Dimension> {
 protected:
  static constexpr int D = Dimension::value;
  using Nodal = Eigen::Matrix<double, 4 * D, 1>;
  using Real = Dual<double>;

  /// from + s direction, s the variable of differentiation; the material coordinates are prescribed.
  static MovingCoordinates<Real, D> along(const ElementColumn<double, D>& from, const Nodal& direction) {
    ElementColumn<double, D> rate = ElementColumn<double, D>::Zero();
    rate.template head<4 * D>() = direction;
    return coordinates<Real, D>(in_motion<double, element_size<D>>(from, rate));
  }

  void compare(Formulation formulation, const TangentWeights& by, double damping) {
    auto& o = this->oracle_;
    o.section.damping = damping;
    o.section.curvature_regularization = D == 3 && damping > 0 ? 0.4 : 0;
    const MovingLaw<D> law{o.section, formulation, o.transport, o.gravity};
    const ShapeTabulation table(o.rule, o.stored.w);
    const ElementColumn<double, D> a = this->random_.template vector<element_size<D>>();
    const Nodal direction = this->random_.template vector<4 * D>();
    const auto tangent =
        moving_tangent<MovingEnds::both, D, 0>(coordinates<double, D>(this->q_), coordinates<double, D>(this->rate_),
                                               coordinates<double, D>(a), by, o.stored, table, law);
    const auto eq = moving_equations<Real, D>(along(this->q_, by.q * direction), along(this->rate_, by.v * direction),
                                              o.stored, table, law);
    const auto exact = nodal_residual(eq, along(a, by.a * direction));
    const Nodal product = tangent * direction;
    Nodal expected;
    for (int i = 0; i < 4; ++i) {
      expected.template segment<D>(i * D) = rate_of<double, D>(exact[static_cast<std::size_t>(i)]);
    }
    EXPECT_LE(relative_difference(product, expected), 1e-11) << by.q << " " << by.v << " " << by.a;
    o.section.damping = 0;
  }
};
TYPED_TEST_SUITE(DrivenTangent, Dimensions, DimensionNames);

TYPED_TEST(DrivenTangent, IsTheDerivativeOfTheResidual) {
  this->for_each_element(2, [this](const ElementKindUnderTest&) {
    for (const Formulation formulation : formulations) {
      for (const TangentWeights& by :
           {TangentWeights{1, 0, 0}, TangentWeights{0, 1, 0}, TangentWeights{0, 0, 1}, TangentWeights{1, 30, 900}}) {
        for (const double damping : {0.0, 0.6}) {
          this->compare(formulation, by, damping);
        }
      }
    }
  });
}

}  // namespace
}  // namespace vlbeam::test
