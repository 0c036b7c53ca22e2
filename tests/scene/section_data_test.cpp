// Sections by sizes and by diameter: areas and stiffnesses against other ways to sum them, and beams made of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/names.hpp"
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

struct Tabulated {
  const char* name;
  double area, i_y;  // [cm^2], [cm^4]
};

/// Areas and second moments as tables of manufacturers print them, to four digits.
TEST(SectionData, StandardProfilesHaveTheirPrintedValues) {
  const std::vector<Tabulated> printed{
      {"IPE 80", 7.64, 80.14},    {"IPE 100", 10.32, 171},    {"IPE 120", 13.21, 317.8},  {"IPE 140", 16.43, 541.2},
      {"IPE 160", 20.09, 869.3},  {"IPE 180", 23.95, 1317},   {"IPE 200", 28.48, 1943},   {"IPE 220", 33.37, 2772},
      {"IPE 240", 39.12, 3892},   {"IPE 270", 45.95, 5790},   {"IPE 300", 53.81, 8356},   {"IPE 330", 62.61, 11770},
      {"IPE 360", 72.73, 16270},  {"IPE 400", 84.46, 23130},  {"IPE 450", 98.82, 33740},  {"IPE 500", 115.5, 48200},
      {"IPE 550", 134.4, 67120},  {"IPE 600", 156, 92080},    {"HEA 100", 21.24, 349.2},  {"HEA 120", 25.34, 606.2},
      {"HEA 140", 31.42, 1033},   {"HEA 160", 38.77, 1673},   {"HEA 180", 45.25, 2510},   {"HEA 200", 53.83, 3692},
      {"HEA 220", 64.34, 5410},   {"HEA 240", 76.84, 7763},   {"HEA 260", 86.82, 10450},  {"HEA 280", 97.26, 13670},
      {"HEA 300", 112.5, 18260},  {"HEA 320", 124.4, 22930},  {"HEA 340", 133.5, 27690},  {"HEA 360", 142.8, 33090},
      {"HEA 400", 159, 45070},    {"HEA 450", 178, 63720},    {"HEA 500", 197.5, 86970},  {"HEA 550", 211.8, 111900},
      {"HEA 600", 226.5, 141200}, {"HEB 100", 26.04, 449.5},  {"HEB 120", 34.01, 864.4},  {"HEB 140", 42.96, 1509},
      {"HEB 160", 54.25, 2492},   {"HEB 180", 65.25, 3831},   {"HEB 200", 78.08, 5696},   {"HEB 220", 91.04, 8091},
      {"HEB 240", 106, 11260},    {"HEB 260", 118.4, 14920},  {"HEB 280", 131.4, 19270},  {"HEB 300", 149.1, 25170},
      {"HEB 320", 161.3, 30820},  {"HEB 340", 170.9, 36660},  {"HEB 360", 180.6, 43190},  {"HEB 400", 197.8, 57680},
      {"HEB 450", 218, 79890},    {"HEB 500", 238.6, 107200}, {"HEB 550", 254.1, 136700}, {"HEB 600", 270, 171000},
  };
  ASSERT_EQ(printed.size(), standard_profiles.size());
  for (std::size_t i = 0; i < printed.size(); ++i) {
    SCOPED_TRACE(printed[i].name);
    const auto sizes = *sizes_of({.type = Section::Type::profile, .standard = static_cast<StandardProfile>(i)});
    EXPECT_EQ(to_string(static_cast<StandardProfile>(i)), printed[i].name);
    EXPECT_NEAR(sizes.area * 1e4, printed[i].area, 1e-3 * printed[i].area);
    EXPECT_NEAR(sizes.area * sizes.i2_y * 1e8, printed[i].i_y, 1e-3 * printed[i].i_y);
  }
  const auto of = [](const char* name) {
    for (std::size_t i = 0; i < standard_profiles.size(); ++i) {
      if (standard_profiles[i].name == name) {
        return *sizes_of({.type = Section::Type::profile, .standard = static_cast<StandardProfile>(i)});
      }
    }
    throw std::logic_error(name);
  };
  const SectionSizes ipe = of("IPE 300"), heb = of("HEB 300");
  EXPECT_NEAR(ipe.area * ipe.i2_z * 1e8, 603.8, 0.6);
  EXPECT_NEAR(heb.area * heb.i2_z * 1e8, 8563, 9);
  EXPECT_NEAR(ipe.torsion * 1e8, 20.12, 0.02);
  EXPECT_NEAR(heb.torsion * 1e8, 185.0, 0.2);
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
