// A bead that slides with friction on a stiff wire, bent at rest and of a material that damps: as on a rigid one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/support/scenes.hpp"

namespace vlbeam::curved_damping {
namespace {

constexpr double rubs = 0.3, fades = 0.05, pull = 9.81;

struct Slid {
  double way, speed;
};
/// By Runge and Kutta; `rate` is the acceleration along the wire there.
template <class Rate>
Slid slide(Slid at, double duration, const Rate& rate) {
  constexpr int steps = 20000;
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const auto after = [&](const Slid& by, double share) -> Slid {
      return {at.way + share * h * by.way, at.speed + share * h * by.speed};
    };
    const auto rates = [&](const Slid& now) -> Slid { return {now.speed, rate(now)}; };
    const Slid a = rates(at), b = rates(after(a, 0.5)), c = rates(after(b, 0.5)), d = rates(after(c, 1));
    at = {at.way + h * (a.way + 2 * b.way + 2 * c.way + d.way) / 6,
          at.speed + h * (a.speed + 2 * b.speed + 2 * c.speed + d.speed) / 6};
  }
  return at;
}
double friction(double normal, double speed) { return rubs * std::abs(normal) * std::tanh(speed / fades); }

/// A bead of 10 kg on a wire of 16 elements that hardly gives way.
Scene wire(int elements) {
  Scene scene;
  scene.beam.curve.type = CurveType::arc;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e9, .EI = 1e7, .rhoA = 1, .GIp = 8e6, .rhoIp = 1e-3};
  scene.beam.material.damping = 1e-4;
  scene.beam.elements = elements;
  for (SupportSpec* end : {&scene.start, &scene.end}) {
    end->type = SupportType::clamp;
    end->clamp = ClampType::full;
  }
  SlidingMassSpec& bead = scene.sliding_mass.emplace();
  bead.mass = 10;
  bead.friction = AxialFriction{rubs, fades};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 1e-3;
  scene.integrator.rho_inf = 0;
  return scene;
}

TEST(CurvedDamping, LetsABeadSlideDownAnArc) {
  Scene scene = wire(10);
  scene.gravity = {0, -pull, 0};
  scene.beam.curve.from_degrees = 180;
  scene.beam.curve.to_degrees = 360;
  scene.sliding_mass->position = 0.4;
  scene.duration = scene.output.interval = 0.8;
  const Slid rigid = slide({0.4, 0}, scene.duration, [](const Slid& at) {  // of radius 1 m
    return pull * std::cos(at.way) - friction(at.speed * at.speed + pull * std::sin(at.way), at.speed);
  });
  const RunResult run = test::completed(scene);
  ASSERT_GT(run.events.size(), 2U);
  EXPECT_NEAR(*run.samples.back().joint_position, rigid.way, 2e-3);
}

TEST(CurvedDamping, LetsABeadSlideDownAHelix) {
  Scene scene = wire(12);
  scene.dimension = 3;
  scene.gravity = {0, 0, -pull};
  constexpr double radius = 0.5, pitch = -1;
  scene.beam.curve.radius = radius;
  scene.beam.curve.pitch = pitch;
  scene.beam.curve.to_degrees = 360;
  scene.sliding_mass->position = 0.5;
  scene.sliding_mass->velocity = 2;
  scene.duration = scene.output.interval = 0.6;
  const double rise = pitch / (2 * std::numbers::pi), along = std::hypot(radius, rise);
  const Slid rigid = slide({0.5, 2}, scene.duration, [&](const Slid& at) {
    const double bends = radius / (along * along) * at.speed * at.speed, carries = pull * radius / along;
    return -pull * rise / along - friction(std::hypot(bends, carries), at.speed);
  });
  const RunResult run = test::completed(scene);
  ASSERT_GT(run.events.size(), 1U);
  EXPECT_NEAR(*run.samples.back().joint_position, rigid.way, 2e-3);
}

}  // namespace
}  // namespace vlbeam::curved_damping
