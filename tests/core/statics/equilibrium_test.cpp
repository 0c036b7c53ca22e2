#include "mechanics/statics/equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

Scene straight(int elements, double EA, double EI) {
  Scene scene = at_rest(elements, EA, EI);
  scene.start.type = SupportType::clamp;
  return scene;
}

double distance(const Point& a, double x, double y) { return std::hypot(a[0] - x, a[1] - y); }

/// A cable of length 1.5 from (0, 0) to (1, 0) hangs under a weight of 1 N/m from the arc through both.
Scene cable(int elements, double EA) {
  Scene scene = straight(elements, EA, 0);
  scene.gravity = {0, -1, 0};
  const double half = 1.4957815682221;  // sin(h)/h = 2/3
  const double radius = 0.75 / half, degrees = half * 180 / std::numbers::pi;
  scene.beam.curve = {.type = CurveType::arc,
                      .center = {0.5, radius * std::cos(half), 0},
                      .radius = radius,
                      .from_degrees = -90 - degrees,
                      .to_degrees = -90 + degrees};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.statics.steps = 4;
  return scene;
}

/// M = 2 pi EI/L on EA 4e4, EI 100/3: with this strain law a circle of more than one turn, in closed form.
TEST(Statics, EndMomentRollsABeamUp) {
  std::vector<double> errors;
  for (const int n : {16, 32}) {
    Scene scene = straight(n, 4e4, 100.0 / 3);
    scene.loads = {{.type = LoadType::moment,
                    .node = n,
                    .x = {},
                    .magnitude = {.value = 2 * std::numbers::pi * 100 / 3},
                    .turn = {}}};
    const RunResult result = completed(scene);
    EXPECT_EQ(result.samples.size(), 11U);
    EXPECT_EQ(result.samples.back().equilibrium->negative_pivots, 0);
    errors.push_back(distance(result.samples.back().end, 0.06193394864661416, 0.01298778587883767));
    // what holds the beam is the moment turned round
    EXPECT_NEAR(result.samples.back().reactions[0].position[1], 0, 1e-6);
  }
  EXPECT_LT(errors[1], 5e-6);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.8);
}

/// A dead load of P L^2/EI = 4 at the tip, by an independent solution of this strain law.
TEST(Statics, ElasticaOfThisLaw) {
  Scene scene = straight(32, 0, 0);
  scene.beam.section = {.radius = 0.01};
  scene.loads = {{.node = 32, .x = {}, .magnitude = {.value = 0.2 * std::numbers::pi}, .turn = {}}};
  EXPECT_LT(distance(completed(scene).samples.back().end, 0.671038728694, 0.670119114398), 2e-7);
}

/// Irvine's closed form, which needs the linear law, from a cable that holds nothing at first.
TEST(Statics, ElasticCatenary) {
  Scene scene = cable(64, 10);
  scene.beam.strain_law = StrainLaw::engineering;
  const RunResult result = completed(scene);
  EXPECT_NEAR(result.configurations.back().r[32][1], -0.54887345701418, 1e-7);
  EXPECT_NEAR(std::abs(result.samples.back().reactions[0].position[0]), 0.27971378560362, 1e-8);
  EXPECT_EQ(result.samples.back().equilibrium->negative_pivots, 0);
}

/// Beyond Euler's load a straight column is an equilibrium, but not a stable one.
TEST(Statics, CountsDirectionsOfInstability) {
  const double euler = std::numbers::pi * std::numbers::pi / 4;
  for (const auto& [load, falls] : std::vector<std::pair<double, int>>{
           {0.98 * euler, 0}, {1.02 * euler, 1}, {8.98 * euler, 1}, {9.02 * euler, 2}}) {
    Scene scene = straight(16, 1e7, 1);
    scene.loads = {{.node = 16, .x = {}, .magnitude = {.value = load}, .direction = {-1, 0, 0}, .turn = {}}};
    EXPECT_EQ(completed(scene).samples.back().equilibrium->negative_pivots, falls) << load / euler;
  }
}

Scene arch(LoadControl control) {
  Scene scene = straight(16, 1e4, 1);
  const double rise = 0.04, radius = (0.25 + rise * rise) / (2 * rise), half = std::asin(0.5 / radius);
  const double degrees = half * 180 / std::numbers::pi;
  scene.beam.curve = {.type = CurveType::arc,
                      .center = {0.5, rise - radius, 0},
                      .radius = radius,
                      .from_degrees = 90 + degrees,
                      .to_degrees = 90 - degrees};
  scene.start.type = scene.end.type = SupportType::pin;
  scene.loads = {{.node = 8, .x = {}, .magnitude = {.value = 60}, .direction = {0, -1, 0}, .turn = {}}};
  scene.statics.steps = 100;
  scene.statics.control = control;
  return scene;
}

TEST(Statics, ArchSnapsThroughAlongItsPath) {
  const RunResult result = completed(arch(LoadControl::arc_length));
  double largest = 0, least = 1;
  int falling = 0;
  const auto& samples = result.samples;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double factor = samples[i].equilibrium->load_factor, before = samples[i - 1].equilibrium->load_factor;
    if (factor < before) {
      ++falling;
      largest = std::max(largest, before);
      least = std::min(least, factor);
      if (i > 1 && samples[i - 1].equilibrium->negative_pivots > 0) {
        EXPECT_GT(samples[i].energy.total(), 0);
      }
    }
  }
  EXPECT_GT(falling, 3);
  EXPECT_GT(largest, least);
  EXPECT_EQ(samples.back().equilibrium->load_factor, 1);
  EXPECT_EQ(samples.back().equilibrium->negative_pivots, 0);
  EXPECT_LT(samples.back().flow->loads[0][1], -0.04);
  const auto unstable =
      std::ranges::count_if(samples, [](const Sample& s) { return s.equilibrium->negative_pivots > 0; });
  EXPECT_NEAR(static_cast<double>(unstable), falling, 2);  // where the load falls
}

/// A failed step keeps what was found before it.
TEST(Statics, LoadControlStopsAtALimitPoint) {
  const RunResult result = simulate(arch(LoadControl::load));
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("arc-length"), std::string::npos) << result.failure;
  EXPECT_GT(result.samples.size(), 4U);
  EXPECT_LE(result.samples.back().equilibrium->load_factor, result.failure_time + 1e-12);
}

/// A pinned beam swings down until it hangs; on a slide that gravity pulls along it finds nothing.
TEST(Statics, MechanismIsNamed) {
  Scene scene = straight(8, 1e4, 1);
  scene.gravity = {0, -9.81, 0};
  scene.start.type = SupportType::pin;
  const RunResult hanging = completed(scene);
  EXPECT_LT(distance(hanging.samples.back().end, 0, -hanging.samples.back().beam_length), 1e-6);
  scene.start.type = SupportType::slide;
  scene.gravity = {1, 0, 0};
  const RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("nothing holds it along (1, 0)"), std::string::npos) << result.failure;
}

/// H of a rope of length L that weighs w by length, between supports at one height. Green's law,
/// T = EA l (l^2 - 1)/2: the half of its span is H/w times the integral of l over u, T = H cosh u, up to sinh u = w L/2
/// H (reference/exact/catenary.py).
double catenary_pull(double EA, double w, double L, double span) {
  const auto stretch = [EA](double T) {
    double l = 1 + T / EA;
    for (int i = 0; i < 8; ++i) l -= (l * l * l - l - 2 * T / EA) / (3 * l * l - 1);
    return l;
  };
  const auto reach = [&](double H) {
    constexpr int steps = 400;  // of Simpson's rule
    const double last = std::asinh(w * L / (2 * H)), h = last / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
      sum += (i % steps == 0 ? 1 : i % 2 == 0 ? 2 : 4) * stretch(H * std::cosh(i * h));
    }
    return 2 * H / w * sum * h / 3;
  };
  double low = 1e-3 * w * L, high = 10 * w * L;
  for (int i = 0; i < 100; ++i) (reach((low + high) / 2) < span ? low : high) = (low + high) / 2;
  return low;
}

constexpr double slack_length = 2 * std::numbers::sqrt2;

/// A rope that is longer than its supports are apart, 2 m, drawn without stress.
Scene slack(const std::string& drawn, int elements, double EA, int dimension = 2) {
  Scene scene = straight(elements, EA, 0);
  scene.dimension = dimension;
  scene.gravity = {0, -9.81, 0};
  scene.beam.axial_strain = AxialStrain::lobatto;
  scene.start.type = scene.end.type = SupportType::pin;
  scene.beam.curve = {.type = CurveType::polyline};
  if (drawn == "V") scene.beam.curve.points = {{0, 0, 0}, {1, -1, 0}, {2, 0, 0}};
  if (drawn == "across") scene.beam.curve.points = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}};
  if (drawn == "zigzag") scene.beam.curve.points = {{0, 0, 0}, {0.5, 0.5, 0}, {1.5, -0.5, 0}, {2, 0, 0}};
  if (drawn == "arc") {
    const double half = 1.391557378251510, radius = slack_length / 2 / half;  // sin(h)/h = 1/sqrt 2
    const double degrees = half * 180 / std::numbers::pi;
    scene.beam.curve = {.type = CurveType::arc,
                        .center = {1, radius * std::cos(half), 0},
                        .radius = radius,
                        .from_degrees = -90 - degrees,
                        .to_degrees = -90 + degrees};
  }
  return scene;
}

TEST(SlackRope, HangsAsTheElasticCatenaryWhateverItsStiffnessAndDrawing) {
  for (const double EA : {1e4, 1e6, 1e8, 1e9}) {
    const double exact = catenary_pull(EA, 9.81, slack_length, 2);
    for (const std::string drawn : {"V", "arc", "zigzag", "across"}) {
      const int dimension = drawn == "across" ? 3 : 2;
      std::vector<double> errors;
      for (const int n : {16, 32, 64}) {
        const RunResult run = completed(slack(drawn, n, EA, dimension));
        EXPECT_EQ(run.samples.back().equilibrium->negative_pivots, 0) << drawn << " " << EA;
        errors.push_back(std::abs(run.samples.back().reactions[1].position[0] / exact - 1));
      }
      // rounding of the strain makes a force of EA; a slope is a sum of products, and rounds several times
      const double rounding = std::numeric_limits<double>::epsilon() * EA / exact;
      EXPECT_LE(errors[2], 8e-9 + 8 * rounding) << drawn << " " << EA;
      if (rounding > 0.01 * errors[0]) continue;
      EXPECT_GT(std::log2(errors[0] / errors[1]), 3.7) << drawn << " " << EA << ": " << errors[0] << " " << errors[1];
    }
  }
}

/// Rounding of the strain is 1e-4 of the tension there, and no more.
TEST(SlackRope, HangsWhereRoundingIsMostOfWhatItsStrainsTell) {
  const double exact = catenary_pull(2e12, 9.81, slack_length, 2);
  const RunResult run = completed(slack("V", 32, 2e12));
  EXPECT_NEAR(run.samples.back().reactions[1].position[0] / exact, 1, 1e-3);
}

/// A weight in the middle of a light rope: two straight legs at 45 degrees.
TEST(SlackRope, BearsAWeight) {
  for (const std::string drawn : {"V", "arc"}) {
    Scene scene = slack(drawn, 32, 1e9);
    scene.beam.section.rhoA = 1e-6;
    scene.point_masses = {{16, 2}};
    const RunResult run = completed(scene);
    const double pull = run.samples.back().reactions[1].position[0];
    EXPECT_NEAR(pull / 9.81, 1, 1e-5) << drawn;
    EXPECT_NEAR(run.configurations.back().r[16][1], -1, 1e-5) << drawn;
  }
}

TEST(SlackRope, IsWhereAMotionStarts) {
  Scene scene = slack("arc", 16, 1e8), start = scene;
  const Sample at_rest = completed(scene).samples.back();
  start.analysis = Analysis::dynamics;
  start.initial_shape = InitialShape::equilibrium;
  start.integrator.type = IntegratorType::generalized_alpha;
  start.integrator.step = 1e-3;
  start.duration = 0.01;
  start.output.interval = 0.01;
  const RunResult run = completed(start);
  EXPECT_NEAR(run.samples.front().reactions[1].position[0] / at_rest.reactions[1].position[0], 1, 1e-6);
  EXPECT_EQ(run.samples.front().equilibrium->negative_pivots, 0);
  EXPECT_LE(run.max_kinetic, 1e-9);
}

/// Hardly stretched, a beam bends as if it could not be: the elastica of a dead load, P L^2/EI = 10, in elliptic
/// integrals.
TEST(Statics, ASlenderBeamBendsHoweverStiffItsAxis) {
  for (const double EA : {1e8, 1e10, 1e12, 1e13}) {
    Scene scene = straight(32, EA, 1);
    scene.beam.axial_strain = AxialStrain::lobatto;
    scene.loads = {{.node = 32, .x = {}, .magnitude = {.value = 10}, .direction = {0, -1, 0}, .turn = {}}};
    EXPECT_LT(distance(completed(scene).samples.back().end, 0.4450044022, -0.8106090249), 8e-7) << EA;
  }
}

/// Loads that rounding of the axial force swallows move nothing: that is no equilibrium.
TEST(Statics, WhatRoundingHidesIsNoAnswer) {
  Scene scene = straight(8, 1e18, 1);
  scene.loads = {{.node = 8, .x = {}, .magnitude = {.value = 10}, .direction = {0, -1, 0}, .turn = {}}};
  EXPECT_EQ(simulate(scene).status, RunStatus::failed);
}

/// A verdict is right, or says that rounding hides it.
TEST(Statics, KnowsWhereRoundingHidesStability) {
  const double euler = std::numbers::pi * std::numbers::pi / 4;
  for (const double EA : {1e8, 1e10, 1e11, 1e12, 1e14}) {
    for (const auto& [load, falls] : std::vector<std::pair<double, int>>{{0.98, 0}, {1.02, 1}}) {
      Scene scene = straight(16, EA, 1);
      scene.beam.curve.end = {std::cos(0.6), std::sin(0.6), 0};
      scene.loads = {{.node = 16, .x = {}, .magnitude = {.value = load * euler}, .turn = {}}};
      scene.loads.front().direction = {-std::cos(0.6), -std::sin(0.6), 0};
      const StaticSample seen = *completed(scene).samples.back().equilibrium;
      const bool known = seen.hidden_pivots == 0;
      EXPECT_TRUE(known || EA > 1e11) << EA << " " << load;
      EXPECT_FALSE(known && EA > 1e13) << EA << " " << load;
      if (known) {
        EXPECT_EQ(seen.negative_pivots, falls) << EA << " " << load;
      }
    }
  }
}

/// What rounding leaves of no force must not move a beam that nothing holds.
TEST(Statics, FreeBeamWithoutLoadsIsInEquilibriumOnEveryMesh) {
  for (int n = 2; n <= 40; ++n) {
    for (const double angle : {0.0, 0.7, 2.0}) {
      Scene scene = straight(n, 1e4, 1);
      scene.start.type = SupportType::free;
      scene.beam.curve.end = {std::cos(angle), std::sin(angle), 0};
      scene.statics.steps = 1;
      const RunResult result = completed(scene);
      EXPECT_LT(distance(result.samples.back().end, std::cos(angle), std::sin(angle)), 1e-9) << n << ", " << angle;
    }
  }
}

/// (b/L)^2 sqrt(EI/rhoA)/2 pi, b of the characteristic equations.
TEST(Frequencies, OfBeams) {
  struct Case {
    SupportType start, end;
    std::size_t rigid;
    double b;
  };
  for (const Case& c : {Case{SupportType::pin, SupportType::slide, 0, std::numbers::pi},
                        Case{SupportType::clamp, SupportType::free, 0, 1.8751040687119611},
                        Case{SupportType::free, SupportType::free, 3, 4.730040744862704}}) {
    std::vector<double> errors;
    for (const int n : {4, 8}) {
      Scene scene = straight(n, 1e4, 1);
      scene.start = {.type = c.start, .clamp = ClampType::full};
      scene.end.type = c.end;
      scene.statics = {.steps = 1, .frequencies = 4};
      const RunResult result = completed(scene);
      ASSERT_EQ(result.frequencies.size(), 4U);
      errors.push_back(result.frequencies[c.rigid] / (c.b * c.b / (2 * std::numbers::pi)) - 1);
      for (std::size_t i = 0; i < c.rigid; ++i) EXPECT_NEAR(result.frequencies[i], 0, 1e-3);
    }
    EXPECT_LT(errors[1], 1e-4);
    EXPECT_GT(std::log2(errors[0] / errors[1]), 3.7);
  }
}

/// j_n sqrt(g/L)/2, j_n the zeros of the Bessel function J_0; the chain is stretched by its weight over 2 EA.
TEST(Frequencies, OfAHangingChain) {
  Scene scene = straight(16, 1e6, 0);
  scene.gravity = {0, -1, 0};
  scene.beam.curve.end = {0, -1, 0};
  scene.start.type = SupportType::pin;
  scene.statics = {.steps = 1, .frequencies = 3};
  const RunResult result = completed(scene);
  const std::array zeros{2.404825557695773, 5.520078110286311, 8.653727912911013};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(result.frequencies[i] / (zeros[i] / (4 * std::numbers::pi)), 1, 1e-6);
  }
}

/// A point mass at the tip of a light cantilever: f = sqrt(3 EI/(m L^3))/2 pi, with 33/140 of the beam's mass
/// (Rayleigh), an upper bound that is off by 1e-4 of the ratio of the masses.
TEST(Frequencies, OfAMassOnACantilever) {
  Scene scene = straight(8, 1e6, 1);
  scene.start.clamp = ClampType::full;
  scene.point_masses = {{8, 100}};
  scene.statics = {.steps = 1, .frequencies = 1};
  const double expected = std::sqrt(3 / (100 + 33.0 / 140)) / (2 * std::numbers::pi);
  EXPECT_NEAR(completed(scene).frequencies[0] / expected, 1, 1e-5);
}

}  // namespace
}  // namespace vlbeam::test
