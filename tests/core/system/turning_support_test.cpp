// Clamps that turn as a given function of time.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mechanics/motion/system/implicit_beam.hpp"
#include "scene/build.hpp"
#include "scene/run_support.hpp"
#include "scene/time_function.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// Starts smoothly, from rest.
TimeFunction swinging(double amplitude, double w) {
  return [=](double t) {
    const double c = std::cos(w * t), s = std::sin(w * t);
    return Prescribed{amplitude * (1 - c) * (1 - c), 2 * amplitude * w * (1 - c) * s,
                      2 * amplitude * w * w * (s * s + (1 - c) * c)};
  };
}

/// A damped chain in motion between a clamp of the direction that turns and moves, and a full one that turns.
BeamModel<2> turning_model(const ChainShape& shape, Random& random) {
  auto model = model_of<2>(shape, random);
  model.section.damping = 0.01;
  model.start = Support<2>::direction_clamp(random.vector<2>());
  model.end = Support<2>::clamp();
  model.start_motion = {random.vector<2>(), swinging(0.3, 7), swinging(0.4, 6)};
  model.end_motion.angle = swinging(-0.5, 5);
  return model;
}

constexpr double instant = 0.17;

struct Turning {
  Turning(const ChainShape& shape, unsigned seed, Constraints constraints = Constraints::eliminated) : random(seed) {
    auto model = turning_model(shape, random);
    model.constraints = constraints;
    system = std::make_unique<BeamSystem<2>>(model, random_chain<2>(shape, random));
    y = system->initial_state();
    system->impose(y, instant);
  }
  Eigen::VectorXd rhs(const Eigen::VectorXd& at, double t) const {
    Eigen::VectorXd dydt(at.size());
    system->rhs(at, dydt, t);
    return dydt;
  }

  Random random;
  std::unique_ptr<BeamSystem<2>> system;
  Eigen::VectorXd y;
};

/// Along the motion, a parabola in time, what a turned support holds stays where it is, to second order.
TEST(TurningSupport, HoldsTheSlopeAsItTurns) {
  unsigned seed = 3;
  for (const auto& shape : supported_shapes) {
    const Turning c(shape, seed++);
    const Eigen::Index n = c.system->coordinates();
    const Eigen::VectorXd rates = c.rhs(c.y, instant);
    for (const int end : {0, 1}) {
      const auto e = static_cast<std::size_t>(end);
      const Eigen::Index at = (end == 0 ? 0 : Eigen::Index{4} * c.system->mesh().last()) + 2;
      auto held = [&](double s) -> Eigen::Vector2d {
        const auto support = c.system->supports().at(instant + s)[e].support;
        const Eigen::Vector2d slope =
            c.y.segment<2>(at) + s * rates.segment<2>(at) + s * s / 2 * rates.segment<2>(n + at);
        return (support.into_frame(slope).array() * (1 - support.free_slope)).matrix();
      };
      const auto rate_by = [&](double h) -> Eigen::Vector2d { return (held(h) - held(-h)) / (2 * h); };
      const double h = 1e-4;
      const Eigen::Vector2d second = (held(h) + held(-h) - 2 * held(0)) / (h * h);
      const auto& model = c.system->model();
      const Eigen::Vector2d anchor =
          ((end == 0 ? model.start : model.end).into_frame(c.system->supports().nodes()[e].anchor.tail<2>()).array() *
           (1 - (end == 0 ? model.start : model.end).free_slope))
              .matrix();
      EXPECT_LE((held(0) - anchor).norm(), 1e-14);
      // the difference is off by h^2/6 times the third derivative, some 3 theta' s''
      EXPECT_LE(rate_by(1e-6).norm(), 1e-9 + 1e-11 * rates.segment<2>(n + at).norm());
      EXPECT_LE(second.norm(), 1e-4 * (1 + rates.segment<2>(n + at).norm()));
      EXPECT_GT(rates.segment<2>(n + at).norm(), 1);
    }
  }
}

TEST(TurningSupport, IsTheSameToImplicitMethods) {
  unsigned seed = 13;
  for (const auto& shape : supported_shapes) {
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
      const Turning c(shape, seed++, constraints);
      const Eigen::VectorXd dydt = c.rhs(c.y, instant);
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, instant, a);
      implicit.residual(q, v, a, instant, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));
      const double power = dydt[dydt.size() - 1];
      EXPECT_GT(std::abs(power), 1e-3);
      EXPECT_NEAR(implicit.supplied_power(q, v, a, instant).supports, power, 1e-11 * (1 + a.norm()));
      // forces on the point, and the moment about it
      const auto forces = c.system->forces(c.y, instant).supports;
      const auto& held_ends = c.system->supports().at(instant);
      double work = 0;
      for (const std::size_t e : {0U, 1U}) {
        const Eigen::Index node = e == 0 ? 0 : Eigen::Index{4} * c.system->mesh().last();
        const Eigen::Vector2d slope = c.y.segment<2>(node + 2);
        const auto& [support, point] = std::tie(held_ends[e].support, held_ends[e].driven);
        const Eigen::Vector2d on_slope = DrivenPoint<2>::held(support, forces[e].tail<2>());
        const double moment = slope[0] * on_slope[1] - slope[1] * on_slope[0];
        work += forces[e].head<2>().dot(point.rate) + moment * point.angle.rate;
      }
      EXPECT_NEAR(work, power, 1e-11 * (1 + a.norm()));
    }
  }
}

TEST(TurningSupport, IsInTheJacobian) {
  unsigned seed = 71;
  for (const auto& shape : supported_shapes) {
    Turning c(shape, seed++);
    const Eigen::Index size = c.y.size();
    Eigen::MatrixXd dfdy(size, size);
    Eigen::VectorXd dfdt(size);
    c.system->jacobian(c.y, instant, dfdy, dfdt);
    const Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(size, [&] { return c.random.uniform(-0.3, 0.3); });
    const Eigen::VectorXd expected = slope_of([&](double s) { return c.rhs(c.y + s * d, instant); });
    EXPECT_LE((dfdy * d - expected).norm(), 1e-6 * expected.norm()) << "joint " << shape.joint;
    const Eigen::VectorXd in_time = slope_of([&](double s) { return c.rhs(c.y, instant + s); });
    EXPECT_LE((dfdt - in_time).norm(), 1e-6 * in_time.norm());
  }
}

/// A soft beam with a sliding mass whose clamp is swung to and fro.
Scene swung(ElementKind element, ClampType clamp = ClampType::direction) {
  Scene scene = falling_beam(element, 5);
  scene.beam.rest_shape = RestShape::as_built;
  scene.length_control.velocities = VelocityTransfer::projected;
  scene.start.clamp = clamp;
  scene.start.motion.emplace().angle = {.amplitude = 0.5, .frequency = 2, .ramp = 0.1};
  scene.duration = 0.4;
  scene.output.interval = 0.05;
  set_tolerance(scene, IntegratorType::dopri5, 1e-12);
  return scene;
}

double largest_energy(const RunResult& run) {
  double largest = 0;
  for (const Sample& s : run.samples) largest = std::max(largest, s.energy.kinetic + s.energy.bending + s.energy.axial);
  return largest;
}

TEST(TurningSupport, SuppliesTheEnergyThatTheBeamGains) {
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const auto clamp : {ClampType::direction, ClampType::full}) {
      for (const bool slides : {true, false}) {
        Scene scene = swung(element, clamp);
        if (!slides) scene.sliding_mass.reset();
        const RunResult run = completed(scene);
        EXPECT_GT(std::abs(run.samples.back().energy.supplied), 1e-2 * largest_energy(run));
        EXPECT_LE(run.max_energy_drift, 1e-9 * largest_energy(run));
        EXPECT_EQ(run.events.empty(), !slides);
      }
    }
  }
}

TEST(TurningSupport, WithAngleZeroIsOneAtRest) {
  for (const auto type : {IntegratorType::dopri5, IntegratorType::generalized_alpha}) {
    for (const auto clamp : {ClampType::direction, ClampType::full}) {
      Scene scene = swung(ElementKind::ale_rancf, clamp);
      scene.duration = 0.3;
      scene.integrator.type = type;
      scene.integrator.rtol = scene.integrator.atol = 1e-9;
      scene.start.motion->angle = TimeSpec{};
      Scene resting = scene;
      resting.start.motion.reset();
      const Sample seen = completed(scene).samples.back(), expected = completed(resting).samples.back();
      for (const std::size_t c : {0U, 1U}) EXPECT_NEAR(seen.end[c], expected.end[c], 1e-9);
      EXPECT_NEAR(*seen.joint_position, *expected.joint_position, 1e-9);
      EXPECT_EQ(seen.energy.supplied, 0);
    }
  }
}

/// Order 2, and the same with multipliers.
TEST(TurningSupport, KeepsTheOrderOfGeneralizedAlpha) {
  Scene scene = swung(ElementKind::ale_ancf);
  scene.beam.material.damping = 1e-3;
  scene.duration = 0.15;  // before the first event
  scene.output.interval = 0.15;
  const Sample exact = completed(scene).samples.back();
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.newton_tolerance = 1e-12;
  std::array<std::array<double, 2>, 2> other{};
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    scene.constraints = constraints;
    std::array<double, 3> places{}, work{};
    scene.integrator.step = 1e-3;
    for (std::size_t i = 0; i < 3; ++i, scene.integrator.step /= 2) {
      const RunResult run = completed(scene);
      const Sample& seen = run.samples.back();
      places[i] = std::hypot(seen.end[0] - exact.end[0], seen.end[1] - exact.end[1]);
      work[i] = std::abs(seen.energy.supplied - exact.energy.supplied);
      if (i > 0) continue;
      if (constraints == Constraints::eliminated) {
        other = {{{seen.end[0], seen.end[1]}, {seen.energy.supplied, 0}}};
      } else {
        EXPECT_NEAR(seen.end[0], other[0][0], 1e-8);
        EXPECT_NEAR(seen.end[1], other[0][1], 1e-8);
        EXPECT_NEAR(seen.energy.supplied, other[1][0], 1e-7);
        EXPECT_LE(run.solver.newton.constraints.position, 1e-12);
      }
    }
    for (const auto& errors : {places, work}) {
      EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
      EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.1);
    }
  }
}

/// By the engineering strain a bar that turns steadily has r(x) = sin(k x)/(k cos(k L)), k^2 = rhoA omega^2/EA.
TEST(TurningSupport, KeepsASteadyRotation) {
  constexpr double omega = 3, EA = 2000, rhoA = 2;
  const double k = omega * std::sqrt(rhoA / EA);
  Scene scene = test::by_greens_law();
  scene.gravity = {};
  scene.beam.elements = 8;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.strain_law = StrainLaw::engineering;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = 0.3, .rhoA = rhoA};
  scene.beam.axial_strain = AxialStrain::full;
  scene.start = {SupportType::clamp, ClampType::direction, SupportMotionSpec{{}, {}, TimeSpec{.rate = omega}}};
  scene.initial_velocity = {.rotation = omega};
  EXPECT_NO_THROW(completed(scene));
  for (const auto clamp : {ClampType::direction, ClampType::full}) {
    scene.start.clamp = clamp;
    ChainState<2> chain = build_chain<2>(scene);
    for (int i = 0; i <= 8; ++i) {
      const double x = i / 8.0, r = std::sin(k * x) / (k * std::cos(k)), r_x = std::cos(k * x) / std::cos(k);
      position<2>(chain.q.data(), i) << r, 0;
      slope<2>(chain.q.data(), i) << r_x, 0;
      position<2>(chain.rate.data(), i) << 0, omega * r;
      slope<2>(chain.rate.data(), i) << 0, omega * r_x;
    }
    BeamSystem<2> system(build_model<2>(scene), chain);
    for (const auto type : {IntegratorType::fehlberg78, IntegratorType::generalized_alpha}) {
      Eigen::VectorXd y = system.initial_state();
      double t = 0, end = 2;
      SolverCounters counters;
      IntegrationOptions options;
      set_method(type, 1e-3, options);
      options.tolerances = {1e-11, 1e-11};
      options.generalized_alpha.step = 2e-4;
      ASSERT_TRUE(integrate(system, y, t, end, {}, options, counters));
      system.impose(y, end);
      const double radius = std::tan(k) / k, angle = omega * end;
      const Eigen::Vector2d tip = position<2>(y.data(), 8);
      const double allowed = type == IntegratorType::fehlberg78 ? 1e-9 : 1e-6;  // of the mesh; of the step
      EXPECT_NEAR(tip[0], radius * std::cos(angle), allowed);
      EXPECT_NEAR(tip[1], radius * std::sin(angle), allowed);
      const double supplied = system.observe(y, end, 5).energy.supplied;
      EXPECT_LE(std::abs(supplied), allowed) << "a steady motion takes no work";
    }
  }
}

/// Simo & Vu-Quoc (1986), their beam without shear, by the Green strain of this library: offsets of the tip at `time`.
std::array<double, 2> spun_up(double time, int elements, ElementKind element, double step) {
  constexpr double pi = std::numbers::pi, spin_up = 15, omega = 6, share = omega / spin_up;
  Scene scene = test::by_greens_law();
  scene.gravity = {};
  scene.beam.curve.end = {10, 0, 0};
  scene.beam.elements = elements;
  scene.beam.element = element;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2.8e7, .EI = 1.4e4, .rhoA = 1.2};
  const double amplitude = share * (spin_up / (2 * pi)) * (spin_up / (2 * pi));
  const TimeSpec angle{.value = -amplitude,
                       .acceleration = share,
                       .amplitude = amplitude,
                       .frequency = 1 / spin_up,
                       .phase_degrees = 90,
                       .until = spin_up};
  scene.start = {SupportType::clamp, ClampType::direction, SupportMotionSpec{{}, {}, angle}};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  scene.integrator.newton_tolerance = 1e-12;
  scene.duration = scene.output.interval = time;
  const Point end = completed(scene).samples.back().end;
  const double phi = time_function(angle)(time).value - time_function(angle)(0).value;
  const double c = std::cos(phi), s = std::sin(phi);
  return {c * end[0] + s * end[1] - 10, -s * end[0] + c * end[1]};
}

/// An independent p-version code with the same strain energy has these offsets. Two steps are extrapolated.
TEST(TurningSupport, SpinsUpAFlexibleBeam) {
  const auto converged = [](double time, ElementKind element) {
    const auto coarse = spun_up(time, 32, element, 1e-3), fine = spun_up(time, 32, element, 5e-4);
    return std::array{fine[0] + (fine[0] - coarse[0]) / 3, fine[1] + (fine[1] - coarse[1]) / 3};
  };
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    const auto at_6 = converged(6, element);
    EXPECT_NEAR(at_6[0], -0.0169693837, 1e-7);
    EXPECT_NEAR(at_6[1], -0.5435661989, 1e-7);
  }
  const auto at_15 = converged(15, ElementKind::ale_ancf);
  EXPECT_NEAR(at_15[0], 0.0005139434, 1e-7);
  EXPECT_NEAR(at_15[1], 0.0012958557, 1e-7);
}

}  // namespace
}  // namespace vlbeam::test
