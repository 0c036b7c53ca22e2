#include "core/parts/drag.hpp"

#include "core/element/quadrature.hpp"

namespace vlbeam {
namespace {

template <class Real>
ShapeTable<Real> shape_at(const Weights<Real>& weights, bool unit, double u) {
  return unit ? hermite_shape(Real(u)) : rational_shape(weights, Real(u));
}

}  // namespace

template <int D>
double Drag<D>::add_forces(const ChainView<D>& beam, double* out, double* on_marks) const {
  double taken = 0;
  const auto& rule = gauss_legendre(quadrature_points);
  for (int k = 0; k < beam.mesh.elements(); ++k) {
    const MovingKinematics<double, D> element = beam.kinematics(k);
    const bool unit = beam.weights(k).w == unit_weights;
    for (const auto& [u, share] : rule) {
      const PointMotion<double, D> at = element.at(u, shape_at(element.weights(), unit, u));
      PointForce<double, D> f;
      f.on_r = share * element.length() * this->force(at.v, at.r_x);
      add_point_force(beam, k, at, f, out);
      taken -= f.on_r.dot(at.v);
      if (on_marks == nullptr) continue;
      on_marks[k] += f.on_r.dot(at.y_a);
      on_marks[k + 1] += f.on_r.dot(at.y_b);
    }
  }
  return taken;
}

template <int D>
PointMatrix<D> Drag<D>::fixed_tangent(const ChainView<D>& beam, int k, const TangentWeights& by) const {
  constexpr int N = 2 * D;  // velocity and slope
  using Real = Active<N>;
  const MovingKinematics<double, D> element = beam.kinematics(k);
  const bool unit = beam.weights(k).w == unit_weights;
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  for (const auto& [u, share] : gauss_legendre(quadrature_points)) {
    const PointMotion<double, D> at = element.at(u, shape_at(element.weights(), unit, u));
    Vec<Real, D> v, r_x;
    for (int c = 0; c < D; ++c) {
      v[c] = Real(at.v[c], c);
      r_x[c] = Real(at.r_x[c], D + c);
    }
    const Vec<Real, D> f = this->force(v, r_x);
    Eigen::Matrix<double, D, N> by_point;
    for (int c = 0; c < D; ++c) by_point.row(c) = -share * element.length() * f[c].derivatives().transpose();
    for (int j = 0; j < 4; ++j) {
      const auto n = static_cast<std::size_t>(j);
      const Eigen::Matrix<double, D, D> by_node =
          by.v * at.s[n] * by_point.template leftCols<D>() + by.q * at.s_x[n] * by_point.template rightCols<D>();
      for (int i = 0; i < 4; ++i) {
        matrix.template block<D, D>(D * i, D * j) += at.s[static_cast<std::size_t>(i)] * by_node;
      }
    }
  }
  return matrix;
}

/// The points of an element at the joint move along the beam with it.
template <int D>
PointMatrix<D> Drag<D>::moving_tangent(const ChainView<D>& beam, int k, const TangentWeights& by) const {
  using Real = ElementReal<D>;
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  const MovingKinematics<Real, D> element = active_element(beam, k, by);
  for (const auto& [u, share] : gauss_legendre(quadrature_points)) {
    const PointMotion<Real, D> at = element.at(Real(u), rational_shape(element.weights(), Real(u)));
    PointForce<Real, D> f;
    f.on_r = this->force(at.v, at.r_x) * Real(element.length() * Real(share));
    add_point_tangent(beam, k, at, f, matrix);
  }
  return matrix;
}

template struct Drag<2>;
template struct Drag<3>;

}  // namespace vlbeam
