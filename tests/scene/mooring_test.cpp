// Ropes in water and on the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/ropes/ground.hpp"
#include "scene/energy_ledger.hpp"
#include "tests/core/support/held_chain.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

constexpr double gravity = 9.81;

/// An inextensible chain from an anchor on the ground to a fairlead: laid on it, then a catenary that leaves it along
/// the ground (Irvine, Cable Structures, 1981, 1.2).
struct Chain {
  double weight = 100;  ///< in water, by length [N/m]
  double pull = 1000;   ///< horizontal tension [N]
  double height = 20, laid = 15;

  double of_span() const { return std::acosh(1 + height * weight / pull); }
  double hanging() const { return pull / weight * std::sinh(of_span()); }
  double length() const { return laid + hanging(); }
  double reach() const { return laid + pull / weight * of_span(); }
  double tension() const { return pull + weight * height; }
};

/// Drawn along the ground and straight up to the fairlead, of the right length.
Scene moored(const Chain& chain, int elements) {
  Scene scene;
  const double L = chain.length(), X = chain.reach(), h = chain.height;
  const double corner = (L * L - X * X - h * h) / (2 * (L - X));
  scene.analysis = Analysis::statics;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = {{0, 0, 0}, {corner, 0, 0}, {X, h, 0}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e9, .EI = 0, .rhoA = chain.weight / gravity};
  scene.beam.elements = elements;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.ground = GroundSpec{.stiffness = 1e7};
  return scene;
}

TEST(Mooring, AChainFromTheGroundToAFairleadPullsAsACatenary) {
  const Chain chain;
  const RunResult run = test::completed(moored(chain, 60));
  const Point pull = run.samples.back().reactions[1].position;
  EXPECT_NEAR(pull[0], chain.pull, 2e-4 * chain.tension());
  EXPECT_NEAR(pull[1], chain.weight * chain.hanging(), 2e-4 * chain.tension());
  EXPECT_NEAR(std::hypot(pull[0], pull[1]), chain.tension(), 2e-4 * chain.tension());
  // some of it lies: the weight there is the ground's
  EXPECT_NEAR(run.samples.back().reactions[0].position[1], 0, 0.02 * chain.weight * chain.laid);
}

TEST(Mooring, BuoyancyIsTheWeightOfWhatIsDisplaced) {
  const Chain chain;
  Scene dry = moored(chain, 24), wet = dry;
  wet.beam.section.rhoA *= 1.5;
  wet.fluid = FluidSpec{.density = 1025, .area = 0.5 * chain.weight / gravity / 1025};
  const Point a = test::completed(dry).samples.back().reactions[1].position;
  const Point b = test::completed(wet).samples.back().reactions[1].position;
  // the ground sets in over another depth
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(a[i], b[i], 1e-5 * chain.tension());
  Scene named = wet;
  named.fluid->area.reset();
  EXPECT_EQ(test::refused(named), "/fluid/area");
  named = wet;
  named.fluid->velocity = {1, 0, 0};
  EXPECT_EQ(test::refused(named), "/fluid/velocity") << "there is no drag";
}

/// A free rod that a stream takes along: at the end it is as fast.
TEST(Mooring, AStreamTakesARodAlong) {
  Scene scene;
  scene.gravity = {};
  scene.beam.elements = 4;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 6000, .EI = 0.2, .rhoA = 2};
  scene.drag = DragSpec{.linear = {.normal = 3, .tangential = 3}};
  scene.fluid = FluidSpec{.velocity = {0.3, 0.4, 0}};
  scene.duration = 1;
  test::set_tolerance(scene, IntegratorType::dopri5, 1e-10);
  const RunResult run = test::completed(scene);
  const double faded = std::exp(-1.5), mass = 2;
  EXPECT_NEAR(run.samples.back().momentum[0], mass * 0.3 * (1 - faded), 1e-8);
  EXPECT_NEAR(run.samples.back().momentum[1], mass * 0.4 * (1 - faded), 1e-8);
  EXPECT_LE(run.max_energy_drift, 1e-9) << "what the stream gives is booked";
  EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-9) << "in reports, too";
}

TEST(Mooring, NoSupportStandsBelowTheFloor) {
  Scene scene;
  scene.start.type = SupportType::pin;
  scene.ground = GroundSpec{.height = 0, .stiffness = 1e4};
  scene.duration = 1e-3;
  EXPECT_EQ(test::refused(scene), "nothing");
  scene.ground->height = 1;
  EXPECT_EQ(test::refused(scene), "/ground/height");
  scene.start.type = SupportType::free;
  EXPECT_EQ(test::refused(scene), "nothing") << "what lies below the floor comes up";
}

// It falls, bounces, and what the ground keeps is booked.
TEST(Mooring, ARodBouncesOffTheGroundAndTheLedgerCloses) {
  Scene scene;
  scene.beam.elements = 6;
  scene.beam.curve.start = {0, 0.1, 0};
  scene.beam.curve.end = {1, 0.15, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 5000, .EI = 5, .rhoA = 1};
  scene.beam.material.damping = 1e-4;
  scene.initial_velocity.emplace().translation = {0.5, 0, 0};
  scene.duration = 0.5;
  for (const bool implicit : {false, true}) {
    Scene now = scene;
    now.ground = GroundSpec{.height = 0.02, .stiffness = 2e4, .depth = 2e-3, .damping = 20};
    now.ground->friction = AxialFriction{.coefficient = 0.3, .velocity = 0.01};
    test::set_tolerance(now, IntegratorType::dopri5, 1e-9);
    if (implicit) {
      now.integrator.type = IntegratorType::generalized_alpha;
      now.integrator.step = 1e-4;
    }
    const RunResult run = test::completed(now);
    EXPECT_LE(run.max_energy_drift, (implicit ? 1e-3 : 1e-6) * run.max_kinetic);
    EXPECT_LE(energy_ledger(run).largest_unexplained, (implicit ? 1e-3 : 1e-5) * run.max_kinetic);
    EXPECT_GT(run.samples.back().energy.dissipated, 0.05);
    EXPECT_LT(run.samples.back().momentum[0], 0.45) << "it rubs";
    for (const Sample& sample : run.samples) EXPECT_GT(sample.end[1], 0) << "the floor holds";
  }
}

TEST(Mooring, TheGroundPushesOneWayAndSetsInSmoothly) {
  FloorLaw<2> floor{.level = 1, .stiffness = 50, .depth = 0.1};
  EXPECT_FALSE(floor.acts({3, 1}));
  EXPECT_EQ(floor.spring().push(0.1), 50 * 0.05);
  EXPECT_NEAR((floor.spring().push(0.1 + 1e-6) - floor.spring().push(0.1 - 1e-6)) / 2e-6, 50, 1e-3);
  EXPECT_EQ(floor.spring().push(1.05), 50.0);
  const Vec<double, 2> f = floor.force(LinePoint<double, 2>{{0, 0.5}, {1, 0}, {0, 0}});
  EXPECT_EQ(f[0], 0);
  EXPECT_EQ(f[1], 50 * 0.45);
}

template <class Dimension>
class GroundTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(GroundTest, Dimensions);

TYPED_TEST(GroundTest, ActsInAllViewsOfTheEquations) {
  constexpr int D = TypeParam::value;
  unsigned seed = 5;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    for (const test::ChainShape& shape : test::bearing_shapes) {
      SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
      const auto add = [](BeamModel<D>& model, test::Random&) {
        FloorLaw<D> floor{.level = 0.8, .stiffness = 30, .depth = 0.4, .damping = 2};
        floor.friction = AxialFriction{.coefficient = 0.4, .velocity = 0.5};
        model.parts = {std::make_shared<Ground<D>>(floor, 7)};
      };
      test::HeldChain<D> c(shape, seed++, constraints, add);
      const EnergyBalance booked = c.system->model().balance().of(c.rates());
      const double given = c.support_power() + booked.loads;
      EXPECT_NEAR(c.energy_rate(), given, 1e-8 * (1 + std::abs(given)));
      EXPECT_GT(std::abs(booked.loads), 1e-3);
      EXPECT_GT(booked.dissipated, 1e-3);
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, c.now, a);
      const double dissipated = implicit.residual(q, v, a, c.now, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));
      EXPECT_NEAR(dissipated, booked.dissipated, 1e-12 * (1 + dissipated));
      EXPECT_LE(c.tangent_error(q, v), 1e-6);
    }
  }
}

}  // namespace
}  // namespace vlbeam
