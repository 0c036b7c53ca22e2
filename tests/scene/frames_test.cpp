// What a scene says of beams in space whose sections have frames, and what it may not say.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"

namespace vlbeam::test {
namespace {

Scene arc_in_space() {
  Scene scene;
  scene.dimension = 3;
  scene.beam.curve.type = CurveType::arc;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e4, .EI = 1, .rhoA = 1, .GIp = 0.8, .rhoIp = 1e-3};
  scene.start.type = SupportType::clamp;
  scene.integrator.type = IntegratorType::generalized_alpha;
  return scene;
}

TEST(SpaceLaw, IsThatOfTheScene) {
  Scene scene = arc_in_space();
  EXPECT_TRUE(has_frames(scene));
  scene.beam.out_of_plane = OutOfPlane::none;
  EXPECT_FALSE(has_frames(scene));
  scene.beam.out_of_plane.reset();
  scene.beam.curve.type = CurveType::line;
  EXPECT_FALSE(has_frames(scene));
  scene.beam.space_law = SpaceLaw::frames;
  EXPECT_TRUE(has_frames(scene));
  scene.beam.space_law.reset();
  scene.beam.section = {.type = Section::Type::rectangle, .width = 0.02, .height = 0.01};
  EXPECT_TRUE(has_frames(scene));
  scene.beam.section.width = 0.01;
  EXPECT_FALSE(has_frames(scene));
  scene.dimension = 2;
  EXPECT_FALSE(has_frames(scene));
}

TEST(SpaceLaw, KnowsWhatSolidSectionsResist) {
  BeamSpec beam;
  beam.material.youngs_modulus = 2.6;
  beam.material.poisson_ratio = 0.3;  // a shear modulus of 1
  beam.section = {.type = Section::Type::rectangle, .width = 3, .height = 0.5};
  FrameSection of = build_frames(beam);
  EXPECT_NEAR(of.EI_y, 2.6 * 3 * 0.125 / 12, 1e-15);
  EXPECT_NEAR(of.EI_z, 2.6 * 0.5 * 27 / 12, 1e-15);
  EXPECT_NEAR(of.GIp, 0.298 * 3 * 0.125, 2e-4);  // Timoshenko & Goodier, table of section 109: b/c = 6
  EXPECT_NEAR(of.rhoIp, 7200 * (3 * 0.125 + 0.5 * 27) / 12, 1e-10);
  beam.section.height = beam.section.width;
  EXPECT_NEAR(build_frames(beam).GIp / 81, 0.1406, 1e-4);
  beam.section = {.radius = 0.3};
  of = build_frames(beam);
  EXPECT_NEAR(of.GIp, std::numbers::pi * 0.0081 / 2, 1e-15);
  EXPECT_EQ(of.EI_y, build_section(beam).stiffness.EI);
}

struct Breach {
  const char* field;
  const char* says;
  std::function<void(Scene&)> make;
};

TEST(SpaceLaw, RefusesByName) {
  const auto line = [](Scene& s) {
    s.beam.curve.type = CurveType::line;
    s.beam.space_law = SpaceLaw::frames;
  };
  const std::vector<Breach> breaches{
      {"/beam/section/GIp", "out_of_plane", [](Scene& s) { s.beam.section.GIp = 0; }},
      {"/beam/section/rhoIp", "> 0", [](Scene& s) { s.beam.section.rhoIp = 0; }},
      {"/beam/section/EI_z", "EI_y", [](Scene& s) { s.beam.section.EI_y = 2; }},
      {"/beam/section/EI", "left out", [](Scene& s) { s.beam.section.EI_y = s.beam.section.EI_z = 2; }},
      {"/beam/section/orientation", "axis y",
       [](Scene& s) {
         s.beam.section.EI = 0;
         s.beam.section.EI_y = 2;
         s.beam.section.EI_z = 3;
       }},
      {"/beam/section/orientation", "across",
       [](Scene& s) {
         s.beam.section.orientation = {0, 1, 0};
       }},
      {"/beam/section/orientation", "frames",
       [](Scene& s) {
         s.beam.out_of_plane = OutOfPlane::none;
         s.beam.material.curvature_regularization = 1e-3;
         s.beam.section.orientation = {0, 0, 1};
       }},
      {"/beam/space_law", "frames",
       [](Scene& s) {
         s.beam.section.EI = 0;
         s.beam.section.EI_y = 2;
         s.beam.section.EI_z = 3;
         s.beam.curve.type = CurveType::line;
         s.beam.space_law = SpaceLaw::scalar;
       }},
      {"/beam/out_of_plane", "frames", [](Scene& s) { s.beam.space_law = SpaceLaw::scalar; }},
      {"/beam/out_of_plane", "leave one",
       [](Scene& s) {
         s.beam.space_law = SpaceLaw::frames;
         s.beam.out_of_plane = OutOfPlane::none;
       }},
      {"/beam/space_law", "planar",
       [&](Scene& s) {
         line(s);
         s.dimension = 2;
         s.gravity = {};
       }},
      {"/beam/space_law", "cable",
       [&](Scene& s) {
         line(s);
         s.beam.section.EI = 0;
       }},
      {"/sliding_mass/slopes", "continuous",
       [](Scene& s) {
         s.sliding_mass.emplace().position = 0.3;
         s.sliding_mass->slopes = JointSlopes::free;
       }},
      {"/weights", "frozen",
       [](Scene& s) {
         s.sliding_mass.emplace().position = 0.3;
         s.weights = WeightTransport::transported;
       }},
      {"/length_control/merge", "rest-arc",
       [](Scene& s) {
         s.sliding_mass.emplace().position = 0.3;
         s.length_control.merge = MergePolicy::relaxed;
       }},
      {"/length_control/cut", "exact",
       [](Scene& s) {
         s.sliding_mass.emplace().position = 0.3;
         s.length_control.cut = CutPolicy::relaxed;
       }},
      {"/formulation", "variational",
       [](Scene& s) {
         s.sliding_mass.emplace().position = 0.3;
         s.formulation = Formulation::virtual_work;
       }},
      {"/sliding_joints/0/pitch", "nut",
       [](Scene& s) {
         auto& joint = s.sliding_joints.emplace_back();
         joint.position = 0.3;
         joint.mass = 1;
         joint.pitch = 0.1;
       }},
      {"/flow", "travel", [](Scene& s) { s.flow.emplace(); }},
      {"/spin", "initial_velocity",
       [&](Scene& s) {
         line(s);
         s.spin.emplace();
       }},
      {"/loads/0/node", "ends",
       [](Scene& s) {
         s.sliding_mass.emplace().position = 0.3;
         s.loads = {{.type = LoadType::moment, .node = 2, .x = {}, .magnitude = {.value = 1}, .turn = {}}};
       }},
      {"/loads/0/at", "node",
       [](Scene& s) {
         s.loads = {{.type = LoadType::moment,
                     .at = LoadPlace::point,
                     .x = {.value = 0.3},
                     .magnitude = {.value = 1},
                     .turn = {}}};
       }},
      {"/integrator/type", "generalized-alpha", [](Scene& s) { s.integrator.type = IntegratorType::energy_momentum; }},
      {"/integrator/type", "generalized-alpha",
       [](Scene& s) {
         s.start.motion.emplace().angle = TimeSpec{.value = 1, .ramp = 1};
         s.integrator.type = IntegratorType::dopri5;
       }},
  };
  for (const Breach& breach : breaches) {
    Scene scene = arc_in_space();
    breach.make(scene);
    try {
      validate(scene);
      ADD_FAILURE() << breach.field << " " << breach.says;
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.field, breach.field) << error.what();
      EXPECT_NE(std::string(error.what()).find(breach.says), std::string::npos) << error.what();
    }
  }
  validate(arc_in_space());
}

TEST(SpaceLaw, AMotionStartsFromTheEquilibrium) {
  Scene scene = arc_in_space();
  scene.gravity = {0, 0, -0.5};
  scene.initial_shape = InitialShape::equilibrium;
  scene.beam.elements = 6;
  scene.integrator.step = 1e-2;
  scene.duration = 0.2;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const Point &first = result.samples.front().end, &last = result.samples.back().end;
  EXPECT_LT(first[2], -0.1);  // it hangs, and twists
  EXPECT_GT(result.samples.front().energy.torsion, 0.01);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(last[c], first[c], 1e-9);
}

/// An arc that a clamp at its start turns about its tangent there.
Scene turned_arc() {
  Scene scene = arc_in_space();
  scene.gravity = {};
  scene.beam.elements = 6;
  scene.beam.curve = {.type = CurveType::arc, .from_degrees = 0, .to_degrees = 60};
  scene.beam.section.EI = scene.beam.section.GIp = 100;
  scene.beam.section.rhoIp = 1e-2;
  scene.start.motion.emplace().angle = TimeSpec{.value = 3, .ramp = 1};
  scene.integrator.step = 2e-3;
  scene.duration = 1.1;
  return scene;
}

TEST(SpaceLaw, AClampThatTurnsKnowsHowFarThroughEvents) {
  Scene scene = turned_arc();
  const RunResult alone = simulate(scene);
  SlidingMassSpec& mass = scene.sliding_mass.emplace();
  mass.position = 0.5;
  mass.mass = 0.01;
  mass.velocity = 0.4;
  const RunResult result = simulate(scene);
  ASSERT_NE(result.status, RunStatus::failed) << result.failure;  // it may leave the beam
  EXPECT_GE(result.events.size(), 2U);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(result.samples.back().end[c], alone.samples.back().end[c], 1e-2);
}

TEST(SpaceLaw, MultipliersHoldWhatEliminationHolds) {
  Scene scene = turned_arc();
  const RunResult eliminated = simulate(scene);
  scene.constraints = Constraints::multipliers;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(result.samples.back().end[c], eliminated.samples.back().end[c], 1e-7);
}

/// A clamp that turns about the beam winds it up.
TEST(SpaceLaw, AClampTurnsAboutTheTangent) {
  Scene scene = arc_in_space();
  scene.gravity = {};
  scene.beam.curve.type = CurveType::line;
  scene.beam.space_law = SpaceLaw::frames;
  scene.beam.strain_law = StrainLaw::engineering;
  scene.beam.elements = 6;
  scene.end.type = SupportType::clamp;
  scene.end.motion.emplace().angle = TimeSpec{.value = 1.5, .ramp = 0.5};
  scene.analysis = Analysis::statics;
  EXPECT_NEAR(simulate(scene).samples.back().energy.torsion, 0.8 * 1.5 * 1.5 / 2, 1e-12);
  scene.analysis = Analysis::dynamics;
  scene.integrator.step = 1e-3;
  scene.duration = 0.6;
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_LE(result.max_energy_drift, 1e-3 * result.samples.back().energy.torsion);  // the clamp's work included
  EXPECT_GT(result.samples.back().energy.supplied, 0.8);
}

}  // namespace
}  // namespace vlbeam::test
