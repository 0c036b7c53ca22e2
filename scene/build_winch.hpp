#pragma once

#include "mechanics/motion/system/beam_model.hpp"
#include "mechanics/motion/system/observation.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// A joint's material coordinate, from its way along the beam.
TimeFunction travelling(double from, const TimeFunction& way);

/// Makes a joint of an end of the beam through which it is fed; `length` [m] is the beam's at t = 0.
template <int D>
void add_winch(const Scene& scene, bool at_start, double length, BeamModel<D>& model);

/// A joint on the beam at an instant.
template <int D>
struct JointNow {
  int index;       ///< which of the model's
  double x, rate;  ///< material coordinate [m] and its rate [m/s]
  Vec<double, D> position, slope, slope_rate;
};

/// What the winch there does at an instant, by its joint and the accelerations and forces that belong to it.
template <int D>
WinchSample look_at_winch(const Scene& scene, bool at_start, const BeamModel<D>& model, const JointNow<D>& joint,
                          const OuterForces<D>& forces, const Vec<double, D>& gravity, double t);

}  // namespace vlbeam
