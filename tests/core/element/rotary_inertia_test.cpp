#include "mechanics/flow/rotary_inertia.hpp"

#include <gtest/gtest.h>

#include "core/element/quadrature.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

template <class Real>
using Column = Eigen::Matrix<Real, 14, 1>;  // r_A, s_A, r_B, s_B, x_A, x_B

const RotaryInertia<3> rotary{1.3, 0.7, Eigen::Vector3d(1, 2, -2) / 3};

/// Position of the material point x by Hermite's formula.
template <class Real>
Vec<Real, 3> axis(const Column<Real>& q, const Real& x) {
  const Real l = q[13] - q[12], u = (x - q[12]) / l, v = Real(1) - u;
  Vec<Real, 3> r;
  for (int c = 0; c < 3; ++c) {
    r[c] = v * v * (Real(1) + Real(2) * u) * q[c] + l * u * v * v * q[3 + c] +
           u * u * (Real(3) - Real(2) * u) * q[6 + c] - l * u * u * v * q[9 + c];
  }
  return r;
}

template <class Real>
Real lagrangian(const Column<Real>& q, const Column<Real>& rate) {
  using D1 = Dual<Real>;
  using D2 = Dual<D1>;
  const Real l = q[13] - q[12];
  Real sum(0);
  for (const auto& [u, w] : gauss_legendre(4)) {
    const Real x = q[12] + Real(u) * l;
    Column<D2> moving;  // x in the inner part, time in the outer
    for (int i = 0; i < 14; ++i) moving[i] = {D1(q[i], Real(0)), D1(rate[i], Real(0))};
    const auto r = axis<D2>(moving, D2(D1(x, Real(1)), D1(Real(0), Real(0))));
    Vec<Real, 3> slope, turning;
    for (int c = 0; c < 3; ++c) {
      slope[c] = r[c].value.rate;
      turning[c] = r[c].rate.rate;
    }
    Real triple(0);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      triple += Real(rotary.direction[c]) * (slope[d] * turning[e] - slope[e] * turning[d]);
    }
    Real along(0);
    for (int c = 0; c < 3; ++c) along += Real(rotary.direction[c]) * turning[c];
    sum += Real(w) * l *
           (Real(rotary.rhoJ / 2) * (turning.dot(turning) - along * along) - Real(rotary.gyroscopic / 2) * triple);
  }
  return sum;
}

NodalCubic<double, 3> nodal(const Column<double>& q) {
  return {q.segment<3>(0), q.segment<3>(3), q.segment<3>(6), q.segment<3>(9)};
}

TEST(RotaryInertia, FollowsLagrangesEquationsOfTheMovingElement) {
  Random random(8);
  for (int repeat = 0; repeat < 4; ++repeat) {
    Column<double> q = random.vector<14>(), rate = random.vector<14>(), a = random.vector<14>();
    q[12] = 0.2;
    q[13] = random.uniform(0.9, 1.4);
    const Column<double> expected = lagrange_residual(
        []<class Real>(const Column<Real>& at, const Column<Real>& moving) { return lagrangian<Real>(at, moving); }, q,
        rate, a);
    const Prescribed x_a{q[12], rate[12], a[12]}, x_b{q[13], rate[13], a[13]};
    const ShapeTabulation table(beam_rule(4), unit_weights);
    const RotaryElement element(x_a, x_b, table);
    const auto residual = element.residual(rotary, nodal(q), nodal(rate));
    const auto inertia = element.inertia(rotary, nodal(a));
    const double size = expected.lpNorm<Eigen::Infinity>();
    double error = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d row = expected.segment<3>(3 * static_cast<int>(i));
      error = std::max(error, (residual[i] + inertia[i] - row).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LE(error, 1e-13 * size);
    // all forces, guiding ones among them, supply the energy
    const double power = rotary_power(rotary, x_a, x_b, table, nodal(q), nodal(rate), nodal(a));
    EXPECT_LE(std::abs(power - expected.dot(rate)), 1e-12 * size);

    // everything is linear in the nodal coordinates: the tangent maps them to the residual
    const TangentWeights by{0.7, 1.9, 2.3};
    const Eigen::Matrix<double, 12, 1> d = random.vector<12>();
    Column<double> along = Column<double>::Zero();
    along.head<12>() = d;
    const Eigen::Matrix<double, 12, 1> mapped = element.tangent(rotary, by) * d;
    const auto moved = element.residual(rotary, nodal(by.q * along), nodal(by.v * along));
    const auto pushed = element.inertia(rotary, nodal(by.a * along));
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LE((mapped.segment<3>(3 * static_cast<int>(i)) - moved[i] - pushed[i]).norm(), 1e-13 * mapped.norm());
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
