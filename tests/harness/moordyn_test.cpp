// Scenes made of mooring files: what stands in them, and what they hang like.
#include "io/moordyn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {
namespace {

/// The mooring line of the OC3 spar as MoorDyn's first version has it; lengths and places are printed in its design.
const char* const one_line = R"(One line
---------------------- LINE DICTIONARY ----------------------
LineType Diam MassDenInAir EA BA/-zeta Can Cat Cdn Cdt
(-) (m) (kg/m) (N) (Pa-s/-) (-) (-) (-) (-)
main 0.09 77.7066 384.243E6 -0.8 1 0 1.6 0.05
---------------------- NODE PROPERTIES ----------------------
Node Type X Y Z M V FX FY FZ CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (kN) (kN) (kN) (m^2) (-)
1 Fixed 426.935 739.47 -320 0 0 0 0 0 0 0
2 Vessel 2.6 4.5033 -70 0 0 0 0 0 0 0
---------------------- LINE PROPERTIES ----------------------
Line LineType UnstrLen NumSegs NodeAnch NodeFair Flags/Outputs
(-) (-) (m) (-) (-) (-) (-)
1 main 902.2 20 1 2 p
---------------------- SOLVER OPTIONS -----------------------
3.0e6 kBot
3.0e5 cBot
1025 rhoW
320 WtrDpth
9.81 g
)";

const char* const bridle = R"(A bridle
---------------------- LINE TYPES ---------------------------
Name Diam MassDen EA BA/-zeta EI Cd Ca CdAx CaAx
(-) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain 0.09 77.7 384e6 1e4 0 1.6 1 0.05 0
rope 0.12 12 20e6 -0.8 0 1.6 1 0.05 0
---------------------- POINTS -------------------------------
ID Attachment X Y Z M V CdA CA
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 500 0 -100 0 0 0 0
2 Free 100 0 -20 0 0 0 0
3 Coupled 20 15 0 0 0 0 0
4 Coupled 20 -15 0 0 0 0 0
5 Free 300 0 -60 2000 0.5 0 0
---------------------- LINES --------------------------------
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (-) (#) (#) (m) (-) (-)
1 chain 1 5 210 20 p
2 chain 5 2 205 20 p
3 rope 2 3 90 20 p
4 rope 2 4 90 20 p
---------------------- OPTIONS ------------------------------
9.81 g
0 WtrDpth
)";

std::string with(std::string text, const std::string& before, const std::string& after) {
  return text.replace(text.find(before), before.size(), after);
}

TEST(MoorDyn, ALineIsDrawnWithItsLengthOverTheSeabed) {
  const ImportedScene imported = scene_of_moordyn(one_line);
  const Scene scene = scene_from_json(imported.scene);
  EXPECT_EQ(scene.dimension, 2);
  EXPECT_NEAR(beam_length(scene), 902.2, 1e-9);
  for (const Point& corner : scene.beam.curve.points) EXPECT_GE(corner[1], -320 - 1e-9);
  EXPECT_EQ(scene.beam.section.EA, 384.243e6);
  EXPECT_NEAR(scene.ground->stiffness, 3e6 * 0.09, 1e-6);
  EXPECT_NEAR(scene.beam.material.damping, 0.8 * 902.2 / 20 * std::sqrt(77.7066 / 384.243e6), 1e-12);
  EXPECT_FALSE(imported.left_out.empty());
}

/// Catenary over a floor without friction (Jonkman 2007): H and V at the fairlead of one elastic line.
std::array<double, 2> pulls(double across, double up, double length, double EA, double weight) {
  double H = 8e5, V = 6e5;
  const auto off = [&](double h, double v) {
    const double lying = length - v / weight, s = v / h;
    return std::array{lying + h / weight * std::asinh(s) + h * length / EA - across,
                      h / weight * (std::sqrt(1 + s * s) - 1) + v * v / (2 * EA * weight) - up};
  };
  for (int i = 0; i < 60; ++i) {
    const auto at = off(H, V), of_H = off(H * (1 + 1e-6), V), of_V = off(H, V * (1 + 1e-6));
    const double a = (of_H[0] - at[0]) / (1e-6 * H), b = (of_V[0] - at[0]) / (1e-6 * V),
                 c = (of_H[1] - at[1]) / (1e-6 * H), d = (of_V[1] - at[1]) / (1e-6 * V), det = a * d - b * c;
    H -= (d * at[0] - b * at[1]) / det;
    V -= (a * at[1] - c * at[0]) / det;
  }
  return {H, V};
}

TEST(MoorDyn, ALineHangsAsItsCatenary) {
  const Scene scene = scene_from_json(scene_of_moordyn(with(one_line, " 20 1 2", " 60 1 2")).scene);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const double across = std::hypot(426.935 - 2.6, 739.47 - 4.5033);
  const double weight = 9.81 * (77.7066 - 1025 * std::numbers::pi / 4 * 0.09 * 0.09);
  const auto [H, V] = pulls(across, 250, 902.2, 384.243e6, weight);
  const double tension = find_quantity(scene, "places.B.axial_force").of(result.samples.back());
  EXPECT_NEAR(tension, std::hypot(H, V), 1e-3 * std::hypot(H, V));
}

TEST(MoorDyn, ATautLineIsStretchedByItsSupport) {
  const Scene scene = scene_from_json(scene_of_moordyn(with(one_line, "902.2", "850")).scene);
  EXPECT_NEAR(beam_length(scene), 850, 1e-9);
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  const double chord = std::hypot(426.935 - 2.6, 739.47 - 4.5033, 250);
  const double tension = find_quantity(scene, "places.B.axial_force").of(result.samples.back());
  // mean tension of a taut line; its weight tilts it by 215 kN from one end to the other
  EXPECT_NEAR(tension, 384.243e6 * (chord / 850 - 1) + 0.5 * 250 * 9.81 * 71.2, 0.02 * tension);
}

TEST(MoorDyn, LinesMeetInBodiesAndPins) {
  const Json json = scene_of_moordyn(bridle).scene;
  const Scene scene = scene_from_json(json);
  EXPECT_EQ(scene.dimension, 3);
  EXPECT_EQ(json.at("beams").size(), 4U);
  EXPECT_EQ(json.at("bodies").size(), 1U);
  EXPECT_EQ(json.at("links").size(), 4U);  // two of the body, two of three ends
  const RunResult result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  // what holds the lines carries their weight in water, and that of the body
  const double chain = 415 * (77.7 - 1025 * std::numbers::pi / 4 * 0.0081),
               ropes = 180 * (12 - 1025 * std::numbers::pi / 4 * 0.0144), body = 2000 - 1025 * 0.5;
  double held = 0;
  for (const char* const support : {"line 1.reactions.start", "line 3.reactions.end", "line 4.reactions.end"}) {
    held += find_quantity(scene, support + std::string(".position.z")).of(result.samples.back());
  }
  EXPECT_NEAR(held, 9.81 * (chain + ropes + body), 1e-3 * held);
}

TEST(MoorDyn, WhatIsNotUnderstoodIsNamed) {
  const auto says = [](const std::string& text, const std::string& word) {
    try {
      scene_of_moordyn(text);
    } catch (const InvalidInput& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(says("nothing", "LINE TYPES"));
  EXPECT_TRUE(
      says(std::string(one_line).substr(0, std::string(one_line).find("1 Fixed")) + "--- LINES\nID\n(-)\n1 main\n",
           "no point"));
  EXPECT_TRUE(says(with(one_line, "902.2", "-1"), "> 0"));
  EXPECT_TRUE(says(with(one_line, "902.2 20", "902.2 0"), "> 0"));
  EXPECT_TRUE(says(with(one_line, "2.6 4.5033 -70", "426.935 739.47 -320"), "apart"));
  EXPECT_TRUE(says(with(one_line, "1 main 902.2", "1 mian 902.2"), "the nearest is \"main\""));
  EXPECT_TRUE(says(with(one_line, " 1 2 p", " 1 3 p"), "\"3\""));
  EXPECT_TRUE(says(with(one_line, "384.243E6", "curve.txt"), "curve.txt"));
  EXPECT_TRUE(says(with(one_line, "2 Vessel", "2 Turret"), "Fixed, Coupled"));
  EXPECT_TRUE(says(with(bridle, "---------------------- POINTS",
                        "---------------------- BODIES ---\nID\n(-)\n1 Free\n"
                        "---------------------- POINTS"),
                   "a body"));
}

}  // namespace
}  // namespace vlbeam
