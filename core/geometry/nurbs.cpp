#include "core/geometry/nurbs.hpp"

#include <algorithm>
#include <cmath>

namespace vlbeam {
namespace {

constexpr double kink = 1e-9;  // sine of the angle between two tangents that are one direction

template <int D>
void check(const Nurbs<D>& c) {
  const auto p = static_cast<std::size_t>(c.degree);
  if (c.points.size() < p + 1) {
    throw NurbsError("control_points", c.points.size(), "there must be at least degree + 1 of them");
  }
  if (c.weights.size() != c.points.size()) {
    throw NurbsError("weights", c.weights.size(),
                     "there must be one for each of the " + std::to_string(c.points.size()) + " control points");
  }
  if (c.knots.size() != c.points.size() + p + 1) {
    throw NurbsError(
        "knots", c.knots.size(),
        "there must be as many as control points, degree and 1 together: " + std::to_string(c.points.size() + p + 1));
  }
  for (std::size_t i = 0; i < c.weights.size(); ++i) {
    if (!(c.weights[i] > 0)) throw NurbsError("weights", i, "it must be a number > 0");
  }
  for (std::size_t i = 1; i < c.knots.size(); ++i) {
    if (!(c.knots[i] >= c.knots[i - 1])) throw NurbsError("knots", i, "knots must not decrease");
  }
  if (!(c.knots[c.points.size()] > c.knots[p])) {
    throw NurbsError("knots", p, "the curve's domain, from this knot to the one before the last `degree`, is empty");
  }
  for (std::size_t i = p + 1; i + p < c.knots.size(); ++i) {
    const bool inside = c.knots[i] > c.knots[p] && c.knots[i] < c.knots[c.points.size()];
    if (inside && c.knots[i] == c.knots[i - p]) {
      throw NurbsError("knots", i, "more than `degree` equal knots tear the curve");
    }
  }
}

/// The polar form of the span that starts at knot k, at as many arguments as the degree (de Boor's algorithm with an
/// argument of its own for each level), in homogeneous coordinates.
template <int D>
Vec<double, D + 1> polar(const Nurbs<D>& c, std::size_t k, const std::array<double, 3>& arguments) {
  const auto p = static_cast<std::size_t>(c.degree);
  std::array<Vec<double, D + 1>, 4> d;
  for (std::size_t i = 0; i <= p; ++i) {
    const std::size_t at = k - p + i;
    d[i] << c.points[at] * c.weights[at], c.weights[at];
  }
  for (std::size_t level = 1; level <= p; ++level) {
    for (std::size_t i = p; i >= level; --i) {
      const double low = c.knots[k - p + i], high = c.knots[k + 1 + i - level];
      const double share = (arguments[level - 1] - low) / (high - low);
      d[i] = d[i - 1] * (1 - share) + d[i] * share;
    }
  }
  return d[p];
}

/// Bezier points of the span from knot k to the next, raised to degree 3.
template <int D>
RationalCubic<double, D> span_at(const Nurbs<D>& c, std::size_t k) {
  const auto p = static_cast<std::size_t>(c.degree);
  std::vector<Vec<double, D + 1>> bezier;
  for (std::size_t j = 0; j <= p; ++j) {
    std::array<double, 3> arguments{};
    for (std::size_t i = 0; i < p; ++i) arguments[i] = c.knots[i < p - j ? k : k + 1];
    bezier.push_back(polar(c, k, arguments));
  }
  while (bezier.size() < 4) {
    const std::size_t n = bezier.size();
    std::vector<Vec<double, D + 1>> raised{bezier.front()};
    for (std::size_t i = 1; i < n; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(n);
      raised.push_back(bezier[i - 1] * share + bezier[i] * (1 - share));
    }
    raised.push_back(bezier.back());
    bezier = raised;
  }
  RationalCubic<double, D> curve;
  for (std::size_t i = 0; i < 4; ++i) {
    curve.weights[i] = bezier[i][D];
    curve.points[i] = bezier[i].template head<D>() / bezier[i][D];
  }
  return curve;
}

}  // namespace

template <int D>
std::vector<NurbsSpan<D>> rational_spans(const Nurbs<D>& curve) {
  check(curve);
  std::vector<NurbsSpan<D>> spans;
  Vec<double, D> tangent = Vec<double, D>::Zero();
  for (auto k = static_cast<std::size_t>(curve.degree); k < curve.points.size(); ++k) {
    if (!(curve.knots[k + 1] > curve.knots[k])) continue;
    const auto span = span_at(curve, k);
    const auto& P = span.points;
    double size = 0;
    for (std::size_t i = 1; i < 4; ++i) size = std::max(size, (P[i] - P[0]).norm());
    const Vec<double, D> out = P[1] - P[0], in = P[3] - P[2];
    if (!(size > 0)) throw NurbsError("knots", k, "the curve from this knot to the next has no length");
    if (!(std::min(out.norm(), in.norm()) > 1e-12 * size)) {
      throw NurbsError("knots", k, "the curve from this knot to the next starts or ends without a direction");
    }
    const bool kinked = !spans.empty() && !((out.normalized() - tangent).norm() < kink);
    tangent = in.normalized();
    spans.push_back({k, span, kinked});
  }
  return spans;
}

template std::vector<NurbsSpan<2>> rational_spans(const Nurbs<2>&);
template std::vector<NurbsSpan<3>> rational_spans(const Nurbs<3>&);

}  // namespace vlbeam
