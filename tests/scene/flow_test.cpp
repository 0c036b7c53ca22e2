// Nodes that travel along a beam are a way of describing it: what it does tends to the same.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/validate.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

Scene clamped_arc(ElementKind element, int elements) {
  Scene scene;
  scene.beam.element = element;
  scene.beam.elements = elements;
  scene.beam.curve = {.type = CurveType::arc, .center = {0, 0, 0}, .radius = 1, .from_degrees = 90, .to_degrees = 180};
  scene.start.type = SupportType::clamp;
  scene.drag = DragSpec{{0.4, 0.1}, {0.3, 0.05}};
  scene.gravity_ramp = 0.1;
  scene.duration = 0.1;
  scene.output.interval = 0.1;
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-11);
  return scene;
}

/// Its middle node travels, from the middle to two thirds of it, and is shaken.
void let_nodes_travel(Scene& scene) {
  const double length = beam_length(scene);
  const int last = scene.beam.elements;
  scene.flow.emplace().nodes = {
      {.node = 0, .x = {}},
      {.node = last / 2,
       .x = {.value = length / 2, .rate = length / 6 / scene.duration, .amplitude = 0.02, .frequency = 10}},
      {.node = last, .x = {.value = length}}};
}

/// Its elements are up to a third longer than those of nodes that rest, whose error is of third to fourth order.
TEST(Flow, NodesThatTravelOnACurvedBeamChangeItsMotionByTheMeshAlone) {
  const Point exact = simulate(clamped_arc(ElementKind::ale_ancf, 32)).samples.back().end;
  const auto error = [&](const Scene& scene) {
    const RunResult run = simulate(scene);
    EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
    double largest = 0;
    for (const Sample& sample : run.samples) largest = std::max(largest, std::abs(sample.energy.gravity));
    EXPECT_LE(run.max_energy_drift, 1e-6 * largest);  // of a ramp of this many steps
    const Point& end = run.samples.back().end;
    return std::hypot(end[0] - exact[0], end[1] - exact[1]);
  };
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const int elements : {4, 8}) {
      Scene scene = clamped_arc(element, elements);
      const double resting = error(scene);
      let_nodes_travel(scene);
      EXPECT_LE(error(scene), std::pow(4.0 / 3, 4) * resting) << elements;
    }
  }
}

/// What a beam with nodes that travel cannot have is refused by its key.
TEST(Flow, IsRefusedWithWhatItDoesNotGoTogetherWith) {
  const auto field_of = [](const auto& change) -> std::string {
    Scene scene = clamped_arc(ElementKind::ale_ancf, 4);
    let_nodes_travel(scene);
    change(scene);
    try {
      validate(scene);
    } catch (const InvalidInput& refused) {
      return refused.field;
    }
    return "";
  };
  EXPECT_EQ(field_of([](Scene&) {}), "");
  EXPECT_EQ(field_of([](Scene& s) { s.flow->tension = 1; }), "/flow/tension");
  EXPECT_EQ(field_of([](Scene& s) { s.flow->nodes.back().x.rate = 0.1; }), "/flow/nodes");
  EXPECT_EQ(field_of([](Scene& s) { s.beam.rotary_inertia = BendingInertia::rayleigh; }), "/beam/curve/type");
  EXPECT_EQ(field_of([](Scene& s) {
              s.integrator.type = IntegratorType::energy_momentum;
              s.drag.reset();
              s.beam.rest_shape = RestShape::paper;
            }),
            "/integrator/type");
  EXPECT_EQ(field_of([](Scene& s) {
              s.flow->nodes[1].support = SupportType::pin;
              s.initial_velocity = {.translation = {0, 0, 0}};
            }),
            "/initial_velocity");
}

}  // namespace
}  // namespace vlbeam
