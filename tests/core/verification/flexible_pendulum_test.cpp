#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support/reference.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

TEST(FlexiblePendulum, HasTheKnownErrorsOfCubicElements) {
  const auto exact = reference("flexible_pendulum.json");
  double coarser = 0;
  for (const auto& row : exact.at("cubic_elements")) {
    auto scene = flexible_pendulum(row.at("elements"));
    scene.output.interval = scene.duration;
    set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
    const auto result = simulate(scene);
    const auto& end = result.samples.back().end;
    const double error = std::max(std::abs(end[0] - exact.at("end").at(0).get<double>()),
                                  std::abs(end[1] - exact.at("end").at(1).get<double>()));
    const double expected = row.at("error");
    EXPECT_NEAR(error, expected, 0.02 * expected) << row.at("elements") << " elements";
    const double order = coarser > 0 ? std::log2(coarser / error) : 4.85;
    EXPECT_NEAR(order, 4.85, 0.2) << row.at("elements") << " elements";
    coarser = error;
  }
}

}  // namespace
}  // namespace vlbeam::test
