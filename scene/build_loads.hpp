#pragma once

#include "mechanics/frames/section_moment.hpp"
#include "mechanics/motion/parts/loads.hpp"
#include "mechanics/spin/spin.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// The loads of a scene: those at a node say which, and a torque or a moment in space has a place among the loads, too.
template <int D>
struct BeamLoads {
  Loads<D> loads;
  Torques torques;
  std::vector<SectionMoment> moments;
};
template <int D>
BeamLoads<D> build_loads(const Scene& scene);

}  // namespace vlbeam
