// Loads that come onto a beam and leave it, and supports that move along several axes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "scene/sample_quantities.hpp"
#include "scene/simulate.hpp"

namespace vlbeam {
namespace {
namespace coming {

constexpr double pi = std::numbers::pi;
constexpr double L = 20, EI = 2e9, rhoA = 2000, P = 1e5, v = 40;

/// Deflection of the middle of a simply supported beam that a force crosses from t = 0 on: Fryba's series, and free
/// vibrations behind it.
double crossed(double t) {
  if (t < 0) return 0;
  double sum = 0;
  for (int n = 1; n < 40; n += 2) {
    const double omega = n * n * pi * pi / (L * L) * std::sqrt(EI / rhoA), turn = n * pi * v / L;
    const double size = 2 * P / (rhoA * L * (omega * omega - turn * turn)), ratio = turn / omega;
    const auto way = [&](double s) { return size * (std::sin(turn * s) - ratio * std::sin(omega * s)); };
    const auto rate = [&](double s) { return size * turn * (std::cos(turn * s) - std::cos(omega * s)); };
    const double on = L / v;
    const double q =
        t < on ? way(t) : way(on) * std::cos(omega * (t - on)) + rate(on) / omega * std::sin(omega * (t - on));
    sum += q * (n % 4 == 1 ? 1 : -1);
  }
  return sum;
}

Scene bridge(double from) {
  Scene scene;
  scene.gravity = {0, 0, 0};
  scene.beam.curve.end = {L, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e11, .EI = EI, .rhoA = rhoA};
  scene.beam.elements = 16;
  scene.beam.element = ElementKind::ale_ancf;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  scene.places = {{.name = "middle", .x = L / 2}};
  LoadSpec axle;
  axle.at = LoadPlace::point;
  axle.x = {.value = from, .rate = v};
  axle.magnitude.value = P;
  axle.direction = {0, -1, 0};
  scene.loads = {axle};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 2e-4;
  scene.integrator.rho_inf = 1;
  scene.duration = 1;
  scene.output.interval = 0.05;
  return scene;
}

TEST(ComingLoads, CrossABridgeAsTheSeriesSays) {
  for (const double from : {0.0, -5.3}) {
    const RunResult run = simulate(bridge(from));
    ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
    const double still = P * L * L * L / (48 * EI);
    for (const Sample& sample : run.samples) {
      const double deflection = -sample.sections->places[0]->position[1];
      EXPECT_NEAR(deflection, crossed(sample.t + from / v), 1e-3 * still) << from << " at " << sample.t;
      const bool on = sample.t + from / v >= 0 && sample.t + from / v <= L / v;
      EXPECT_EQ(std::isfinite(sample.flow->loads[0][0]), on) << "where it is, at " << sample.t;
    }
  }
}

TEST(ComingLoads, ATrainIsTheSumOfItsAxles) {
  Scene train = bridge(0);
  train.loads.push_back(train.loads[0]);
  train.loads[1].x.value = -3;
  const RunResult run = simulate(train);
  const double still = P * L * L * L / (48 * EI);
  for (const Sample& sample : run.samples) {
    const double deflection = -sample.sections->places[0]->position[1];
    EXPECT_NEAR(deflection, crossed(sample.t) + crossed(sample.t - 3 / v), 2e-3 * still) << sample.t;
  }
}

TEST(ComingLoads, AreRefusedWhereTheyNeverCome) {
  Scene scene = bridge(-100);
  try {
    simulate(scene);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, "/loads/0/x");
    EXPECT_NE(error.allowed.find("never on the beam"), std::string::npos);
  }
  scene = bridge(-1);
  scene.analysis = Analysis::statics;
  scene.integrator = {};
  EXPECT_THROW(simulate(scene), InvalidInput);
}

/// A weight on a string whose upper end is moved.
Scene pendulum(const SupportMotionSpec& motion) {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  scene.initial_shape = InitialShape::equilibrium;
  scene.beam.curve = {.type = CurveType::line, .start = {0, 0, 0}, .end = {0, -2, 0}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 0, .rhoA = 0.01};
  scene.beam.elements = 4;
  scene.beam.element = ElementKind::ale_ancf;
  scene.start.type = SupportType::pin;
  scene.start.motion = motion;
  scene.point_masses = {{.node = 4, .mass = 5}};
  scene.places = {{.name = "pivot", .end = BeamEnd::start}};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 1e-3;
  scene.duration = 1;
  scene.output.interval = 0.1;
  return scene;
}

TEST(MovedAlongAxes, ASupportGoesWhereEachFunctionSays) {
  const TimeSpec across{.value = 0.5, .ramp = 0.8}, up{.amplitude = 0.1, .frequency = 1, .phase_degrees = 90};
  const RunResult run = simulate(pendulum({.displacement = {}, .x = across, .y = up}));
  ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
  for (const Sample& sample : run.samples) {
    const double s = std::min(sample.t / 0.8, 1.0),
                 smooth = s * s * s * s * (35 - 84 * s + 70 * s * s - 20 * s * s * s);
    const Point& pivot = sample.sections->places[0]->position;
    EXPECT_NEAR(pivot[0], 0.5 * smooth, 1e-12) << sample.t;
    EXPECT_NEAR(pivot[1], 0.1 * (std::cos(2 * pi * sample.t) - 1), 1e-12) << sample.t;
  }
}

TEST(MovedAlongAxes, IsTheSameAsAlongADirection) {
  const TimeSpec way{.value = 0.5, .ramp = 0.8};
  const RunResult a = simulate(pendulum({.displacement = {}, .x = way})),
                  b = simulate(pendulum({.direction = {1, 0, 0}, .displacement = way}));
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) EXPECT_EQ(a.samples[i].end, b.samples[i].end);
}

TEST(MovedAlongAxes, StartsFromRestOnEachAxis) {
  const auto refused = [](const SupportMotionSpec& motion) {
    try {
      simulate(pendulum(motion));
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return std::string("nothing");
  };
  EXPECT_EQ(refused({.displacement = {}, .y = TimeSpec{.rate = 1}}), "/supports/at=start/motion/y");
  EXPECT_EQ(refused({.displacement = {}, .x = TimeSpec{.value = 1}}), "/supports/at=start/motion/x");
}

}  // namespace coming
}  // namespace
}  // namespace vlbeam
