#include "mechanics/spin/spin_element.hpp"

#include <gtest/gtest.h>

#include "mechanics/flow/driven_residual.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

using First = Dual<double>;
using Second = Dual<First>;
template <class Real>
using Column = Eigen::Matrix<Real, 4, 1>;

constexpr SpinSection section{1.3, 0.9, 0};

template <class Real>
SpinCoordinates<Real> coordinates(const Column<Real>& q) {
  return {q[0], q[1], q[2], q[3]};
}

/// Angle of the material point x, and what follows from it alone.
template <class Real>
Real angle(const Column<Real>& q, const Real& x) {
  return q[0] + (q[1] - q[0]) * (x - q[2]) / (q[3] - q[2]);
}

/// The Lagrangian from its definition: Simpson's rule, exact for quadratic integrands, over the moving element.
template <class Real>
Real lagrangian(const Column<Real>& q, const Column<Real>& rate) {
  const Real l = q[3] - q[2];
  const std::array<double, 3> points{0, 0.5, 1}, weights{1.0 / 6, 4.0 / 6, 1.0 / 6};
  Real sum(0);
  for (std::size_t g = 0; g < 3; ++g) {
    const Real x = q[2] + Real(points[g]) * l;
    const Real omega = angle<Dual<Real>>(in_motion(q, rate), Dual<Real>(x, Real(0))).rate;
    const Column<Real> still = Column<Real>::Zero();
    const Real twist = angle<Dual<Real>>(in_motion(q, still), Dual<Real>(x, Real(1))).rate;
    sum += Real(weights[g]) * l * (Real(section.rhoIp / 2) * omega * omega - Real(section.GIp / 2) * twist * twist);
  }
  return sum;
}

struct Equations {
  Eigen::Matrix4d mass;
  Eigen::Vector4d force;
};

Equations from_lagrangian(const Eigen::Vector4d& q, const Eigen::Vector4d& rate) {
  auto second = [&](const Eigen::Vector4d& v1, const Eigen::Vector4d& q2, const Eigen::Vector4d& v2) {
    Column<Second> at, moving;
    for (int i = 0; i < 4; ++i) {
      at[i] = {First(q[i], 0), First(q2[i])};
      moving[i] = {First(rate[i], v1[i]), First(v2[i])};
    }
    return lagrangian<Second>(at, moving).rate.rate;
  };
  const Eigen::Vector4d still = Eigen::Vector4d::Zero();
  const Eigen::Vector4d by_position =
      gradient([&](const Column<First>& at) { return lagrangian<First>(at, Column<First>(rate.cast<First>())); }, q);
  Equations eq;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) eq.mass(i, j) = second(Eigen::Vector4d::Unit(i), still, Eigen::Vector4d::Unit(j));
    eq.force[i] = by_position[i] - second(Eigen::Vector4d::Unit(i), rate, still);
  }
  return eq;
}

/// Virtual work at fixed material points, by differentiation in time of the angle of each.
Equations from_virtual_work(const Eigen::Vector4d& q, const Eigen::Vector4d& rate) {
  Equations eq{Eigen::Matrix4d::Zero(), Eigen::Vector4d::Zero()};
  const std::array<double, 3> points{0, 0.5, 1}, weights{1.0 / 6, 4.0 / 6, 1.0 / 6};
  const double l = q[3] - q[2];
  for (std::size_t g = 0; g < 3; ++g) {
    const double x = q[2] + points[g] * l, w = weights[g] * l;
    Column<Second> moving;
    for (int i = 0; i < 4; ++i) moving[i] = {First(q[i], rate[i]), First(rate[i], 0)};
    const double remainder = angle<Second>(moving, Second(First(x, 0), First(0))).rate.rate;
    const double twist = (q[1] - q[0]) / l;
    Eigen::Vector4d by_angle, by_twist;
    for (int i = 0; i < 4; ++i) {
      Column<Second> varied;
      for (int j = 0; j < 4; ++j) varied[j] = {First(q[j], 0), First(i == j ? 1 : 0)};
      const Second at = angle<Second>(varied, Second(First(x, 1), First(0)));
      by_angle[i] = at.rate.value;
      by_twist[i] = at.rate.rate;
    }
    eq.mass += w * section.rhoIp * by_angle * by_angle.transpose();
    eq.force -= w * (section.rhoIp * remainder * by_angle + section.GIp * twist * by_twist);
  }
  return eq;
}

class SpinElement : public ::testing::Test {
 protected:
  void SetUp() override { draw(); }
  void draw() {
    q_ << random_.uniform(-1, 1), random_.uniform(-1, 1), 0.3, random_.uniform(0.8, 1.5);
    rate_ = random_.vector<4>();
    a_ = random_.vector<4>();
  }
  Eigen::Vector4d residual(Formulation formulation, const SpinSection& of = section) const {
    const auto eq = spin_equations(coordinates<double>(q_), coordinates<double>(rate_), formulation, of);
    auto one = [](double value) -> Vec<double, 1> { return Vec<double, 1>::Constant(value); };
    const MovingCoordinates<double, 1> a{{one(a_[0]), one(0), one(a_[1]), one(0)}, a_[2], a_[3]};
    const auto angles = nodal_residual(eq, a);
    const auto guiding = guiding_forces(eq, a);
    return {angles[0][0], angles[2][0], guiding[0], guiding[1]};
  }

  Random random_{7};
  Eigen::Vector4d q_, rate_, a_;
};

TEST_F(SpinElement, VariationalEquationsAreLagrangesOfTheMovingElement) {
  for (int i = 0; i < 8; ++i, draw()) {
    const Equations exact = from_lagrangian(q_, rate_);
    const Eigen::Vector4d expected = exact.mass * a_ - exact.force;
    EXPECT_LE((residual(Formulation::variational) - expected).norm(), 1e-13 * (1 + expected.norm()));
  }
}

TEST_F(SpinElement, VirtualWorkIsAtFixedMaterialPoints) {
  for (int i = 0; i < 8; ++i, draw()) {
    const Equations exact = from_virtual_work(q_, rate_);
    const Eigen::Vector4d expected = exact.mass * a_ - exact.force;
    EXPECT_LE((residual(Formulation::virtual_work) - expected).norm(), 1e-13 * (1 + expected.norm()));
  }
}

TEST_F(SpinElement, DifferByTheMomentumFluxAtTheEnds) {
  for (int i = 0; i < 8; ++i, draw()) {
    const SpinMotion<double> at(coordinates<double>(q_), coordinates<double>(rate_));
    const Eigen::Vector4d difference = residual(Formulation::variational) - residual(Formulation::virtual_work);
    const double inertia = section.rhoIp;
    EXPECT_NEAR(difference[0], -inertia * at.omega_a * rate_[2], 1e-13);  // matter leaves through A
    EXPECT_NEAR(difference[1], inertia * at.omega_b * rate_[3], 1e-13);
    // and by the configurational force: both parts of the energy that the ends pass
    auto density = [&](double omega) { return inertia * omega * omega / 2 + section.GIp * at.tau * at.tau / 2; };
    EXPECT_NEAR(difference[2],
                inertia * at.tau * at.omega_a * rate_[2] + density(at.omega_a) - section.GIp * at.tau * at.tau, 1e-13);
    EXPECT_NEAR(difference[3],
                -inertia * at.tau * at.omega_b * rate_[3] - density(at.omega_b) + section.GIp * at.tau * at.tau, 1e-13);
  }
}

TEST_F(SpinElement, UniformSpinIsFreeOfForceHoweverTheEndsMove) {
  for (int i = 0; i < 8; ++i, draw()) {
    q_[1] = q_[0];
    rate_[0] = rate_[1] = 370;
    a_[0] = a_[1] = 0;
    const Eigen::Vector4d virtual_work = residual(Formulation::virtual_work);
    EXPECT_LE(virtual_work.norm(), 1e-13 * 370);
    // the momentum that the matter brings in through the ends is all there is
    const Eigen::Vector4d r = residual(Formulation::variational);
    EXPECT_NEAR(r[0], -section.rhoIp * 370 * rate_[2], 1e-13 * 370 * 370);
    EXPECT_NEAR(r[1], section.rhoIp * 370 * rate_[3], 1e-13 * 370 * 370);
  }
}

TEST_F(SpinElement, DampingTakesThePowerItReports) {
  const SpinSection damped{section.rhoIp, section.GIp, 0.4};
  for (int i = 0; i < 8; ++i, draw()) {
    for (const Formulation formulation : formulations) {
      const Eigen::Vector4d viscous = residual(formulation, damped) - residual(formulation);
      const auto eq = spin_equations(coordinates<double>(q_), coordinates<double>(rate_), formulation, damped);
      EXPECT_GT(eq.dissipation, 0);
      EXPECT_NEAR(viscous.dot(rate_), eq.dissipation, 1e-13 * (1 + eq.dissipation));
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
