// Sections by sizes and by diameter: areas and stiffnesses against other ways to sum them, and beams made of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/section_data.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {
namespace {

/// Second moment of a rectangle about an axis at a distance from its middle.
double about(double width, double height, double distance) {
  return width * height * height * height / 12 + width * height * distance * distance;
}

TEST(SectionData, OfATubeIsACircleLessAnother) {
  const auto tube = *sizes_of({.type = Section::Type::tube, .radius = 0.05, .wall = 0.004});
  const auto outer = *sizes_of({.type = Section::Type::circle, .radius = 0.05});
  const auto inner = *sizes_of({.type = Section::Type::circle, .radius = 0.046});
  EXPECT_NEAR(tube.area, outer.area - inner.area, 1e-15);
  EXPECT_NEAR(tube.area * tube.i2_y, outer.area * outer.i2_y - inner.area * inner.i2_y, 1e-18);
  EXPECT_NEAR(tube.torsion, outer.torsion - inner.torsion, 1e-18);
  EXPECT_EQ(tube.half_z, 0.05);
}

TEST(SectionData, OfABoxAndAProfileAreSumsOfTheirPlates) {
  const double w = 0.15, h = 0.3, t = 0.01, web = 0.007;
  const auto box = *sizes_of({.type = Section::Type::box, .width = w, .height = h, .wall = t});
  EXPECT_NEAR(box.area, 2 * w * t + 2 * (h - 2 * t) * t, 1e-15);
  EXPECT_NEAR(box.area * box.i2_y, 2 * about(w, t, (h - t) / 2) + 2 * about(t, h - 2 * t, 0), 1e-15);
  EXPECT_NEAR(box.area * box.i2_z, 2 * about(h, t, (w - t) / 2) + 2 * about(t, w - 2 * t, 0), 1e-15);
  const double enclosed = (w - t) * (h - t), around = 2 * (w + h - 2 * t);
  EXPECT_NEAR(box.torsion, 4 * enclosed * enclosed * t / around, 1e-15);
  const auto profile = *sizes_of({.type = Section::Type::profile, .width = w, .height = h, .web = web, .flange = t});
  EXPECT_NEAR(profile.area, 2 * w * t + (h - 2 * t) * web, 1e-15);
  EXPECT_NEAR(profile.area * profile.i2_y, 2 * about(w, t, (h - t) / 2) + about(web, h - 2 * t, 0), 1e-15);
  EXPECT_NEAR(profile.area * profile.i2_z, 2 * about(t, w, 0) + about(h - 2 * t, web, 0), 1e-15);
}

TEST(SectionData, OfRopesAndChainsGoWithTheSquareOfTheDiameter) {
  BeamSpec rope;
  rope.section = {.type = Section::Type::rope, .diameter = 0.02};
  const BeamSection wire = build_section(rope);
  EXPECT_NEAR(wire.stiffness.EA, 4.04e10 * 4e-4, 1);
  EXPECT_NEAR(wire.rhoA, 3.9897e3 * 4e-4, 1e-9);
  EXPECT_EQ(wire.stiffness.EI, 0);
  rope.section.diameter = 0.04;
  EXPECT_NEAR(build_section(rope).rhoA, 4 * wire.rhoA, 1e-12);
  const Section chain{.type = Section::Type::chain, .diameter = 0.1};
  EXPECT_NEAR(displaced_area(chain) * 7850, with_stiffness(chain).rhoA, 1e-9) << "it displaces its steel";
}

TEST(SectionData, AMaterialByItsNameIsItsNumbers) {
  BeamSpec by_name, by_numbers;
  by_name.section = by_numbers.section = {.type = Section::Type::tube, .radius = 0.05, .wall = 0.004};
  by_name.material.name = MaterialName::steel;
  by_numbers.material.density = 7850;
  by_numbers.material.youngs_modulus = 2.1e11;
  by_numbers.material.poisson_ratio = 0.3;
  const FrameSection a = build_frames(by_name), b = build_frames(by_numbers);
  EXPECT_EQ(build_section(by_name).rhoA, build_section(by_numbers).rhoA);
  EXPECT_EQ(a.EI_y, b.EI_y);
  EXPECT_EQ(a.GIp, b.GIp);
  EXPECT_EQ(a.rhoIp, b.rhoIp);
  EXPECT_EQ(build_section(with_mass(by_name, 2)).rhoA, 2 * build_section(by_numbers).rhoA);
}

TEST(SectionData, ACantileverOfAProfileBendsAndIsStressedByTheFormula) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {0, 0, 0};
  scene.beam.curve.end = {3, 0, 0};
  scene.beam.section = {.type = Section::Type::profile, .width = 0.15, .height = 0.3, .web = 0.007, .flange = 0.01};
  scene.beam.material.name = MaterialName::steel;
  scene.beam.elements = 8;
  scene.start = {.type = SupportType::clamp, .clamp = ClampType::full};
  LoadSpec load;
  load.node = 8;
  load.magnitude.value = 1000;
  load.direction = {0, -1, 0};
  scene.loads.push_back(load);
  const Sample sample = simulate(scene).samples.back();
  const double I = 2 * about(0.15, 0.01, 0.145) + about(0.007, 0.28, 0);
  const double way = 1000 * 27 / (3 * 2.1e11 * I), stress = 1000 * 3 * 0.15 / I;
  EXPECT_NEAR(sample.end[1], -way, 1e-4 * way);
  EXPECT_NEAR(sample.sections->stress->largest, stress, 1e-3 * stress);
}

TEST(SectionData, WallsLeaveSomethingHollow) {
  const auto refused = [](const Section& section) {
    Scene scene;
    scene.beam.section = section;
    try {
      simulate(scene, [](double) { return false; });
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string("nothing");
  };
  using enum Section::Type;
  EXPECT_EQ(refused({.type = tube, .radius = 0.1, .wall = 0.1}), "/beam/section/wall");
  EXPECT_EQ(refused({.type = box, .width = 0.1, .height = 0.2, .wall = 0.05}), "/beam/section/wall");
  EXPECT_EQ(refused({.type = profile, .width = 0.1, .height = 0.2, .web = 0.01, .flange = 0.1}),
            "/beam/section/flange");
  EXPECT_EQ(refused({.type = profile, .width = 0.1, .height = 0.2, .web = 0.1, .flange = 0.01}), "/beam/section/web");
  EXPECT_EQ(refused({.type = rope}), "/beam/section/diameter");
}

}  // namespace
}  // namespace vlbeam
