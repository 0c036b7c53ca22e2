#include <gtest/gtest.h>

#include "mechanics/contact/contact_room.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/element_family.hpp"

namespace vlbeam::test {
namespace {

/// A free beam in random motion, its mass sliding, followed for a while without length-control events.
template <class Dimension>
class FreeBeam : public ::testing::Test {
 protected:
  static constexpr int dim = Dimension::value;

  struct Seen {
    double t;
    Observation<dim> observation;
    Vec<double, 3> angular_momentum;
    ConstraintResidual slopes;
    double kink;  ///< jump of the slope at the joint
  };

  /// States along the run, the initial one first.
  static std::vector<Seen> run(BeamModel<dim> model, const ChainState<dim>& chain) {
    model.length_control.enabled = false;
    BeamSystem<dim> system(model, chain);
    std::vector<Seen> seen;
    system.on_sample = [&](const Eigen::VectorXd& y, double t) {
      seen.push_back({t, system.observe(y, t, own_points), angular_momentum(system, y), system.slope_residual(y), 0});
      if (!system.has_joint()) return;
      const auto slopes = system.joint_slopes(0, y.data());
      seen.back().kink = (slopes.template head<dim>() - slopes.template tail<dim>()).norm();
    };
    Eigen::VectorXd y = system.initial_state();
    double t = 0;
    SolverCounters counters;
    IntegrationOptions options;
    options.type = IntegrationMethod::fehlberg78;
    options.tolerances = {1e-13, 1e-13};
    integrate(system, y, t, 0.04, {0, 0.02, 0.04}, options, counters);
    return seen;
  }

  /// Total energy, over the first kinetic one, and momenta are all along what they are at first.
  static void expect_kept(const std::vector<Seen>& seen, double energy, double momenta) {
    const auto& first = seen.front();
    for (const auto& at : seen) {
      EXPECT_NEAR(at.observation.energy.total(), first.observation.energy.total(),
                  energy * first.observation.energy.kinetic);
      EXPECT_LE((at.observation.momentum - first.observation.momentum).norm(), momenta);
      EXPECT_LE((at.angular_momentum - first.angular_momentum).norm(), momenta);
    }
  }

  Random random_{7};
};
TYPED_TEST_SUITE(FreeBeam, Dimensions, DimensionNames);

constexpr std::array<int, 3> point_counts{3, 5, 10};

TYPED_TEST(FreeBeam, KeepsItsMomentaAndItsEnergyWithAnyElementAndAnyNumberOfPoints) {
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    for (const int points : point_counts) {
      const ChainShape shape{.elements = 4, .joint = 2, .rational = kind.rational, .transport = kind.transport};
      auto model = model_of<TypeParam::value>(shape, this->random_);
      model.section.stiffness.law = kind.law;
      model.axial_strain = kind.axial;
      model.quadrature_points = points;
      model.gravity.setZero();
      const auto seen = this->run(model, random_chain<TypeParam::value>(shape, this->random_));
      ASSERT_EQ(seen.size(), 3U);
      this->expect_kept(seen, 1e-10, 1e-11);
    }
  }
}

TYPED_TEST(FreeBeam, KeepsItsMomentaAndItsEnergyWithSeveralJoints) {
  using Joints = std::vector<ChainShape::Joint>;
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    for (const Joints& more : {Joints{{2}}, Joints{{3}}, Joints{{3}, {4, JointSlopes::tangent}}}) {
      const ChainShape shape{
          .elements = 6, .joint = 1, .rational = kind.rational, .transport = kind.transport, .more = more};
      auto model = model_of<TypeParam::value>(shape, this->random_);
      model.section.stiffness.law = kind.law;
      model.axial_strain = kind.axial;
      model.gravity.setZero();
      const auto chain = random_chain<TypeParam::value>(shape, this->random_);
      const auto seen = this->run(model, chain);
      this->expect_kept(seen, 1e-10, 1e-11);
      model.formulation = Formulation::virtual_work;
      const auto lossy = this->run(model, chain);
      EXPECT_GT(std::abs(lossy.back().observation.energy.total() - seen.front().observation.energy.total()),
                1e-5 * seen.front().observation.energy.kinetic);
    }
  }
}

TYPED_TEST(FreeBeam, KeepsItsMomentaAndItsEnergyWithAMassInsideAnEndElement) {
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    for (const int rider : {0, 3}) {
      for (const bool held : {false, true}) {
        const ChainShape shape{.elements = 4, .rational = kind.rational, .rider = rider, .held = held};
        auto model = model_of<TypeParam::value>(shape, this->random_);
        bring<ContactRoom<TypeParam::value>>(model).at_support = {
            {AtSupport::rebound, 1}};  // nor does an impact lose anything
        model.section.stiffness.law = kind.law;
        model.axial_strain = kind.axial;
        model.gravity.setZero();
        auto chain = random_chain<TypeParam::value>(shape, this->random_);
        const auto seen = this->run(model, chain);
        // impacts and lift-offs are located to 1e-12 of an element, and leave 1e-11 of it
        this->expect_kept(seen, 1e-9, kind.axial == AxialStrain::lobatto ? 5e-10 : 2e-10);
      }
    }
  }
}

TYPED_TEST(FreeBeam, VirtualWorkLosesEnergyWhereTheVariationalEquationsKeepIt) {
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    const ChainShape shape{.elements = 4, .joint = 2, .rational = kind.rational, .transport = kind.transport};
    auto model = model_of<TypeParam::value>(shape, this->random_);
    model.section.stiffness.law = kind.law;
    model.axial_strain = kind.axial;
    model.formulation = Formulation::virtual_work;
    model.gravity.setZero();
    const auto seen = this->run(model, random_chain<TypeParam::value>(shape, this->random_));
    const auto &first = seen.front().observation.energy, &last = seen.back().observation.energy;
    EXPECT_GT(std::abs(last.total() - first.total()), 1e-5 * first.kinetic);
  }
}

/// Two slopes at the joint: the momentum that they pass from one to the other as the joint moves is part of the
/// discrete Lagrangian, and of no virtual work at fixed material points.
TYPED_TEST(FreeBeam, KeepsItsMomentaAndItsEnergyWithAKinkAtTheJoint) {
  for (const auto slopes : all_slopes) {
    for (const auto& kind : element_family) {
      SCOPED_TRACE(std::string(kind.name()) + ", slopes " + std::to_string(static_cast<int>(slopes)));
      const ChainShape shape{
          .elements = 4, .joint = 2, .rational = kind.rational, .transport = kind.transport, .slopes = slopes};
      auto model = model_of<TypeParam::value>(shape, this->random_);
      model.section.stiffness.law = kind.law;
      model.axial_strain = kind.axial;
      model.gravity.setZero();
      const auto chain = random_chain<TypeParam::value>(shape, this->random_);
      const auto seen = this->run(model, chain);
      const auto &first = seen.front(), &last = seen.back();
      EXPECT_NEAR(last.observation.energy.total(), first.observation.energy.total(),
                  1e-10 * first.observation.energy.kinetic);
      EXPECT_LE((last.observation.momentum - first.observation.momentum).norm(), 1e-11);
      EXPECT_LE((last.angular_momentum - first.angular_momentum).norm(), 1e-11);
      EXPECT_LE(last.slopes.position, 1e-10);
      EXPECT_LE(last.slopes.velocity, 1e-9);
      EXPECT_GT(last.kink, 1e-3) << "nothing is shown without a jump of the slopes";
      model.formulation = Formulation::virtual_work;
      const auto lossy = this->run(model, chain);
      EXPECT_GT(std::abs(lossy.back().observation.energy.total() - first.observation.energy.total()),
                1e-5 * first.observation.energy.kinetic);
    }
  }
}

TYPED_TEST(FreeBeam, WhatFrictionTakesIsOnTheLedger) {
  for (const auto slopes : {JointSlopes::continuous, JointSlopes::tangent, JointSlopes::free}) {
    const ChainShape shape{.elements = 4, .joint = 2, .slopes = slopes};
    auto model = model_of<TypeParam::value>(shape, this->random_);
    model.joints.front().law.friction = AxialFriction{0.3, 0.1};
    const auto seen = this->run(model, random_chain<TypeParam::value>(shape, this->random_));
    const auto &first = seen.front().observation.energy, &last = seen.back().observation.energy;
    EXPECT_GT(last.dissipated, 1e-3 * first.kinetic);
    EXPECT_NEAR(last.total(), first.total(), 1e-10 * first.kinetic);
  }
}

TYPED_TEST(FreeBeam, FallsInGravityAsABody) {
  const ChainShape shape{.elements = 4, .joint = 2};
  const auto model = model_of<TypeParam::value>(shape, this->random_);
  const auto chain = random_chain<TypeParam::value>(shape, this->random_);
  const double mass = model.section.rhoA * chain.mesh.length() + model.joints.front().law.mass;
  const auto seen = this->run(model, chain);
  const auto& first = seen.front();
  for (const auto& at : seen) {
    EXPECT_LE((at.observation.momentum - first.observation.momentum - mass * at.t * model.gravity).norm(), 1e-11);
    EXPECT_NEAR(at.observation.energy.total(), first.observation.energy.total(), 1e-10);
  }
}

TYPED_TEST(FreeBeam, WhatDampingTakesIsOnTheLedger) {
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    const ChainShape shape{.elements = 4, .joint = 2, .rational = kind.rational, .transport = kind.transport};
    auto model = model_of<TypeParam::value>(shape, this->random_);
    model.section.stiffness.law = kind.law;
    model.axial_strain = kind.axial;
    model.section.damping = 0.01;
    const auto seen = this->run(model, random_chain<TypeParam::value>(shape, this->random_));
    const auto &first = seen.front().observation.energy, &last = seen.back().observation.energy;
    EXPECT_GT(last.dissipated, 1e-3 * first.kinetic);
    EXPECT_NEAR(last.total(), first.total(), 1e-10 * first.kinetic);
  }
}

TYPED_TEST(FreeBeam, TimeReversalReturnsToTheStart) {
  const ChainShape shape{.elements = 4, .joint = 2, .rational = true, .transport = WeightTransport::transported};
  auto model = model_of<TypeParam::value>(shape, this->random_);
  model.length_control.enabled = false;
  const auto chain = random_chain<TypeParam::value>(shape, this->random_);
  BeamSystem<TypeParam::value> system(model, chain);
  const Eigen::VectorXd start = system.initial_state();
  const Eigen::Index n = start.size() / 2;
  Eigen::VectorXd y = start;
  SolverCounters counters;
  IntegrationOptions options;
  options.type = IntegrationMethod::fehlberg78;
  options.tolerances = {1e-13, 1e-13};
  for (int way = 0; way < 2; ++way) {
    double t = 0;
    integrate(system, y, t, 0.04, {}, options, counters);
    y.tail(n) *= -1;
  }
  EXPECT_LE((y - start).norm(), 1e-9 * start.norm());
}

}  // namespace
}  // namespace vlbeam::test
