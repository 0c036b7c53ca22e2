#include "core/parts/drag.hpp"

namespace vlbeam {
namespace {

/// Integrals of the products of two shape functions, of r_A, s_A, r_B and s_B, of element k, which has a fixed length.
Eigen::Matrix4d overlaps(const Mesh& mesh, int k, int points) {
  const auto i = static_cast<std::size_t>(k);
  const Weights<double>& weights = mesh.weights[i].w;
  const double length = mesh.x[i + 1] - mesh.x[i];
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const auto& [u, share] : gauss_legendre(points)) {
    const ShapeTable<double> f = shape_at(weights, weights == unit_weights, u);
    const Eigen::Vector4d s(f[0][0], length * f[1][0], f[2][0], length * f[3][0]);
    sum += share * length * s * s.transpose();
  }
  return sum;
}

}  // namespace

template <int D>
Tally Drag<D>::add_proportional_force(const ChainView<D>& beam, int k, double* out) const {
  const Eigen::Matrix4d mass = linear.normal * overlaps(beam.mesh, k, quadrature_points);
  const auto e = element_nodes<D>(beam.rate, k);
  const std::array<Vec<double, D>, 4> v{e.r_a - stream, e.s_a, e.r_b - stream, e.s_b};
  Tally power;
  for (int i = 0; i < 4; ++i) {
    Vec<double, D> f = Vec<double, D>::Zero();
    for (int j = 0; j < 4; ++j) f -= mass(i, j) * v[static_cast<std::size_t>(j)];
    Eigen::Map<Vec<double, D>>(out + beam.vector(k, i)) += f;
    power.dissipated -= f.dot(v[static_cast<std::size_t>(i)]);
    if (i % 2 == 0) power.loads += f.dot(stream);
  }
  return power;
}

template <int D>
PointMatrix<D> Drag<D>::proportional_tangent(const ChainView<D>& beam, int k, const TangentWeights& by) const {
  const Eigen::Matrix4d mass = by.v * linear.normal * overlaps(beam.mesh, k, quadrature_points);
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) matrix.template block<D, D>(D * i, D * j).diagonal().setConstant(mass(i, j));
  }
  return matrix;
}

template <int D>
Tally Drag<D>::add_forces(const ChainView<D>& beam, double* out, double* on_marks) const {
  Tally power;
  const auto visit = [&](int k, const PointMotion<double, D>& at, const Vec<double, D>& f, double weight) {
    const double given = f.dot(stream);
    power.loads += weight * given;
    power.dissipated += weight * (given - f.dot(at.v));
    if (on_marks == nullptr) return;
    on_marks[k] += weight * f.dot(at.y_a);
    on_marks[k + 1] += weight * f.dot(at.y_b);
  };
  for (int k = 0; k < beam.mesh.elements(); ++k) {
    if (proportional() && !moves_along(beam, k)) {
      power = power + add_proportional_force(beam, k, out);
    } else {
      add_line_force_of<D>(beam, k, quadrature_points, *this, out, visit);
    }
  }
  return power;
}

template struct Drag<2>;
template struct Drag<3>;

}  // namespace vlbeam
