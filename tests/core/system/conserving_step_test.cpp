#include "mechanics/conserving/conserving_step.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/element_family.hpp"

namespace vlbeam::test {
namespace {

/// A free chain in motion and some other rates at the end of a step, far from those of the motion.
template <int D>
struct Step {
  Step(const ElementKindUnderTest& kind, int joint, double damping, unsigned seed, int rider = -1) : random(seed) {
    const ChainShape shape{
        .elements = 4, .joint = joint, .rational = kind.rational, .transport = kind.transport, .rider = rider};
    auto model = model_of<D>(shape, random);
    model.section.stiffness.law = kind.law;
    model.section.damping = damping;
    system = std::make_unique<BeamSystem<D>>(model, random_chain<D>(shape, random));
    n = system->coordinates();
    y0 = y1 = system->initial_state();
  }

  /// Ends the step in other rates, by up to `change` [m/s].
  void end(double h, double change) {
    const Eigen::VectorXd difference = Eigen::VectorXd::NullaryExpr(n, [&] { return random.uniform(-1, 1); });
    y1.segment(n, n) = y0.segment(n, n) + change * difference;
    y1.head(n) = y0.head(n) + h / 2 * (y0.segment(n, n) + y1.segment(n, n));
  }

  double residual(double h, Eigen::VectorXd& r) {
    ConservingStep<D> step(*system);
    r.resize(n);
    return step.residual(y0.head(n), y0.segment(n, n), y1.head(n), y1.segment(n, n), 0, h, r);
  }

  double energy(const Eigen::VectorXd& y) const { return system->observe(y, 0, own_points).energy.total(); }

  Random random;
  std::unique_ptr<BeamSystem<D>> system;
  Eigen::Index n = 0;
  Eigen::VectorXd y0, y1;
};

/// Elements whose weights stay with the element while its end moves.
bool frozen(const ElementKindUnderTest& kind) { return !kind.rational || kind.transport == WeightTransport::frozen; }

template <class Dimension>
class ConservingStepTest : public ::testing::Test {};
TYPED_TEST_SUITE(ConservingStepTest, Dimensions, DimensionNames);

/// For any two states, whether or not one follows from the other: the residual does the work E_1 - E_0 + dissipated.
TYPED_TEST(ConservingStepTest, WorkOfTheResidualIsTheChangeOfEnergy) {
  unsigned seed = 1;
  for (const auto& kind : element_family) {
    if (!frozen(kind)) continue;
    SCOPED_TRACE(kind.name());
    for (const int joint : {no_joint, 1, 2, 3}) {
      for (const double damping : {0.0, 0.01}) {
        Step<TypeParam::value> step(kind, joint, damping, seed++);
        const double h = 0.05;
        step.end(h, 0.5);
        Eigen::VectorXd r;
        const double power = step.residual(h, r);
        const double work = r.dot(step.y1.head(step.n) - step.y0.head(step.n));
        const double change = step.energy(step.y1) - step.energy(step.y0);
        EXPECT_GT(std::abs(change), 1e-2);
        EXPECT_NEAR(work, change + h * power, 1e-13 * (std::abs(work) + 1)) << "joint " << joint;
      }
    }
  }
}

TYPED_TEST(ConservingStepTest, WorkOfTheResidualIsTheChangeOfEnergyWithARider) {
  unsigned seed = 51;
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    for (const int rider : {0, 3}) {
      Step<TypeParam::value> step(kind, no_joint, 0, seed++, rider);
      const double h = 0.05;
      step.end(h, 0.5);
      Eigen::VectorXd r;
      step.residual(h, r);
      const double work = r.dot(step.y1.head(step.n) - step.y0.head(step.n));
      const double change = step.energy(step.y1) - step.energy(step.y0);
      EXPECT_GT(std::abs(change), 1e-2);
      EXPECT_NEAR(work, change, 1e-13 * (std::abs(work) + 1)) << "element " << rider;
    }
  }
}

/// Against M a - Q in the middle of the step, with a halving of the step: an error of second order.
TYPED_TEST(ConservingStepTest, ResidualTendsToTheEquationsOfMotion) {
  unsigned seed = 101;
  for (const auto& kind : element_family) {
    if (!frozen(kind)) continue;
    SCOPED_TRACE(kind.name());
    for (const auto& [joint, rider] : {std::pair{no_joint, -1}, {2, -1}, {no_joint, 3}}) {
      std::array<double, 2> error{};
      for (std::size_t i = 0; i < 2; ++i) {
        Step<TypeParam::value> step(kind, joint, 0.01, seed, rider);
        const double h = i == 0 ? 2e-3 : 1e-3;
        step.end(h, 4 * h);
        Eigen::VectorXd r, expected(step.n);
        step.residual(h, r);
        const Eigen::VectorXd middle = (step.y0 + step.y1) / 2;
        step.system->second_order()->residual(middle.head(step.n), middle.segment(step.n, step.n),
                                              (step.y1 - step.y0).segment(step.n, step.n) / h, h / 2, expected);
        error[i] = (r - expected).norm() / expected.norm();
      }
      EXPECT_LE(error[1], 1e-3);
      EXPECT_NEAR(error[0] / error[1], 4, 0.4) << "joint " << joint;
      ++seed;
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
