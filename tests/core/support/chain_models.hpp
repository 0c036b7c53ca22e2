#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/element/quadrature.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "tests/core/support/chain_states.hpp"

namespace vlbeam::test {

inline constexpr std::array all_slopes{JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free};

/// A free beam, with a sliding mass if the shape has a joint; stiffness, mass and gravity of ordinary size.
template <int D>
BeamModel<D> model_of(const ChainShape& shape, Random& random) {
  BeamModel<D> model;
  model.section = {1.3, {20, 0.3}, 0, 0.1};
  model.transport = shape.transport;
  model.gravity = random.vector<D>(10);
  model.length_control.standard_length = shape.element_length;
  for (const auto& joint : shape.joints()) model.joints.push_back({.law = {0.4, joint.slopes}});
  if (shape.rider >= 0) model.joints = {{.law = {0.4, shape.slopes}}};
  return model;
}

/// Forces of every kind on a beam of this length that change in time: at points that travel, of fixed directions and
/// along the tangent, and along the whole beam.
template <int D>
Loads<D> loads_on(double length, Random& random) {
  const auto swinging = [&random](double size) {
    return [size, phase = random.uniform(0, 6)](double t) { return size * std::sin(5 * t + phase); };
  };
  Loads<D> loads;
  for (const double place : {0.05, 0.3, 0.45, 0.6, 0.95}) {
    loads.points.push_back({.x = [x = place * length, speed = 0.02 * length](double t) { return x + speed * t; },
                            .force = [size = swinging(4), along = random.vector<D>()](double t) -> Vec<double, D> {
                              return size(t) * along;
                            },
                            .follower = swinging(3)});
  }
  if (D == 2) {
    for (const double place : {0.1, 0.42, 0.57}) {
      loads.points.push_back({.x = [x = place * length](double) { return x; }, .moment = swinging(2)});
    }
  }
  loads.line_force = [size = swinging(5), along = random.vector<D>()](double t) -> Vec<double, D> {
    return size(t) * along;
  };
  return loads;
}

/// Some on every part of a beam of this length.
template <int D>
PointMasses<D> masses_on(double length) {
  return {{{0.1 * length, 0.3}, {0.35 * length, 0.2}, {0.52 * length, 0.4}, {0.8 * length, 0.1}, {length, 0.2}}};
}

/// Angular momentum about the origin by the model's own points; in the plane its last component only.
template <int D>
Vec<double, 3> angular_momentum(const BeamSystem<D>& system, const Eigen::VectorXd& y) {
  const auto& model = system.model();
  const auto chain = system.chain(y, 0);
  auto in_space = [](const Vec<double, D>& v) {
    Vec<double, 3> result = Vec<double, 3>::Zero();
    result.template head<D>() = v;
    return result;
  };
  Vec<double, 3> sum = Vec<double, 3>::Zero();
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double x_a = chain.mesh.x[i], x_b = chain.mesh.x[i + 1];
    for (const auto& [u, weight] : gauss_legendre(model.quadrature_points)) {
      const auto at = point_motion(chain, model.transport, x_a + u * (x_b - x_a));
      sum += weight * (x_b - x_a) * model.section.rhoA * in_space(at.r).cross(in_space(at.v));
    }
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const auto mass = system.mass_motion(y, static_cast<int>(i));
    if (mass) sum += model.joints[i].law.mass * in_space(mass->r).cross(in_space(mass->v));
  }
  return sum;
}

}  // namespace vlbeam::test
