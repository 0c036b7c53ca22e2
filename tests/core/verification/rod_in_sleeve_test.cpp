#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/core/support/reference.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

using Place = std::array<double, 2>;

/// Of the weight, off that on the inextensible rod, at its times.
std::vector<Place> off_inextensible(const nlohmann::json& exact, double EA) {
  const auto& rod = exact.at("rod");
  const double length = rod.at("length"), in_front = rod.at("in_front"),
               angle = rod.at("inclination_degrees").get<double>() * std::numbers::pi / 180;
  const Place along{std::cos(angle), std::sin(angle)};
  Scene scene = test::by_greens_law();
  scene.gravity = {0, -rod.at("gravity").get<double>(), 0};
  scene.beam.elements = 64;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.curve.start = {0, 0, 0};
  scene.beam.curve.end = {length * along[0], length * along[1], 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = rod.at("EI"), .rhoA = rod.at("rhoA")};
  scene.start.type = scene.end.type = SupportType::free;
  SlidingJointSpec& sleeve = scene.sliding_joints.emplace_back();
  sleeve.position = length - in_front;
  sleeve.support = SupportType::clamp;
  scene.point_masses = {{.node = scene.beam.elements, .mass = rod.at("mass")}};
  scene.initial_shape = InitialShape::equilibrium;
  scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 2.5e-4};
  scene.duration = 0.9;
  scene.output.interval = 0.1;
  const RunResult run = test::completed(scene);
  std::vector<Place> off;
  for (const auto& at : exact.at("motion")) {
    const Sample& seen = run.samples.at(off.size() + 1);
    EXPECT_NEAR(seen.t, at.at("t").get<double>(), 1e-12);
    off.push_back({seen.end[0] - sleeve.position * along[0] - at.at("x").get<double>(),
                   seen.end[1] - sleeve.position * along[1] - at.at("y").get<double>()});
  }
  return off;
}

double largest(const std::vector<Place>& off) {
  double size = 0;
  for (const Place& place : off) size = std::max(size, std::hypot(place[0], place[1]));
  return size;
}

/// reference/rod_in_sleeve.py: the angles of an inextensible rod (arXiv 2410.22545). What is off is 1/EA, and none of
/// it is left at an infinite stiffness.
TEST(RodInSleeve, TendsToTheInextensibleOne) {
  const auto exact = test::reference("rod_in_sleeve.json");
  const auto soft = off_inextensible(exact, 1e4), stiff = off_inextensible(exact, 4e4),
             stiffest = off_inextensible(exact, 16e4);
  EXPECT_NEAR(largest(soft) / largest(stiff), 4, 0.3);
  EXPECT_NEAR(largest(stiff) / largest(stiffest), 4, 0.3);
  std::vector<Place> rigid = stiffest;
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    for (std::size_t c = 0; c < 2; ++c) rigid[i][c] -= (stiff[i][c] - stiffest[i][c]) / 3;
  }
  EXPECT_LT(largest(rigid), largest(stiffest) / 10) << largest(stiffest);
}

}  // namespace
}  // namespace vlbeam
