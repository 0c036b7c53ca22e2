#include "studies/exact_solutions/axis.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/elementary.hpp"

namespace vlbeam::exact_solutions {
namespace {

constexpr int steps = 4096;
constexpr int per_element = 8;  // intervals, an even number: Simpson's rule

/// Under the force `along` the axis, where a beam has the moment mu.
double stretch(const Piece& piece, double mu, double along) {
  if (piece.law == Stretching::none) return 1;
  if (piece.law == Stretching::engineering) return 1 + along / piece.EA;
  const double bent = piece.EI > 0 ? mu * mu / piece.EI : 0;
  double l = 1;
  for (int i = 0; i < 60; ++i) {
    const double change = (piece.EA * l * (l * l - 1) / 2 - l * bent - along) / (piece.EA * (3 * l * l - 1) / 2 - bent);
    l -= change;
    if (std::abs(change) < 1e-16) break;
  }
  return l;
}

}  // namespace

KnownAxis::KnownAxis(const Piece& piece) : piece_(piece) {
  states_.push_back({piece.start[0], piece.start[1], piece.angle, piece.moment});
  const double h = piece.length / steps;
  for (int i = 0; i < steps; ++i) states_.push_back(step(states_.back(), i * h, h));
}

KnownAxis::State KnownAxis::rates(const State& at, double s) const {
  const double H = piece_.pull[0], V = piece_.pull[1] + piece_.weight * s;
  if (piece_.EI == 0) {
    const double T = portable::hypot(H, V), l = stretch(piece_, 0, T);
    return {l * H / T, l * V / T, 0, 0};
  }
  const double c = portable::cos(at[2]), sine = portable::sin(at[2]);
  const double l = stretch(piece_, at[3], H * c + V * sine);
  return {l * c, l * sine, at[3] / piece_.EI * (piece_.law == Stretching::green ? l * l : 1), -l * (V * c - H * sine)};
}

KnownAxis::State KnownAxis::step(const State& from, double s, double h) const {
  const auto moved = [&](const State& rate, double by) {
    State to = from;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += by * rate[i];
    return to;
  };
  const State a = rates(from, s), b = rates(moved(a, h / 2), s + h / 2), c = rates(moved(b, h / 2), s + h / 2),
              d = rates(moved(c, h), s + h);
  State to = from;
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  return to;
}

AxisPoint KnownAxis::at(double s) const {
  const double h = piece_.length / steps;
  const double i = std::clamp(std::round(s / h), 0.0, static_cast<double>(steps));
  const State there = step(states_[static_cast<std::size_t>(i)], i * h, s - i * h), rate = rates(there, s);
  return {{there[0], there[1]}, {rate[0], rate[1]}};
}

double Differences::norm(const std::vector<std::array<double, 2>>& of) const {
  double sum = 0;
  for (std::size_t i = 0; i < of.size(); ++i) sum += share[i] * (of[i][0] * of[i][0] + of[i][1] * of[i][1]);
  return std::sqrt(sum);
}

Differences differences(const Scene& scene, const Configuration& shape,
                        const std::function<AxisPoint(double x, std::size_t element)>& known) {
  Differences result;
  const std::vector<ShapePoint> points = points_along(scene, shape, per_element);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t first = i - i % (per_element + 1), k = i - first;
    const double dx = (points[first + per_element].x - points[first].x) / per_element;
    const double simpson = k == 0 || k == per_element ? 1 : k % 2 == 1 ? 4 : 2;
    const AxisPoint exact = known(points[i].x, points[i].element);
    result.share.push_back(simpson * dx / 3);
    result.r.push_back({points[i].r[0] - exact.r[0], points[i].r[1] - exact.r[1]});
    result.r_x.push_back({points[i].r_x[0] - exact.r_x[0], points[i].r_x[1] - exact.r_x[1]});
  }
  return result;
}

Differences beyond(const Differences& a, const Differences& b) {
  Differences result = b;
  for (std::size_t i = 0; i < b.r.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      result.r[i][k] += b.r[i][k] - a.r[i][k];
      result.r_x[i][k] += b.r_x[i][k] - a.r_x[i][k];
    }
  }
  return result;
}

}  // namespace vlbeam::exact_solutions
