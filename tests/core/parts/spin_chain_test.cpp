#include "mechanics/spin/spin_chain.hpp"

#include <gtest/gtest.h>

#include "core/element/quadrature.hpp"
#include "core/element/twist_law.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/flows.hpp"

namespace vlbeam::test {
namespace {

template <class Real>
using Column = Eigen::Matrix<Real, 6, 1>;  // angle and twist at A, at B, x_A, x_B

constexpr SpinSection spinning{1.3, 0.9, 0};

/// Angle of the material point x: the cubic with the nodal angles and twists, from its divided differences.
template <class Real>
Real angle(const Column<Real>& q, const Real& x) {
  const Real l = q[5] - q[4], s = x - q[4], d = (q[2] - q[0]) / l;
  const Real first = (d - q[1]) / l, second = (q[3] - d) / l;
  return q[0] + q[1] * s + first * s * s + (second - first) / l * s * s * (x - q[5]);
}

/// The Lagrangian from its definition, on the given points of the moving element.
template <class Real>
Real lagrangian(const Column<Real>& q, const Column<Real>& rate) {
  Real sum(0);
  const Real l = q[5] - q[4];
  for (const auto& [u, w] : gauss_legendre(5)) {
    const Real x = q[4] + Real(u) * l;
    const Real omega = angle<Dual<Real>>(in_motion(q, rate), Dual<Real>(x, Real(0))).rate;
    const Column<Real> still = Column<Real>::Zero();
    const Real twist = angle<Dual<Real>>(in_motion(q, still), Dual<Real>(x, Real(1))).rate;
    sum += Real(w) * l * (Real(spinning.rhoIp / 2) * omega * omega - Real(spinning.GIp / 2) * twist * twist);
  }
  return sum;
}

SpinChain::Coordinates coordinates(const Column<double>& q) {
  auto one = [](double value) -> Vec<double, 1> { return Vec<double, 1>::Constant(value); };
  return {{one(q[0]), one(q[1]), one(q[2]), one(q[3])}, q[4], q[5]};
}

TEST(SpinChain, CubicAngleFollowsLagrangesEquationsOfTheMovingElement) {
  Random random(3);
  const SpinChain chain(spinning, AngleField::hermite, Formulation::variational, 1, 5, {});
  for (int repeat = 0; repeat < 8; ++repeat) {
    Column<double> q = random.vector<6>(), rate = random.vector<6>(), a = random.vector<6>();
    q[4] = 0.3;
    q[5] = random.uniform(0.9, 1.6);
    const Column<double> expected = lagrange_residual(
        []<class Real>(const Column<Real>& at, const Column<Real>& moving) { return lagrangian<Real>(at, moving); }, q,
        rate, a);
    const auto eq = chain.equations(coordinates(q), coordinates(rate));
    const auto nodal = nodal_residual(eq, coordinates(a));
    const auto guiding = guiding_forces(eq, coordinates(a));
    Column<double> residual;
    residual << nodal[0], nodal[1], nodal[2], nodal[3], guiding[0], guiding[1];
    EXPECT_LE((residual - expected).norm(), 1e-12 * (1 + expected.norm()));
  }
}

TEST(SpinChain, ResidualIsThatOfTheEquations) {
  Random random(7);
  constexpr int elements = 3;
  for (const AngleField field : {AngleField::linear, AngleField::hermite}) {
    SpinChain chain(spinning, field, Formulation::variational, elements, 5, {});
    SpinChain::Nodes nodes;
    for (int k = 0; k <= elements; ++k) {
      nodes.push_back({k + random.uniform(-0.2, 0.2), random.uniform(-1, 1), random.uniform(-1, 1)});
    }
    const Eigen::Index n = chain.coordinates();
    const auto any = [&] { return Eigen::VectorXd::NullaryExpr(n, [&] { return random.uniform(-1, 1); }).eval(); };
    const Eigen::VectorXd q = any(), rate = any(), a = any();
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(n), residual = Eigen::VectorXd::Zero(n);
    chain.evaluate(q.data(), rate.data(), nodes);
    chain.add_residual(a.data(), nodes, expected.data());
    const double lost = chain.residual(q.data(), rate.data(), a.data(), nodes, residual.data());
    EXPECT_NEAR(lost, chain.dissipation(), 1e-14);
    EXPECT_LE((residual - expected).norm(), 1e-13 * expected.norm());
    for (int k = 0; k < elements; ++k) {
      const auto at = chain.local(q.data(), nodes, &Prescribed::value, k);
      const auto guiding = guiding_forces(chain.equations(at, chain.local(rate.data(), nodes, &Prescribed::rate, k)),
                                          chain.local(a.data(), nodes, &Prescribed::acceleration, k));
      for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(chain.guiding_forces(k)[i], guiding[i], 1e-13);
    }
  }
}

TEST(SpinChain, CubicAngleThatIsLinearHasTheTwistOfTheClosedForm) {
  const SpinChain linear(spinning, AngleField::linear, Formulation::variational, 1, 5, {});
  const SpinChain cubic(spinning, AngleField::hermite, Formulation::variational, 1, 5, {});
  Column<double> q, rate;
  q << 0.2, 0.5, 0.7, 0.5, 0.1, 1.1;  // twist 0.5 all along
  rate << 1, 0, 1.4, 0, -0.3, 0.7;
  const double twist_rate = ((rate[2] - 0.5 * rate[5]) - (rate[0] - 0.5 * rate[4])) / 1.0;
  rate[1] = rate[3] = twist_rate;  // so does its rate
  for (const double u : {0.0, 0.3, 1.0}) {
    const auto a = linear.at(coordinates(q), coordinates(rate), u), b = cubic.at(coordinates(q), coordinates(rate), u);
    EXPECT_NEAR(a.twist, b.twist, 1e-14);
    EXPECT_NEAR(a.spin, b.spin, 1e-14);
  }
}

TEST(SpinChain, CubicAngleOfAFlowingRodConvergesWithOrderSix) {
  const double coarse = flowing_rod(8, Formulation::variational, AngleField::hermite) - 0.375,
               fine = flowing_rod(16, Formulation::variational, AngleField::hermite) - 0.375;
  EXPECT_LE(std::abs(coarse), 1e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 6, 0.3);
}

}  // namespace
}  // namespace vlbeam::test
