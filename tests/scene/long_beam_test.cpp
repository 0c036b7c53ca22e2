#include <gtest/gtest.h>

#include "core/pieces.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// A mass that shoots along a beam whose elements are 25 mm long, however many there are.
Scene shot(int elements, IntegratorType method) {
  Scene scene = test::falling_beam(ElementKind::ale_rancf, elements);
  scene.beam.curve.end = {0.025 * elements, 0, 0};
  scene.duration = 4.5e-3;
  scene.integrator.type = method;
  scene.integrator.step = 1e-3;
  scene.output.interval = 1.5e-3;
  scene.sliding_mass->position = 0.2 * 0.025 * elements;
  scene.sliding_mass->velocity = 25;
  return scene;
}

/// All of a run that a user sees.
std::vector<double> digits(const RunResult& result) {
  std::vector<double> all;
  for (const Sample& sample : result.samples) {
    all.insert(all.end(), {sample.t, sample.energy.kinetic, sample.energy.axial, *sample.joint_position});
    all.insert(all.end(), sample.end.begin(), sample.end.end());
  }
  for (const Event& event : result.events) {
    all.insert(all.end(), {event.t, event.joint_position, event.energy_jump.kinetic, event.discrete_jump});
  }
  return all;
}

class LongBeam : public ::testing::TestWithParam<IntegratorType> {};

TEST_P(LongBeam, HasTheSameDigitsWithAnyNumberOfThreads) {
  const Scene scene = shot(4500, GetParam());
  std::vector<std::vector<double>> seen;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    const RunResult result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    EXPECT_GE(result.events.size(), 4U);
    seen.push_back(digits(result));
  }
  EXPECT_EQ(seen[1], seen[0]);
  EXPECT_EQ(seen[2], seen[0]);
}

INSTANTIATE_TEST_SUITE_P(Methods, LongBeam,
                         ::testing::Values(IntegratorType::generalized_alpha, IntegratorType::dopri5));

/// Work goes with the length: events cost no more steps, and are found in as many.
TEST(LongBeam, TakesAsManyStepsAsAShortOne) {
  const RunResult few = simulate(shot(40, IntegratorType::generalized_alpha)),
                  many = simulate(shot(40000, IntegratorType::generalized_alpha));
  ASSERT_EQ(many.status, RunStatus::completed) << many.failure;
  EXPECT_EQ(many.events.size(), few.events.size());
  EXPECT_LE(many.solver.newton.iterations, few.solver.newton.iterations + few.solver.newton.iterations / 2);
  EXPECT_LE(many.solver.newton.tangents, few.solver.newton.tangents + few.solver.newton.tangents / 2);
}

/// A feed draws in, and merges, until the beam is short enough for its whole shape: the beam before the event decides.
TEST(LongBeam, KeepsAsMuchBeforeAnEventAsBehindIt) {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = 202;
  scene.beam.curve.end = {0, -2, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 1e-6, .rhoA = 1e-4};
  scene.start.type = SupportType::pin;
  scene.start.feed = TimeSpec{.rate = -1, .ramp = 0.002};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 5e-4;
  scene.duration = scene.output.interval = 0.06;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  std::size_t whole = 0, parts = 0;
  for (const Event& event : result.events) {
    const auto before = static_cast<std::ptrdiff_t>(event.before.x.size()),
               after = static_cast<std::ptrdiff_t>(event.after.x.size());
    EXPECT_LE(std::abs(before - after), 1) << "at t = " << event.t;
    ++(before > 100 ? whole : parts);
  }
  EXPECT_GE(whole, 1U);
  EXPECT_GE(parts, 1U);
}

/// What an event changed is kept, not thousands of whole shapes.
TEST(LongBeam, KeepsOfEventsWhatTheyChanged) {
  const RunResult result = simulate(shot(4500, IntegratorType::generalized_alpha));
  ASSERT_FALSE(result.events.empty());
  for (const Event& event : result.events) {
    for (const Configuration* shape : {&event.before, &event.after}) {
      ASSERT_EQ(shape->x.size(), 18U);
      EXPECT_EQ(shape->weights.size(), 17U);
      EXPECT_LT(shape->x.front(), event.joint_position - 0.1);
      EXPECT_GT(shape->x.back(), event.joint_position + 0.1);
      EXPECT_EQ(shape->rates.v.size(), shape->r.size());
    }
  }
}

}  // namespace
}  // namespace vlbeam
