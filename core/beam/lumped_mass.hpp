#pragma once

#include <array>
#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/point_mass.hpp"
#include "core/element/shape_functions.hpp"

namespace vlbeam {

/// How much each nodal vector (r_A, s_A, r_B, s_B) of an element of length l counts in the place at u of it, 0 to 1.
inline std::array<double, 4> shares_at(const Weights<double>& weights, double l, double u) {
  const auto f = rational_shape(weights, u);
  return {f[0][0], l * f[1][0], f[2][0], l * f[3][0]};
}

/// Adds those on element k, of fixed length, to its mass matrix (order r_A, s_A, r_B, s_B); false where there are none.
/// A mass on a node belongs to the element behind it, as Mesh::element_at() has it.
inline bool add_point_masses(const std::vector<PointMass>& masses, const Mesh& mesh, int k,
                             std::array<std::array<double, 4>, 4>& matrix) {
  bool any = false;
  for (const PointMass& point : masses) {
    if (mesh.element_at(point.x) != k) continue;
    any = true;
    const auto i = static_cast<std::size_t>(k);
    const double l = mesh.x[i + 1] - mesh.x[i];
    const std::array<double, 4> s = shares_at(mesh.weights[i].w, l, (point.x - mesh.x[i]) / l);
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t column = 0; column < 4; ++column) matrix[row][column] += point.mass * s[row] * s[column];
    }
  }
  return any;
}

}  // namespace vlbeam
