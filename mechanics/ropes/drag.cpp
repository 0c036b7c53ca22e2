#include "mechanics/ropes/drag.hpp"

#include "core/element/fixed_element.hpp"

namespace vlbeam {
namespace {

/// The mass matrix of element k, which has a fixed length, of 1 kg/m: by r_A, s_A, r_B, s_B.
std::array<std::array<double, 4>, 4> unit_mass(const Mesh& mesh, int k, int points) {
  const auto i = static_cast<std::size_t>(k);
  return fixed_inertia(mesh.x[i + 1] - mesh.x[i], mesh.weights[i].w, gauss_legendre(points)).mass;
}

}  // namespace

template <int D>
EnergyBalance Drag<D>::add_proportional_force(const ChainView<D>& beam, int k, double* out) const {
  const auto mass = unit_mass(beam.mesh, k, quadrature_points);
  const auto e = element_nodes<D>(beam.rate, k);
  const std::array<Vec<double, D>, 4> v{e.r_a - stream, e.s_a, e.r_b - stream, e.s_b};
  EnergyBalance power;
  for (std::size_t i = 0; i < 4; ++i) {
    Vec<double, D> f = Vec<double, D>::Zero();
    for (std::size_t j = 0; j < 4; ++j) f -= linear.normal * mass[i][j] * v[j];
    Eigen::Map<Vec<double, D>>(out + beam.vector(k, static_cast<int>(i))) += f;
    power.dissipated -= f.dot(v[i]);
    if (i % 2 == 0) power.loads += f.dot(stream);
  }
  return power;
}

template <int D>
PointMatrix<D> Drag<D>::proportional_tangent(const ChainView<D>& beam, int k, const TangentWeights& by) const {
  const auto mass = unit_mass(beam.mesh, k, quadrature_points);
  PointMatrix<D> matrix = PointMatrix<D>::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double damping = by.v * linear.normal * mass[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      matrix.template block<D, D>(D * i, D * j).diagonal().setConstant(damping);
    }
  }
  return matrix;
}

template <int D>
EnergyBalance Drag<D>::add_forces(const ChainView<D>& beam, double* out, double* on_marks) const {
  EnergyBalance power;
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
template class ActingDrag<2>;
template class ActingDrag<3>;

}  // namespace vlbeam
