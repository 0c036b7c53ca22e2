// What a user adds to the equations: a spring between a material point and the ground, in one class of its own.
#include "mechanics/motion/parts/part.hpp"

#include <gtest/gtest.h>

#include "mechanics/motion/parts/material_point.hpp"
#include "tests/core/support/held_chain.hpp"

namespace vlbeam::test {
namespace {

template <int D>
class SpringToGround final : public Part<D> {
 public:
  SpringToGround(double x, double stiffness, double damping) : x_(x), stiffness_(stiffness), damping_(damping) {}

  EnergyBalance add_force(const Motion<D>& now, double* force) const override {
    const int k = now.beam.element_at(x_);
    const auto at = point_at<double, D>(now.beam.kinematics(k), x_);
    add_point_force<D>(now.beam, k, at, {-stiffness_ * at.r - damping_ * at.v, Vec<double, D>::Zero()}, force);
    return {.dissipated = damping_ * at.v.squaredNorm(), .loads = -stiffness_ * at.r.dot(at.v)};
  }
  void add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    const int k = now.beam.element_at(x_);
    const auto force = [this](const auto& at, const auto& /*acceleration*/) {
      using Real = typename std::decay_t<decltype(at.r)>::Scalar;
      PointForce<Real, D> of;
      of.on_r = at.r * Real(-stiffness_) - at.v * Real(damping_);
      return of;
    };
    tangent.add_point(now.beam, k, point_tangent<D>(now.beam, k, x_, now.beam.rate, by, force));
  }

 private:
  double x_, stiffness_, damping_;
};

template <class Dimension>
class PartTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PartTest, Dimensions);

TYPED_TEST(PartTest, OfOnesOwnActsInAllViewsOfTheEquations) {
  constexpr int D = TypeParam::value;
  unsigned seed = 5;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    for (const ChainShape& shape : bearing_shapes) {
      SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
      const auto add = [](BeamModel<D>& model, Random&) {
        model.parts = {std::make_shared<SpringToGround<D>>(0.45, 30, 2)};
      };
      HeldChain<D> c(shape, seed++, constraints, add);
      const EnergyBalance booked = c.system->model().balance().of(c.rates());
      const double given = c.support_power() + booked.loads;
      EXPECT_NEAR(c.energy_rate(), given, 1e-8 * (1 + std::abs(given)));
      EXPECT_GT(std::abs(booked.loads), 1e-3);
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, c.now, a);
      const double dissipated = implicit.residual(q, v, a, c.now, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));
      EXPECT_NEAR(dissipated, booked.dissipated, 1e-12 * (1 + dissipated));
      EXPECT_NEAR(implicit.supplied_power(q, v, a, c.now).loads, booked.loads, 1e-12 * (1 + std::abs(booked.loads)));
      EXPECT_LE(c.tangent_error(q, v), 1e-6);
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
