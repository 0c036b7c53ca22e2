// Shafts whose sections have frames: where they are straight, what the angle of a shaft that spins says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/simulate.hpp"

namespace vlbeam::test {
namespace {

using std::numbers::pi;

TEST(FramesOfShafts, HaveTheTorsionalFrequenciesOfLinearAngles) {
  Scene scene;
  scene.dimension = 3;
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 1e5, .rhoA = 1, .GIp = 4, .rhoIp = 0.25};
  scene.beam.space_law = SpaceLaw::frames;
  scene.beam.elements = 5;
  scene.start.type = SupportType::clamp;
  scene.statics.frequencies = 3;
  const RunResult run = simulate(scene);
  ASSERT_EQ(run.frequencies.size(), 3U) << run.failure;
  for (int i = 1; i <= 3; ++i) {  // study torsion: f_h/f = sqrt(6 (1 - cos phi)/(2 + cos phi))/phi
    const double phi = (2 * i - 1) * pi / (2 * scene.beam.elements), exact = (2 * i - 1) * 4.0 / 4;
    const double known = exact * std::sqrt(6 * (1 - std::cos(phi)) / (2 + std::cos(phi))) / phi;
    EXPECT_NEAR(run.frequencies[static_cast<std::size_t>(i - 1)] / known, 1, 1e-9) << i;
  }
}

/// A force that travels along a spinning shaft and turns about it.
TEST(FramesOfShafts, BendUnderARotatingLoadAsTheScalarLawDoes) {
  Scene scene;
  scene.dimension = 3;
  scene.gravity = {};
  scene.beam.curve = {.type = CurveType::line, .start = {0, 0, 0}, .end = {0, 0, 1}};
  scene.beam.section = {.radius = 0.01};
  scene.beam.material = {.density = 7800, .youngs_modulus = 2.1e11, .poisson_ratio = 0.3};
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.loads = {{.at = LoadPlace::point,
                  .x = {.rate = 40},
                  .magnitude = {.value = 8},
                  .direction = {1, 0, 0},
                  .turn = {.rate = 250}}};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 2e-5;
  scene.duration = 0.02;
  scene.output.interval = 1e-3;
  scene.output.configurations = {0.01, 0.02};
  scene.spin.emplace().rate = 300;
  scene.spin->drives = {{0, {.rate = 300}}};
  const RunResult scalar = simulate(scene);
  scene.spin.reset();
  scene.beam.space_law = SpaceLaw::frames;
  const auto apart = [&](double spin) {
    scene.initial_velocity = InitialVelocitySpec{.rotation = spin, .axis = {0, 0, 1}};
    const RunResult frames = simulate(scene);
    EXPECT_EQ(frames.status, RunStatus::completed) << frames.failure;
    double most = 0, largest = 0;
    for (std::size_t i = 0; i < scalar.configurations.size(); ++i) {
      const auto &a = scalar.configurations[i].r, &b = frames.configurations[i].r;
      for (std::size_t k = 0; k < a.size(); ++k) {
        largest = std::max(largest, std::hypot(a[k][0], a[k][1]));
        most = std::max(most, std::hypot(a[k][0] - b[k][0], a[k][1] - b[k][1]));
      }
    }
    return most / largest;
  };
  EXPECT_LE(apart(0), 1e-6);
  const double slow = apart(300), fast = apart(600);  // gyroscopic moments: the scalar law knows none by itself
  EXPECT_LE(slow, 1e-3);
  EXPECT_NEAR(fast / slow, 2, 0.05);
}

}  // namespace
}  // namespace vlbeam::test
