#include "mechanics/frames/moving_frame.hpp"

#include <algorithm>
#include <tuple>

#include "core/element/active.hpp"
#include "core/element/shape_functions.hpp"

namespace vlbeam {
namespace {

/// Coordinates of FrameEnds, spins last; behind them the inner angle.
constexpr int of_ends = 11;
using FrameNumber = Active<of_ends + 1>;

Vec<FrameNumber, 3> seeded_vector(const Vec<double, 3>& value, int first) {
  Vec<FrameNumber, 3> result;
  for (int c = 0; c < 3; ++c) result[c] = FrameNumber(value[c], first + c);
  return result;
}

/// A direction turns with its slope, and by its spin: d(d) = -t (d.ds)/|s| + t x d dspin.
Vec<FrameNumber, 3> seeded_axis(const Vec<double, 3>& d, const Vec<double, 3>& s, int slope, int spin) {
  const double size = s.norm();
  const Vec<double, 3> t = s / size, turned = t.cross(d);
  Vec<FrameNumber, 3> result;
  for (int c = 0; c < 3; ++c) {
    result[c] = FrameNumber(d[c]);
    for (int i = 0; i < 3; ++i) result[c].derivatives()[slope + i] = -t[c] * d[i] / size;
    result[c].derivatives()[spin] = turned[c];
  }
  return result;
}

Eigen::Matrix<double, of_ends + 1, 1> flat(const FrameForce<double>& f) {
  Eigen::Matrix<double, of_ends + 1, 1> result;
  result << f.chord, f.s_a, f.s_b, f.spin_a, f.spin_b, f.inner;
  return result;
}

double& component(FrameTable& table, int i) {
  FrameStrain<double>& rest = table.points[static_cast<std::size_t>(i / 3)].rest;
  return i % 3 == 0 ? rest.y : i % 3 == 1 ? rest.z : rest.torsion;
}

}  // namespace

MovingFrameRest moving_frame_rest(const FrameTable& unit, const FrameSection& section, const FrameRestEnd& a,
                                  const FrameRestEnd& b, const RestTriads& along) {
  using Real = TwiceActive;
  const auto number = [](const FrameRestEnd& end, bool first, int c, std::size_t n) {
    if (!end.moves) return Real(end.curve[n][c]);
    const double value = end.curve[n][c], once = end.curve[n + 1][c], twice = n < 2 ? end.curve[n + 2][c] : 0;
    return first ? Real(value, once, 0, twice, 0, 0) : Real(value, 0, once, 0, 0, twice);
  };
  const auto vector = [&](const FrameRestEnd& end, bool first, std::size_t n) {
    Vec<Real, 3> result;
    for (int c = 0; c < 3; ++c) result[c] = number(end, first, c, n);
    return result;
  };
  const auto axis = [&](const FrameRestEnd& end, const Vec<Real, 3>& s) -> Vec<Real, 3> {
    return end.moves ? along.direction<Real>(end.x, s) : Vec<Real, 3>(end.direction.cast<Real>());
  };
  const Real length(b.x - a.x, -1, 1, 0, 0, 0);
  const Vec<Real, 3> s_a = vector(a, true, 1), s_b = vector(b, false, 1);
  const Vec<Real, 3> chord = vector(b, false, 0) - vector(a, true, 0);
  const FrameEnds<Real> ends{chord, s_a * length, s_b * length, axis(a, s_a), axis(b, s_b), 0};
  const FrameElement<Real> element(unit, section, ends);
  MovingFrameRest rest;
  for (std::size_t g = 0; g < 2; ++g) {
    const FrameStrain<Real> strain = element.strain(g, Real(0));
    rest[3 * g] = strain.y;
    rest[3 * g + 1] = strain.z;
    rest[3 * g + 2] = strain.torsion;
  }
  return rest;
}

MovingFrame::MovingFrame(const FrameTable& unit, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                         double x_a, double x_b, double turned, const MovingFrameRest* rest)
    : table_(unit), section_(section), a_(a), b_(b), l_(x_b - x_a), ends_(frame_ends(a, b, turned)) {
  ends_.s_a *= l_;
  ends_.s_b *= l_;
  rest_.fill(TwiceActive(0));
  if (rest != nullptr) rest_ = *rest;
  for (int i = 0; i < 6; ++i) component(table_, i) = rest_[static_cast<std::size_t>(i)].value;
}

Eigen::Matrix<double, 6, 1> MovingFrame::on_rest(const FrameElement<double>& element, double inner) const {
  Eigen::Matrix<double, 6, 1> result;
  for (std::size_t g = 0; g < 2; ++g) {
    const auto& point = table_.points[g];
    const FrameStrain<double> strain = element.strain(g, inner);
    result.segment<3>(3 * static_cast<Eigen::Index>(g)) << section_.EI_y * (point.rest.y - strain.y),
        section_.EI_z * (point.rest.z - strain.z), section_.GIp * (point.rest.torsion - strain.torsion);
    result.segment<3>(3 * static_cast<Eigen::Index>(g)) *= point.weight;
  }
  return result;
}

MovingFrameVector MovingFrame::gradient() const {
  const FrameElement<double> element(table_, section_, ends_);
  const double inner = element.inner();
  const FrameForce<double> f = element.force(inner);
  const auto energy = element.energy(inner);
  const auto by_rest = on_rest(element, inner);
  const double longer = exponent() * (energy[0] + energy[1]) / l_ + f.s_a.dot(a_.s) + f.s_b.dot(b_.s);
  double on_a = -longer, on_b = longer;
  for (std::size_t i = 0; i < 6; ++i) {
    on_a += by_rest[static_cast<Eigen::Index>(i)] * rest_[i].a;
    on_b += by_rest[static_cast<Eigen::Index>(i)] * rest_[i].b;
  }
  MovingFrameVector result;
  result << -f.chord, l_ * f.s_a + f.spin_a * a_.spin_by_slope, f.spin_a, f.chord,
      l_ * f.s_b + f.spin_b * b_.spin_by_slope, f.spin_b, on_a, on_b;
  return scale() * result;
}

/// Second derivatives of V by (ends, K_0), the inner angle condensed; from there by the coordinates.
MovingFrameMatrix MovingFrame::tangent() const {
  constexpr int inner_at = of_ends, all = of_ends + 6, own = of_ends + 2;
  const FrameElement<double> element(table_, section_, ends_);
  const double inner = element.inner();
  const FrameForce<double> f = element.force(inner);
  const auto energies = element.energy(inner);
  const double energy = energies[0] + energies[1];
  const auto by_rest = on_rest(element, inner);

  Eigen::Matrix<double, all, all> h = Eigen::Matrix<double, all, all>::Zero();
  Eigen::Matrix<double, all, 1> by_inner, inner_by;
  const FrameEnds<FrameNumber> active{seeded_vector(ends_.chord, 0),
                                      seeded_vector(ends_.s_a, 3),
                                      seeded_vector(ends_.s_b, 6),
                                      seeded_axis(ends_.d_a, ends_.s_a, 3, 9),
                                      seeded_axis(ends_.d_b, ends_.s_b, 6, 10),
                                      ends_.turned};
  const FrameForce<FrameNumber> moved =
      FrameElement<FrameNumber>(table_, section_, active).force(FrameNumber(inner, inner_at));
  const auto put = [&](int i, const FrameNumber& number) {
    h.row(i).head<of_ends>() = number.derivatives().head<of_ends>().transpose();
    by_inner[i] = number.derivatives()[inner_at];
  };
  for (int c = 0; c < 3; ++c) {
    put(c, moved.chord[c]);
    put(3 + c, moved.s_a[c]);
    put(6 + c, moved.s_b[c]);
  }
  put(9, moved.spin_a);
  put(10, moved.spin_b);
  inner_by.head<of_ends>() = moved.inner.derivatives().head<of_ends>();
  FrameTable other = table_;
  for (int i = 0; i < 6; ++i) {  // forces are linear in strains at rest
    const double kept = component(other, i), unit = 1 + std::abs(kept);
    component(other, i) = kept + unit;
    const auto change = ((flat(FrameElement<double>(other, section_, ends_).force(inner)) - flat(f)) / unit).eval();
    component(other, i) = kept;
    h.col(of_ends + i).head<of_ends>() = change.head<of_ends>();
    h.row(of_ends + i).head<of_ends>() = change.head<of_ends>().transpose();
    by_inner[of_ends + i] = inner_by[of_ends + i] = change[inner_at];
    const double stiffness = i % 3 == 0 ? section_.EI_y : i % 3 == 1 ? section_.EI_z : section_.GIp;
    h(of_ends + i, of_ends + i) = stiffness * table_.points[static_cast<std::size_t>(i / 3)].weight;
  }
  h -= by_inner * inner_by.transpose() / moved.inner.derivatives()[inner_at];

  // of ends and K_0 by the coordinates: chord, slopes, spins, x_A, x_B
  Eigen::Matrix<double, all, own> by = Eigen::Matrix<double, all, own>::Zero();
  by.topLeftCorner<of_ends, of_ends>().setIdentity();
  by.block<6, 6>(3, 3) *= l_;
  by.col(of_ends).segment<3>(3) = -a_.s;
  by.col(of_ends).segment<3>(6) = -b_.s;
  by.col(of_ends + 1).segment<6>(3) = -by.col(of_ends).segment<6>(3);
  Eigen::Matrix<double, all, 1> gradient;
  gradient << flat(f).head<of_ends>(), by_rest;
  Eigen::Matrix<double, own, 1> length = Eigen::Matrix<double, own, 1>::Zero();
  length[of_ends] = -1;
  length[of_ends + 1] = 1;
  Eigen::Matrix<double, own, own> second = Eigen::Matrix<double, own, own>::Zero();
  for (int i = 0; i < 6; ++i) {
    const TwiceActive& rest = rest_[static_cast<std::size_t>(i)];
    by(of_ends + i, of_ends) = rest.a;
    by(of_ends + i, of_ends + 1) = rest.b;
    second(of_ends, of_ends) += by_rest[i] * rest.aa;
    second(of_ends, of_ends + 1) += by_rest[i] * rest.ab;
    second(of_ends + 1, of_ends + 1) += by_rest[i] * rest.bb;
  }
  second(of_ends + 1, of_ends) = second(of_ends, of_ends + 1);
  Eigen::Matrix<double, own, 1> slopes = Eigen::Matrix<double, own, 1>::Zero();
  slopes.segment<3>(3) = f.s_a;
  slopes.segment<3>(6) = f.s_b;
  second += slopes * length.transpose() + length * slopes.transpose();
  const Eigen::Matrix<double, own, 1> of_unit = by.transpose() * gradient;
  const int e = exponent();
  Eigen::Matrix<double, own, own> k =
      scale() *
      (by.transpose() * h * by + second + (e / l_) * (length * of_unit.transpose() + of_unit * length.transpose()) +
       (e * (e - 1) / (l_ * l_)) * energy * length * length.transpose());

  for (const auto& [node, slope, spin] : {std::tuple(&a_, 3, 9), {&b_, 6, 10}}) {
    k.middleRows<3>(slope) += node->spin_by_slope * k.row(spin);
    k.middleCols<3>(slope) += k.col(spin) * node->spin_by_slope.transpose();
    k.block<3, 3>(slope, slope) +=
        scale() * (spin == 9 ? f.spin_a : f.spin_b) * node->reference->spin_by_slope_gradient<double>(node->s);
  }
  constexpr std::array<int, own> at{7, 8, 9, 3, 4, 5, 10, 11, 12, 6, 13, 14, 15};
  MovingFrameMatrix result = MovingFrameMatrix::Zero();
  for (int j = 0; j < own; ++j) {
    for (int i = 0; i < own; ++i) result(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]) = k(i, j);
  }
  result.topRows<3>() = -result.middleRows<3>(7);
  result.leftCols<3>() = -result.middleCols<3>(7);
  return result;
}

std::array<double, 2> MovingFrame::energy() const {
  const FrameElement<double> element(table_, section_, ends_);
  const auto of_unit = element.energy(element.inner());
  return {scale() * of_unit[0], scale() * of_unit[1]};
}

std::array<FrameStrain<double>, 2> MovingFrame::from_rest() const {
  const FrameElement<double> element(table_, section_, ends_);
  const double inner = element.inner(), per_length = exponent() > 0 ? 1 : l_;
  const auto at = [&](std::size_t g) -> FrameStrain<double> {
    const FrameStrain<double> strain = element.from_rest(g, inner);
    return {strain.y / per_length, strain.z / per_length, strain.torsion / per_length};
  };
  return {at(0), at(1)};
}

std::array<double, 2> MovingFrame::angles() const {
  const FrameElement<double> element(table_, section_, ends_);
  return {element.twist(), element.inner()};
}

TriadReference frame_at(double u, double length, const Weights<double>& weights, const FrameEnds<double>& ends,
                        double twist, double inner) {
  const auto tangent = [&](double at) -> Vec<double, 3> {
    const auto f = rational_shape(weights, at);
    return (ends.chord * f[2][1] + length * (ends.s_a * f[1][1] + ends.s_b * f[3][1])).normalized();
  };
  const Vec<double, 3> m = tangent(0.5), t = tangent(u);
  const Vec<double, 3> d = carried<double>(ends.s_a.normalized(), m, ends.d_a);
  const auto [sine, cosine] = sine_cosine(u * twist + 4 * u * (1 - u) * inner);
  const Vec<double, 3> f = d * cosine + m.cross(d) * sine;
  return {t, carried<double>(m, t, f)};
}

}  // namespace vlbeam
