#include <gtest/gtest.h>

#include "core/length_control/remeshing.hpp"
#include "core/pieces.hpp"
#include "mechanics/motion/system/beam_observation.hpp"
#include "mechanics/motion/system/event_ledger.hpp"
#include "tests/core/support/chain_models.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class EnergyJump : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(EnergyJump, Dimensions);

/// Energies of all elements and of what slides.
template <int D>
Energy whole(const CurrentBeam<D>& beam, const ChainState<D>& chain, int points) {
  Observation<D> seen = observe_elements(beam, chain, 0, chain.mesh.elements(), 0, points, false);
  for (const auto& joint : chain.joints) {
    const SlidingJoint& law = beam.model().joints[static_cast<std::size_t>(joint.index)].law;
    seen.add_mass(law.mass, position<D>(chain.q.data(), joint.node), position<D>(chain.rate.data(), joint.node),
                  beam.gravity(0));
    seen.energy.kinetic += 0.5 * law.turning.inertia * joint.rate * joint.rate;
  }
  return seen.energy;
}

TYPED_TEST(EnergyJump, IsTheDifferenceOfTheWholeBeamsEnergies) {
  constexpr int D = TypeParam::value;
  for (const bool rational : {false, true}) {
    for (const int points : {3, 5, 25}) {
      Random random(5);
      const ChainShape shape{.elements = 14, .joint = 6, .rational = rational};
      auto model = model_of<D>(shape, random);
      model.masses.points = {{0.5 * shape.element_length, 0.4}, {10.5 * shape.element_length, 0.3}};
      const auto before = random_chain<D>(shape, random);
      CurrentBeam<D> beam(model, before);
      auto after = before;
      segment_and_merge(after, 0, Direction::forward, {}, model.length_control, beam.moving_law(0));
      beam.adopt(after);
      // a projection reaches far, and the farther the less
      for (double& rate : after.rate) rate += random.uniform(-0.1, 0.1);
      after.joints.front().rate += 0.05;
      const Energy expected = whole(beam, after, points) - whole(beam, before, points);
      const Energy jump = energy_jump(beam, before, after, {4, 8}, 0, points);
      const double size = whole(beam, after, points).kinetic;
      EXPECT_NEAR(jump.kinetic, expected.kinetic, 1e-13 * size);
      EXPECT_NEAR(jump.total(), expected.total(), 1e-12 * std::abs(whole(beam, after, points).total()));
      const auto both = energy_jumps(beam, before, after, {4, 8}, 0, std::array{25, points});
      EXPECT_EQ(both[1].total(), jump.total()) << "whatever else is asked for";
      EXPECT_EQ(both[0].kinetic, energy_jump(beam, before, after, {4, 8}, 0, 25).kinetic);
    }
  }
}

/// It is so long that pieces of it are observed at once; its parts are too short for that.
TYPED_TEST(EnergyJump, ALongBeamIsObservedAsItsPartsAre) {
  constexpr int D = TypeParam::value, elements = static_cast<int>(long_range) / node_size<D> + 100;
  Random random(6);
  const ChainShape shape{.elements = elements, .joint = 6};
  auto model = model_of<D>(shape, random);
  model.masses.points = {{0.5 * shape.element_length, 0.4}};
  const auto chain = random_chain<D>(shape, random);
  const CurrentBeam<D> beam(model, chain);
  Observation<D> parts;
  parts.extremes.emplace();
  for (int first = 0; first < elements; first += 500) {
    parts += observe_elements(beam, chain, first, std::min(first + 500, elements), 0, 5, true);
  }
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    const Observation<D> seen = observe_elements(beam, chain, 0, elements, 0, 5, true);
    EXPECT_NEAR(seen.energy.kinetic, parts.energy.kinetic, 1e-12 * parts.energy.kinetic);
    EXPECT_NEAR(seen.energy.axial, parts.energy.axial, 1e-12 * parts.energy.axial);
    EXPECT_NEAR(seen.energy.bending, parts.energy.bending, 1e-12 * parts.energy.bending);
    EXPECT_NEAR(seen.mass, parts.mass, 1e-12 * parts.mass);
    EXPECT_NEAR(seen.beam_length, parts.beam_length, 1e-12 * parts.beam_length);
    EXPECT_LE((seen.mass_moment - parts.mass_moment).norm(), 1e-12 * parts.mass_moment.norm());
    EXPECT_EQ(seen.extremes->strain.least, parts.extremes->strain.least);
    EXPECT_EQ(seen.extremes->force.largest, parts.extremes->force.largest);
    EXPECT_EQ(seen.extremes->curvature, parts.extremes->curvature);
  }
}

}  // namespace
}  // namespace vlbeam::test
