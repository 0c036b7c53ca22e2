#include "core/geometry/axis.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/geometry/arc.hpp"
#include "core/geometry/elementary.hpp"

namespace vlbeam {
namespace {

constexpr int length_pieces = 64;  // of a span; 10 points on each leave rounding alone

template <int D>
double speed_at(const RationalCubic<double, D>& curve, double u) {
  return curve.template evaluate<2>(u)[1].norm();
}

/// Arc length of `curve` between two values of its parameter.
template <int D>
double arc_length(const RationalCubic<double, D>& curve, double from, double to) {
  return boost::math::quadrature::gauss<double, 10>::integrate([&](double u) { return speed_at(curve, u); }, from, to);
}

/// The parameter at `length` from the start of `curve`: Newton's iteration inside the piece that holds it.
template <int D>
double parameter_at(const RationalCubic<double, D>& curve, const std::vector<double>& lengths, double length) {
  const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, length);
  const auto piece = static_cast<std::size_t>(after - lengths.begin()) - 1;
  const double start = static_cast<double>(piece) / length_pieces, target = length - lengths[piece];
  double low = start, high = static_cast<double>(piece + 1) / length_pieces;
  double u = low + (high - low) * std::clamp(target / (lengths[piece + 1] - lengths[piece]), 0.0, 1.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double excess = arc_length(curve, start, u) - target;
    if (std::abs(excess) <= 2e-16 * lengths.back()) break;
    (excess > 0 ? high : low) = u;
    double next = u - excess / speed_at(curve, u);
    if (!(low <= next && next <= high)) next = (low + high) / 2;
    const bool settled = std::abs(next - u) <= 1e-15;
    u = next;
    if (settled) break;
  }
  return u;
}

/// Position and its first three derivatives by arc length, of a curve at its parameter u.
template <int D>
std::array<Vec<double, D>, 4> by_arc_length(const RationalCubic<double, D>& curve, double u) {
  const auto r = curve.evaluate(u);
  const double speed = r[1].norm();
  const Vec<double, D> tangent = r[1] / speed;
  const double speed_u = tangent.dot(r[2]);
  const Vec<double, D> second = (r[2] - tangent * speed_u) / (speed * speed);
  const double speed_uu = speed * second.dot(r[2]) + tangent.dot(r[3]);
  const Vec<double, D> third = (r[3] - tangent * speed_uu - second * (3 * speed * speed_u)) / (speed * speed * speed);
  return {r[0], tangent, second, third};
}

}  // namespace

template <int D>
Axis<D> Axis<D>::line(const Vector& start, const Vector& end) {
  const double length = (end - start).norm();
  return {Line{start, (end - start) / length}, {0, length}};
}

template <int D>
Axis<D> Axis<D>::arc(const Vector& center, double radius, double from, double to, double pitch) {
  if (pitch == 0) {
    const double length = radius * std::abs(to - from);
    return {Arc{center, radius, from, (to - from) / length}, {0, length}};
  }
  const double rise = pitch / (2 * std::numbers::pi);  // a radian
  const double length = std::sqrt(radius * radius + rise * rise) * std::abs(to - from);
  return {Arc{center, radius, from, (to - from) / length, rise * std::abs(to - from) / length}, {0, length}};
}

template <int D>
void Axis<D>::Spans::add(const RationalCubic<double, D>& span) {
  std::vector<double> from_start{0};
  for (int k = 0; k < length_pieces; ++k) {
    from_start.push_back(from_start.back() + arc_length(span, k / static_cast<double>(length_pieces),
                                                        (k + 1) / static_cast<double>(length_pieces)));
  }
  bounds.push_back(bounds.back() + from_start.back());
  spans.push_back(span);
  lengths.push_back(std::move(from_start));
}

template <int D>
Axis<D> Axis<D>::nurbs(const Nurbs<D>& curve) {
  Spans chain;
  std::vector<double> kinks;
  for (const auto& span : rational_spans(curve)) {
    if (span.kinked) kinks.push_back(chain.bounds.back());
    chain.add(span.curve);
  }
  return {chain, chain.bounds, kinks};
}

template <int D>
Axis<D> Axis<D>::polyline(const std::vector<Vector>& points) {
  Nurbs<D> curve{1, {0}, std::vector<double>(points.size(), 1), points};
  for (std::size_t i = 0; i < points.size(); ++i) curve.knots.push_back(static_cast<double>(i));
  curve.knots.push_back(curve.knots.back());
  return nurbs(curve);
}

template <int D>
double Axis<D>::turn_at(double x) const {
  const Vector before = tangent_before(x), behind = tangent(x);
  return 2 * portable::atan2((before - behind).norm(), (before + behind).norm());
}

template <int D>
Axis<D> Axis<D>::straightened() const {
  if (kinks_.empty()) return *this;
  const Spans& chain = this->chain();
  const auto straight_piece = [](const RationalCubic<double, D>& span) {
    const Vector along = (span.points[3] - span.points[0]).normalized();
    return std::ranges::all_of(span.points, [&](const Vector& point) {
      const Vector way = point - span.points[0];
      return (way - along * along.dot(way)).norm() <= 1e-12 * (span.points[3] - span.points[0]).norm();
    });
  };
  const Vector start = chain.spans.front().points[0], first = tangent(0);
  if (std::ranges::all_of(chain.spans, straight_piece)) return line(start, start + length() * first);
  Spans turned;
  Vector at = start, tangent_there = first;
  for (const RationalCubic<double, D>& span : chain.spans) {
    const Vector own = (span.points[1] - span.points[0]).normalized();
    const double cosine = own.dot(tangent_there);
    const auto turn = [&](const Vector& v) -> Vector {  // own to tangent_there; of opposite ones the mirror image of v
      if (cosine < -1 + 1e-12) return -v;
      const Vector sum = own + tangent_there;
      return v - sum * (sum.dot(v) / (1 + cosine)) + tangent_there * (2 * own.dot(v));
    };
    RationalCubic<double, D> now = span;
    for (Vector& point : now.points) point = at + turn(point - span.points[0]);
    at = now.points[3];
    tangent_there = (now.points[3] - now.points[2]).normalized();
    turned.add(now);
  }
  return {turned, breaks_};
}

template <int D>
Axis<D> Axis<D>::rounded(const std::vector<double>& kinks, double reach) const {
  if (kinks.empty()) return *this;
  const Spans& chain = this->chain();
  const auto is_rounded = [&](double at) { return std::ranges::find(kinks, at) != kinks.end(); };
  const std::size_t n = chain.spans.size();
  const auto cut_at =
      [&](std::size_t i) {  // how much of span i, and of the one before, the rounding at its start takes
        return std::min({reach, chain.length_of(i - 1) / 2, chain.length_of(i) / 2});
      };
  Spans round;
  std::vector<double> breaks{0}, left;
  for (std::size_t i = 0; i < n; ++i) {
    const double from = chain.bounds[i], to = chain.bounds[i + 1];
    const double start = i > 0 && is_rounded(from) ? cut_at(i) : 0;
    const double end = i + 1 < n && is_rounded(to) ? cut_at(i + 1) : 0;
    if (i > 0) {
      if (start == 0) {
        breaks.push_back(round.bounds.back());
        if (std::ranges::find(kinks_, from) != kinks_.end()) left.push_back(breaks.back());
      } else {
        // a circle's arc, as far as both pieces are straight: its control points stand on their tangents
        const auto before = derivatives(from - start), behind = derivatives(from + start);
        const double turn = 2 * portable::atan2((behind[1] - before[1]).norm(), (behind[1] + before[1]).norm());
        const double w = (1 + 2 * portable::cos(turn / 2)) / 3;
        const double arm = (behind[0] - before[0]).norm() / (3 * w);
        const RationalCubic<double, D> arc{
            {before[0], before[0] + arm * before[1], behind[0] - arm * behind[1], behind[0]}, {1, w, w, 1}};
        round.add(arc.restrict(0, 0.5));
        breaks.push_back(round.bounds.back());
        round.add(arc.restrict(0.5, 1));
      }
    }
    round.add(between(from + start, to - end));
  }
  breaks.push_back(round.bounds.back());
  return {round, breaks, left};
}

template <int D>
std::pair<std::size_t, double> Axis<D>::locate(const Spans& chain, double x) const {
  const auto& bounds = chain.bounds;
  const auto after = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, x);
  const auto i = static_cast<std::size_t>(after - bounds.begin()) - 1;
  return {i, parameter_at(chain.spans[i], chain.lengths[i], x - bounds[i])};
}

template <int D>
Vec<double, D> Axis<D>::tangent_before(double x) const {
  if (std::ranges::find(kinks_, x) == kinks_.end()) return tangent(x);
  const Spans& chain = this->chain();
  const auto i = static_cast<std::size_t>(std::ranges::find(chain.bounds, x) - chain.bounds.begin());
  return by_arc_length(chain.spans[i - 1], 1)[1];
}

template <int D>
bool Axis<D>::in_one_piece(double x_a, double x_b) const {
  if (const auto* shape = std::get_if<Arc>(&shape_)) {
    return shape->rise_per_length == 0 && std::abs((x_b - x_a) * shape->turn_per_length) < std::numbers::pi;
  }
  const auto* chain = std::get_if<Chain>(&shape_);
  return !chain || std::ranges::none_of((*chain)->bounds, [&](double at) { return x_a < at && at < x_b; });
}

template <int D>
std::array<Vec<double, D>, 4> Axis<D>::derivatives(double x) const {
  const Vector none = Vector::Zero();
  if (const auto* shape = std::get_if<Line>(&shape_))
    return {shape->start + x * shape->tangent, shape->tangent, none, none};
  if (const auto* shape = std::get_if<Arc>(&shape_)) {
    const double angle = shape->from + x * shape->turn_per_length, sign = shape->turn_per_length > 0 ? 1 : -1;
    Vector out = none, along = none;
    out.template head<2>() << portable::cos(angle), portable::sin(angle);
    along.template head<2>() << -sign * out[1], sign * out[0];
    if constexpr (D == 3) {
      if (shape->rise_per_length != 0) {
        const Vector up = shape->rise_per_length * Vector::UnitZ();
        const double turn = std::abs(shape->turn_per_length), across = shape->radius * turn;
        return {shape->center + shape->radius * out + x * up, across * along + up, -across * turn * out,
                -across * turn * turn * along};
      }
    }
    const double curvature = 1 / shape->radius;
    return {shape->center + shape->radius * out, along, -curvature * out, -curvature * curvature * along};
  }
  const Spans& chain = this->chain();
  const auto [i, u] = locate(chain, x);
  return by_arc_length(chain.spans[i], u);
}

template <int D>
RationalCubic<double, D> Axis<D>::between(double x_a, double x_b) const {
  if (!in_one_piece(x_a, x_b)) throw std::domain_error("an element cannot be the axis between these points");
  if (const auto* shape = std::get_if<Line>(&shape_)) {
    auto at = [&](double u) -> Vector { return shape->start + (x_a + u * (x_b - x_a)) * shape->tangent; };
    return {{at(0), at(1.0 / 3), at(2.0 / 3), at(1)}, unit_weights};
  }
  if (const auto* shape = std::get_if<Arc>(&shape_)) {
    return circular_arc<D>(shape->center, shape->radius, shape->from + x_a * shape->turn_per_length,
                           (x_b - x_a) * shape->turn_per_length);
  }
  const Spans& chain = this->chain();
  const auto [i, u_a] = locate(chain, x_a);
  const auto [j, u_b] = locate(chain, x_b);
  const double end = j == i ? u_b : 1;  // x_b may be the next break
  return u_a == 0 && end == 1 ? chain.spans[i] : chain.spans[i].restrict(u_a, end);
}

template <int D>
CubicChain<D> exact_chain(const Axis<D>& axis, const std::vector<double>& x) {
  CubicChain<D> chain;
  std::vector<RationalCubic<double, D>> cubics;
  std::vector<double> own, product;  // |slope| at the start of a cubic, and that times the one at its end
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    cubics.push_back(axis.between(x[k], x[k + 1]));
    const auto e = cubics.back().to_nodal(x[k + 1] - x[k]);
    own.push_back(e.s_a.norm());
    product.push_back(e.s_a.norm() * e.s_b.norm());
  }
  // log of the slopes at the nodes, +-first + offset with alternating sign; the first makes them least, the mean over
  // the elements of the mean of their ends, so that equal elements get equal slopes
  std::vector<double> offset{0};
  for (const double p : product) offset.push_back(portable::log(p) - offset.back());
  double first = 0, sign = 1;
  for (std::size_t k = 0; k < product.size(); ++k, sign = -sign) {
    first -= sign * (offset[k] - offset[k + 1]) / (2 * static_cast<double>(product.size()));
  }
  sign = 1;
  for (std::size_t k = 0; k < x.size(); ++k, sign = -sign) {
    const bool last = k + 1 == x.size();
    const double size = portable::exp(sign * first + offset[k]);
    const auto& P = cubics[last ? k - 1 : k].points;
    chain.r.push_back(P[last ? 3 : 0]);
    chain.r_x.push_back((last ? Vec<double, D>(P[3] - P[2]) : Vec<double, D>(P[1] - P[0])).normalized() * size);
    if (last) break;
    const double c = size / own[k];
    const auto& w = cubics[k].weights;
    chain.weights.push_back({w[0], c * w[1], c * c * w[2], c * c * c * w[3]});
  }
  return chain;
}

template <int D>
CubicChain<D> even_chain(const Axis<D>& axis, const std::vector<double>& x, bool rational) {
  CubicChain<D> chain;
  Vec<double, D> behind = axis.tangent(x.front());
  for (const double at : x) {
    const auto derivatives = axis.derivatives(at);
    const Vec<double, D> before = axis.tangent_before(at);
    chain.r.push_back(derivatives[0]);
    chain.r_x.push_back(before);
    if (chain.r.size() > 1) chain.weights.push_back(rational ? even_arc_weights<D>(behind, before) : unit_weights);
    behind = derivatives[1];
  }
  return chain;
}

template class Axis<2>;
template class Axis<3>;
template CubicChain<2> exact_chain(const Axis<2>&, const std::vector<double>&);
template CubicChain<3> exact_chain(const Axis<3>&, const std::vector<double>&);
template CubicChain<2> even_chain(const Axis<2>&, const std::vector<double>&, bool);
template CubicChain<3> even_chain(const Axis<3>&, const std::vector<double>&, bool);

}  // namespace vlbeam
