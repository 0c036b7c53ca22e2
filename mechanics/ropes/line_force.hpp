#pragma once

#include "core/element/quadrature.hpp"
#include "mechanics/motion/parts/material_point.hpp"

namespace vlbeam {

/// Place, slope and velocity of a material point, as a force on a line depends on them.
template <class Real, int D>
struct LinePoint {
  Vec<Real, D> r, r_x, v;
};

/// Shape functions of an element's point; `unit` where its weights are 1.
template <class Real>
ShapeTable<Real> shape_at(const Weights<Real>& weights, bool unit, double u) {
  return unit ? hermite_shape(Real(u)) : rational_shape(weights, Real(u));
}

/// A point of an element whose ends stay at their material points: of its motion what a force on a line needs.
template <int D>
PointMotion<double, D> resting_point(const MovingKinematics<double, D>& element, const ShapeTable<double>& f) {
  PointMotion<double, D> point;
  const double length = element.length(), inverse = 1 / length;
  for (std::size_t i = 0; i < 4; ++i) {
    point.s[i] = i % 2 == 0 ? f[i][0] : length * f[i][0];
    point.s_x[i] = i % 2 == 0 ? inverse * f[i][1] : f[i][1];
  }
  point.r = combine_nodes<double, D>(point.s, element.coordinates().e);
  point.r_x = combine_nodes<double, D>(point.s_x, element.coordinates().e);
  point.v = combine_nodes<double, D>(point.s, element.rates().e);
  return point;
}

/// Whether points of element k may move along the beam with its ends.
template <int D>
bool moves_along(const ChainView<D>& beam, int k) {
  return beam.at_joint(k) || beam.marks != nullptr;
}

/// Adds N^T f of a force per unstretched length to an array like q, summed at Gauss points of element k. The law has
/// acts(place), where the force can be other than zero, and force(point). Calls visit(k, motion, force [N/m],
/// weight [m]) at each point where it acts.
template <int D, class Law, class Visit>
void add_line_force_of(const ChainView<D>& beam, int k, int points, const Law& law, double* out, const Visit& visit) {
  const MovingKinematics<double, D> element = beam.kinematics(k);
  const bool unit = beam.weights(k).w == unit_weights, moves = moves_along(beam, k);
  for (const auto& [u, share] : gauss_legendre(points)) {
    const ShapeTable<double> shape = shape_at(element.weights(), unit, u);
    const PointMotion<double, D> at = moves ? element.at(u, shape) : resting_point<D>(element, shape);
    if (!law.acts(at.r)) continue;
    const Vec<double, D> f = law.force(LinePoint<double, D>{at.r, at.r_x, at.v});
    const double weight = share * element.length();
    add_point_force<D>(beam, k, at, {weight * f, Vec<double, D>::Zero()}, out);
    visit(k, at, f, weight);
  }
}

/// The same of all elements.
template <int D, class Law, class Visit>
void add_line_force(const ChainView<D>& beam, int points, const Law& law, double* out, const Visit& visit) {
  for (int k = 0; k < beam.mesh.elements(); ++k) add_line_force_of<D>(beam, k, points, law, out, visit);
}

/// Of an element whose nodes rest: the derivatives of minus that force.
template <int D, class Law>
PointMatrix<D> fixed_line_tangent(const ChainView<D>& beam, int k, int points, const Law& law,
                                  const TangentWeights& by) {
  constexpr int N = 3 * D;
  using Real = Active<N>;
  const MovingKinematics<double, D> element = beam.kinematics(k);
  const bool unit = beam.weights(k).w == unit_weights;
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  for (const auto& [u, share] : gauss_legendre(points)) {
    const PointMotion<double, D> at = resting_point<D>(element, shape_at(element.weights(), unit, u));
    if (!law.acts(at.r)) continue;
    LinePoint<Real, D> point;
    for (int c = 0; c < D; ++c) {
      point.r[c] = Real(at.r[c], c);
      point.r_x[c] = Real(at.r_x[c], D + c);
      point.v[c] = Real(at.v[c], 2 * D + c);
    }
    const Vec<Real, D> f = law.force(point);
    Eigen::Matrix<double, D, N> by_point;
    for (int c = 0; c < D; ++c) by_point.row(c) = -share * element.length() * f[c].derivatives().transpose();
    for (int j = 0; j < 4; ++j) {
      const auto n = static_cast<std::size_t>(j);
      const Eigen::Matrix<double, D, D> by_node = (by.q * at.s[n]) * by_point.template leftCols<D>() +
                                                  (by.q * at.s_x[n]) * by_point.template middleCols<D>(D) +
                                                  (by.v * at.s[n]) * by_point.template rightCols<D>();
      for (int i = 0; i < 4; ++i) {
        matrix.template block<D, D>(D * i, D * j) += at.s[static_cast<std::size_t>(i)] * by_node;
      }
    }
  }
  return matrix;
}

/// Of an element at a joint, whose points move along the beam with it.
template <int D, class Law>
PointMatrix<D> moving_line_tangent(const ChainView<D>& beam, int k, int points, const Law& law,
                                   const TangentWeights& by) {
  using Real = ElementReal<D>;
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  const MovingKinematics<Real, D> element = active_element(beam, k, by);
  for (const auto& [u, share] : gauss_legendre(points)) {
    const PointMotion<Real, D> at = element.at(Real(u), rational_shape(element.weights(), Real(u)));
    Vec<double, D> place;
    for (int c = 0; c < D; ++c) place[c] = at.r[c].value();
    if (!law.acts(place)) continue;
    PointForce<Real, D> f;
    f.on_r = law.force(LinePoint<Real, D>{at.r, at.r_x, at.v}) * Real(element.length() * Real(share));
    add_point_tangent(beam, k, at, f, matrix);
  }
  return matrix;
}

/// Of element k.
template <int D, class Law>
PointMatrix<D> line_tangent(const ChainView<D>& beam, int k, int points, const Law& law, const TangentWeights& by) {
  return moves_along(beam, k) ? moving_line_tangent(beam, k, points, law, by)
                              : fixed_line_tangent(beam, k, points, law, by);
}

}  // namespace vlbeam
