#include "core/element/frame_element.hpp"

#include <tuple>

#include "core/element/active.hpp"
#include "core/element/fixed_element.hpp"
#include "core/element/quadrature.hpp"

namespace vlbeam {
namespace {

/// Coordinates of FrameEnds, spins last, and the inner angle.
constexpr int own = 11;
using Number = Active<own + 1>;
using OwnVector = Eigen::Matrix<double, own, 1>;
using OwnMatrix = Eigen::Matrix<double, own, own>;

Vec<Number, 3> seeded(const Vec<double, 3>& value, int first) {
  Vec<Number, 3> result;
  for (int c = 0; c < 3; ++c) result[c] = Number(value[c], first + c);
  return result;
}

/// A direction turns with its slope, and by its spin: d(d) = -t (d.ds)/|s| + t x d dspin.
Vec<Number, 3> seeded_direction(const Vec<double, 3>& d, const Vec<double, 3>& s, int slope, int spin) {
  const double size = s.norm();
  const Vec<double, 3> t = s / size, turned = t.cross(d);
  Vec<Number, 3> result;
  for (int c = 0; c < 3; ++c) {
    result[c] = Number(d[c]);
    for (int i = 0; i < 3; ++i) result[c].derivatives()[slope + i] = -t[c] * d[i] / size;
    result[c].derivatives()[spin] = turned[c];
  }
  return result;
}

/// Flattened: left in calls, numbers with derivatives would go through memory.
[[gnu::flatten]] FrameForce<Number> active_force(const FrameTable& table, const FrameSection& section,
                                                 const FrameEnds<Number>& ends, double inner) {
  return FrameElement<Number>(table, section, ends).force(Number(inner, own));
}

}  // namespace

FrameTable::FrameTable(double l, const Weights<double>& w) {
  length = l;
  const auto& gauss = gauss_legendre(2);
  const BeamRule rule{{gauss[0].u, gauss[0].weight}, {gauss[1].u, gauss[1].weight}, {0.5, 1}};
  const FixedBasis<double> basis = fixed_basis(l, w, rule);
  for (std::size_t g = 0; g < 2; ++g) {
    points[g] = {gauss[g].u, basis.points[g].weight, basis.points[g].s_x, basis.points[g].s_xx};
  }
  middle = basis.points[2].s_x;
}

FrameEnds<double> frame_ends(const FrameNode& a, const FrameNode& b, double turned) {
  return {b.r - a.r, a.s, b.s, a.direction, b.direction, turned};
}

FrameVector frame_gradient(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                           double turned) {
  const FrameElement<double> element(table, section, frame_ends(a, b, turned));
  const FrameForce<double> f = element.force(element.inner());
  FrameVector result;
  result << -f.chord, f.s_a + f.spin_a * a.spin_by_slope, f.spin_a, f.chord, f.s_b + f.spin_b * b.spin_by_slope,
      f.spin_b;
  return result;
}

FrameMatrix frame_tangent(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                          double turned) {
  const FrameEnds<double> ends = frame_ends(a, b, turned);
  const double inner = FrameElement<double>(table, section, ends).inner();
  const FrameEnds<Number> active{seeded(ends.chord, 0),
                                 seeded(ends.s_a, 3),
                                 seeded(ends.s_b, 6),
                                 seeded_direction(ends.d_a, ends.s_a, 3, 9),
                                 seeded_direction(ends.d_b, ends.s_b, 6, 10),
                                 turned};
  const FrameForce<Number> f = active_force(table, section, active, inner);
  OwnMatrix k;
  OwnVector by_inner;
  const auto row = [&](int i, const Number& of) {
    k.row(i) = of.derivatives().head<own>().transpose();
    by_inner[i] = of.derivatives()[own];
  };
  for (int c = 0; c < 3; ++c) {
    row(c, f.chord[c]);
    row(3 + c, f.s_a[c]);
    row(6 + c, f.s_b[c]);
  }
  row(9, f.spin_a);
  row(10, f.spin_b);
  // the inner angle follows, and is gone
  const OwnVector inner_by = f.inner.derivatives().head<own>();
  k -= by_inner * inner_by.transpose() / f.inner.derivatives()[own];

  // from spins to angles: dspin = dphi + A.ds
  for (const auto& [node, slope, spin] : {std::tuple(&a, 3, 9), {&b, 6, 10}}) {
    k.middleRows<3>(slope) += node->spin_by_slope * k.row(spin);
    k.middleCols<3>(slope) += k.col(spin) * node->spin_by_slope.transpose();
    k.block<3, 3>(slope, slope) +=
        (spin == 9 ? f.spin_a : f.spin_b).value() * node->reference->spin_by_slope_gradient<double>(node->s);
  }
  // from the chord to the places, and in the order of nodes
  constexpr std::array<int, own> at{7, 8, 9, 3, 4, 5, 10, 11, 12, 6, 13};
  FrameMatrix result;
  for (int j = 0; j < own; ++j) {
    for (int i = 0; i < own; ++i) result(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]) = k(i, j);
  }
  result.topRows<3>() = -result.middleRows<3>(7);
  result.leftCols<3>() = -result.middleCols<3>(7);
  return result;
}

}  // namespace vlbeam
