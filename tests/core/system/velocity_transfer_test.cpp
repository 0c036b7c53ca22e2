#include <gtest/gtest.h>

#include "mechanics/motion/system/beam_system.hpp"
#include "tests/core/support/chain_models.hpp"

namespace vlbeam::test {
namespace {

/// One forward length-control event of a free beam in random motion, its mass sliding.
template <int D>
struct Transfer {
  Transfer(VelocityTransfer velocities, bool rational, unsigned seed, JointSlopes slopes = JointSlopes::continuous) {
    Random random(seed);
    const ChainShape shape{.elements = 6, .joint = 2, .rational = rational, .slopes = slopes};
    auto model = model_of<D>(shape, random);
    model.quadrature_points = 12;
    model.length_control.velocities = velocities;
    model.length_control.merge = MergeShape::unit;
    auto chain = random_chain<D>(shape, random);
    chain.mesh.x[2] = 2.3 * shape.element_length;  // past where the node behind the mass goes
    BeamSystem<D> system(model, chain);
    system.on_event = [&](const EventRecord<D>& record) { jump = record.discrete_jump; };
    Eigen::VectorXd y = system.initial_state();
    before = system.observe(y, 0, 12);
    angular_before = angular_momentum(system, y);
    system.handle_event(0, y, 0);
    after = system.observe(y, 0, 12);
    angular_after = angular_momentum(system, y);
    slopes_after = system.slope_residual(y);
  }

  Observation<D> before, after;
  Vec<double, 3> angular_before, angular_after;
  ConstraintResidual slopes_after;
  double jump = 0;
};

template <class Dimension>
class VelocityTransferOf : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(VelocityTransferOf, Dimensions);

TYPED_TEST(VelocityTransferOf, NodalVelocitiesKeepNoMomentum) {
  constexpr int D = TypeParam::value;
  const Transfer<D> nodal(VelocityTransfer::nodal, false, 3);
  EXPECT_GT((nodal.after.momentum - nodal.before.momentum).norm(), 1e-3);
}

TYPED_TEST(VelocityTransferOf, AProjectionKeepsMomentumAndAddsNoKineticEnergy) {
  constexpr int D = TypeParam::value;
  for (unsigned seed = 1; seed < 6; ++seed) {
    for (const bool rational : {false, true}) {
      const Transfer<D> projected(VelocityTransfer::projected, rational, seed);
      EXPECT_LE((projected.after.momentum - projected.before.momentum).norm(), 1e-9);
      EXPECT_LE(projected.after.energy.kinetic, projected.before.energy.kinetic + 1e-9);
      const Transfer<D> nodal(VelocityTransfer::nodal, rational, seed);
      EXPECT_LT(std::abs(projected.after.energy.kinetic - projected.before.energy.kinetic),
                std::abs(nodal.after.energy.kinetic - nodal.before.energy.kinetic));
    }
  }
}

TYPED_TEST(VelocityTransferOf, AConservativeOneKeepsMomentaAndTotalEnergy) {
  constexpr int D = TypeParam::value;
  int exact = 0;
  for (unsigned seed = 1; seed < 6; ++seed) {
    const Transfer<D> transfer(VelocityTransfer::conservative, true, seed);
    EXPECT_LE((transfer.after.momentum - transfer.before.momentum).norm(), 1e-12);
    EXPECT_LE((transfer.angular_after - transfer.angular_before).norm(), 1e-12);
    EXPECT_NEAR(transfer.jump, transfer.after.energy.total() - transfer.before.energy.total(), 1e-12);
    if (std::abs(transfer.jump) < 1e-12) ++exact;
  }
  EXPECT_GE(exact, 4) << "a fluctuation that holds enough energy is the rule";
}

TYPED_TEST(VelocityTransferOf, AKinkedJointKeepsItAllAndItsConditions) {
  constexpr int D = TypeParam::value;
  for (const auto slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    int exact = 0;
    for (unsigned seed = 1; seed < 6; ++seed) {
      const Transfer<D> projected(VelocityTransfer::projected, true, seed, slopes);
      EXPECT_LE((projected.after.momentum - projected.before.momentum).norm(), 1e-9);
      EXPECT_LE(projected.after.energy.kinetic, projected.before.energy.kinetic + 1e-9);
      const Transfer<D> transfer(VelocityTransfer::conservative, true, seed, slopes);
      EXPECT_LE((transfer.after.momentum - transfer.before.momentum).norm(), 1e-12);
      EXPECT_LE((transfer.angular_after - transfer.angular_before).norm(), 1e-12);
      EXPECT_LE(transfer.slopes_after.position, 1e-14);
      EXPECT_LE(transfer.slopes_after.velocity, 1e-12);
      if (std::abs(transfer.jump) < 1e-12) ++exact;
    }
    EXPECT_GE(exact, 4);
  }
}

}  // namespace
}  // namespace vlbeam::test
