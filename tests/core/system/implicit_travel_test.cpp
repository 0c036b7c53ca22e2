#include "mechanics/flow/flow_room.hpp"
#include "mechanics/motion/system/implicit_beam.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "scene/run_support.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/element_state.hpp"
#include "tests/core/support/flows.hpp"

namespace vlbeam::test {
namespace {

template <int D>
BeamModel<D> whirling(Formulation formulation = Formulation::variational, AngleField field = AngleField::linear) {
  const CircularShaft shaft{.radius = 0.02, .density = 1300, .youngs_modulus = 1e6};
  Vec<double, D> along = Vec<double, D>::UnitX();
  along[1] = 0.3;
  BeamModel<D> model;
  model.section = shaft.section();
  model.section.damping = D == 2 ? 0.01 : 0;
  spin_in(model).section = shaft.spin();
  flow_in(model).rotary = {.rhoJ = spin_in(model).section.rhoIp / 2, .direction = along.normalized()};
  if (D == 3) flow_in(model).rotary.gyroscopic = spin_in(model).section.rhoIp * 30;
  spin_in(model).section.damping = 0.01;
  model.gravity = Vec<double, D>::UnitY() * -9.81;
  flow_in(model).motion = MeshMotion({{0, steadily(0, -0.5)},
                                      {2,
                                       [](double t) {
                                         return Prescribed{0.5 + 0.3 * t * t, 0.6 * t, 0.6};
                                       }},
                                      {4, steadily(1, 0.4)}});
  model.start = Support<D>::direction_clamp(along);
  model.held_nodes = {{2, Support<D>::pin()}, {3, Support<D>::slide(along)}};
  spin_in(model).drives = {{0, [](double t) { return Prescribed{2 * t + t * t, 2 + 2 * t, 2}; }}};
  model.loads.points = {{.node = 4, .follower = [](double) { return 0.7; }}};
  spin_in(model).torques.points = {{.node = 4, .torque = [](double) { return 0.1; }}};
  model.loads.points.push_back({.x = [](double t) { return 0.8 - t; }, .follower = [](double) { return -0.4; }});
  model.formulation = formulation;
  if (formulation == Formulation::virtual_work) flow_in(model).rotary = {};
  spin_in(model).field = field;
  return model;
}

constexpr std::pair<Formulation, AngleField> choices[] = {{Formulation::variational, AngleField::linear},
                                                          {Formulation::variational, AngleField::hermite},
                                                          {Formulation::virtual_work, AngleField::linear},
                                                          {Formulation::virtual_work, AngleField::hermite}};

template <class Dimension>
class ImplicitTravelTest : public ::testing::Test {
 protected:
  /// Calls check(flow, q, v) with a random state for each of the choices.
  template <class Check>
  void with_each(const Check& check) {
    constexpr int D = Dimension::value;
    for (const auto& [formulation, field] : choices) {
      const BeamModel<D> model = whirling<D>(formulation, field);
      BeamSystem<D> beam(model, straight_chain(model));
      ImplicitBeam<D> flow(beam.accelerations());
      const Eigen::Index n = beam.coordinates();
      const Eigen::VectorXd y = random_state(beam, random_);
      check(flow, Eigen::VectorXd(y.head(n)), Eigen::VectorXd(y.segment(n, n)));
    }
  }
  Eigen::VectorXd numbers(Eigen::Index count) {
    return Eigen::VectorXd::NullaryExpr(count, [&] { return static_cast<double>(random_.uniform(-1, 1)); });
  }

  Random random_{5};
};
TYPED_TEST_SUITE(ImplicitTravelTest, Dimensions, DimensionNames);

TYPED_TEST(ImplicitTravelTest, ResidualVanishesAtTheAccelerationsOfTheExplicitForm) {
  this->with_each([&](auto& flow, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    const Eigen::Index n = q.size();
    Eigen::VectorXd a(n), r(n), scale(n);
    flow.acceleration(q, v, 0.1, a);
    flow.residual(q, v, Eigen::VectorXd::Zero(n), 0.1, scale);
    flow.residual(q, v, a, 0.1, r);
    EXPECT_LE(r.norm(), 1e-11 * scale.norm());
  });
}

TYPED_TEST(ImplicitTravelTest, InertiaIsWhatMoreAccelerationAddsToTheResidual) {
  this->with_each([&](auto& flow, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    const Eigen::Index n = q.size();
    const Eigen::VectorXd more = this->numbers(n);
    Eigen::VectorXd r(n), r_of_more(n), inertia(n);
    flow.residual(q, v, more, 0.1, r_of_more);
    flow.residual(q, v, Eigen::VectorXd::Zero(n), 0.1, r);
    ASSERT_TRUE(flow.inertia(q, more, 0.1, inertia));
    EXPECT_GT(inertia.norm(), 0.1);
    EXPECT_LE((r_of_more - r - inertia).norm(), 1e-12 * (r.norm() + inertia.norm()));
  });
}

TYPED_TEST(ImplicitTravelTest, TangentIsTheDerivativeOfTheResidual) {
  this->with_each([&](auto& flow, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    const Eigen::Index n = q.size();
    const Eigen::VectorXd a = this->numbers(n);
    const double by_v = 30, by_a = 900, h = 1e-6;
    ASSERT_TRUE(flow.linearize(q, v, a, 0.1, {1, by_v, by_a}));
    // along a direction that the supports allow: one that the solver returns
    Eigen::VectorXd direction = this->numbers(n);
    Eigen::VectorXd plus(n), minus(n);
    flow.residual(q, v, direction, 0.1, plus);  // projects
    flow.residual(q, v, Eigen::VectorXd::Zero(n), 0.1, minus);
    direction = plus - minus;
    flow.residual(q + h * direction, v + h * by_v * direction, a + h * by_a * direction, 0.1, plus);
    flow.residual(q - h * direction, v - h * by_v * direction, a - h * by_a * direction, 0.1, minus);
    Eigen::VectorXd back = (plus - minus) / (2 * h);
    ASSERT_TRUE(flow.linearize(q, v, a, 0.1, {1, by_v, by_a}));
    flow.solve(back);
    EXPECT_LE(relative_difference(back, direction), 1e-6);
  });
}

TYPED_TEST(ImplicitTravelTest, GeneralizedAlphaFollowsAnExplicitMethod) {
  constexpr int D = TypeParam::value;
  auto final_state = [](const IntegrationOptions& options) {
    const BeamModel<D> model = whirling<D>();
    BeamSystem<D> beam(model, straight_chain(model));
    Vec<double, D> along = Vec<double, D>::UnitX();
    along[1] = 0.3;
    Eigen::VectorXd y = straight_state<D>(beam, Vec<double, D>::Zero(), along.normalized(), 1, 0, 2);
    auto held = model.held_nodes;
    held.push_back({0, model.start});
    for (const auto& [node, support] : held) {
      auto rate = position<D>(y.data() + beam.coordinates(), node);
      rate = support.out_of_frame(support.free_position.matrix().cwiseProduct(support.into_frame(rate)));
    }
    SolverCounters counters;
    double t = 0;
    integrate(beam, y, t, 0.1, {}, options, counters);
    return Eigen::VectorXd(y.head(beam.coordinates()));
  };
  IntegrationOptions options;
  options.type = IntegrationMethod::fehlberg78;
  options.tolerances = {1e-10, 1e-10};
  const Eigen::VectorXd exact = final_state(options);
  options.type = IntegrationMethod::generalized_alpha;
  std::vector<double> errors;
  for (const double step : {4e-4, 2e-4, 1e-4}) {
    options.generalized_alpha.step = step;
    options.generalized_alpha.rho_inf = 0.8;
    errors.push_back((final_state(options) - exact).template lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE(errors[2], 1e-3);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.3);
}

TEST(ImplicitTravel, RefusesMethodsThatDoNotApply) {
  for (const IntegratorType type : {IntegratorType::rosenbrock4, IntegratorType::energy_momentum}) {
    const BeamModel<2> model = whirling<2>();
    BeamSystem<2> beam(model, straight_chain(model));
    Eigen::VectorXd y = straight_state<2>(beam, Eigen::Vector2d::Zero(), Eigen::Vector2d::UnitX(), 1, 0, 0);
    IntegrationOptions options;
    set_method(type, 1e-3, options);
    SolverCounters counters;
    double t = 0;
    EXPECT_THROW(integrate(beam, y, t, 0.1, {}, options, counters), InvalidInput);
  }
}

}  // namespace
}  // namespace vlbeam::test
