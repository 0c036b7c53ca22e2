// Same options, same digits: what is looked at of a run does not change it.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "mechanics/sundials/sundials_stepper.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

struct Choice {
  std::string name;
  IntegratorType type;
  std::function<void(Scene&)> choose = [](Scene&) {};
};

void PrintTo(const Choice& method, std::ostream* out) { *out << method.name; }

/// With length-control events.
Scene scene_for(const Choice& method) {
  Scene scene = falling_beam(ElementKind::ale_ancf, 5);
  scene.duration = 0.5;
  set_tolerance(scene, method.type, 1e-7);
  method.choose(scene);
  return scene;
}

void expect_equal(const Reaction& a, const Reaction& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.slope, b.slope);
}

class Output : public ::testing::TestWithParam<Choice> {};

TEST_P(Output, ChangesNoDigit) {
  if (of_sundials(GetParam().type) && !have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  Scene scene = scene_for(GetParam());
  constexpr std::size_t ratio = 32;
  scene.output.interval = 1.0 / 16;
  const RunResult few = simulate(scene);
  scene.output.interval /= ratio;
  scene.output.configurations = {0.1, 0.30001, 0.4};
  const RunResult many = simulate(scene);
  ASSERT_EQ(few.status, RunStatus::completed) << few.failure;
  ASSERT_GE(few.events.size(), 1U);
  ASSERT_EQ(few.events.size(), many.events.size());
  for (std::size_t i = 0; i < few.events.size(); ++i) {
    EXPECT_EQ(few.events[i].t, many.events[i].t);
    EXPECT_EQ(few.events[i].discrete_jump, many.events[i].discrete_jump);
  }
  ASSERT_EQ(ratio * (few.samples.size() - 1) + 1, many.samples.size());
  for (std::size_t i = 0; i < few.samples.size(); ++i) {
    SCOPED_TRACE(few.samples[i].t);
    const Sample &a = few.samples[i], &b = many.samples[ratio * i];
    ASSERT_EQ(a.t, b.t);
    EXPECT_EQ(a.joint_position, b.joint_position);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.momentum, b.momentum);
    EXPECT_EQ(a.discrete_total, b.discrete_total);
    EXPECT_EQ(a.energy.dissipated, b.energy.dissipated);
    expect_equal(a.reactions[0], b.reactions[0]);
  }
  EXPECT_EQ(few.solver.steps, many.solver.steps);
  EXPECT_EQ(few.solver.rejected, many.solver.rejected);
  EXPECT_EQ(few.solver.newton.longest, many.solver.newton.longest);
  EXPECT_EQ(few.solver.newton.constraints.position, many.solver.newton.constraints.position);
  EXPECT_EQ(few.solver.newton.constraints.velocity, many.solver.newton.constraints.velocity);
  EXPECT_EQ(few.solver.newton.multipliers, many.solver.newton.multipliers);
}

void with_multipliers(Scene& scene) {
  scene.constraints = Constraints::multipliers;
  scene.beam.material.damping = 1e-3;
}

/// In space the multipliers of parallel slopes change their meaning where the beam turns.
void tangent_in_space(Scene& scene) {
  with_multipliers(scene);
  scene.dimension = 3;
  scene.beam.material.curvature_regularization = 1e-3;
  scene.beam.curve.end = {0.5, 0.1, 0.86023252670426265};
  scene.sliding_mass->slopes = JointSlopes::tangent;
  scene.integrator.newton_tolerance = 1e-10;
}

constexpr auto generalized_alpha = IntegratorType::generalized_alpha;
INSTANTIATE_TEST_SUITE_P(
    Methods, Output,
    ::testing::Values(
        Choice{"dopri5", IntegratorType::dopri5}, Choice{"fehlberg78", IntegratorType::fehlberg78},
        Choice{"bulirsch_stoer", IntegratorType::bulirsch_stoer},
        Choice{"adams", IntegratorType::adams_bashforth_moulton, [](Scene& scene) { scene.integrator.step = 2e-4; }},
        Choice{"rosenbrock4", IntegratorType::rosenbrock4}, Choice{"modified", generalized_alpha},
        Choice{"full", generalized_alpha, [](Scene& scene) { scene.integrator.newton = NewtonKind::full; }},
        Choice{"adaptive", generalized_alpha,
               [](Scene& scene) {
                 scene.integrator.adaptive = true;
                 scene.integrator.rtol = scene.integrator.atol = 1e-5;
               }},
        Choice{"multipliers", generalized_alpha, with_multipliers},
        Choice{"tangent_slopes", generalized_alpha, tangent_in_space},
        Choice{"energy_momentum", IntegratorType::energy_momentum},
        Choice{"ida", IntegratorType::ida, with_multipliers}, Choice{"cvode", IntegratorType::cvode},
        Choice{"arkode", IntegratorType::arkode}),
    [](const auto& of) { return of.param.name; });

/// Full Newton ends at once where rounding is all that is left: what the last correction of another step was, of a
/// sample or an event, must not tell.
TEST(Output, ChangesNoDigitOfAMotionThatNewtonFollowsToRounding) {
  Scene scene = test::by_greens_law();  // a bead on a stiff incline
  scene.beam.curve.end = {0.8660254037844387, -0.5, 0};
  scene.beam.elements = 8;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 1e4, .rhoA = 1e-3};
  scene.start.type = scene.end.type = SupportType::clamp;
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->mass = 1e-3;
  scene.duration = 0.5;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.newton = NewtonKind::full;
  scene.output.interval = 0.01;
  const RunResult few = simulate(scene);
  scene.output.interval = 0.03;
  const RunResult many = simulate(scene);
  ASSERT_EQ(few.status, RunStatus::completed) << few.failure;
  ASSERT_GE(few.events.size(), 1U);
  ASSERT_EQ(few.events.size(), many.events.size());
  for (std::size_t i = 0; i < few.events.size(); ++i) EXPECT_EQ(few.events[i].t, many.events[i].t) << i;
}

}  // namespace
}  // namespace vlbeam::test
