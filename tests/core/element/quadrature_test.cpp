#include "core/element/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace vlbeam::test {
namespace {

TEST(Quadrature, IntegratesPolynomialsUpToTheRulesDegreeAndNoFurther) {
  for (int count = 1; count <= max_quadrature_points; ++count) {
    const auto& rule = gauss_legendre(count);
    ASSERT_EQ(rule.size(), static_cast<std::size_t>(count));
    auto integral = [&](int degree) {
      double sum = 0;
      for (const auto& [u, weight] : rule) sum += weight * std::pow(u, degree);
      return sum;
    };
    for (int degree = 0; degree < 2 * count; ++degree) EXPECT_NEAR(integral(degree), 1.0 / (degree + 1), 1e-15);
    if (count > 8) continue;  // the error sinks into roundoff
    EXPECT_GT(std::abs(integral(2 * count) - 1.0 / (2 * count + 1)), 1e-11);
  }
}

TEST(Quadrature, PointsLieInIncreasingOrderInsideTheInterval) {
  for (int count = 1; count <= max_quadrature_points; ++count) {
    double last = 0;
    for (const auto& point : gauss_legendre(count)) {
      EXPECT_GT(point.u, last);
      last = point.u;
    }
    EXPECT_LT(last, 1);
  }
}

TEST(Quadrature, OtherNumbersOfPointsAreRefused) {
  EXPECT_THROW(gauss_legendre(0), std::out_of_range);
  EXPECT_THROW(gauss_legendre(-1), std::out_of_range);
  EXPECT_THROW(gauss_legendre(max_quadrature_points + 1), std::out_of_range);
}

}  // namespace
}  // namespace vlbeam::test
