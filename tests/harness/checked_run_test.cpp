// What companions tell of a run's error, where the error is known.
#include "tools/checked_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/scene_json.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/simulate.hpp"
#include "tests/folders.hpp"
#include "tools/scene_library.hpp"

namespace vlbeam {
namespace {

Scene library_scene_to_check(const std::string& name) {
  return read_scene(test::source_folder() / "scenes" / (name + ".json"));
}

RunResult checked(const Scene& scene, int jobs = 1) { return checked_run(scene, {}, {}, jobs); }

bool warns_of(const RunResult& result, WarningKind kind) {
  return std::ranges::any_of(result.warnings, [kind](const Warning& warning) { return warning.kind == kind; });
}

/// What the places of three runs are off from each other, with errors c h^p.
struct ThreeRuns {
  double error, distance, next;
};
ThreeRuns three_runs(double p, double ratio, double next_ratio) {
  const double second = std::pow(ratio, p), third = std::pow(ratio * next_ratio, p);
  return {1e-6, 1e-6 * (second - 1), 1e-6 * (third - second)};
}

TEST(ErrorOrders, IsTheErrorWhereTheOrderIsWithinItsBounds) {
  for (const double p : {0.5, 1.0, 1.7, 2.0}) {
    for (const double ratio : {1.5, 2.0}) {
      const ThreeRuns runs = three_runs(p, ratio, 2);
      const ToldError told = ErrorOrders(ratio, 2, {0.5, 2}).told(runs.distance, runs.next);
      EXPECT_NEAR(told.error, runs.error, 1e-6 * runs.error) << p;
      EXPECT_NEAR(told.order, p, 1e-6);
    }
  }
}

TEST(ErrorOrders, TrustsNoOrderBeyondTheBest) {
  const ThreeRuns runs = three_runs(4, 2, 2);
  EXPECT_NEAR(ErrorOrders(2, 2, {0.5, 2}).told(runs.distance, runs.next).error, 5 * runs.error, 1e-6 * runs.error);
}

TEST(ErrorOrders, ExceedsTheDistanceWhereRunsDoNotApproachEachOther) {
  EXPECT_GT(ErrorOrders(2, 2, {0.5, 2}).told(1, 0.5).error, 2);
}

TEST(ErrorOrders, SaysWhetherRunsApproachEachOther) {
  for (const double p : {0.6, 1.0, 2.0}) {
    for (const double ratio : {2.0, 4.0}) {
      const ThreeRuns runs = three_runs(p, ratio, 2);
      EXPECT_TRUE(ErrorOrders(ratio, 2, {1, 2}).told(runs.distance, runs.next).falls) << p;
    }
  }
  const ThreeRuns hardly = three_runs(0.4, 2, 2);
  EXPECT_FALSE(ErrorOrders(2, 2, {1, 2}).told(hardly.distance, hardly.next).falls);
  EXPECT_FALSE(ErrorOrders(2, 2, {1, 2}).told(1, 1).falls);
}

TEST(ErrorOrders, OfTwoRunsIsTheirDistanceWhereStepsAreDoubled) {
  EXPECT_EQ(ErrorOrders(2, 1, {1, 2}).told(3, -1).error, 3);
}

// The judge: the same scene with a thousandth of the tolerance, and on four times the elements.
TEST(CheckedRun, TellsTheErrorsOfAFallingBeam) {
  Scene scene = library_scene_to_check("falling_beam_ramped");
  scene.beam.elements = 12;
  const RunResult run = checked(scene);
  ASSERT_TRUE(run.error);
  ASSERT_TRUE(run.error->time && run.error->mesh);
  Scene fine = scene;
  fine.integrator.automatic = false;
  fine.integrator.step /= 10;
  fine.integrator.atol_by_kind->length *= 1e-3;
  fine.integrator.atol_by_kind->velocity *= 1e-3;
  const auto away = [](const RunResult& a, const RunResult& b) {
    double largest = 0;
    for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
      if (!a.samples[i].joint_position || !b.samples[i].joint_position) break;
      largest =
          std::max({largest, std::abs(*a.samples[i].joint_position - *b.samples[i].joint_position),
                    std::hypot(a.samples[i].end[0] - b.samples[i].end[0], a.samples[i].end[1] - b.samples[i].end[1])});
    }
    return largest;
  };
  const RunResult in_time = simulate(fine);
  const double time = away(run, in_time);
  EXPECT_GE(*run.error->time, time / 1.5);
  EXPECT_LE(*run.error->time, std::max(20 * time, 1e-6));
  EXPECT_LE(time, run.error->allowed);
  fine.beam.elements *= 4;
  const double mesh = away(in_time, simulate(fine));
  EXPECT_GE(*run.error->mesh, mesh / 1.5);
}

TEST(CheckedRun, HasTheDigitsOfTheRunAloneWhateverTheJobs) {
  Scene scene = library_scene_to_check("falling_beam_ramped");
  scene.output.configurations = {scene.duration / 2};
  const RunResult alone = simulate(scene), one = checked(scene, 1), two = checked(scene, 2);
  ASSERT_TRUE(one.error && two.error);
  ASSERT_EQ(one.error->repeats, 0);
  EXPECT_EQ(one.samples.back().end, alone.samples.back().end);
  EXPECT_EQ(one.solver.steps, alone.solver.steps);
  ASSERT_EQ(one.configurations.size(), 1U);
  EXPECT_EQ(one.configurations.front().r, alone.configurations.front().r);
  EXPECT_EQ(one.error->time, two.error->time);
  EXPECT_EQ(one.error->mesh, two.error->mesh);
}

TEST(CheckedRun, MeasuresTheMeshByNoMotionOfRounding) {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  scene.beam.curve = {.type = CurveType::polyline, .points = {{0, 0, 0}, {0.5, -0.3, 0}, {1, 0, 0}}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e4, .EI = 0, .rhoA = 0.1};
  scene.beam.elements = 8;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.initial_shape = InitialShape::equilibrium;
  scene.duration = 0.5;
  scene.output.interval = 0.1;
  scene.integrator = automatic_integrator(scene);
  const RunResult result = checked(scene);
  ASSERT_TRUE(result.error && result.error->mesh) << result.failure;
  EXPECT_LT(result.error->motion, 1e-10);
  EXPECT_GT(*result.error->mesh, 1e-10) << "which is what the elements make of a rope at rest";
  EXPECT_EQ(result.error->elements_wanted, 0);
  EXPECT_EQ(std::ranges::count(result.warnings, WarningKind::error_of_mesh, &Warning::kind), 0);
}

// A load hangs askew on a light rope that is drawn unstrained: the jolt sets its stretch swinging, and that shakes the
// rope to and fro like a string whose tension is wound up and down. Runs with shorter steps shake as much, but
// otherwise.
TEST(CheckedRun, DoesNotRepeatWhatShorterStepsDoNotTell) {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  scene.beam.curve.end = {0.8, -7.9599, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 8e5, .EI = 0, .rhoA = 0.02};
  scene.beam.elements = 8;
  scene.point_masses = {{8, 60}};
  scene.start.type = SupportType::pin;
  scene.duration = 6;
  scene.output.interval = 0.1;
  scene.integrator = automatic_integrator(scene);
  const RunResult result = checked(scene);
  ASSERT_TRUE(result.error && result.error->time) << result.failure;
  EXPECT_GT(*result.error->time, 5 * result.error->allowed);
  EXPECT_EQ(result.error->repeats, 0);
  const auto told = std::ranges::find(result.warnings, WarningKind::error_in_time, &Warning::kind);
  ASSERT_NE(told, result.warnings.end());
  EXPECT_NE(told->message.find("shorter steps change as much"), std::string::npos) << told->message;
  EXPECT_NE(told->message.find("along the beam ("), std::string::npos) << told->message;
}

// A bucket falls into a well, and the drum pays out seven metres of a rope of one: the accuracy is of the longest.
TEST(CheckedRun, MeasuresAFedBeamByItsLargestLength) {
  Scene scene;
  scene.beam.curve.end = {0, -1, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = 0.5};
  scene.beam.elements = 10;
  scene.point_masses = {{10, 15}};
  scene.start.type = SupportType::pin;
  scene.start.drum = DrumSpec{.radius = 0.25, .inertia = 1.84375, .torque = {}};
  scene.duration = 2;
  scene.output.interval = 0.5;
  scene.integrator = automatic_integrator(scene);
  const RunResult result = checked(scene);
  ASSERT_TRUE(result.error) << result.failure;
  EXPECT_NEAR(result.error->allowed, scene.integrator.accuracy * 8, 0.01 * scene.integrator.accuracy * 8);
}

TEST(CheckedRun, CompanionsStepAsTheRunDoes) {
  // steps of an automatic run follow turns: companions that did not do so told a sixth of the error of this rod, rod
  // pendulum 12 of reference/trust.json
  Scene scene;
  scene.beam.curve.end = {6.707497783, -4.837599972, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 2.34e12, .EI = 1.91e10, .rhoA = 3.45};
  scene.beam.elements = 12;
  scene.start.type = SupportType::pin;
  scene.initial_velocity = InitialVelocitySpec{.rotation = -0.686};
  scene.duration = 5.04;
  scene.output.interval = 0.252;
  scene.integrator = automatic_integrator(scene);
  const RunResult run = checked(scene);
  ASSERT_TRUE(run.error && run.error->time) << run.failure;
  Scene fine = scene;
  fine.integrator = automatic_integrator(scene, 1e-6);
  const RunResult truth = simulate(fine);
  double error = 0;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const Point &a = run.samples[i].end, &b = truth.samples[i].end;
    error = std::max(error, std::hypot(a[0] - b[0], a[1] - b[1]));
  }
  EXPECT_GT(*run.error->time, error / 3);
  EXPECT_LT(*run.error->time, 3 * error);
  EXPECT_EQ(run.error->repeats, 0);
  EXPECT_LT(*run.error->mesh, error) << "of a rigid rod, unless a mesh is run with steps of its own";
}

// Six elements for a stiff wire of many bends.
TEST(CheckedRun, WarnsOfACoarseMesh) {
  Scene scene = library_scene_to_check("bead_on_wire");
  scene.beam.elements = 6;
  const RunResult run = checked(scene);
  ASSERT_TRUE(run.error);
  EXPECT_TRUE(warns_of(run, WarningKind::error_of_mesh));
  EXPECT_GT(run.error->elements_wanted, scene.beam.elements);
}

// A rope that is drawn as a V hangs in nearly one shape under a tenth of its weight and under all of it. What it moves
// by is the way from the drawing: an error of the mesh is not to be held against less.
TEST(CheckedRun, AHangingRopeMovesFromWhereItIsDrawn) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.beam.curve.type = CurveType::polyline;
  scene.beam.curve.points = {{0, 0, 0}, {65, -0.84, 0}, {89.9, 59.2, 0}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 7.51e8, .EI = 0, .rhoA = 89.8};
  scene.beam.elements = 20;
  scene.start.type = scene.end.type = SupportType::pin;
  const RunResult run = checked(scene);
  ASSERT_TRUE(run.error && run.error->mesh);
  EXPECT_GT(run.error->motion, 5);
  EXPECT_FALSE(warns_of(run, WarningKind::error_of_mesh)) << *run.error->mesh;
}

TEST(CheckedRun, TellsTheErrorOfFrequencies) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.curve.end = {20, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 4e11, .EI = 6e8, .rhoA = 250};
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.statics.frequencies = 3;
  const RunResult run = checked(scene);
  ASSERT_EQ(run.frequencies.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = static_cast<double>(k) + 1, exact = n * n * std::numbers::pi / 2 * std::sqrt(6e8 / 250) / 400;
    const auto told =
        std::ranges::find(run.error->quantities, "frequencies." + std::to_string(k), &QuantityError::quantity);
    ASSERT_TRUE(told != run.error->quantities.end() && told->mesh);
    EXPECT_GE(1.5 * *told->mesh, std::abs(run.frequencies[k] - exact)) << k;
    EXPECT_LE(*told->mesh, 20 * std::abs(run.frequencies[k] - exact)) << k;
  }
}

Scene girder(double gravity_ramp) {
  Scene scene;
  scene.beam.curve.end = {20, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 4e9, .EI = 6e8, .rhoA = 250};
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.gravity_ramp = gravity_ramp;
  scene.duration = 1;
  scene.output.interval = 0.01;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 0.002;
  return scene;
}

TEST(SuddenGravity, IsNamedWhereItMakesAGirderVibrate) {
  EXPECT_TRUE(warns_of(checked(girder(0)), WarningKind::sudden_gravity));
  EXPECT_FALSE(warns_of(checked(girder(0.5)), WarningKind::sudden_gravity));
}

TEST(SuddenGravity, IsNamedInAnAssembly) {
  Json scene = Json::parse(R"({
    "beams": [{"name": "girder", "elements": 8, "curve": {"type": "line", "start": [0, 0], "end": [20, 0]},
               "section": {"type": "stiffness", "EA": 4e9, "EI": 6e8, "rhoA": 250},
               "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "slide"}]}],
    "bodies": [{"name": "load", "mass": 500, "position": [10, 0]}],
    "links": [{"name": "hook", "type": "pin", "between": [{"beam": "girder", "at": {"node": 4}}, {"body": "load"}]}],
    "integrator": {"type": "generalized-alpha", "step": 0.002}, "duration": 1, "output": {"interval": 0.01}})");
  EXPECT_TRUE(warns_of(checked(scene_from_json(scene)), WarningKind::sudden_gravity));
  scene["gravity_ramp"] = 0.5;
  EXPECT_FALSE(warns_of(checked(scene_from_json(scene)), WarningKind::sudden_gravity));
}

TEST(SuddenGravity, IsAMotionWhereABeamFalls) {
  EXPECT_FALSE(warns_of(checked(library_scene_to_check("falling_beam")), WarningKind::sudden_gravity));
}

TEST(CheckedRun, OfAnEquilibriumTellsTheMesh) {
  const RunResult run = checked(library_scene_to_check("mooring_line"));
  ASSERT_TRUE(run.error);
  EXPECT_TRUE(run.error->mesh);
  EXPECT_FALSE(run.error->time);
}

}  // namespace
}  // namespace vlbeam
