#include "mechanics/frames/frame_rest_rates.hpp"

namespace vlbeam {
namespace {

using Real = Active<2>;
using Vector = Vec<Real, 3>;

/// The n-th derivative of the rest curve at an end.
Vector curve_at(const std::array<FrameRestEnd, 2>& ends, int e, std::size_t n) {
  const FrameRestEnd& end = ends[static_cast<std::size_t>(e)];
  Vector result = end.curve[n].cast<Real>();
  if (!end.moves) return result;
  for (int c = 0; c < 3; ++c) result[c].derivatives()[e] = end.curve[n + 1][c];
  return result;
}

Real material_coordinate(const std::array<FrameRestEnd, 2>& ends, int e) {
  return {ends[static_cast<std::size_t>(e)].x, e};
}

}  // namespace

FrameRestRates frame_rest_rates(const FrameTable& unit, const FrameSection& section,
                                const std::array<FrameRestEnd, 2>& ends,
                                const std::array<std::array<double, 3>, 2>& bends, const RestTriads& along) {
  const Real l = material_coordinate(ends, 1) - material_coordinate(ends, 0);
  const Vector chord = curve_at(ends, 1, 0) - curve_at(ends, 0, 0);
  const std::array<Vector, 2> s{curve_at(ends, 0, 1), curve_at(ends, 1, 1)};
  const auto axis = [&](std::size_t e) -> Vector {
    return ends[e].moves ? along.direction<Real>(ends[e].x, s[e]) : Vector(ends[e].direction.cast<Real>());
  };
  const FrameEnds<Real> at{chord, s[0] * l, s[1] * l, axis(0), axis(1), 0};
  const FrameElement<Real> element(unit, section, at);
  std::array<FrameForce<Real>, 6> by;
  for (std::size_t k = 0; k < 6; ++k) by[k] = element.derivative(k, Real(0));
  FrameRestRates rates{};
  for (int e = 0; e < 2; ++e) {
    const auto i = static_cast<std::size_t>(e);
    if (!ends[i].moves) continue;
    const Vector bent = (chord * Real(bends[i][0]) + at.s_a * Real(bends[i][1]) + at.s_b * Real(bends[i][2])) / (l * l);
    const Vector slope = (curve_at(ends, e, 2) - bent) * l;
    const auto turning = along.turning(ends[i].x, ends[i].curve);
    Real spin(turning[0]);
    spin.derivatives()[e] = turning[1];
    spin -= element.twist() / l;
    for (std::size_t k = 0; k < 6; ++k) {
      rates[i][k] =
          e == 0 ? Real(by[k].s_a.dot(slope) + by[k].spin_a * spin) : Real(by[k].s_b.dot(slope) + by[k].spin_b * spin);
    }
  }
  return rates;
}

}  // namespace vlbeam
