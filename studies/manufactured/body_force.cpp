#include "studies/manufactured/body_force.hpp"

#include "core/element/quadrature.hpp"
#include "mechanics/motion/parts/material_point.hpp"

namespace vlbeam::manufactured {

EnergyBalance BodyForce::add_force(const Motion<2>& now, double* force) const {
  constexpr int points = 6;  // b varies along an element far more slowly than they resolve
  double power = 0;
  const auto act = [&](int k, const MovingKinematics<double, 2>& element, double x, const PointForce<double, 2>& f) {
    const auto at = point_at<double, 2>(element, x);
    add_point_force<2>(now.beam, k, at, f, force);
    power += f.on_r.dot(at.v) + f.on_slope.dot(at.v_x);
  };
  const int last = now.beam.mesh.last();
  for (int k = 0; k < last; ++k) {
    const auto element = now.beam.kinematics(k);
    const double x_a = element.coordinates().x_a, l = element.length();
    for (const auto& [u, weight] : gauss_legendre(points)) {
      const double x = x_a + u * l;
      act(k, element, x, {weight * l * forces_.body(x, now.t), Vector::Zero()});
    }
    if (k == 0) {
      const auto [on_r, on_slope] = forces_.cut(x_a, now.t);
      act(k, element, x_a, {-on_r, -on_slope});
    }
    if (k + 1 == last) {
      const auto [on_r, on_slope] = forces_.cut(x_a + l, now.t);
      act(k, element, x_a + l, {on_r, on_slope});
    }
  }
  return {.loads = power};
}

}  // namespace vlbeam::manufactured
