#pragma once

#include "mechanics/flow/flow_room.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/spin/spin_room.hpp"

namespace vlbeam::torsion {

/// The motion of the angles of a shaft about its axis, which flows along it at `speed` [m/s]; held where its ends are.
inline LinearMotion angle_flow(const BeamSection& section, const SpinSection& spin, double length, int elements,
                               bool start_held, bool end_held, double speed, Formulation formulation,
                               AngleField field) {
  BeamModel<3> model;
  model.section = section;
  spin_in(model).section = spin;
  spin_in(model).field = field;
  model.formulation = formulation;
  flow_in(model).motion = MeshMotion({{0, steadily(0, -speed)}, {elements, steadily(length, -speed)}});
  model.start = model.end = Support<3>::pin();
  if (start_held) spin_in(model).drives.push_back({0, steadily(0, 0)});
  if (end_held) spin_in(model).drives.push_back({elements, steadily(0, 0)});
  BeamSystem<3> beam(model, straight_chain(model));
  return linear_flows(beam, straight_state<3>(beam, Vec<double, 3>::Zero(), Vec<double, 3>::UnitX(), 1, speed, 0))
      .angles;
}

}  // namespace vlbeam::torsion
