#include "mechanics/frames/frame_element.hpp"

#include "core/element/fixed_element.hpp"
#include "core/element/quadrature.hpp"
#include "mechanics/frames/frame_stiffness.hpp"

namespace vlbeam {
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

void add_turned_reference(const FrameNode& node, double torque, int slope, FrameMatrix& tangent) {
  const Eigen::Matrix3d by = node.reference->spin_by_slope_gradient<double>(node.s);
  tangent.block<3, 3>(slope, slope) += (torque / 2) * (by + by.transpose());
}

FrameMatrix frame_tangent(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                          double turned) {
  const FrameElement<double> element(table, section, frame_ends(a, b, turned));
  const FrameStiffness<double> k(element, element.inner(), a.spin_by_slope, b.spin_by_slope);
  FrameMatrix result = k.in_order();
  add_turned_reference(a, k.torques[0], 3, result);
  add_turned_reference(b, k.torques[1], 10, result);
  return result;
}

}  // namespace vlbeam
