// Points along the axis: what they say of shapes whose strains, forces and velocities are known.
#include "scene/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/scene_json.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {
namespace {

Scene bar() {
  return parse_scene(R"({"beam": {"strain_law": "green", "curve": {"type": "line", "start": [0, 0], "end": [1, 0]},
    "section": {"type": "stiffness", "EA": 7, "EI": 3, "rhoA": 1}, "elements": 2}, "duration": 1})");
}

/// Two elements of unit length in all, stretched by `stretch`, whose middle node is at x = 0.3 and travels at `rate`.
Configuration stretched(double stretch, double rate) {
  Configuration shape;
  shape.x = {0, 0.3, 1};
  for (const double x : shape.x) shape.r.push_back({stretch * x, 0, 0});
  shape.r_x.assign(3, {stretch, 0, 0});
  shape.weights.assign(2, {1, 1, 1, 1});
  shape.rates.x = {0, rate, 0};
  shape.rates.v.assign(3, Point{});
  shape.rates.r_x.assign(3, Point{});
  return shape;
}

TEST(PointsAlong, OfAStretchedBarAtRest) {
  const auto points = points_along(bar(), stretched(1.2, 0), 4);
  ASSERT_EQ(points.size(), 10U);
  for (const ShapePoint& point : points) {
    EXPECT_NEAR(point.r[0], 1.2 * point.x, 1e-15);
    EXPECT_NEAR(point.strain, (1.2 * 1.2 - 1) / 2, 1e-15);
    EXPECT_NEAR(point.tension, 7 * (1.2 * 1.2 - 1) / 2 * 1.2, 1e-14);
    EXPECT_NEAR(point.curvature, 0, 1e-12);
  }
  EXPECT_EQ(points[4].x, 0.3);
  EXPECT_EQ(points[5].x, 0.3) << "a node stands there twice";
}

TEST(PointsAlong, ANodeThatTravelsMovesNoMatter) {
  for (const ShapePoint& point : points_along(bar(), stretched(1.2, 5), 7)) {
    for (const double v : point.v) EXPECT_NEAR(v, 0, 1e-14);
  }
}

TEST(PointsAlong, VelocityOfATurningBar) {
  Configuration shape = stretched(1, 2);
  for (std::size_t k = 0; k < 3; ++k) {
    shape.rates.v[k] = {0, 3 * shape.x[k], 0};
    shape.rates.r_x[k] = {0, 3, 0};
  }
  for (const ShapePoint& point : points_along(bar(), shape, 5)) EXPECT_NEAR(point.v[1], 3 * point.x, 1e-14);
}

TEST(PointsAlong, CurvatureIsFromTheRestShape) {
  Scene scene = parse_scene(
      R"({"beam": {"strain_law": "green", "curve": {"type": "arc", "center": [0, 0], "radius": 2, "from_degrees": 0,
    "to_degrees": 90}, "axis": "exact", "axial_strain": "full", "elements": 3}, "gravity": [0, 0], "duration": 1e-3,
    "output": {"interval": 1e-3, "configurations": [0]}})");
  for (const RestShape rest : {RestShape::as_built, RestShape::paper}) {
    scene.beam.rest_shape = rest;
    const RunResult result = simulate(scene);
    for (const ShapePoint& point : points_along(scene, result.configurations.front(), 6)) {
      // kappa = 1/R |r_x|, or nothing of it; |r_x| is within 1e-3 of 1 on these elements
      const double stretch = std::hypot(point.r_x[0], point.r_x[1]);
      EXPECT_NEAR(std::hypot(point.r[0], point.r[1]), 2, 1e-13);
      EXPECT_NEAR(point.curvature, rest == RestShape::paper ? 0.5 : 0, 1e-3) << stretch;
      EXPECT_NEAR(point.strain, rest == RestShape::paper ? (stretch * stretch - 1) / 2 : 0, 1e-12);
    }
  }
}

/// Between the points where it is summed, the strain is their parabola: at 3/4 of an element -e_A/8 + 3 e_m/4 + 3
/// e_B/8.
TEST(PointsAlong, HaveTheParabolaOfASampledStrain) {
  Scene scene = parse_scene(
      R"({"beam": {"strain_law": "green", "curve": {"type": "line", "end": [1, 0]}, "axial_strain": "lobatto",
    "section": {"type": "stiffness", "EA": 7, "EI": 3, "rhoA": 1}, "elements": 2}, "duration": 1})");
  Configuration shape = stretched(1.1, 0);
  shape.r_x[1] = {1.3, 0.2, 0};
  const auto points = points_along(scene, shape, 4);
  for (const std::size_t first : {0, 5}) {
    const auto local = [&](std::size_t i) {
      const Point& r_x = points[first + i].r_x;
      return (r_x[0] * r_x[0] + r_x[1] * r_x[1] - 1) / 2;
    };
    for (const std::size_t i : {0, 2, 4}) EXPECT_NEAR(points[first + i].strain, local(i), 1e-14) << i;
    EXPECT_NEAR(points[first + 3].strain, -local(0) / 8 + 3 * local(2) / 4 + 3 * local(4) / 8, 1e-14);
    EXPECT_GT(std::abs(points[first + 3].strain - local(3)), 1e-3) << "which is not the strain of the curve there";
  }
}

TEST(PointsAlong, AgreeWithTheExtremesOfTheSample) {
  Scene scene = parse_scene(R"({"beam": {"curve": {"type": "line", "start": [0, 0], "end": [1, 0]}, "elements": 8},
    "supports": [{"at": "start", "type": "clamp"}], "sliding_mass": {"mass": 0.8, "position": 0.1}, "duration": 0.3,
    "output": {"interval": 0.1, "configurations": [0.3]}})");
  const RunResult result = simulate(scene);
  const auto points = points_along(scene, result.configurations.front(), 200);
  const StrainSample& seen = result.samples.back().strains;
  const auto by = [&](double ShapePoint::*member) {
    const auto [least, most] = std::ranges::minmax_element(points, {}, member);
    return std::array{(*least).*member, (*most).*member};
  };
  // Both look at points, the sample at 27 an element: apart by a parabola's height over half the widest gap of these.
  const auto close = [](double value, double other, double range) { EXPECT_NEAR(value, other, 0.02 * range); };
  const auto strain = by(&ShapePoint::strain), tension = by(&ShapePoint::tension),
             curvature = by(&ShapePoint::curvature);
  for (std::size_t i = 0; i < 2; ++i) {
    close(strain[i], seen.axial_strain[i], strain[1] - strain[0]);
    close(tension[i], seen.axial_force[i], tension[1] - tension[0]);
  }
  close(curvature[1], seen.curvature, curvature[1]);
  const ShapePoint& last = points.back();
  for (std::size_t c = 0; c < 2; ++c) EXPECT_DOUBLE_EQ(last.r[c], result.samples.back().end[c]);
}

TEST(PointsAlong, RefusesWhatIsNoShape) {
  Configuration shape = stretched(1, 0);
  EXPECT_THROW(points_along(bar(), shape, 0), std::invalid_argument);
  shape.weights.pop_back();
  EXPECT_THROW(points_along(bar(), shape, 2), std::invalid_argument);
}

}  // namespace
}  // namespace vlbeam
