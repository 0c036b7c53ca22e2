#include "scene/plausibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/simulate.hpp"

namespace vlbeam::test {
namespace {

std::vector<WarningKind> kinds(const std::vector<Warning>& warnings) {
  std::vector<WarningKind> result;
  for (const Warning& warning : warnings) result.push_back(warning.kind);
  return result;
}

/// A steel bar of 1 m that hangs from a pin and is at rest.
Scene hanging_bar() {
  Scene scene;
  scene.beam.curve.end = {0, -1, 0};
  scene.beam.section.radius = 0.01;
  scene.beam.material = {.density = 7800, .youngs_modulus = 2e11};
  scene.beam.elements = 4;
  scene.start.type = SupportType::pin;
  return scene;
}

Sample with_force(double t, double least, double most) {
  Sample sample;
  sample.t = t;
  sample.strains.axial_force = {least, most};
  return sample;
}

TEST(Plausibility, IsQuietAboutAPlainScene) {
  RunResult run;
  run.samples = {with_force(0, 0, 20), with_force(1, -10, 20)};  // far from Euler's load of an element, 2.5e5 N
  EXPECT_TRUE(implausible(hanging_bar(), run).empty());
}

TEST(Plausibility, NamesUnitsThatMayBeWrong) {
  RunResult run;
  run.samples.resize(1);
  Scene scene = hanging_bar();
  scene.beam.section.radius = 10;  // mm
  EXPECT_EQ(kinds(implausible(scene, run)), std::vector{WarningKind::thick_elements});
  scene = hanging_bar();
  scene.assumed = "/beam/material/youngs_modulus";
  EXPECT_EQ(kinds(implausible(scene, run)), std::vector{WarningKind::assumed_material});
  scene = hanging_bar();
  scene.beam.material.density = 7.8;  // g/cm^3
  EXPECT_EQ(kinds(implausible(scene, run)), std::vector{WarningKind::light_material});
  run.samples.front().strains.axial_strain = {-0.2, 0.05};
  const auto warnings = implausible(hanging_bar(), run);  // youngs_modulus in MPa
  ASSERT_EQ(kinds(warnings), std::vector{WarningKind::large_strain});
  EXPECT_NE(warnings[0].message.find("20 %"), std::string::npos) << warnings[0].message;
  EXPECT_NE(warnings[0].remedy.find("youngs_modulus"), std::string::npos);
}

// A jerk strains a beam of the right stiffness, too: no unit is to blame.
TEST(Plausibility, BlamesNoUnitForAJerk) {
  RunResult run;
  run.samples.resize(10);
  run.samples[7].strains.axial_strain = {-0.05, 0.2};
  const auto warnings = implausible(hanging_bar(), run);
  ASSERT_EQ(kinds(warnings), std::vector{WarningKind::large_strain});
  EXPECT_EQ(warnings[0].remedy.find("youngs_modulus"), std::string::npos);
  EXPECT_NE(warnings[0].message.find("jerks"), std::string::npos) << warnings[0].message;
}

// A rope that is folded is shorter than it is long, and one of nylon stretches by a tenth in its daily work.
TEST(Plausibility, KnowsThatRopesFoldAndStretch) {
  Scene rope = hanging_bar();
  rope.beam.section = Section{};
  rope.beam.section.type = Section::Type::stiffness;
  rope.beam.section.EA = 1e4;
  rope.beam.section.rhoA = 0.2;
  RunResult run;
  run.samples.resize(1);
  run.samples.front().strains.axial_strain = {-0.9, 0.15};
  EXPECT_TRUE(implausible(rope, run).empty());
  rope.beam.section.EI = 10;  // a beam is neither
  EXPECT_EQ(kinds(implausible(rope, run)), std::vector{WarningKind::large_strain});
  rope.beam.section.EI = 0;
  run.samples.front().strains.axial_strain = {0, 0.4};
  EXPECT_EQ(kinds(implausible(rope, run)), std::vector{WarningKind::large_strain});
}

TEST(Plausibility, TellsSlackBeams) {
  RunResult run;
  run.samples = {with_force(0, 0, 20), with_force(1, -10, 20)};
  Scene scene = hanging_bar();
  scene.beam.section.radius = 5e-4;  // an element bears 1.6 N
  EXPECT_EQ(kinds(implausible(scene, run)), std::vector{WarningKind::buckled_elements});
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 0, .rhoA = 0.1};
  EXPECT_TRUE(implausible(scene, run).empty()) << "a rope may go slack";
  scene.beam.compression = Compression::full;
  EXPECT_EQ(kinds(implausible(scene, run)), std::vector{WarningKind::buckled_elements});
  run.samples.back().strains.axial_force = {-1e-3, 20};
  EXPECT_TRUE(implausible(scene, run).empty()) << "rounding and ringing of a taut rope";
}

TEST(Plausibility, TellsWhereRoundingHidesStability) {
  RunResult run;
  run.samples.resize(2);
  Scene scene = hanging_bar();
  scene.analysis = Analysis::statics;
  run.samples.front().equilibrium = StaticSample{.hidden_pivots = 3};  // before loads are there
  run.samples.back().equilibrium = StaticSample{.load_factor = 1};
  EXPECT_TRUE(implausible(scene, run).empty());
  run.samples.back().equilibrium->hidden_pivots = 1;
  EXPECT_EQ(kinds(implausible(scene, run)), std::vector{WarningKind::hidden_stability});
  run.samples.back().equilibrium->negative_pivots = 1;
  EXPECT_TRUE(implausible(scene, run).empty()) << "it is not stable, whatever the other does";
}

TEST(Plausibility, TellsFrictionByAVibration) {
  Scene scene = hanging_bar();
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->friction = AxialFriction{0.2, 0.01};
  const auto run = [](double swing) {
    RunResult result;
    for (int i = 0; i < 20; ++i) {
      Sample sample;
      sample.joint = JointSample{};
      sample.joint->normal = 1 + (i % 2 == 0 ? swing : -swing);
      result.samples.push_back(sample);
    }
    return result;
  };
  EXPECT_TRUE(implausible(scene, run(0.3)).empty());
  EXPECT_EQ(kinds(implausible(scene, run(0.9))), std::vector{WarningKind::ringing_friction});
  scene.beam.material.damping = 1e-4;  // too little
  EXPECT_EQ(kinds(implausible(scene, run(0.9))), std::vector{WarningKind::ringing_friction});
  // what each step says goes before samples
  RunResult seen = run(0.9);
  seen.pressures = {{1.05, 1, 3}};
  EXPECT_TRUE(implausible(scene, seen).empty());
  seen = run(0);
  seen.pressures = {{1.3, 1, 3}};
  EXPECT_EQ(kinds(implausible(scene, seen)), std::vector{WarningKind::ringing_friction});
}

TEST(Plausibility, IsAskedOfEveryRun) {
  Scene scene = hanging_bar();
  scene.beam.material.density = 1;
  scene.duration = 1e-3;
  scene.output.interval = 1e-3;
  const auto found = kinds(simulate(scene).warnings);
  EXPECT_NE(std::ranges::find(found, WarningKind::light_material), found.end());
}

}  // namespace
}  // namespace vlbeam::test
