#include "core/element/shape_functions.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

constexpr std::array<double, 5> within_and_beyond{-0.1, 0, 0.35, 1, 1.2};

TEST(ShapeFunctions, ThoseOfThePositionsSumToOne) {
  Random random(4);
  for (const double u : within_and_beyond) {
    const auto f = rational_shape(random.weights(5), u), h = hermite_shape(u);
    EXPECT_NEAR(f[0][0] + f[2][0], 1, 1e-14);
    EXPECT_NEAR(h[0][0] + h[2][0], 1, 1e-14);
    for (std::size_t n = 1; n < 4; ++n) {
      EXPECT_NEAR(f[0][n] + f[2][n], 0, 1e-12 * (1 + std::abs(f[0][n])));
      EXPECT_NEAR(h[0][n] + h[2][n], 0, 1e-12);
    }
  }
}

TEST(ShapeFunctions, EqualWeightsGiveHermites) {
  for (const double u : within_and_beyond) {
    const auto f = rational_shape<double>({0.4, 0.4, 0.4, 0.4}, u), h = hermite_shape(u);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(f[i][n], h[i][n], 1e-13 * (1 + std::abs(h[i][n])));
    }
  }
}

TEST(ShapeFunctions, HermitesAreTheKnownCubics) {
  for (const double u : within_and_beyond) {
    const auto h = hermite_shape(u);
    const std::array<double, 4> exact{1 - 3 * u * u + 2 * u * u * u, u - 2 * u * u + u * u * u,
                                      3 * u * u - 2 * u * u * u, u * u * u - u * u};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(h[i][0], exact[i], 1e-15);
  }
}

TEST(ShapeFunctions, InterpolateEndPositionsAndSlopes) {
  Random random(4);
  const auto w = random.weights(5);
  const auto a = rational_shape(w, 0.0), b = rational_shape(w, 1.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(a[i][0], i == 0, 1e-15);
    EXPECT_NEAR(a[i][1], i == 1, 1e-14);
    EXPECT_NEAR(b[i][0], i == 2, 1e-15);
    EXPECT_NEAR(b[i][1], i == 3, 1e-14);
  }
}

TEST(ShapeFunctions, TheirCurveIsTheRationalCubic) {
  Random random(4);
  const auto w = random.weights(5);
  const double l = 0.7;
  const NodalCubic<double, 3> e{random.vector<3>(), random.vector<3>(), random.vector<3>(), random.vector<3>()};
  const auto curve = RationalCubic<double, 3>::from_nodal(e, l, w);
  for (const double u : within_and_beyond) {
    const auto f = rational_shape(w, u);
    const auto r = curve.evaluate(u);
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec<double, 3> sum = f[0][n] * e.r_a + f[1][n] * l * e.s_a + f[2][n] * e.r_b + f[3][n] * l * e.s_b;
      EXPECT_LE((sum - r[n]).norm(), 1e-13 * (1 + r[n].norm()));
    }
  }
}

TEST(ShapeFunctions, HigherOnesAreDerivativesOfTheFirst) {
  using Second = Dual<Dual<double>>;
  using Third = Dual<Second>;
  Random random(4);
  for (const double at : within_and_beyond) {
    const auto w = random.weights(5);
    const Third u(Second(Dual<double>(at, 1), 1), 1);
    const auto exact = rational_shape<Third>({Third(w[0]), Third(w[1]), Third(w[2]), Third(w[3])}, u);
    const auto f = rational_shape(w, at);
    for (std::size_t i = 0; i < 4; ++i) {
      const Third& value = exact[i][0];
      EXPECT_NEAR(f[i][1], value.value.value.rate, 1e-12 * (1 + std::abs(f[i][1])));
      EXPECT_NEAR(f[i][2], value.value.rate.rate, 1e-12 * (1 + std::abs(f[i][2])));
      EXPECT_NEAR(f[i][3], value.rate.rate.rate, 1e-12 * (1 + std::abs(f[i][3])));
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
