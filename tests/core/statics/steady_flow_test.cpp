#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/flow/flow_room.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/flows.hpp"

namespace vlbeam::test {
namespace {

template <int D>
std::vector<double> span_frequencies(int elements, bool bends, double raise = 1, double speed = 40) {
  const BeamModel<D> model = moving_span<D>(elements, bends, speed, raise);
  BeamSystem<D> beam(model, straight_chain(model));
  const Eigen::VectorXd y = steady_state(beam, moving_span_state(beam, speed));
  return frequencies(eigenvalues(linear_flows(beam, y).axis));
}

// Four elements linearised about the stretched moving state; the exact values are those of the linear theory, of a
// string (c^2 - v^2)/(2 l c) and of a beam (quartic dispersion relation, simply supported).
TEST(SteadyFlow, FrequenciesOfAnAxiallyMovingStringAndBeam) {
  EXPECT_NEAR(span_frequencies<2>(4, false).front(), 22.690807, 1e-6);
  EXPECT_NEAR(span_frequencies<2>(4, true).front(), 32.190676, 1e-6);
  EXPECT_NEAR(span_frequencies<2>(4, false, 1e4).front(), 22.68663, 1e-5);
  EXPECT_NEAR(span_frequencies<2>(4, true, 1e4).front(), 32.18760, 1e-5);
  EXPECT_NEAR(span_frequencies<2>(32, true, 1e4).front(), 32.165173959848, 1e-5);
}

TEST(SteadyFlow, InSpaceEveryTransverseFrequencyIsThereTwice) {
  const auto planar = span_frequencies<2>(4, true), spatial = span_frequencies<3>(4, true);
  EXPECT_NEAR(spatial[0], planar[0], 1e-9 * planar[0]);
  EXPECT_NEAR(spatial[1], planar[0], 1e-9 * planar[0]);
}

TEST(SteadyFlow, ThereIsNoStableOneAtOrAboveTheCriticalSpeed) {
  const double critical = 80;  // of the beam above: sqrt((F + EI pi^2/l^2)/rhoA), 79.6 m/s
  const BeamModel<2> model = moving_span<2>(8, true, critical);
  BeamSystem<2> beam(model, straight_chain(model));
  EXPECT_THROW(steady_state(beam, moving_span_state(beam, critical)), ComputationFailed);
  const Eigen::VectorXd y = steady_state(beam, moving_span_state(beam, critical), 0, true);
  EXPECT_GT(growth_rate(eigenvalues(linear_flows(beam, y).axis)), 1);
}

TEST(SteadyFlow, OfAHangingBeamIsItsStaticShape) {
  BeamModel<2> model = moving_span<2>(8, true, 0);
  model.gravity = {0, -9.81};
  BeamSystem<2> beam(model, straight_chain(model));
  const Eigen::VectorXd y = steady_state(beam, moving_span_state(beam, 0));
  Eigen::VectorXd dydt(y.size());
  beam.rhs(y, dydt, 0);
  const double tension = 1000, sag = model.section.rhoA * 9.81 / (8 * tension);
  EXPECT_LE(dydt.tail(beam.coordinates()).norm(), 1e-4);
  EXPECT_NEAR(-position<2>(y.data(), 4)[1], sag, 0.6 * sag);  // bending stiffness carries a part of it
  EXPECT_GT(-position<2>(y.data(), 4)[1], 0.4 * sag);
}

// Of a simply supported Rayleigh shaft of wave number k = n pi/l the whirling frequencies solve
// (rhoA + rhoJ k^2) omega^2 - rhoI_p Omega k^2 omega - EI k^4 = 0: forward (omega > 0) and backward.
TEST(SteadyFlow, RotaryInertiaSplitsTheWhirlOfASpinningShaft) {
  const CircularShaft shaft{.radius = 0.05, .density = 7800, .youngs_modulus = 2e11};
  const double spin = 2000;
  const SpinSection section = shaft.spin();
  const double k2 = std::numbers::pi * std::numbers::pi, m = shaft.section().rhoA + section.rhoIp / 2 * k2;
  const double g = section.rhoIp * spin * k2, stiffness = shaft.section().stiffness.EI * k2 * k2;
  const double root = std::sqrt(g * g + 4 * m * stiffness);
  const double forward = (root + g) / (2 * m) / (2 * std::numbers::pi),
               backward = (root - g) / (2 * m) / (2 * std::numbers::pi);
  EXPECT_GT(forward / backward, 1.01);
  std::vector<double> errors;
  for (const int elements : {4, 8, 16}) {
    BeamModel<3> model;
    model.section = shaft.section();
    spin_in(model).section = section;
    flow_in(model).rotary = {section.rhoIp / 2, section.rhoIp * spin, Eigen::Vector3d::UnitX()};
    flow_in(model).motion = MeshMotion({{0, steadily(0, 0)}, {elements, steadily(1, 0)}});
    model.start = Support<3>::pin();
    model.end = Support<3>::slide(Eigen::Vector3d::UnitX());
    BeamSystem<3> beam(model, straight_chain(model));
    const Eigen::VectorXd y = straight_state<3>(beam, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 1, 0, spin);
    const auto found = frequencies(eigenvalues(linear_flows(beam, y).axis));
    errors.push_back(std::hypot(found[0] / backward - 1, found[1] / forward - 1));
  }
  EXPECT_LE(errors[0], 5e-4);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 4, 0.2);
}

TEST(SteadyFlow, TorsionOfAFlowingRodNeedsTheMomentumFluxAtTheNodes) {
  const std::pair<int, double> expected[] = {{4, 0.40024}, {8, 0.38121}, {16, 0.37655}, {32, 0.37539}, {64, 0.37510}};
  for (const auto& [elements, frequency] : expected) {
    EXPECT_NEAR(flowing_rod(elements, Formulation::variational), frequency, 1e-5) << elements;
  }
  // without it the term v^2 theta_xx is lost, and with it the frequency tends to c^2/(2 l sqrt(c^2 + v^2))
  EXPECT_NEAR(flowing_rod(64, Formulation::virtual_work), 0.4472, 1e-3);
}

}  // namespace
}  // namespace vlbeam::test
