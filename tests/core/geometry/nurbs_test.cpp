#include "core/geometry/nurbs.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

/// B-spline basis function by its definition (Cox and de Boor's recursion), the last interval closed.
double basis(const std::vector<double>& t, std::size_t i, int p, double u, double domain_end) {
  if (p == 0) {
    const bool last = u == domain_end && t[i + 1] == domain_end && t[i] < domain_end;
    return (t[i] <= u && u < t[i + 1]) || last ? 1 : 0;
  }
  const auto pu = static_cast<std::size_t>(p);
  double sum = 0;
  if (t[i + pu] > t[i]) sum += (u - t[i]) / (t[i + pu] - t[i]) * basis(t, i, p - 1, u, domain_end);
  if (t[i + pu + 1] > t[i + 1]) {
    sum += (t[i + pu + 1] - u) / (t[i + pu + 1] - t[i + 1]) * basis(t, i + 1, p - 1, u, domain_end);
  }
  return sum;
}

Vec<double, 3> evaluate(const Nurbs<3>& c, double u) {
  Vec<double, 3> sum = Vec<double, 3>::Zero();
  double weight = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const double b = basis(c.knots, i, c.degree, u, c.knots[c.points.size()]) * c.weights[i];
    sum += b * c.points[i];
    weight += b;
  }
  return sum / weight;
}

Nurbs<3> random_nurbs(int degree, std::vector<double> knots, Random& random) {
  Nurbs<3> c{degree, std::move(knots), {}, {}};
  for (std::size_t i = 0; i + static_cast<std::size_t>(degree) + 1 < c.knots.size(); ++i) {
    c.points.push_back(Vec<double, 3>(static_cast<double>(i), 0, 0) + random.vector<3>(0.4));
    c.weights.push_back(random.uniform(0.5, 2));
  }
  return c;
}

TEST(Nurbs, SpansAreTheCurveByItsDefinition) {
  Random random(3);
  const std::vector<Nurbs<3>> curves{random_nurbs(3, {0, 0, 0, 0, 0.4, 1, 1, 2.5, 2.5, 2.5, 2.5}, random),
                                     random_nurbs(3, {0, 0.3, 0.5, 1, 1.4, 2, 2.5, 3, 3.1}, random),  // not clamped
                                     random_nurbs(2, {-1, -1, -1, 0, 2, 3, 3, 3}, random),
                                     random_nurbs(1, {0, 0, 1, 1}, random)};
  for (const auto& curve : curves) {
    const auto spans = rational_spans(curve);
    for (const auto& span : spans) {
      const double a = curve.knots[span.knot], b = curve.knots[span.knot + 1];
      for (const double s : {0.0, 0.2, 0.5, 0.9}) {
        EXPECT_LE((span.curve.evaluate(s)[0] - evaluate(curve, a + s * (b - a))).norm(), 1e-13);
      }
    }
    EXPECT_LE((spans.back().curve.evaluate(1.0)[0] - evaluate(curve, curve.knots[curve.points.size()])).norm(), 1e-13);
  }
}

void expect_error(const Nurbs<2>& curve, const std::string& field, std::size_t index) {
  try {
    rational_spans(curve);
    FAIL() << "accepted";
  } catch (const NurbsError& error) {
    EXPECT_EQ(error.field, field);
    EXPECT_EQ(error.index, index);
  }
}

TEST(Nurbs, ErrorsNameTheKnotOrPoint) {
  const Nurbs<2> good{2, {0, 0, 0, 1, 2, 2, 2}, {1, 1, 1, 1}, {{0, 0}, {1, 0}, {2, 1}, {3, 1}}};
  EXPECT_NO_THROW(rational_spans(good));
  auto bad = good;
  bad.knots[4] = 0.5;
  expect_error(bad, "knots", 4);
  bad = good;
  bad.knots.push_back(2);
  expect_error(bad, "knots", 8);
  bad = good;
  bad.weights[2] = 0;
  expect_error(bad, "weights", 2);
  bad = good;
  bad.weights.pop_back();
  expect_error(bad, "weights", 3);
  bad = good;
  bad.points.resize(2);
  bad.weights.resize(2);
  expect_error(bad, "control_points", 2);
  bad = good;
  for (auto& point : bad.points) point.setZero();
  expect_error(bad, "knots", 2);
  const Nurbs<2> torn{1, {0, 0, 1, 1, 2, 2}, {1, 1, 1, 1}, {{0, 0}, {1, 0}, {2, 0}, {3, 0}}};
  expect_error(torn, "knots", 3);
}

TEST(Nurbs, ADoubleKnotOfAQuadraticIsAKinkUnlessItsNeighboursAreInLine) {
  Nurbs<2> curve{2, {0, 0, 0, 1, 1, 2, 2, 2}, {1, 1, 1, 1, 1}, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}};
  EXPECT_FALSE(rational_spans(curve)[0].kinked);
  EXPECT_TRUE(rational_spans(curve)[1].kinked);
  curve.points[3] = {3, 0};
  EXPECT_FALSE(rational_spans(curve)[1].kinked);
}

}  // namespace
}  // namespace vlbeam::test
