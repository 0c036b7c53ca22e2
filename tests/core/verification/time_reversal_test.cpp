// A motion that loses nothing goes back the way it came when all velocities are reversed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/length_control/chain_motion.hpp"
#include "scene/build.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

struct Return {
  double position = 0;   ///< largest distance of a material point from where it started [m]
  double velocity = 0;   ///< largest difference of its velocity from the reverse of what it was [m/s]
  double joint = 0;      ///< of the material coordinate of the mass [m]
  double travelled = 0;  ///< by the point that went furthest [m]
  std::size_t events = 0;
};

/// Runs for the duration, reverses all velocities, and runs as long again.
Return there_and_back(const Scene& scene, double tolerance = 1e-12) {
  BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
  Return seen;
  system.on_event = [&](const EventRecord<2>&) { ++seen.events; };
  IntegrationOptions options;
  options.type = IntegrationMethod::fehlberg78;
  options.tolerances = {tolerance, tolerance};
  SolverCounters counters;
  Eigen::VectorXd y = system.initial_state();
  const ChainState<2> start = system.chain(y, 0);
  const auto run = [&] {
    double t = 0;
    EXPECT_TRUE(integrate(system, y, t, scene.duration, {}, options, counters));
  };
  run();
  const ChainState<2> turn = system.chain(y, 0);
  const Eigen::Index n = system.coordinates();
  y.segment(n, n) *= -1;
  run();
  const ChainState<2> end = system.chain(y, 0);
  const WeightTransport transport = system.model().transport;
  for (int i = 0; i <= 200; ++i) {
    const double x = start.mesh.length() * i / 200;
    const auto was = point_motion(start, transport, x), is = point_motion(end, transport, x);
    seen.position = std::max(seen.position, (is.r - was.r).norm());
    seen.velocity = std::max(seen.velocity, (is.v + was.v).norm());
    seen.travelled = std::max(seen.travelled, (point_motion(turn, transport, x).r - was.r).norm());
  }
  if (!start.joints.empty() && !end.joints.empty()) {
    const auto mark = [](const auto& chain) {
      return chain.mesh.x[static_cast<std::size_t>(chain.joints.front().node)];
    };
    seen.joint = std::abs(mark(end) - mark(start));
  }
  return seen;
}

/// A soft beam that turns about its pin and falls.
Scene thrown(ElementKind element) {
  Scene scene = test::by_greens_law();
  scene.beam.element = element;
  scene.beam.elements = 8;
  scene.start.type = SupportType::pin;
  scene.initial_velocity = {.rotation = 3};
  scene.duration = 0.3;
  return scene;
}

TEST(TimeReversal, BringsABeamBack) {
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    const Return seen = there_and_back(thrown(element));
    EXPECT_GT(seen.travelled, 0.3);
    EXPECT_LE(seen.position, 1e-8);
    EXPECT_LE(seen.velocity, 1e-6);
  }
}

/// With the mass it carries, and over a lumped one: nothing is lost where the mesh stays what it is.
TEST(TimeReversal, BringsASlidingMassBackBetweenEvents) {
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    for (const auto transport : {WeightTransport::frozen, WeightTransport::transported}) {
      Scene scene = thrown(element);
      scene.weights = transport;
      scene.sliding_mass.emplace().position = 0.5;
      scene.sliding_mass->mass = 0.3;
      scene.sliding_mass->velocity = 0.1;
      scene.duration = 0.12;
      const Return seen = there_and_back(scene);
      EXPECT_EQ(seen.events, 0U);
      EXPECT_GT(seen.travelled, 0.2);
      EXPECT_LE(seen.position, 1e-8);
      EXPECT_LE(seen.joint, 1e-8);
      EXPECT_LE(seen.velocity, 1e-6);
    }
  }
}

/// A cut changes nothing, and a merge of two pieces of one cubic neither: on a beam that stays straight and is
/// stretched evenly the mass comes back through all events.
TEST(TimeReversal, BringsAMassBackThroughEventsThatLoseNothing) {
  for (const auto velocities : {VelocityTransfer::nodal, VelocityTransfer::conservative}) {
    for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      Scene scene = thrown(element);
      scene.gravity = {};
      scene.start.type = SupportType::free;
      scene.initial_velocity = {.translation = {0.3, 0.4, 0}};
      scene.length_control.velocities = velocities;
      scene.sliding_mass.emplace().position = 0.3;
      scene.sliding_mass->velocity = 1;
      scene.duration = 0.4;
      const Return seen = there_and_back(scene);
      EXPECT_GE(seen.events, 4U);
      EXPECT_LE(seen.position, 1e-8);
      EXPECT_LE(seen.joint, 1e-8);
      EXPECT_LE(seen.velocity, 1e-6);
    }
  }
}

/// On a beam that bends a merge puts one cubic where two were: what it changes is of the mesh, and does not come back.
TEST(TimeReversal, DoesNotUndoAMergeOfABentBeam) {
  for (const auto velocities : {VelocityTransfer::nodal, VelocityTransfer::conservative}) {
    Scene scene = thrown(ElementKind::ale_ancf);
    scene.length_control.velocities = velocities;
    scene.sliding_mass.emplace().position = 0.3;
    scene.sliding_mass->mass = 0.3;
    scene.sliding_mass->velocity = 0.8;
    scene.duration = 0.25;
    const Return coarse = there_and_back(scene);
    EXPECT_GE(coarse.events, 1U);
    EXPECT_GT(coarse.position, 1e-7);
    scene.beam.elements = 24;
    const Return fine = there_and_back(scene);
    EXPECT_GT(fine.events, coarse.events);
    EXPECT_LT(fine.position, coarse.position / 4);
  }
}

}  // namespace
}  // namespace vlbeam::test
