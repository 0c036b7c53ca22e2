// Blocks: joints that keep their distances in space.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/energy_ledger.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// A rope from a support down to a sheave of a block, up over a ring, down to its other sheave, up over another ring,
/// and down to a weight.
Scene tackle(double block, double weight, double rhoA = 1e-3) {
  Scene scene;
  scene.beam.curve = {.type = CurveType::polyline};
  scene.beam.curve.points = {{0, 0, 0}, {0.1, -2, 0}, {0.2, 0, 0}, {0.3, -2, 0}, {0.4, 0, 0}, {0.4, -1, 0}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 0, .rhoA = rhoA};
  scene.beam.elements = 27;
  scene.start.type = SupportType::pin;
  const double fall = std::hypot(0.1, 2);
  for (int i = 0; i < 4; ++i) {
    SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
    joint.position = (i + 1) * fall;
    joint.slopes = JointSlopes::free;
    if (i % 2 == 1) joint.support = SupportType::pin;
  }
  scene.blocks = {{.joints = {0, 2}, .mass = block}};
  scene.point_masses = {{27, weight}};
  scene.duration = 0.3;
  scene.output.interval = 0.05;
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.adaptive = true;
  scene.integrator.rtol = 1e-7;
  scene.integrator.atol = 1e-7;
  scene.integrator.step = 5e-3;
  return scene;
}

// A block on four falls comes down a quarter as far as the weight goes up: (M - 4 m) g/(M + 16 m), but that the falls
// are not quite vertical.
TEST(Block, FourFallsCarryFourTimesTheWeight) {
  for (const double block : {20.0, 30.0, 60.0}) {
    const RunResult run = test::completed(tackle(block, 10));
    const double a = (block - 40) * 9.81 / (block + 160);
    for (const Sample& sample : run.samples) {
      const Point &one = *sample.joints[0].mass_position, &other = *sample.joints[2].mass_position;
      const double falls = -2 - one[1];
      EXPECT_NEAR(falls, a / 2 * sample.t * sample.t, 1e-3 + 4e-3 * std::abs(falls)) << block << " " << sample.t;
      EXPECT_NEAR(other[0] - one[0], 0.2, 1e-9) << "the block does not turn";
      EXPECT_NEAR(other[1], one[1], 1e-9);
    }
    EXPECT_LE(run.max_energy_drift, 1e-3 * run.max_kinetic);
  }
}

// Explicit methods solve for the forces of the block themselves: the same motion, and the ledger closes to tolerance.
TEST(Block, MovesTheSameByEveryMethod) {
  Scene scene = tackle(30, 10, 0.2);
  scene.beam.section.EA = 3000;
  scene.duration = 0.2;
  test::set_tolerance(scene, IntegratorType::fehlberg78, 1e-10);
  const RunResult run = test::completed(scene);
  EXPECT_LE(run.max_energy_drift, 1e-8 * run.max_kinetic);
  EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-6 * run.max_kinetic);
  Scene implicit = scene;
  implicit.integrator = IntegratorSpec{.type = IntegratorType::generalized_alpha, .step = 1e-4, .rho_inf = 1};
  const RunResult other = test::completed(implicit);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR((*run.samples.back().joints[i].mass_position)[c], (*other.samples.back().joints[i].mass_position)[c],
                  2e-6)
          << i;
    }
  }
  const Sample& end = run.samples.back();
  EXPECT_NEAR((*end.joints[2].mass_position)[0] - (*end.joints[0].mass_position)[0], 0.2, 1e-12);
}

// What the joints' mass and the block's have in common is their sum.
TEST(Block, HasTheMassOfItsJointsToo) {
  const RunResult run = test::completed(tackle(30, 10));
  Scene scene = tackle(12, 10);
  scene.sliding_joints[0].mass = 5;
  scene.sliding_joints[2].mass = 13;
  const RunResult other = test::completed(scene);
  EXPECT_NEAR((*run.samples.back().mass_position)[1], (*other.samples.back().mass_position)[1], 1e-6);
}

}  // namespace
}  // namespace vlbeam
