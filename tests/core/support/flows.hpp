#pragma once

#include <cmath>
#include <numbers>

#include "mechanics/flow/flow_room.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "scene/stretch.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {

/// A span of 1 m between two pins, stretched by 1000 N, through which the beam flows at 40 m/s: the axially moving beam
/// of the shaft element's first example (r = 5 mm, aluminium). `raise` multiplies EA.
template <int D>
BeamModel<D> moving_span(int elements, bool bends, double speed, double raise = 1) {
  const CircularShaft shaft{.radius = 0.005, .density = 2700, .youngs_modulus = 70e9};
  BeamModel<D> model;
  model.section = shaft.section();
  model.section.stiffness.EA *= raise;
  if (!bends) model.section.stiffness.EI = 0;
  const double stretch = stretch_under(1000, model.section.stiffness.EA);
  flow_in(model).motion =
      MeshMotion({{0, steadily(0, -speed / stretch)}, {elements, steadily(1 / stretch, -speed / stretch)}});
  model.start = model.end = Support<D>::pin();
  return model;
}

/// Its steady state as a guess.
template <int D>
Eigen::VectorXd moving_span_state(const BeamSystem<D>& beam, double speed) {
  const double stretch = 1 / beam.mesh().length();
  return straight_state<D>(beam, Vec<double, D>::Zero(), Vec<double, D>::UnitX(), stretch, speed, 0);
}

/// First torsional frequency of a rod fixed at both ends that flows at half the speed of its waves; l = c = 1.
inline double flowing_rod(int elements, Formulation formulation, AngleField field = AngleField::linear) {
  BeamModel<2> model;
  model.section = {.rhoA = 1, .stiffness = {1, 1}};
  spin_in(model).section = {.rhoIp = 1, .GIp = 1};
  spin_in(model).field = field;
  model.formulation = formulation;
  flow_in(model).motion = MeshMotion({{0, steadily(0, -0.5)}, {elements, steadily(1, -0.5)}});
  model.start = model.end = Support<2>::pin();
  spin_in(model).drives = {{0, steadily(0, 0)}, {elements, steadily(0, 0)}};
  BeamSystem<2> beam(model, straight_chain(model));
  const Eigen::VectorXd y = straight_state<2>(beam, Eigen::Vector2d::Zero(), Eigen::Vector2d::UnitX(), 1, 0.5, 0);
  return frequencies(eigenvalues(linear_flows(beam, y).angles)).front();
}

/// A state in which everything moves: a curved, stretched, twisted beam with random rates.
template <int D>
Eigen::VectorXd random_state(const BeamSystem<D>& beam, Random& random, double size = 0.05) {
  Eigen::VectorXd y = straight_state<D>(beam, Vec<double, D>::Zero(), Vec<double, D>::UnitX(), 1, 0, 0);
  for (Eigen::Index i = 0; i < 2 * beam.coordinates(); ++i) y[i] += random.uniform(-size, size);
  return y;
}

}  // namespace vlbeam::test
