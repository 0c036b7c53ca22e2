#include "core/element/rotary_inertia.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/dual.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

using First = Dual<double>;
using Second = Dual<First>;
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
    auto second = [&](const Column<double>& v1, const Column<double>& q2, const Column<double>& v2) {
      Column<Second> at, moving;
      for (int i = 0; i < 14; ++i) {
        at[i] = {First(q[i], 0), First(q2[i])};
        moving[i] = {First(rate[i], v1[i]), First(v2[i])};
      }
      return lagrangian<Second>(at, moving).rate.rate;
    };
    const Column<double> still = Column<double>::Zero();
    const Column<double> by_position =
        gradient([&](const Column<First>& at) { return lagrangian<First>(at, Column<First>(rate.cast<First>())); }, q);
    const Prescribed x_a{q[12], rate[12], a[12]}, x_b{q[13], rate[13], a[13]};
    const ShapeTabulation table(gauss_legendre(4), unit_weights);
    const RotaryElement element(x_a, x_b, table);
    const auto residual = element.residual(rotary, nodal(q), nodal(rate));
    double power = rotary_power(rotary, x_a, x_b, table, nodal(q), nodal(rate), nodal(a)), size = 0, error = 0;
    for (int i = 0; i < 14; ++i) {
      const Column<double> unit = Column<double>::Unit(i);
      const double expected = second(unit, rate, still) + second(unit, still, a) - by_position[i];
      power -= expected * rate[i];  // all forces, guiding ones among them, supply the energy
      if (i >= 12) continue;
      double found = residual[static_cast<std::size_t>(i / 3)][i % 3];
      found += element.inertia(rotary, nodal(a))[static_cast<std::size_t>(i / 3)][i % 3];
      size = std::max(size, std::abs(expected));
      error = std::max(error, std::abs(found - expected));
    }
    EXPECT_LE(error, 1e-13 * size);
    EXPECT_LE(std::abs(power), 1e-12 * size);
  }
}

}  // namespace
}  // namespace vlbeam::test
