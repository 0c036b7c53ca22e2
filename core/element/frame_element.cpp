#include "core/element/frame_element.hpp"

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

}  // namespace

FrameTable::FrameTable(double l, const Weights<double>& w) : length(l) {
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
  const FrameForce<Number> f = FrameElement<Number>(table, section, active).force(Number(inner, own));
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
  Eigen::Matrix<double, own, 14> map = Eigen::Matrix<double, own, 14>::Zero();
  map.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
  map.block<3, 3>(0, 7).setIdentity();
  map.block<3, 3>(3, 3).setIdentity();
  map.block<3, 3>(6, 10).setIdentity();
  map.block<1, 3>(9, 3) = a.spin_by_slope.transpose();
  map.block<1, 3>(10, 10) = b.spin_by_slope.transpose();
  map(9, 6) = map(10, 13) = 1;
  FrameMatrix result = map.transpose() * k * map;
  result.block<3, 3>(3, 3) += f.spin_a.value() * a.reference->spin_by_slope_gradient<double>(a.s);
  result.block<3, 3>(10, 10) += f.spin_b.value() * b.reference->spin_by_slope_gradient<double>(b.s);
  return result;
}

}  // namespace vlbeam
