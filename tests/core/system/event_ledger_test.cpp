#include <gtest/gtest.h>

#include "core/length_control/length_control.hpp"
#include "core/system/beam_observation.hpp"
#include "core/system/event_ledger.hpp"
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
  Observation<D> seen;
  observe_elements(beam, chain, 0, chain.mesh.elements(), 0, points, seen);
  for (const auto& joint : chain.joints) {
    const SlidingJoint& law = beam.model().joints[static_cast<std::size_t>(joint.index)].law;
    seen.add_mass(law.mass, position<D>(chain.q.data(), joint.node), position<D>(chain.rate.data(), joint.node),
                  beam.gravity(0));
    seen.energy.kinetic += 0.5 * law.turning * joint.rate * joint.rate;
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

}  // namespace
}  // namespace vlbeam::test
