// What is nothing changes nothing: a load of no size, a spin of no rate, a prescribed coordinate that rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "scene/build.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

using test::falling_beam;

constexpr double nothing = 1e-200;

struct Law {
  const char* name;
  Scene scene;

  friend void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }
};

/// A soft beam, clamped, that falls; of every element, straight or curved, uneven in its weights.
Scene soft_beam(ElementKind element, int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.gravity = {0.3, -9.81, 0};
  scene.beam.curve.start = {0, 1, 0};
  scene.beam.curve.end = {1, 1, 0};
  scene.beam.elements = 6;
  scene.beam.element = element;
  scene.beam.material.curvature_regularization = dimension == 3 ? 1e-3 : 0;
  if (element == ElementKind::ale_rancf || element == ElementKind::rancf) scene.beam.weights = {1, 0.9, 1.1, 1};
  scene.start.type = SupportType::clamp;
  scene.gravity_ramp = 0.1;
  scene.duration = 0.05;
  scene.output.interval = 0.01;
  return scene;
}

/// A scene by an explicit and by an implicit method.
void add_laws(const char* name, Scene scene, std::vector<Law>& laws) {
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  laws.push_back({name, scene});
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.newton_tolerance = 1e-10;
  laws.push_back({name, scene});
}

std::vector<Law> laws() {
  std::vector<Law> result;
  const auto with_integrators = [&](const char* name, const Scene& scene) { add_laws(name, scene, result); };
  with_integrators("RANCF", soft_beam(ElementKind::rancf, 2));
  with_integrators("ANCF", soft_beam(ElementKind::ancf, 2));
  with_integrators("ALE-RANCF", soft_beam(ElementKind::ale_rancf, 2));
  with_integrators("ALE-ANCF in space", soft_beam(ElementKind::ale_ancf, 3));
  with_integrators("ALE-RANCF in space", soft_beam(ElementKind::ale_rancf, 3));
  Scene paper = soft_beam(ElementKind::ale_rancf, 2);
  paper.beam.rest_shape = RestShape::paper;
  with_integrators("no rest shape", paper);
  Scene damped = soft_beam(ElementKind::ale_ancf, 2);
  damped.beam.material.damping = 1e-3;
  damped.gravity_ramp = 0;
  with_integrators("damped, sudden gravity", damped);
  return result;
}

Scene soft_arc() {
  Scene arc = soft_beam(ElementKind::ale_rancf, 2);
  arc.beam.weights = {1, 1, 1, 1};
  arc.beam.curve = {.type = CurveType::arc, .center = {0, 0, 0}, .radius = 1, .from_degrees = 90, .to_degrees = 180};
  return arc;
}

Scene shaken_beam() {
  Scene shaken = soft_beam(ElementKind::ale_ancf, 2);
  shaken.start.motion = {.direction = {0, 1, 0},
                         .displacement = {.amplitude = 0.01, .frequency = 5, .phase_degrees = 90}};
  return shaken;
}

/// Those whose nodes may move along the beam: with all else that a beam may have then.
std::vector<Law> movable_laws() {
  std::vector<Law> result = laws();
  const auto with_methods = [&](const char* name, const Scene& scene) {
    add_laws(name, scene, result);
    Scene cut = result.back().scene;
    cut.constraints = Constraints::multipliers;
    result.push_back({name, cut});
  };
  with_methods("arc", soft_arc());
  with_methods("moving support", shaken_beam());
  Scene braked = soft_beam(ElementKind::ale_rancf, 3);
  braked.drag = DragSpec{{0.4, 0.1}, {0.3, 0.05}};
  braked.beam.material.mass_damping = 2;
  with_methods("drag", braked);
  Scene turned = soft_beam(ElementKind::ale_ancf, 2);
  turned.start.type = SupportType::pin;
  turned.initial_velocity = {.rotation = 3, .about = {0, 1, 0}};
  turned.loads = {{.type = LoadType::moment, .node = 6, .x = {}, .magnitude = {.value = 0.01}, .turn = {}}};
  with_methods("moment and initial velocity", turned);
  std::erase_if(result, [](const Law& law) {
    const ElementKind element = law.scene.beam.element;
    return element == ElementKind::rancf || element == ElementKind::ancf;
  });
  return result;
}

/// Those of other beams, too: with a sliding mass, curved, moved.
std::vector<Law> all_laws() {
  std::vector<Law> result = laws();
  result.push_back({"arc", soft_arc()});
  for (const ElementKind element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
    Scene falling = falling_beam(element, 8);
    falling.duration = 0.1;
    result.push_back({"falling beam", falling});
    falling.constraints = Constraints::multipliers;
    falling.integrator.type = IntegratorType::generalized_alpha;
    result.push_back({"falling beam, multipliers", falling});
  }
  result.push_back({"moving support", shaken_beam()});
  return result;
}

void expect_same(const Scene& scene, const RunResult& a, const RunResult& b, double t, double tolerance) {
  ASSERT_EQ(a.status, RunStatus::completed) << a.failure;
  ASSERT_EQ(b.status, RunStatus::completed) << b.failure;
  ASSERT_EQ(a.samples.size(), b.samples.size());
  const auto near = [&](double x, double y, double size, const char* what, double at) {
    EXPECT_NEAR(x, y, tolerance * size) << what << " at t = " << at;
  };
  // rounding of forces is that of stresses which cancel
  double energy = 0, force = 1e-2 * build_section(scene.beam).stiffness.EA;
  for (const Sample& s : a.samples) {
    energy = std::max(energy, s.energy.kinetic + s.energy.axial + s.energy.bending + std::abs(s.energy.gravity));
    for (const double f : s.reactions[0].position) force = std::max(force, std::abs(f));
  }
  ASSERT_GT(energy, 0);
  for (std::size_t i = 0; i < a.samples.size() && a.samples[i].t <= t; ++i) {
    const Sample &x = a.samples[i], &y = b.samples[i];
    near(x.energy.kinetic, y.energy.kinetic, energy, "kinetic", x.t);
    near(x.energy.axial, y.energy.axial, energy, "axial", x.t);
    near(x.energy.bending, y.energy.bending, energy, "bending", x.t);
    near(x.energy.gravity, y.energy.gravity, energy, "gravity", x.t);
    near(x.energy.dissipated, y.energy.dissipated, energy, "dissipated", x.t);
    near(x.discrete_total, y.discrete_total, energy, "total of the model", x.t);
    near(x.beam_length, y.beam_length, 1, "length", x.t);
    near(x.beam_length_rate, y.beam_length_rate, 1, "its rate", x.t);
    near(x.strains.axial_strain[1], y.strains.axial_strain[1], 1, "strain", x.t);
    for (std::size_t c = 0; c < 3; ++c) {
      near(x.end[c], y.end[c], 1, "end", x.t);
      near(x.momentum[c], y.momentum[c], 1 + energy, "momentum", x.t);
      // by the accelerations
      near(x.reactions[0].position[c], y.reactions[0].position[c], force, "reaction", x.t);
      near(x.reactions[0].slope[c], y.reactions[0].slope[c], force, "reaction", x.t);
    }
  }
}

/// Rounding grows in the course of a run, as its stiffest vibrations have it.
constexpr double in_space_of_time = 1e-8, at_once = 1e-13;

class NothingTest : public testing::TestWithParam<Law> {};

TEST_P(NothingTest, ALoadOfNoSizeChangesNothing) {
  const Scene& bare = GetParam().scene;
  Scene loaded = bare;
  loaded.loads = {{.node = 3, .x = {}, .magnitude = {.value = nothing}, .turn = {}},
                  {.type = LoadType::follower,
                   .at = LoadPlace::point,
                   .x = {.value = 0.3, .rate = 0.4},
                   .magnitude = {.value = nothing},
                   .turn = {}},
                  {.at = LoadPlace::beam, .x = {}, .magnitude = {.value = nothing}, .turn = {}}};
  const RunResult without = simulate(bare), with = simulate(loaded);
  expect_same(bare, without, with, 0, at_once);
  expect_same(bare, without, with, bare.duration, 1e-12);
  EXPECT_EQ(without.solver.steps, with.solver.steps) << "it costs no steps";
  ASSERT_TRUE(with.samples.back().flow);
  EXPECT_NEAR(with.samples.back().flow->ledger.loads, 0, 1e-190);
}
INSTANTIATE_TEST_SUITE_P(Scenes, NothingTest, testing::ValuesIn(all_laws()));

class RestTest : public testing::TestWithParam<Law> {};

class MarkTest : public testing::TestWithParam<Law> {};

TEST_P(MarkTest, AMarkThatRestsChangesNothing) {
  const Scene& bare = GetParam().scene;
  Scene prescribed = bare;
  const double length = beam_length(bare);
  prescribed.flow.emplace().nodes = {
      {.node = 0, .x = {}}, {.node = 2, .x = {.value = 2 * length / 6}}, {.node = 6, .x = {.value = length}}};
  const RunResult without = simulate(bare), with = simulate(prescribed);
  expect_same(bare, without, with, 0, at_once);
  expect_same(bare, without, with, bare.duration, in_space_of_time);
}

TEST_P(RestTest, ASpinOfNoRateChangesNothing) {
  const Scene& bare = GetParam().scene;
  Scene spinning = bare;
  spinning.spin.emplace().rate = 0;
  const RunResult without = simulate(bare), with = simulate(spinning);
  expect_same(bare, without, with, 0, at_once);
  expect_same(bare, without, with, bare.duration, in_space_of_time);
}
INSTANTIATE_TEST_SUITE_P(Scenes, MarkTest, testing::ValuesIn(movable_laws()));
INSTANTIATE_TEST_SUITE_P(Scenes, RestTest, testing::ValuesIn(laws()));

/// The section's angle of a beam whose nodes rest, driven and under torques of every kind, is that of a flowing beam
/// that does not flow, with what drives and torques do.
TEST(SpinOfRestingNodes, IsThatOfABeamThatDoesNotFlow) {
  for (const AngleField angles : {AngleField::linear, AngleField::hermite}) {
    for (const bool implicit : {false, true}) {
      Scene scene = soft_beam(ElementKind::ale_ancf, 3);
      scene.gravity_ramp = 0;
      scene.beam.material.poisson_ratio = 0.4;
      scene.beam.material.damping = 1e-4;
      scene.spin.emplace().angles = angles;
      scene.spin->drives = {{.node = 0, .angle = {.rate = 6, .amplitude = 0.1, .frequency = 30}}};
      scene.loads = {
          {.type = LoadType::torque, .node = 6, .x = {}, .magnitude = {.value = -0.1}, .turn = {}},
          {.type = LoadType::torque,
           .at = LoadPlace::point,
           .x = {.value = 0.2, .rate = 3},
           .magnitude = {.amplitude = 0.3, .frequency = 20},
           .turn = {}},
          {.type = LoadType::torque, .at = LoadPlace::beam, .x = {}, .magnitude = {.value = 0.2}, .turn = {}}};
      test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
      if (implicit) {
        scene.integrator = {};
        scene.integrator.type = IntegratorType::generalized_alpha;
        scene.integrator.newton_tolerance = 1e-11;
      }
      Scene flowing = scene;
      flowing.flow.emplace().nodes = {{.node = 0, .x = {}}, {.node = 6, .x = {.value = 1}}};
      const RunResult a = simulate(scene), b = simulate(flowing);
      expect_same(scene, a, b, scene.duration, in_space_of_time);
      for (std::size_t i = 0; i < a.samples.size(); ++i) {
        const FlowSample &x = *a.samples[i].flow, &y = *b.samples[i].flow;
        for (const std::size_t end : {0U, 1U}) EXPECT_NEAR((*x.end_angles)[end], (*y.end_angles)[end], 1e-8);
        EXPECT_NEAR(x.spin_momentum, y.spin_momentum, 1e-8);
        ASSERT_EQ(x.torques.size(), 1U);
        EXPECT_NEAR(x.torques[0], y.torques[0], 1e-7);
        EXPECT_NEAR(a.samples[i].energy.torsion, b.samples[i].energy.torsion, 1e-8);
        EXPECT_NEAR(x.ledger.ends, y.ledger.ends, 1e-8);
        EXPECT_NEAR(x.ledger.loads, y.ledger.loads, 1e-8);
      }
      const FlowSample& last = *a.samples.back().flow;
      EXPECT_GT(std::abs(last.ledger.ends), 1e-3);
      EXPECT_GT(std::abs(last.ledger.loads), 1e-3);
      double largest = 0;
      for (const Sample& s : a.samples) largest = std::max(largest, s.energy.kinetic + s.energy.torsion);
      EXPECT_LE(a.max_energy_drift, (implicit ? 1e-2 : 1e-9) * largest);
    }
  }
}

/// What supports, loads and growing gravity supply is all that the energy changes by, between events: of a sliding mass
/// under loads that travel, follow and swing, with each element.
TEST(LoadsWithASlidingMass, CloseTheLedger) {
  for (const ElementKind element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
    for (const WeightTransport weights : {WeightTransport::frozen, WeightTransport::transported}) {
      Scene scene = falling_beam(element, 8);
      scene.weights = weights;
      scene.gravity_ramp = 0.1;
      scene.duration = 0.4;
      scene.output.interval = 0.01;
      test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-12);
      scene.loads = {
          {.at = LoadPlace::point,
           .x = {.value = 0.2, .rate = 1},
           .magnitude = {.value = 3, .ramp = 0.1},
           .turn = {.rate = 10}},
          {.type = LoadType::follower, .node = 8, .x = {}, .magnitude = {.value = 2, .ramp = 0.1}, .turn = {}},
          {.at = LoadPlace::beam,
           .x = {},
           .magnitude = {.amplitude = 2, .frequency = 3, .phase_degrees = 90, .ramp = 0.1},
           .turn = {}}};
      const RunResult run = simulate(scene);
      ASSERT_EQ(run.status, RunStatus::completed) << run.failure;
      EXPECT_GE(run.events.size(), 1U);
      EXPECT_GT(std::abs(run.samples.back().flow->ledger.loads), 0.1);
      double largest = 0;
      for (const Sample& s : run.samples) largest = std::max(largest, s.energy.kinetic + std::abs(s.energy.gravity));
      EXPECT_LE(run.max_energy_drift, 1e-9 * largest);

      scene.integrator = {};
      scene.integrator.type = IntegratorType::generalized_alpha;
      double drift[2];
      for (const int halved : {0, 1}) {
        scene.duration = 0.1;  // before any event
        scene.integrator.step = 1e-3 / (1 << halved);
        const RunResult implicit = simulate(scene);
        ASSERT_EQ(implicit.status, RunStatus::completed) << implicit.failure;
        drift[halved] = implicit.max_energy_drift;
      }
      EXPECT_LT(drift[1], 0.3 * drift[0]) << "of second order";
    }
  }
}

}  // namespace
}  // namespace vlbeam
