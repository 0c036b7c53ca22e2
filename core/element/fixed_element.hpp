#pragma once

#include <array>
#include <vector>

#include "core/element/beam_rule.hpp"
#include "core/element/quadrature.hpp"
#include "core/element/section_pieces.hpp"
#include "core/element/shape_functions.hpp"

namespace vlbeam {

/// A fixed-length element's basis at its quadrature points, tabulated once (RANCF; ANCF with unit weights).
/// The shape functions of r_A and r_B sum to one, so r_x needs three columns only: those of r_B - r_A, s_A, s_B.
template <class Real>
struct FixedBasis {
  struct Point {
    Real weight;               ///< quadrature weight times length [m]
    std::array<Real, 3> s_x;   ///< first derivatives with respect to x
    std::array<Real, 3> s_xx;  ///< second derivatives
  };
  std::vector<Point> points;
  std::vector<Point> stretch;  ///< those of the axial strain, where it has points of its own

  std::size_t size() const { return points.size() + stretch.size(); }
  /// The points of both kinds, in this order.
  const Point& operator[](std::size_t g) const { return g < points.size() ? points[g] : stretch[g - points.size()]; }

  /// Calls `visit(points, section)` for the points of each kind with what is felt there.
  template <class Visit>
  void visit_kinds(const BeamSection& section, const Visit& visit) const {
    if (stretch.empty()) return visit(points, section);
    visit(points, section.as_felt(Feels::all_but_stretch));
    visit(stretch, section.as_felt(Feels::stretch));
  }

  /// Calls `visit(point, section, index)` at every point.
  template <class Visit>
  void visit(const BeamSection& section, const Visit& visit) const {
    std::size_t index = 0;
    visit_kinds(section, [&](const std::vector<Point>& of_kind, const BeamSection& felt) {
      for (const Point& point : of_kind) visit(point, felt, index++);
    });
  }
};

/// Basis of an element of length `l` [m] with weights `w`.
FixedBasis<double> fixed_basis(double l, const Weights<double>& w, const BeamRule& rule);

/// Constant matrices of a fixed-length element: its consistent mass is rhoA times `mass` times the identity, its weight
/// rhoA g times `load`.
template <class Real>
struct FixedInertiaOf {
  std::array<std::array<Real, 4>, 4> mass;  ///< integral of s_i s_j dx, order r_A, s_A, r_B, s_B
  std::array<Real, 4> load;                 ///< integral of s_i dx
};
using FixedInertia = FixedInertiaOf<double>;

FixedInertia fixed_inertia(double l, const Weights<double>& w, const BeamRule& rule);

// Of the element from `a` to `b` of a beam whose sections change along it. As the beam's own section is felt: weights
// of points, curvatures and masses have the share that the section there has of it.
FixedBasis<double> fixed_basis(double a, double b, const Weights<double>& w, const BeamRule& rule,
                               const SectionPieces& pieces);
FixedInertia fixed_inertia(double a, double b, const Weights<double>& w, const BeamRule& rule,
                           const SectionPieces& pieces);
FixedInertia fixed_inertia(double l, const Weights<double>& w, const QuadratureRule& rule);

/// Elastic and viscous forces of a fixed-length element on (r_A, s_A, r_B, s_B); that on r_B is minus that on r_A.
template <class Real, int D>
struct FixedForce {
  Vec<Real, D> r_b, s_a, s_b;
  Real dissipation;  ///< [W]

  static FixedForce zero() { return {Vec<Real, D>::Zero(), Vec<Real, D>::Zero(), Vec<Real, D>::Zero(), Real(0)}; }
};

/// Adds what the beam does at `points` that feel `section`: Ding & Ouyang (2022), Q_l and Q_t of Eq. 19 with the length
/// constant. No branch on values: `Real` may be a Pack.
template <class Real, int D>
void add_fixed_force(const std::vector<typename FixedBasis<Real>::Point>& points, const NodalCubic<Real, D>& e,
                     const NodalCubic<Real, D>& rate, const BeamSection& section, FixedForce<Real, D>& force) {
  using Vector = Vec<Real, D>;
  const Vector chord = e.r_b - e.r_a;
  const Vector chord_rate = rate.r_b - rate.r_a;
  for (const auto& point : points) {
    const Vector r_x = chord * point.s_x[0] + e.s_a * point.s_x[1] + e.s_b * point.s_x[2];
    const Vector r_xx = chord * point.s_xx[0] + e.s_a * point.s_xx[1] + e.s_b * point.s_xx[2];
    const ElasticStress<Real, D> elastic(r_x, r_xx, section.stiffness);
    Vector p = elastic.p, m = elastic.m;
    if (section.damped()) {
      const Vector v_x = chord_rate * point.s_x[0] + rate.s_a * point.s_x[1] + rate.s_b * point.s_x[2];
      const Vector v_xx = chord_rate * point.s_xx[0] + rate.s_a * point.s_xx[1] + rate.s_b * point.s_xx[2];
      const DampingStress<Real, D> viscous(r_x, r_xx, v_x, v_xx, section.stiffness, section.damping,
                                           section.curvature_regularization);
      p += viscous.p;
      m += viscous.m;
      force.dissipation += point.weight * viscous.power;
    }
    p *= -point.weight;
    force.r_b += p * point.s_x[0];
    force.s_a += p * point.s_x[1];
    force.s_b += p * point.s_x[2];
    if (section.bends()) {
      m *= -point.weight;
      force.r_b += m * point.s_xx[0];
      force.s_a += m * point.s_xx[1];
      force.s_b += m * point.s_xx[2];
    }
  }
}

/// That of all points of the element.
template <class Real, int D>
FixedForce<Real, D> fixed_force(const FixedBasis<Real>& basis, const NodalCubic<Real, D>& e,
                                const NodalCubic<Real, D>& rate, const BeamSection& section) {
  FixedForce<Real, D> force = FixedForce<Real, D>::zero();
  basis.visit_kinds(section, [&](const auto& points, const BeamSection& felt) {
    add_fixed_force<Real, D>(points, e, rate, felt, force);
  });
  return force;
}

}  // namespace vlbeam
