#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "scene/names.hpp"
#include "tests/core/support/reference.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

const Sample& sample_at(const RunResult& result, double t) {
  for (const auto& sample : result.samples) {
    if (std::abs(sample.t - t) < 1e-9) return sample;
  }
  throw std::out_of_range("no sample at that time");
}

void expect_end(const Sample& sample, const nlohmann::json& end, double tolerance) {
  EXPECT_NEAR(sample.end[0], end.at(0).get<double>(), tolerance);
  EXPECT_NEAR(sample.end[1], end.at(1).get<double>(), tolerance);
}

class CoarseMeshDigits : public ::testing::TestWithParam<std::pair<ElementKind, int>> {};

TEST_P(CoarseMeshDigits, AreThoseOfAnIndependentPrototype) {
  const auto [element, elements] = GetParam();
  auto scene = falling_beam(element, elements);
  scene.beam.quadrature_points = 15;
  scene.output.interval = 0.1;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-9);
  const auto result = simulate(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
  int compared = 0;
  const auto digits = reference("ale_independent_codes.json").at("digits_of_coarse_meshes");
  for (const auto& row : digits.at("rows")) {
    if (row.at("element").get<std::string>() != to_string(element) || row.at("elements").get<int>() != elements)
      continue;
    const double t = row.at("t");
    SCOPED_TRACE(t);
    const double tolerance = t < 0.45 ? 1e-6 : 2e-5;
    const auto& sample = sample_at(result, t);
    EXPECT_NEAR(*sample.joint_position, row.at("joint_position").get<double>(), tolerance);
    expect_end(sample, row.at("end"), tolerance);
    EXPECT_EQ(std::ranges::count_if(result.events, [&](const Event& event) { return event.t <= t; }),
              row.at("events").get<int>());
    ++compared;
  }
  EXPECT_EQ(compared, 2);
}

INSTANTIATE_TEST_SUITE_P(FallingBeam, CoarseMeshDigits,
                         ::testing::Values(std::pair{ElementKind::ale_ancf, 10}, std::pair{ElementKind::ale_ancf, 20},
                                           std::pair{ElementKind::ale_rancf, 10},
                                           std::pair{ElementKind::ale_rancf, 20}));

TEST(FallingBeam, TendsToTheConvergedAnswer) {
  auto scene = falling_beam(ElementKind::ale_ancf, 40);
  scene.output.interval = 0.1;
  scene.duration = 0.4;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-8);
  const auto result = simulate(scene);
  const auto converged = reference("falling_beam_converged.json");
  for (const auto& row : converged.at("samples")) {
    const auto& sample = sample_at(result, row.at("t"));
    EXPECT_NEAR(*sample.joint_position, row.at("joint_position").get<double>(), 1e-4);
    expect_end(sample, row.at("end"), 1e-4);
  }
}

/// Example 1 with smooth gravity and a lighter mass; until t = 0.3 s there is no event on these meshes.
double error_of_the_ramped_twin(ElementKind element, int elements) {
  auto scene = falling_beam(element, elements);
  scene.gravity_ramp = 0.3;
  scene.sliding_mass->mass = 0.2;
  scene.sliding_mass->position = 0.4;
  scene.duration = scene.output.interval = 0.3;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
  const auto result = simulate(scene);
  EXPECT_TRUE(result.events.empty());
  const auto exact = reference("ale_independent_codes.json").at("ramped_twin");
  const auto& last = result.samples.back();
  auto distance = [](const Point& p, const nlohmann::json& q) {
    return std::hypot(p[0] - q.at(0).get<double>(), p[1] - q.at(1).get<double>());
  };
  return std::max({std::abs(*last.joint_position - exact.at("joint_position").get<double>()),
                   distance(last.end, exact.at("end")), distance(*last.mass_position, exact.at("mass"))});
}

TEST(RampedFallingBeam, ConvergesToTheReferenceWithItsOrder) {
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    const double coarse = error_of_the_ramped_twin(element, 10), fine = error_of_the_ramped_twin(element, 20);
    EXPECT_LE(fine, 3e-6);
    EXPECT_NEAR(std::log2(coarse / fine), 4.2, 0.5);
  }
}

TEST(FallingBeam, WithTheEngineeringLawIsWhatACodeOfThatLawFinds) {
  auto scene = falling_beam(ElementKind::ale_ancf, 20);
  scene.beam.strain_law = StrainLaw::engineering;
  scene.output.interval = 0.5;
  set_tolerance(scene, IntegratorType::fehlberg78, 1e-8);
  const auto result = simulate(scene);
  const auto exact = reference("ale_independent_codes.json").at("engineering");
  EXPECT_NEAR(*result.samples.back().joint_position, exact.at("joint_position").get<double>(), 3e-4);
  EXPECT_NEAR(result.samples.back().end[1], exact.at("end_y").get<double>(), 3e-4);
}

TEST(FallingBeam, DoesNotDependOnTheOutputInterval) {
  auto scene = falling_beam(ElementKind::ale_rancf, 6);
  scene.duration = 0.4;
  scene.output.interval = 0.4;
  const auto rare = simulate(scene);
  scene.output.interval = 0.001;
  scene.output.configurations = {0.1234};
  const auto dense = simulate(scene);
  EXPECT_EQ(rare.solver.steps, dense.solver.steps);
  EXPECT_EQ(*rare.samples.back().joint_position, *dense.samples.back().joint_position);
  EXPECT_EQ(rare.samples.back().end, dense.samples.back().end);
  ASSERT_EQ(rare.events.size(), dense.events.size());
  for (std::size_t i = 0; i < rare.events.size(); ++i) EXPECT_EQ(rare.events[i].t, dense.events[i].t);
}

}  // namespace
}  // namespace vlbeam::test
