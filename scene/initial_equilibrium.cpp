#include "scene/initial_equilibrium.hpp"

#include "core/error.hpp"
#include "mechanics/frames/frame_room.hpp"
#include "mechanics/rooms.hpp"
#include "scene/build.hpp"

namespace vlbeam {
namespace {

/// What acts at t = 0 grows with the load factor, which is the model's time; nothing else changes with it. Supports,
/// guides and what holds joints are at t = 0 where they are built.
template <int D>
BeamModel<D> at_start(BeamModel<D> model) {
  const auto hold = [](auto& of_time) {
    if (of_time) of_time = [value = of_time(0)](double) { return value; };
  };
  const auto grow = [](auto& of_time) {
    if (!of_time) return;
    using Value = decltype(of_time(0));
    of_time = [value = of_time(0)](double factor) -> Value { return factor * value; };
  };
  for (PointLoad<D>& load : model.loads.points) {
    hold(load.x);
    grow(load.force);
    grow(load.follower);
    grow(load.moment);
  }
  grow(model.loads.line_force);
  if constexpr (D == 3 && has_room("frames")) {
    if (frame_model(model) != nullptr) {
      FrameModel& frames = bring<FrameRoom>(model);
      for (Torques::Point& point : frames.torques.points) {
        hold(point.x);
        grow(point.torque);
      }
      grow(frames.torques.line);
      for (SectionMoment& moment : frames.moments) grow(moment.size);
    }
  }
  model.time_is_load_factor = true;
  model.start_motion = model.end_motion = {};
  for (ModelJoint<D>& joint : model.joints) {
    joint.motion = {};
    if (joint.x) joint.x = [x = joint.x(0).value](double) -> Prescribed { return {x, 0, 0}; };
  }
  model.length_control.velocities = VelocityTransfer::nodal;  // there are none
  model.length_control.end_merge = 0;
  if (model.joints.size() < 2) model.length_control.lower = 0;
  return model;
}

}  // namespace

EquilibriumOptions equilibrium_options(const Scene& scene) {
  const StaticsSpec& statics = scene.statics;
  return {.steps = statics.steps,
          .arc_length = statics.control == LoadControl::arc_length,
          .tolerance = statics.tolerance,
          .release = static_joints(scene) == StaticJoints::released,
          .conditions_at_held = starts_in_equilibrium(scene)};
}

namespace {

template <int D>
std::optional<InitialEquilibrium<D>> found_by(const Scene& scene, const EquilibriumOptions& options,
                                              const std::function<bool()>& goes_on) {
  const ChainState<D> shape = build_shape<D>(scene);
  BeamSystem<D> system(at_start(build_model<D>(scene)), shape);
  std::optional<Equilibrium> last;
  SolverCounters counters;
  const auto on_point = [&](const Equilibrium& at) {
    last = at;
    if (goes_on()) return true;
    last.reset();
    return false;
  };
  if constexpr (has_room("statics")) trace_equilibria<D>(system, options, on_point, counters);
  if (!last) return std::nullopt;
  return InitialEquilibrium<D>{system.chain(last->y, 0), static_sample_of(*last)};
}

}  // namespace

template <int D>
std::optional<InitialEquilibrium<D>> initial_equilibrium(const Scene& scene, const std::function<bool()>& goes_on) {
  EquilibriumOptions options = equilibrium_options(scene);
  try {
    return found_by<D>(scene, options, goes_on);
  } catch (const ComputationFailed&) {
    if (!options.release || scene.statics.joints) throw;
  }
  options.release = false;  // the rings have none: they are held until t = 0, and the run says so
  return found_by<D>(scene, options, goes_on);
}

template std::optional<InitialEquilibrium<2>> initial_equilibrium(const Scene&, const std::function<bool()>&);
template std::optional<InitialEquilibrium<3>> initial_equilibrium(const Scene&, const std::function<bool()>&);

}  // namespace vlbeam
