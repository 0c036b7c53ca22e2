#include "core/geometry/axis.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/geometry/arc.hpp"

namespace vlbeam {
namespace {

constexpr int length_pieces = 8;

/// Arc length of `curve` from its start to the parameter u.
template <int D>
double arc_length(const RationalCubic<double, D>& curve, double u) {
  auto speed = [&](double at) { return curve.evaluate(at)[1].norm(); };
  double sum = 0;
  for (int i = 0; i < length_pieces; ++i) {
    sum += boost::math::quadrature::gauss<double, 25>::integrate(speed, u * i / length_pieces,
                                                                 u * (i + 1) / length_pieces);
  }
  return sum;
}

}  // namespace

template <int D>
Axis<D> Axis<D>::line(const Vector& start, const Vector& end) {
  const double length = (end - start).norm();
  return {Line{start, (end - start) / length}, {0, length}};
}

template <int D>
Axis<D> Axis<D>::arc(const Vector& center, double radius, double from, double to) {
  const double length = radius * std::abs(to - from);
  return {Arc{center, radius, from, (to - from) / length}, {0, length}};
}

template <int D>
Axis<D> Axis<D>::nurbs(const Nurbs<D>& curve) {
  Spans chain;
  std::vector<double> breaks{0};
  for (const auto& span : rational_spans(curve)) {
    chain.spans.push_back(span.curve);
    breaks.push_back(breaks.back() + arc_length(span.curve, 1));
  }
  return {chain, breaks};
}

template <int D>
std::pair<std::size_t, double> Axis<D>::locate(const Spans& chain, double x) const {
  const auto after = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, x);
  const auto i = static_cast<std::size_t>(after - breaks_.begin()) - 1;
  const auto& span = chain.spans[i];
  const double target = x - breaks_[i], whole = breaks_[i + 1] - breaks_[i];
  // Newton's iteration, kept inside what is known of the root
  double low = 0, high = 1, u = std::clamp(target / whole, 0.0, 1.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double excess = arc_length(span, u) - target;
    if (std::abs(excess) <= 1e-15 * whole) break;
    (excess > 0 ? high : low) = u;
    double next = u - excess / span.evaluate(u)[1].norm();
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == u) break;
    u = next;
  }
  return {i, u};
}

template <int D>
bool Axis<D>::in_one_piece(double x_a, double x_b) const {
  if (const auto* shape = std::get_if<Arc>(&shape_)) {
    return std::abs((x_b - x_a) * shape->turn_per_length) < std::numbers::pi;
  }
  return std::none_of(breaks_.begin(), breaks_.end(), [&](double at) { return x_a < at && at < x_b; });
}

template <int D>
Vec<double, D> Axis<D>::position(double x) const {
  if (const auto* shape = std::get_if<Line>(&shape_)) return shape->start + x * shape->tangent;
  if (const auto* shape = std::get_if<Arc>(&shape_)) {
    return circular_arc<D>(shape->center, shape->radius, shape->from + x * shape->turn_per_length, 0).points[0];
  }
  const auto& chain = std::get<Spans>(shape_);
  const auto [i, u] = locate(chain, x);
  return chain.spans[i].evaluate(u)[0];
}

template <int D>
Vec<double, D> Axis<D>::tangent(double x) const {
  if (const auto* shape = std::get_if<Line>(&shape_)) return shape->tangent;
  if (const auto* shape = std::get_if<Arc>(&shape_)) {
    const double angle = shape->from + x * shape->turn_per_length, sign = shape->turn_per_length > 0 ? 1 : -1;
    Vector along = Vector::Zero();
    along[0] = -sign * std::sin(angle);
    along[1] = sign * std::cos(angle);
    return along;
  }
  const auto& chain = std::get<Spans>(shape_);
  const auto [i, u] = locate(chain, x);
  return chain.spans[i].evaluate(u)[1].normalized();
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
  const auto& chain = std::get<Spans>(shape_);
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
  for (const double p : product) offset.push_back(std::log(p) - offset.back());
  double first = 0, sign = 1;
  for (std::size_t k = 0; k < product.size(); ++k, sign = -sign) {
    first -= sign * (offset[k] - offset[k + 1]) / (2 * static_cast<double>(product.size()));
  }
  sign = 1;
  for (std::size_t k = 0; k < x.size(); ++k, sign = -sign) {
    const bool last = k + 1 == x.size();
    const double size = std::exp(sign * first + offset[k]);
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

template class Axis<2>;
template class Axis<3>;
template CubicChain<2> exact_chain(const Axis<2>&, const std::vector<double>&);
template CubicChain<3> exact_chain(const Axis<3>&, const std::vector<double>&);

}  // namespace vlbeam
