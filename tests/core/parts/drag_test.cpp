#include "mechanics/ropes/drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/build.hpp"
#include "tests/core/support/held_chain.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// A chain in still air.
template <int D>
HeldChain<D> in_air(const ChainShape& shape, unsigned seed, Constraints constraints = Constraints::eliminated) {
  return {shape, seed, constraints, [](BeamModel<D>& model, Random&) {
            model.parts.push_back(std::make_shared<ActingDrag<D>>(Drag<D>{{0.7, 0.3}, {0.5, 0.9}, 7}));
          }};
}

template <class Dimension>
class DragTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(DragTest, Dimensions);

TYPED_TEST(DragTest, IsOfTheVelocityAlongAndAcross) {
  constexpr int D = TypeParam::value;
  Random random(2);
  const Drag<D> drag{{0.7, 0.3}, {0.5, 0.9}, 5};
  const Vec<double, D> v = random.vector<D>(3), r_x = random.vector<D>(), t = r_x.normalized();
  const Vec<double, D> f = drag.force(LinePoint<double, D>{r_x, r_x, v});
  const double along = v.dot(t), across = (v - along * t).norm();
  EXPECT_NEAR(f.dot(t), -along * (0.3 + 0.9 * std::abs(along)), 1e-14);
  EXPECT_NEAR((f - f.dot(t) * t).norm(), across * (0.7 + 0.5 * across), 1e-14);
  EXPECT_LT(f.dot(v), 0);
  const Vec<double, D> still = drag.force(LinePoint<double, D>{r_x, r_x, Vec<double, D>::Zero()});
  EXPECT_EQ(still.norm(), 0);
  const Drag<D> even{{0.7, 0.7}, {}, 5};
  EXPECT_LE((even.force(LinePoint<double, D>{r_x, r_x, v}) + 0.7 * v).norm(), 1e-15);
}

/// The total counts what is dissipated as still there.
TYPED_TEST(DragTest, TakesTheEnergyThatIsBooked) {
  constexpr int D = TypeParam::value;
  unsigned seed = 5;
  for (const ChainShape& shape : bearing_shapes) {
    SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
    const HeldChain<D> c = in_air<D>(shape, seed++);
    const Eigen::VectorXd rates = c.rates();
    EXPECT_GT(rates[rates.size() - 1], 0.01);
    const double held = c.support_power();
    EXPECT_NEAR(c.energy_rate(), held, 1e-8 * (1 + std::abs(held)));
  }
}

TYPED_TEST(DragTest, IsTheSameToImplicitMethods) {
  constexpr int D = TypeParam::value;
  unsigned seed = 25;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    for (const ChainShape& shape : bearing_shapes) {
      SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
      HeldChain<D> c = in_air<D>(shape, seed++, constraints);
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, c.now, a);
      const double dissipated = implicit.residual(q, v, a, c.now, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));
      EXPECT_NEAR(dissipated, c.rates()[c.y.size() - 1], 1e-12 * (1 + dissipated));
      EXPECT_LE(c.tangent_error(q, v), 1e-6);
    }
  }
}

/// In proportion to the mass it is a product with the mass matrix, where it is nearly that a sum over points.
TYPED_TEST(DragTest, InProportionToTheMassIsTheSumOverPoints) {
  constexpr int D = TypeParam::value;
  unsigned seed = 45;
  for (const ChainShape& shape : bearing_shapes) {
    SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
    ++seed;
    const auto with = [&](double tangential) -> HeldChain<D> {
      return {shape, seed, Constraints::eliminated, [&](BeamModel<D>& model, Random&) {
                model.parts.push_back(
                    std::make_shared<ActingDrag<D>>(Drag<D>{{0.7, tangential}, {}, 7, Vec<double, D>::UnitX() * 0.4}));
              }};
    };
    HeldChain<D> even = with(0.7), nearly = with(0.7 + 1e-10);
    const TangentWeights by{1, 7, 300};
    const auto look = [&](HeldChain<D>& c) {
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd r(q.size());
      const Eigen::VectorXd a = Eigen::VectorXd::Zero(q.size());
      const double lost = implicit.residual(q, v, a, c.now, r);
      Eigen::MatrixXd tangent;
      implicit.tangent(q, v, a, c.now, by, tangent);
      const Eigen::Index n = q.size();
      Eigen::VectorXd all(n + 2 + n * n);
      all << lost, implicit.supplied_power(q, v, a, c.now).loads, r, tangent.reshaped();
      return all;
    };
    const Eigen::VectorXd of_even = look(even), of_nearly = look(nearly);
    EXPECT_GT(of_even[0], 0.01);
    EXPECT_GT(std::abs(of_even[1]), 1e-3);
    EXPECT_LE((of_even - of_nearly).cwiseAbs().maxCoeff(), 1e-8);
  }
}

/// A free rod that falls, along its axis or across it.
Scene falling_rod(bool across) {
  Scene scene = test::by_greens_law();
  scene.beam.elements = 4;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 6000, .EI = 0.2, .rhoA = 2};
  if (!across) scene.beam.curve.end = {0, -1, 0};
  scene.duration = 3;
  scene.output.interval = 0.5;
  set_tolerance(scene, IntegratorType::dopri5, 1e-12);
  return scene;
}

double largest_energy(const RunResult& run) {
  double largest = 0;
  for (const Sample& s : run.samples) largest = std::max(largest, s.energy.kinetic + std::abs(s.energy.gravity));
  return largest;
}

/// v' = g - (c/rhoA) v, or g - (q/rhoA) v^2; along the axis and across it nothing strains the rod.
TEST(Drag, LetsARodFallAtItsTerminalVelocity) {
  constexpr double g = 9.81, rhoA = 2, c = 3, q = 1.5;
  for (const bool across : {true, false}) {
    for (const bool quadratic : {true, false}) {
      Scene scene = falling_rod(across);
      DragSpec::Coefficients& of = quadratic ? scene.drag.emplace().quadratic : scene.drag.emplace().linear;
      (across ? of.normal : of.tangential) = quadratic ? q : c;
      (across ? of.tangential : of.normal) = 7;
      for (const auto type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
        scene.integrator.type = type;
        const RunResult run = completed(scene);
        const bool exact = type == IntegratorType::dopri5;
        const double terminal = quadratic ? std::sqrt(rhoA * g / q) : rhoA * g / c;
        for (const Sample& s : run.samples) {
          const double v =
              quadratic ? terminal * std::tanh(g * s.t / terminal) : terminal * -std::expm1(-c / rhoA * s.t);
          EXPECT_NEAR(-s.momentum[1] / rhoA, v, exact ? 1e-9 : 1e-5);
        }
        EXPECT_LE(run.max_energy_drift, (exact ? 1e-9 : 1e-4) * largest_energy(run));
        EXPECT_GT(run.samples.back().energy.dissipated, 0.5 * largest_energy(run) - 40);
      }
    }
  }
}

/// Along a straight bar the engineering strain is linear: u = A sin(pi x/2L) e^(-alpha t/2) (cos w t + alpha/(2 w) sin
/// w t), w^2 = (pi c/2L)^2 - alpha^2/4.
TEST(MassDamping, LetsAModeDecay) {
  constexpr double EA = 200, rhoA = 2, alpha = 3, amplitude = 1e-3, half = std::numbers::pi / 2;
  Scene scene = falling_rod(true);
  scene.gravity = {};
  scene.beam.elements = 12;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.strain_law = StrainLaw::engineering;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0.2, .rhoA = rhoA};
  scene.beam.material.mass_damping = alpha;
  scene.start.type = SupportType::clamp;
  ChainState<2> chain = build_chain<2>(scene);
  for (int i = 0; i <= 12; ++i) {
    const double x = i / 12.0;
    position<2>(chain.q.data(), i)[0] += amplitude * std::sin(half * x);
    slope<2>(chain.q.data(), i)[0] += amplitude * half * std::cos(half * x);
  }
  BeamSystem<2> system(build_model<2>(scene), chain);
  const double w = std::sqrt(half * half * EA / rhoA - alpha * alpha / 4);
  for (const double end : {0.3, 1.0, 2.0}) {
    Eigen::VectorXd y = system.initial_state();
    double t = 0;
    SolverCounters counters;
    IntegrationOptions options;
    options.type = IntegrationMethod::fehlberg78;
    options.tolerances = {1e-13, 1e-13};
    ASSERT_TRUE(integrate(system, y, t, end, {}, options, counters));
    const double decay = std::exp(-alpha * end / 2) * (std::cos(w * end) + alpha / (2 * w) * std::sin(w * end));
    EXPECT_NEAR((position<2>(y.data(), 12)[0] - 1) / amplitude, decay, 1e-7);
  }
}

/// A mass slides along a beam in air, through events.
TEST(Drag, KeepsTheLedgerWithASlidingMass) {
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const bool slides : {true, false}) {
      Scene scene = falling_beam(element, 5);
      scene.beam.rest_shape = RestShape::as_built;
      scene.drag = DragSpec{{0.4, 0.1}, {0.3, 0.05}};
      scene.beam.material.mass_damping = 0.2;
      scene.duration = 0.42;
      if (!slides) scene.sliding_mass.reset();
      set_tolerance(scene, IntegratorType::dopri5, 1e-12);
      const RunResult run = completed(scene);
      EXPECT_GT(run.samples.back().energy.dissipated, 1e-2 * largest_energy(run));
      EXPECT_LE(run.max_energy_drift, 1e-9 * largest_energy(run));
      EXPECT_EQ(run.events.empty(), !slides);
      Scene implicit = scene;
      implicit.integrator = {};
      implicit.integrator.type = IntegratorType::generalized_alpha;
      implicit.integrator.step = 1e-4;
      implicit.duration = 0.3;
      Scene shorter = scene;
      shorter.duration = 0.3;
      const Sample exact = completed(shorter).samples.back();
      for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
        implicit.constraints = constraints;
        const Sample seen = completed(implicit).samples.back();
        EXPECT_NEAR(seen.end[0], exact.end[0], 2e-5);
        EXPECT_NEAR(seen.end[1], exact.end[1], 2e-5);
        EXPECT_NEAR(seen.energy.dissipated, exact.energy.dissipated, 1e-4 * largest_energy(run));
      }
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
