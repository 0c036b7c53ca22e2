// Influence lines against those of a girder on two supports and over a middle one, in closed form.
#include "tools/influence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/json.hpp"
#include "io/scene_json.hpp"

namespace vlbeam {
namespace {

constexpr double L = 10;

Scene girder(const std::string& more = "") {
  return scene_from_json(Json::parse(R"({"analysis": "statics", "gravity": [0, -9.81],
    "beam": {"curve": {"type": "line", "end": [10, 0]}, "elements": 20,
             "section": {"type": "stiffness", "EA": 4e9, "EI": 1e8, "rhoA": 100}},
    "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "slide"})" +
                                     more + R"(],
    "places": [{"name": "mid", "x": 5}, {"name": "quarter", "x": 2.5}]})"));
}

TEST(Influence, OfAGirderOnTwoSupportsIsStraight) {
  const Influence found =
      influence(girder(), {.quantities = {"places.mid.bending_moment", "reactions.start.position.y"}, .jobs = 2});
  EXPECT_TRUE(found.failure.empty()) << found.failure;
  ASSERT_EQ(found.x.size(), 21U);
  const auto &moment = found.lines[0], &reaction = found.lines[1];
  EXPECT_EQ(moment.unit, "m");
  EXPECT_EQ(reaction.unit, "1");
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    const double x = found.x[i];
    EXPECT_NEAR(std::abs(moment.ordinates[i]), std::min(x, L - x) / 2, 1e-5) << x;
    EXPECT_NEAR(reaction.ordinates[i], 1 - x / L, 1e-6) << x;
  }
  EXPECT_NEAR(std::max(moment.largest, -moment.least), L / 4, 1e-5);
  EXPECT_NEAR(std::abs(moment.area), L * L / 8, 1e-4) << "q L^2/8";
  EXPECT_NEAR(reaction.at_largest, 0, 1e-12);
}

/// A node stands where a point mass is, and its neighbours are no longer evenly spaced.
TEST(Influence, KnowsWhereNodesStand) {
  Scene scene = girder();
  scene.point_masses.push_back({.mass = 10, .position = 3.3});
  const Influence found = influence(scene, {.quantities = {"reactions.start.position.y"}, .jobs = 2});
  EXPECT_NE(std::ranges::find_if(found.x, [](double x) { return std::abs(x - 3.3) < 1e-12; }), found.x.end());
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    EXPECT_NEAR(found.lines[0].ordinates[i], 1 - found.x[i] / L, 1e-6) << found.x[i];
  }
}

/// With the load at a in the first of two equal spans the middle support bears (3 s - s^3)/2, s = 2 a/L.
TEST(Influence, OfAMiddleSupportIsACubic) {
  const Scene scene = girder(R"(, {"at": {"x": 5}, "type": "roller", "name": "pier"})");
  const Influence found = influence(scene, {.quantities = {"supports.pier.force.y"}, .jobs = 2});
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    const double s = 2 * std::min(found.x[i], L - found.x[i]) / L;
    EXPECT_NEAR(found.lines[0].ordinates[i], (3 * s - s * s * s) / 2, 2e-5) << found.x[i];
  }
}

/// What one newton does at x of a cantilever to its end: x^2 (3 L - x)/(6 EI), whatever force finds it.
TEST(Influence, DoesNotDependOnTheForceThatFindsIt) {
  Scene scene = girder();
  scene.gravity = {};
  scene.start.type = SupportType::clamp;
  scene.end.type = SupportType::free;
  for (const double force : {1.0, 1e3}) {
    const Influence found = influence(scene, {.quantities = {"end.y"}, .force = force, .intervals = 2, .jobs = 2});
    ASSERT_EQ(found.x.size(), 41U);
    EXPECT_EQ(found.lines[0].unit, "m/N");
    for (std::size_t i = 0; i < found.x.size(); ++i) {
      const double x = found.x[i];
      EXPECT_NEAR(found.lines[0].ordinates[i], -x * x * (3 * L - x) / (6 * 1e8), 1e-4 * L * L * L / 3e8) << x;
    }
  }
}

TEST(Influence, RefusesWhatItDoesNotKnow) {
  Scene moving = girder();
  moving.analysis = Analysis::dynamics;
  EXPECT_THROW(influence(moving, {.quantities = {"end.y"}}), InvalidInput);
  EXPECT_THROW(influence(girder(), {.quantities = {"places.mid.bending_momentum"}}), InvalidInput);
  EXPECT_THROW(influence(girder(), {.quantities = {"end.y"}, .force = -1.0}), InvalidInput);
}

TEST(Influence, IsATable) {
  const Influence found = influence(girder(), {.quantities = {"reactions.start.position.y"}});
  const std::string table = influence_table(found);
  EXPECT_EQ(table.substr(0, table.find('\n')), "x [m],reactions.start.position.y [1]");
  EXPECT_NE(influence_summary(found).find("at most 1 at x = 0 m"), std::string::npos) << influence_summary(found);
}

}  // namespace
}  // namespace vlbeam
