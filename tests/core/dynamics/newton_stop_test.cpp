#include "mechanics/time/newton_stop.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/simulate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

Eigen::VectorXd entries(double position, double angle) { return Eigen::Vector2d(position, angle); }

NewtonStop two_fields() {
  NewtonStop stop;
  stop.set_fields({{Field::position, 0}, {Field::angle, 1}});
  stop.begin_step();
  return stop;
}

constexpr double slow = 0.2;

TEST(NewtonStop, JudgesTheErrorThatIsLeftNotTheCorrection) {
  using Verdict = NewtonStop::Verdict;
  NewtonStop stop = two_fields();
  EXPECT_EQ(stop.judge(entries(1e-13, 0), entries(1e-13, 0), 1e-8, slow), Verdict::go_on);  // small, and all there is
  EXPECT_EQ(stop.judge(entries(1e-15, 0), entries(1e-13, 0), 1e-8, slow), Verdict::go_on);
  EXPECT_EQ(stop.judge(entries(1e-17, 0), entries(1e-13, 0), 1.1e-6, slow), Verdict::done);  // 1e-4 times 1e-2
}

TEST(NewtonStop, CountsWithTheSlowestContractionOfItsTangent) {
  using Verdict = NewtonStop::Verdict;
  NewtonStop stop = two_fields();
  const auto judge = [&](double correction) { return stop.judge(entries(correction, 0), entries(1, 0), 2e-8, slow); };
  judge(1);
  judge(0.1);
  EXPECT_EQ(judge(1e-6), Verdict::go_on) << "1e-6 times 1/9, not times 1e-5";
  stop.new_tangent();
  EXPECT_EQ(judge(1.5e-7), Verdict::go_on);  // from another tangent's correction to its first: that is not its own
  EXPECT_EQ(judge(1e-8), Verdict::done);
  stop.begin_step();
  judge(1);
  judge(2);  // what has grown says nothing of what follows
  judge(1e-3);
  EXPECT_EQ(judge(1e-6), Verdict::done);
}

TEST(NewtonStop, MayExpectAContractionOfTheFirstCorrection) {
  using Verdict = NewtonStop::Verdict;
  for (const bool nearby : {true, false}) {
    NewtonStop stop = two_fields();
    stop.judge(entries(1, 0), entries(1, 0), 1e-9, slow);
    stop.judge(entries(1e-2, 0), entries(1, 0), 1e-9, slow);
    stop.judge(entries(1e-5, 0), entries(1, 0), 1e-9, slow);
    EXPECT_DOUBLE_EQ(stop.slowest(), 1e-2);
    stop.begin_step(nearby ? 1e-2 : 0);
    EXPECT_EQ(stop.judge(entries(1e-4, 0), entries(1, 0), 1.1e-6, slow), nearby ? Verdict::done : Verdict::go_on);
    EXPECT_EQ(stop.slowest(), nearby ? 1e-2 : 0);
  }
}

TEST(NewtonStop, ForeseesTheErrorAfterMoreIterations) {
  NewtonStop stop = two_fields();
  stop.judge(entries(1, 0), entries(1, 0), 1e-9, slow);
  stop.judge(entries(0.25, 0), entries(1, 0), 1e-9, slow);
  EXPECT_DOUBLE_EQ(stop.error_after(3), 0.25 / 64);
}

TEST(NewtonStop, GivesEachFieldItsOwnNorm) {
  NewtonStop stop = two_fields();
  stop.judge(entries(1, 1e-9), entries(1, 1e-9), 1e-8, slow);
  EXPECT_EQ(stop.judge(entries(1e-12, 1e-10), entries(1, 1e-9), 1e-8, slow), NewtonStop::Verdict::go_on);
  EXPECT_DOUBLE_EQ(stop.error(), 0.1);
  EXPECT_DOUBLE_EQ(stop.contraction(), 0.1);
}

TEST(NewtonStop, AMarkIsJudgedByWhatItDoesToPositions) {
  NewtonStop stop;
  stop.set_fields({{Field::position, 0}, {Field::mark, 1}});
  for (const double mark : {1e-17, 1e-2}) {  // it hardly moves, and it moves farther than the beam
    stop.begin_step();
    stop.judge(entries(1e-6, mark), entries(1e-6, mark), 1e-7, slow);
    const bool done = stop.judge(entries(1e-10, 2e-17), entries(1e-6, mark), 1e-7, slow) == NewtonStop::Verdict::done;
    EXPECT_TRUE(done) << mark;
    EXPECT_DOUBLE_EQ(stop.error(), 1e-4);
  }
}

TEST(NewtonStop, EndsAtMeasuredRounding) {
  NewtonStop stop = two_fields();
  stop.judge(entries(1e-3, 0), entries(1e-3, 0), 1e-14, slow);
  stop.judge(entries(1e-15, 0), entries(1e-3, 0), 1e-30, slow);
  EXPECT_EQ(stop.judge(entries(9e-16, 0), entries(1e-3, 0), 1e-14, slow), NewtonStop::Verdict::stagnates);
  stop.set_noise(entries(1e-16, 0), entries(1, 0));
  EXPECT_TRUE(stop.settle());
  stop.set_noise(entries(1e-20, 0), entries(1, 0));
  EXPECT_FALSE(stop.settle());
}

TEST(NewtonStop, TakesNoLargeCorrectionForRounding) {
  NewtonStop stop = two_fields();
  stop.judge(entries(10, 0), entries(10, 0), 1e-8, slow);
  EXPECT_EQ(stop.judge(entries(9, 0), entries(10, 0), 1e-8, slow), NewtonStop::Verdict::stagnates);
  EXPECT_FALSE(stop.negligible(entries(1, 0)));
  stop.set_noise(entries(100, 0), entries(1, 0));
  EXPECT_FALSE(stop.settle());
}

TEST(NewtonStop, OnlyCorrectionsAboveRoundingGrow) {
  NewtonStop stop = two_fields();
  stop.judge(entries(1, 1e-16), entries(1, 1e-16), 1e-8, slow);
  stop.judge(entries(0.1, 2e-16), entries(1, 1e-16), 1e-8, slow);
  EXPECT_FALSE(stop.grows(0.5, entries(1, 1)));
  stop.judge(entries(0.06, 2e-16), entries(1, 1e-16), 1e-8, slow);
  EXPECT_TRUE(stop.grows(0.5, entries(1, 1)));
  EXPECT_FALSE(stop.grows(1, entries(1, 1)));
}

TEST(NewtonStop, IsDoneAtRest) {
  NewtonStop stop = two_fields();
  EXPECT_EQ(stop.judge(entries(0, 0), entries(0, 0), 1e-8, slow), NewtonStop::Verdict::done);
}

Scene shaft(double duration, double step, NewtonKind newton) {
  Scene scene = shaft_under_turning_load(8);
  scene.duration = duration;
  scene.output.interval = duration;
  scene.output.configurations = {duration};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  scene.integrator.newton = newton;
  scene.integrator.newton_tolerance = 1e-8;
  return scene;
}

/// Largest difference of the deflections at the end over the largest deflection.
double difference(const RunResult& a, const RunResult& b) {
  double largest = 0, size = 0;
  for (std::size_t k = 0; k < a.configurations.back().r.size(); ++k) {
    for (std::size_t c = 0; c < 2; ++c) {
      const double there = b.configurations.back().r[k][c];
      largest = std::max(largest, std::abs(a.configurations.back().r[k][c] - there));
      size = std::max(size, std::abs(there));
    }
  }
  return largest / size;
}

TEST(ModifiedNewton, IsFullNewtonAtEveryStep) {
  const std::array<std::array<double, 2>, 4> runs{{{0.045, 1e-3}, {0.045, 1e-4}, {0.01, 1e-5}, {0.001, 1e-6}}};
  for (const auto& [duration, step] : runs) {
    const RunResult modified = simulate(shaft(duration, step, NewtonKind::modified));
    const RunResult full = simulate(shaft(duration, step, NewtonKind::full));
    ASSERT_EQ(modified.status, RunStatus::completed) << modified.failure;
    ASSERT_EQ(full.status, RunStatus::completed) << full.failure;
    EXPECT_EQ(modified.solver.steps, full.solver.steps) << step;
    EXPECT_LE(difference(modified, full), 1e-7) << step;
  }
}

/// Positions of all nodes at the end.
Eigen::VectorXd shape(Scene scene, double step, NewtonKind newton) {
  scene.integrator.step = step;
  scene.integrator.newton = newton;
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  const auto& r = result.configurations.back().r;
  Eigen::VectorXd all(3 * static_cast<Eigen::Index>(r.size()));
  for (std::size_t k = 0; k < r.size(); ++k) {
    all.segment<3>(3 * static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::Vector3d>(r[k].data());
  }
  return all;
}

/// A mass that slides along a soft beam, which gravity bends smoothly.
Scene sliding_mass() {
  Scene scene = test::by_greens_law();
  scene.beam.elements = 4;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.material.youngs_modulus = 2e5;
  scene.gravity = {0, -1, 0};
  scene.gravity_ramp = 0.1;
  scene.start.type = SupportType::clamp;
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->mass = 0.2;
  scene.sliding_mass->position = 0.3;
  scene.sliding_mass->velocity = 0.3;
  scene.duration = scene.output.interval = 0.2;
  scene.output.configurations = {0.2};
  scene.integrator.type = IntegratorType::generalized_alpha;
  return scene;
}

/// Errors against the limit of the other kind, extrapolated.
TEST(ModifiedNewton, AndFullNewtonHaveOneLimitOfOrderTwo) {
  Scene smooth = shaft(0.02, 1e-4, NewtonKind::full);
  smooth.loads.front().magnitude.ramp = 0.01;  // a blow would ring in modes that no such step resolves
  for (const auto& [scene, coarsest] : {std::pair{smooth, 1e-4}, {sliding_mass(), 2e-3}}) {
    for (const auto own : {NewtonKind::modified, NewtonKind::full}) {
      const auto other = own == NewtonKind::full ? NewtonKind::modified : NewtonKind::full;
      const Eigen::VectorXd limit = (4 * shape(scene, coarsest / 16, other) - shape(scene, coarsest / 8, other)) / 3;
      double last = 0;
      for (const double step : {coarsest, coarsest / 2, coarsest / 4}) {
        const double error = (shape(scene, step, own) - limit).lpNorm<Eigen::Infinity>();
        if (last > 0) {
          EXPECT_NEAR(std::log2(last / error), 2, 0.2) << step;
        }
        last = error;
      }
    }
  }
}

/// By default it leaves far less than what halving the step changes.
TEST(ModifiedNewton, LeavesASmallShareOfTheErrorOfTheStep) {
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    Scene scene = sliding_mass();
    const auto shape_with = [&](double tolerance, double of_step) {
      scene.integrator.newton_tolerance = tolerance;
      return shape(scene, of_step, NewtonKind::modified);
    };
    const Eigen::VectorXd strict = shape_with(1e-12, step);
    const double of_method = (strict - shape_with(1e-12, step / 2)).lpNorm<Eigen::Infinity>();
    EXPECT_LE((shape_with(0, step) - strict).lpNorm<Eigen::Infinity>(), 0.05 * of_method) << step;
  }
}

TEST(ModifiedNewton, StopsAtRoundingWhateverIsAskedFor) {
  Scene scene = shaft(0.002, 1e-5, NewtonKind::modified);
  scene.integrator.newton_tolerance = 1e-15;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_EQ(result.solver.rejected, 0u);
  EXPECT_LT(result.solver.newton.iterations, 12 * result.solver.steps);
}

TEST(ModifiedNewton, AJointThatHardlyMovesAsksForNoTangent) {
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    Scene scene = falling_beam(ElementKind::ale_ancf, 1000);
    scene.sliding_mass->position = 0.5 - 0.3e-3;
    scene.constraints = constraints;
    scene.duration = scene.output.interval = 5e-3;
    scene.integrator.type = IntegratorType::generalized_alpha;
    scene.integrator.step = 1e-3;
    const RunResult result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    EXPECT_LE(result.solver.newton.tangents, 3u);
    EXPECT_LE(result.solver.newton.iterations, 4 * result.solver.steps);
  }
}

TEST(ModifiedNewton, RestsWithFewIterations) {
  Scene scene = test::by_greens_law();
  scene.gravity = {};
  scene.start.type = SupportType::clamp;
  scene.integrator.type = IntegratorType::generalized_alpha;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_EQ(result.solver.rejected, 0u);
  EXPECT_LE(result.solver.newton.iterations, 3 * result.solver.steps);
}

}  // namespace
}  // namespace vlbeam::test
