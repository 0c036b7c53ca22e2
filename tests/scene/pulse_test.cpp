// What a scene announces of its course is not stepped over, whichever method takes the steps.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mechanics/sundials/sundials_stepper.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/names.hpp"
#include "scene/timetable.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// A soft beam that nothing holds, and that is pushed once.
Scene pushed(double from, double width, double force) {
  Scene scene;
  scene.gravity = {};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 10, .EI = 0.1, .rhoA = 1};
  scene.beam.elements = 2;
  LoadSpec& push = scene.loads.emplace_back();
  push.node = 1;
  push.magnitude.table = {{from, 0, 0}, {from + width / 2, force, 0}, {from + width, 0, 0}};
  scene.duration = from + 1.5 * width;
  scene.output.interval = scene.duration;
  return scene;
}

std::vector<IntegratorSpec> methods() {
  std::vector<IntegratorSpec> all;
  using enum IntegratorType;
  for (const IntegratorType type :
       {dopri5, cash_karp, fehlberg78, bulirsch_stoer, rosenbrock4, adams_bashforth_moulton, generalized_alpha}) {
    all.emplace_back().type = type;
    all.back().rtol = all.back().atol = 1e-6;
    all.back().step = 0.002;
  }
  all.push_back(all.back());
  all.back().adaptive = true;
  all.back().step = 0.3;
  if (!have_sundials()) return all;
  for (const IntegratorType type : {cvode, arkode, ida}) {
    all.push_back(all.front());
    all.back().type = type;
  }
  return all;
}

double momentum_of(Scene scene, const IntegratorSpec& integrator) {
  scene.integrator = integrator;
  if (integrator.type == IntegratorType::ida) {
    scene.constraints = Constraints::multipliers;
    scene.start.type = SupportType::free;
  }
  return test::completed(scene).samples.back().momentum[1];
}

// Momentum is impulse, whatever the beam does.
TEST(Pulses, AreSeenByAllMethods) {
  const double impulse = 1e-3;
  std::size_t i = 0;
  for (const double width : {1e-4, 7.3e-3, 0.11, 1.0}) {
    for (const IntegratorSpec& integrator : methods()) {
      const double from = 0.31 + 0.137 * static_cast<double>(++i);  // at no multiple of anything
      const Scene scene = pushed(from, width, 2 * impulse / width);
      EXPECT_NEAR(momentum_of(scene, integrator), impulse, 1e-3 * impulse)
          << to_string(integrator.type) << " adaptive: " << integrator.adaptive << ", " << width << " s at " << from;
    }
    const Scene scene = pushed(2.17, width, 2 * impulse / width);
    EXPECT_NEAR(momentum_of(scene, automatic_integrator(scene)), impulse, 1e-3 * impulse) << width;
  }
}

// A pulse of a millisecond in a quarter of an hour.
TEST(Pulses, HoldNoRunToShortStepsForAllItsTime) {
  Scene scene = pushed(412.3, 1e-3, 2);
  scene.duration = 900;
  scene.output.interval = 900;
  scene.beam.material.damping = 1;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = test::completed(scene);
  EXPECT_NEAR(run.samples.back().momentum[1], 1e-3, 1e-6);
  EXPECT_LT(run.solver.steps, 20000U);
}

// Supports that are moved have accelerations that jump. Two methods that share nothing see the same.
TEST(Pulses, OfASupportAreSeen) {
  Scene scene = pushed(0, 1, 0);
  scene.loads.clear();
  scene.start.type = SupportType::clamp;
  scene.start.motion = SupportMotionSpec{.direction = {0, 1, 0}, .displacement = {}};
  scene.start.motion->displacement.table = {{3.3, 0, 0}, {3.302, 0.1, 0}, {3.304, 0, 0}};
  scene.duration = 3.4;
  scene.output.interval = 0.1;
  test::set_tolerance(scene, IntegratorType::dopri5, 1e-8);
  const double explicit_end = test::completed(scene).samples.back().end[1];
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 0.3;
  scene.integrator.adaptive = true;
  EXPECT_GT(std::abs(explicit_end), 5e-4);
  EXPECT_NEAR(test::completed(scene).samples.back().end[1], explicit_end, 1e-2 * std::abs(explicit_end));
}

TEST(SceneTimetable, HasTheCornersOfAllFunctionsOfTime) {
  Scene scene;
  scene.beam.elements = 4;
  EXPECT_TRUE(timetable(scene).empty());
  const auto corner = [&scene](double before) { return timetable(scene).step(before, 1e9).corner.value_or(-1); };
  scene.gravity_ramp = 0.25;
  EXPECT_EQ(corner(0.24), 0.25);
  EXPECT_NEAR(timetable(scene).step(0, 1).length, 0.025, 1e-15);
  scene.loads.resize(1);
  scene.loads[0].magnitude = {.rate = 3, .until = 0.7};
  EXPECT_EQ(corner(0.69), 0.7);
  scene.start.motion.emplace().displacement = {.rate = 1, .rate_ramp = 0.9};
  EXPECT_EQ(corner(0.89), 0.9);
  scene.sliding_joints.emplace_back().x = TimeSpec{.value = 1, .ramp = 1.1};
  EXPECT_EQ(corner(1.09), 1.1);
  scene.end.feed.emplace().table = {{0, 0, 0}, {1.3, 1, 0}, {1.5, 1, 0}};
  EXPECT_EQ(corner(1.29), 1.3);
  EXPECT_EQ(corner(1.31), 1.5) << "while it rests a step may be as long";
  scene.spin.emplace().drives = {{0, {.rate = 1, .ramp = 1.7}}};
  EXPECT_EQ(corner(1.69), 1.7);
  scene.flow.emplace().nodes = {{0, {.rate = 1, .ramp = 1.9}}};
  EXPECT_EQ(corner(1.89), 1.9);
  scene.loads[0].turn = {.rate = 2 * 3.14159265358979};
  EXPECT_NEAR(timetable(scene).step(5, 1).length, 0.1, 1e-12) << "of a turn";
  EXPECT_NEAR(shortest_change(scene), 0.25, 1e-15);
}

}  // namespace
}  // namespace vlbeam
