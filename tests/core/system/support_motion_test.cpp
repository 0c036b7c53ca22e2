// Supports whose point moves as a given function of time.
#include "core/beam/support_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/motion/system/implicit_beam.hpp"
#include "mechanics/sundials/sundials_stepper.hpp"
#include "scene/build.hpp"
#include "scene/run_support.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// A (1 - cos w t)^2: starts smoothly, from rest.
TimeFunction shaking(double amplitude, double w) {
  return [=](double t) {
    const double c = std::cos(w * t), s = std::sin(w * t);
    return Prescribed{amplitude * (1 - c) * (1 - c), 2 * amplitude * w * (1 - c) * s,
                      2 * amplitude * w * w * (s * s + (1 - c) * c)};
  };
}

TimeFunction accelerating(double a) {
  return [=](double t) { return Prescribed{a * t * t / 2, a * t, a}; };
}

template <class Dimension>
class DrivenEquations : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(DrivenEquations, Dimensions);

/// A damped chain in motion between two moving supports, one of them in an oblique frame.
template <int D>
BeamModel<D> driven_model(const ChainShape& shape, Random& random) {
  auto model = model_of<D>(shape, random);
  model.section.damping = 0.01;
  model.start = Support<D>::direction_clamp(random.vector<D>());
  model.end = Support<D>::pin();
  model.start_motion = {random.vector<D>(), shaking(0.3, 7)};
  model.end_motion = {random.vector<D>(), shaking(0.2, 5)};
  return model;
}

TYPED_TEST(DrivenEquations, ExplicitAndImplicitFormsAreTheSame) {
  constexpr int D = TypeParam::value;
  unsigned seed = 3;
  for (const auto& shape : supported_shapes) {
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      SCOPED_TRACE(shape.joint);
      Random random(seed++);
      auto model = driven_model<D>(shape, random);
      model.constraints = constraints;
      BeamSystem<D> system(model, random_chain<D>(shape, random));
      const double t = 0.17;
      Eigen::VectorXd y = system.initial_state(), dydt(y.size());
      system.impose(y, t);
      system.rhs(y, dydt, t);
      const std::array points{system.supports().at(t)[0].driven, system.supports().at(t)[1].driven};
      const Eigen::Index n = system.coordinates();
      EXPECT_LE((dydt.head<D>() - points[0].rate).norm(), 1e-15);
      EXPECT_LE((dydt.segment<D>(n) - points[0].acceleration).norm(), 1e-12);
      EXPECT_GT(points[0].acceleration.norm(), 1);

      auto& implicit = *system.second_order();
      Eigen::VectorXd q, v;
      implicit.expand(y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, t, a);
      implicit.residual(q, v, a, t, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));
      const double power = dydt[dydt.size() - 1];
      EXPECT_GT(std::abs(power), 1e-3);
      EXPECT_NEAR(implicit.supplied_power(q, v, a, t).supports, power, 1e-11 * (1 + a.norm()));
      const auto reactions = system.forces(y, t).supports;
      EXPECT_NEAR(
          reactions[0].template head<D>().dot(points[0].rate) + reactions[1].template head<D>().dot(points[1].rate),
          power, 1e-11 * (1 + a.norm()));
    }
  }
}

TYPED_TEST(DrivenEquations, JacobianIsTheDerivativeOfTheRightHandSide) {
  constexpr int D = TypeParam::value;
  unsigned seed = 71;
  for (const auto& shape : supported_shapes) {
    Random random(seed++);
    BeamSystem<D> system(driven_model<D>(shape, random), random_chain<D>(shape, random));
    const Eigen::VectorXd y = system.initial_state();
    const Eigen::Index size = y.size(), n = system.coordinates();
    const double t = 0.2;
    auto f = [&](const Eigen::VectorXd& at, double time) {
      Eigen::VectorXd dydt(size);
      system.rhs(at, dydt, time);
      return dydt;
    };
    Eigen::MatrixXd dfdy(size, size);
    Eigen::VectorXd dfdt(size);
    system.jacobian(y, t, dfdy, dfdt);
    Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(size, [&] { return random.uniform(-0.3, 0.3); });
    d.segment<D>(D).setZero();  // the clamped slope has a fixed direction
    d.segment<D>(n + D).setZero();
    const Eigen::VectorXd expected = slope_of([&](double s) { return f(y + s * d, t); });
    EXPECT_LE((dfdy * d - expected).norm(), 1e-6 * expected.norm()) << "joint " << shape.joint;
    const Eigen::VectorXd in_time = slope_of([&](double s) { return f(y, t + s); });
    EXPECT_LE((dfdt - in_time).norm(), 1e-6 * in_time.norm());
  }
}

/// A run of a beam whose supports may move, seen at its end.
struct DrivenRun {
  Scene scene = test::by_greens_law();
  SupportMotion<2> start_motion, end_motion;

  struct Seen {
    Eigen::VectorXd position, rate;  ///< of all nodes, in the rest frame
    Energy energy;                   ///< by the model's own points
    double largest_drift = 0;        ///< of total - supplied less jumps [J]
    double largest_kinetic = 0;      ///< [J]
    std::vector<double> supplied;    ///< at each sample [J]
    std::size_t events = 0;
    SolverCounters counters;
  };

  BeamModel<2> model() const {
    BeamModel<2> model = build_model<2>(scene);
    model.start_motion = start_motion;
    model.end_motion = end_motion;
    return model;
  }

  Seen operator()(IntegratorType type, double tolerance, double step = 1e-3, int samples = 20) const {
    BeamSystem<2> system(model(), build_chain<2>(scene));
    Seen seen;
    double first = 0, jumps = 0;
    system.on_event = [&](const EventRecord<2>& record) {
      jumps += record.discrete_jump;
      ++seen.events;
    };
    system.on_sample = [&](const Eigen::VectorXd& y, double t) {
      const auto chain = system.chain(y, t);
      seen.position = Eigen::Map<const Eigen::VectorXd>(chain.q.data(), static_cast<Eigen::Index>(chain.q.size()));
      seen.rate = Eigen::Map<const Eigen::VectorXd>(chain.rate.data(), static_cast<Eigen::Index>(chain.rate.size()));
      seen.energy = system.observe(y, t, own_points).energy;
      seen.supplied.push_back(seen.energy.supplied);
      if (t == 0) first = seen.energy.total();
      seen.largest_kinetic = std::max(seen.largest_kinetic, seen.energy.kinetic);
      seen.largest_drift =
          std::max(seen.largest_drift, std::abs(seen.energy.total() - seen.energy.supplied - first - jumps));
    };
    IntegrationOptions options;
    set_method(type, step, options);
    options.tolerances = {tolerance, tolerance};
    options.generalized_alpha.step = step;
    options.generalized_alpha.newton_tolerance = 1e-12;
    std::vector<double> times;
    for (int i = 0; i <= samples; ++i) times.push_back(scene.duration * i / samples);
    Eigen::VectorXd y = system.initial_state();
    double t = 0;
    EXPECT_TRUE(integrate(system, y, t, scene.duration, times, options, seen.counters));
    return seen;
  }
};

/// Positions of the nodes of a chain, moved by d.
Eigen::VectorXd moved(Eigen::VectorXd nodes, const Eigen::Vector2d& d) {
  for (Eigen::Index k = 0; k < nodes.size(); k += 4) nodes.segment<2>(k) += d;
  return nodes;
}

/// Seen from a support with acceleration a, a beam is one under the gravity g - a.
void expect_moved_as_by_gravity(const Scene& scene, std::size_t events, double position, double rate) {
  const Eigen::Vector2d a(-4, 2.5);
  DrivenRun fixed{scene, {}, {}}, driven{scene, {a, accelerating(1)}, {}};
  fixed.scene.gravity = {-a[0], -9.81 - a[1], 0};
  const double t = scene.duration;
  std::vector<IntegratorType> types{IntegratorType::fehlberg78, IntegratorType::bulirsch_stoer,
                                    IntegratorType::generalized_alpha};
  if (have_sundials()) types.push_back(IntegratorType::arkode);
  for (const auto type : types) {
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      if (constraints == Constraints::multipliers && type != IntegratorType::generalized_alpha) continue;
      SCOPED_TRACE(static_cast<int>(type));
      fixed.scene.constraints = driven.scene.constraints = constraints;
      const auto expected = fixed(type, 1e-12), seen = driven(type, 1e-12);
      EXPECT_EQ(expected.events, events);
      EXPECT_EQ(seen.events, events);
      EXPECT_LE((seen.position - moved(expected.position, a * (t * t / 2))).lpNorm<Eigen::Infinity>(), position);
      EXPECT_LE((seen.rate - moved(expected.rate, a * t)).lpNorm<Eigen::Infinity>(), rate);
    }
  }
}

TEST(SupportMotion, MovesABeamAsGravityWould) {
  Scene pendulum = flexible_pendulum(4), beam = falling_beam(ElementKind::ale_rancf, 5);
  pendulum.gravity_ramp = beam.gravity_ramp = 0;
  beam.length_control.velocities = VelocityTransfer::projected;
  beam.duration = 0.3;
  expect_moved_as_by_gravity(pendulum, 0, 1e-10, 1e-8);
  expect_moved_as_by_gravity(beam, 1, 1e-10, 2e-7);
  beam.duration = 0.45;
  expect_moved_as_by_gravity(beam, 4, 2e-9, 1e-6);  // an event's instant is known to 1e-12 of an element
}

/// A clamped beam with a sliding mass, its support shaken obliquely.
DrivenRun shaken_beam(double damping = 0) {
  DrivenRun run{falling_beam(ElementKind::ale_ancf, 5), {Eigen::Vector2d(0.6, -0.8), shaking(0.02, 25)}, {}};
  run.scene.beam.material.damping = damping;
  run.scene.gravity_ramp = 0.1;
  run.scene.duration = 0.5;
  return run;
}

/// A beam between two pins that move differently.
DrivenRun shaken_bridge() {
  DrivenRun run{flexible_pendulum(6),
                {Eigen::Vector2d::UnitX(), shaking(0.005, 11)},
                {Eigen::Vector2d(1, 1), shaking(0.005, 17)}};
  run.scene.end.type = SupportType::pin;
  return run;
}

TEST(SupportMotion, SuppliesTheEnergyThatTheBeamGains) {
  for (DrivenRun run : {shaken_beam(), shaken_beam(2e-3), shaken_bridge()}) {
    run.scene.gravity_ramp = 0;  // while gravity grows it does work, too
    const auto seen = run(IntegratorType::fehlberg78, 1e-12);
    EXPECT_GT(std::abs(seen.energy.supplied), 1e-2 * seen.largest_kinetic);
    EXPECT_LE(seen.largest_drift, 1e-9 * seen.largest_kinetic);
    EXPECT_GE(seen.energy.dissipated, run.scene.beam.material.damping > 0 ? 1e-3 * seen.largest_kinetic : 0);
  }
}

TEST(SupportMotion, IsTheSameForEveryIntegrator) {
  for (DrivenRun run : {shaken_beam(1e-3), shaken_bridge()}) {
    run.scene.duration = 0.1;
    const auto exact = run(IntegratorType::fehlberg78, 1e-12);
    std::vector<IntegratorType> types{IntegratorType::dopri5, IntegratorType::rosenbrock4,
                                      IntegratorType::adams_bashforth_moulton};
    if (have_sundials())
      types.insert(types.end(), {IntegratorType::cvode, IntegratorType::arkode, IntegratorType::ida});
    for (const auto type : types) {
      SCOPED_TRACE(static_cast<int>(type));
      DrivenRun own = run;
      if (type == IntegratorType::ida) own.scene.constraints = Constraints::multipliers;
      const auto seen = own(type, 1e-8, 5e-5);
      EXPECT_LE((seen.position - exact.position).lpNorm<Eigen::Infinity>(), 1e-6);
      EXPECT_NEAR(seen.energy.supplied, exact.energy.supplied, 1e-5 * exact.largest_kinetic);
      EXPECT_NEAR(seen.energy.dissipated, exact.energy.dissipated, 1e-5 * exact.largest_kinetic);
    }
  }
}

/// Supports that start with an acceleration send a wave front into the beam.
TEST(SupportMotion, MayStartAbruptlyWithMultipliersOfIda) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  DrivenRun run = shaken_bridge();
  run.start_motion.displacement = accelerating(3.6);
  run.end_motion.displacement = [](double t) {
    return Prescribed{0.02 * (1 - std::cos(17 * t)), 0.34 * std::sin(17 * t), 5.78 * std::cos(17 * t)};
  };
  run.scene.duration = 0.1;
  const auto exact = run(IntegratorType::fehlberg78, 1e-12);
  run.scene.constraints = Constraints::multipliers;
  const auto seen = run(IntegratorType::ida, 1e-8);
  EXPECT_LE((seen.position - exact.position).lpNorm<Eigen::Infinity>(), 1e-6);
  EXPECT_LE(seen.counters.steps, 10000U);
}

TEST(SupportMotion, IsTheSameEliminatedAndWithMultipliers) {
  for (DrivenRun run : {shaken_beam(1e-3), shaken_bridge()}) {
    const auto eliminated = run(IntegratorType::generalized_alpha, 0);
    run.scene.constraints = Constraints::multipliers;
    const auto multipliers = run(IntegratorType::generalized_alpha, 0);
    EXPECT_EQ(eliminated.events, multipliers.events);
    EXPECT_LE((eliminated.position - multipliers.position).lpNorm<Eigen::Infinity>(), 1e-8);
    EXPECT_LE((eliminated.rate - multipliers.rate).lpNorm<Eigen::Infinity>(), 1e-6);
    EXPECT_NEAR(eliminated.energy.supplied, multipliers.energy.supplied, 1e-8 * eliminated.largest_kinetic);
    EXPECT_LE(multipliers.counters.newton.constraints.position, 1e-12);
    EXPECT_LE(multipliers.counters.newton.constraints.velocity, 1e-2);
  }
}

/// Where rounding puts a sample just behind the end of a step, the step to it has next to no length.
TEST(SupportMotion, SuppliesNoRoundingAtSamplesNextToTheEndsOfSteps) {
  for (DrivenRun run : {shaken_beam(1e-3), shaken_bridge()}) {
    run.scene.gravity_ramp = 0;
    for (const double step : {1e-3, 1e-4}) {
      const int samples = static_cast<int>(std::lround(run.scene.duration / step));
      run.scene.constraints = Constraints::eliminated;
      const auto seen = run(IntegratorType::generalized_alpha, 0, step, samples);
      run.scene.constraints = Constraints::multipliers;
      const auto expected = run(IntegratorType::generalized_alpha, 0, step, samples);
      ASSERT_EQ(seen.supplied.size(), static_cast<std::size_t>(samples) + 1);
      for (std::size_t i = 0; i < seen.supplied.size(); ++i) {
        EXPECT_NEAR(seen.supplied[i], expected.supplied[i], 1e-7 * expected.largest_kinetic) << "sample " << i;
      }
      EXPECT_NEAR(seen.largest_drift, expected.largest_drift, 1e-7 * expected.largest_kinetic);
    }
  }
}

TEST(SupportMotion, KeepsTheOrderOfGeneralizedAlpha) {
  for (DrivenRun run : {shaken_beam(1e-3), shaken_bridge()}) {
    run.scene.duration = 0.2;  // before the first event
    const auto exact = run(IntegratorType::fehlberg78, 1e-12);
    EXPECT_EQ(exact.events, 0U);
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      run.scene.constraints = constraints;
      std::array<double, 3> positions{}, rates{}, supplied{};
      double step = 1e-3;
      for (std::size_t i = 0; i < 3; ++i, step /= 2) {
        const auto seen = run(IntegratorType::generalized_alpha, 0, step);
        positions[i] = (seen.position - exact.position).norm();
        rates[i] = (seen.rate - exact.rate).norm();
        supplied[i] = std::abs(seen.energy.supplied - exact.energy.supplied);
      }
      for (const auto& errors : {positions, rates, supplied}) {
        EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
        EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.1);
      }
    }
  }
}

/// The supports' forces and the weight are what momentum changes by.
TEST(SupportMotion, IsHeldByForcesThatChangeTheMomentum) {
  for (const DrivenRun& run : {shaken_beam(), shaken_bridge()}) {
    BeamSystem<2> system(run.model(), build_chain<2>(run.scene));
    Eigen::VectorXd y = system.initial_state(), dydt(y.size());
    double t = 0;
    SolverCounters counters;
    IntegrationOptions options;
    integrate(system, y, t, 0.15, {}, options, counters);
    system.impose(y, t);
    system.rhs(y, dydt, t);
    const auto forces = system.forces(y, t).supports;
    auto momentum = [&](double s) -> Eigen::Vector2d { return system.observe(y + s * dydt, t, 25).momentum; };
    const Eigen::Vector2d change = (momentum(1e-6) - momentum(-1e-6)) / 2e-6;
    const auto& model = system.model();
    const double mass = model.section.rhoA * 1 + (!model.joints.empty() ? model.joints.front().law.mass : 0);
    const Eigen::Vector2d force = forces[0].head<2>() + forces[1].head<2>() + mass * system.gravity(t);
    EXPECT_GT(force.norm(), 1);
    EXPECT_LE((force - change).norm(), 1e-6 * force.norm());
  }
}

TEST(SupportMotion, IsRefusedWhereAnEnergyIsKept) {
  EXPECT_THROW(shaken_bridge()(IntegratorType::energy_momentum, 0), InvalidInput);
  DrivenRun run = shaken_beam();
  run.scene.length_control.velocities = VelocityTransfer::conservative;
  EXPECT_THROW(run(IntegratorType::dopri5, 1e-6), InvalidInput);
}

}  // namespace
}  // namespace vlbeam::test
