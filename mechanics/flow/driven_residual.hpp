#pragma once

#include "core/element/moving_element.hpp"

namespace vlbeam {

// A variable-length element both of whose material coordinates are prescribed in time: what remains unknown are the
// nodal coordinates, and everything kinematic is linear in these.

/// Residual M q'' - Q of (r_A, s_A, r_B, s_B) from the element's equations, q'' = (e'', x_A'', x_B'').
template <class Real, int D>
std::array<Vec<Real, D>, 4> nodal_residual(const MovingEquations<Real, D>& eq, const MovingCoordinates<Real, D>& a) {
  const std::array<Vec<Real, D>, 4> nodal{a.e.r_a, a.e.s_a, a.e.r_b, a.e.s_b};
  std::array<Vec<Real, D>, 4> r;
  for (std::size_t i = 0; i < 4; ++i) {
    r[i] = eq.mass_a[i] * a.x_a + eq.mass_b[i] * a.x_b - eq.force[i];
    for (std::size_t j = 0; j < 4; ++j) r[i] += nodal[j] * eq.mass[i][j];
  }
  return r;
}

/// Its M q'' of nodes that alone accelerate.
template <class Real, int D>
std::array<Vec<Real, D>, 4> nodal_inertia(const MovingEquations<Real, D>& eq, const NodalCubic<Real, D>& a) {
  const std::array<Vec<Real, D>, 4> nodal{a.r_a, a.s_a, a.r_b, a.s_b};
  std::array<Vec<Real, D>, 4> r;
  for (std::size_t i = 0; i < 4; ++i) {
    r[i] = nodal[0] * eq.mass[i][0];
    for (std::size_t j = 1; j < 4; ++j) r[i] += nodal[j] * eq.mass[i][j];
  }
  return r;
}

/// That residual of x_A and x_B: the forces that guide the ends along the beam [N].
template <class Real, int D>
std::array<Real, 2> guiding_forces(const MovingEquations<Real, D>& eq, const MovingCoordinates<Real, D>& a) {
  const std::array<Vec<Real, D>, 4> nodal{a.e.r_a, a.e.s_a, a.e.r_b, a.e.s_b};
  std::array<Real, 2> force{eq.mass_aa * a.x_a + eq.mass_ab * a.x_b - eq.force_a,
                            eq.mass_ab * a.x_a + eq.mass_bb * a.x_b - eq.force_b};
  for (std::size_t j = 0; j < 4; ++j) {
    force[0] += eq.mass_a[j].dot(nodal[j]);
    force[1] += eq.mass_b[j].dot(nodal[j]);
  }
  return force;
}

}  // namespace vlbeam
