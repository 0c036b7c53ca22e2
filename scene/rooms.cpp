#include "scene/rooms.hpp"

#include <string>

#include "core/error.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/sundials/sundials_stepper.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

[[noreturn]] void refuse_room(const char* room, const std::string& key, const std::string& value) {
  refuse(key, value,
         std::string("it needs \"") + room +
             "\", which this program is built without: build it with -DVLBEAM_ROOMS=all, or with a list that names it");
}

bool strikes(const SlidingJointSpec& joint) { return joint.at_support != AtSupport::stop; }

}  // namespace

// Of each room: what asks for it.
void refuse_missing_rooms(const Scene& scene) {
  if constexpr (!has_room("statics")) {
    if (scene.analysis == Analysis::statics) refuse_room("statics", "/analysis", quoted(scene.analysis));
    if (starts_in_equilibrium(scene)) refuse_room("statics", "/initial_shape", quoted(scene.initial_shape));
  }
  if constexpr (!has_room("assembly")) {
    if (scene.assembly) refuse_room("assembly", "/beams", "an array");
  }
  if (scene.assembly) return;  // its beams are scenes of their own
  if constexpr (!has_room("frames")) {
    if (has_frames(scene)) refuse_room("frames", "/beam/space_law", quoted(SpaceLaw::frames));
  }
  if constexpr (!has_room("spin")) {
    if (scene.spin) refuse_room("spin", "/spin", "an object");
  }
  if constexpr (!has_room("flow")) {
    if (scene.flow) refuse_room("flow", "/flow", "an object");
    if (flows(scene)) refuse_room("flow", "/beam/rotary_inertia", quoted(scene.beam.rotary_inertia));
  }
  if constexpr (!has_room("ride")) {
    if (end_merge(scene) > 0) refuse_room("ride", "/length_control/end_merge", number_text(end_merge(scene)));
  }
  if constexpr (!has_room("contact")) {
    const auto joints = sliding_joints(scene);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (strikes(joints[i])) {
        refuse_room("contact", joint_key(scene, i) + "/at_support", quoted(joints[i].at_support));
      }
    }
    if (scene.contact && scene.contact->joints != AtSupport::stop) {
      refuse_room("contact", "/contact/joints", quoted(scene.contact->joints));
    }
  }
  if constexpr (!has_room("ropes")) {
    if (scene.drag) refuse_room("ropes", "/drag", "an object");
    if (scene.fluid) refuse_room("ropes", "/fluid", "an object");
    if (scene.ground) refuse_room("ropes", "/ground", "an object");
    if (!scene.beam.sections.empty()) refuse_room("ropes", "/beam/sections", "an array");
    if (scene.beam.material.mass_damping > 0) {
      refuse_room("ropes", "/beam/material/mass_damping", number_text(scene.beam.material.mass_damping));
    }
  }
  if constexpr (!has_room("bearings")) {
    if (!scene.bearings.empty()) refuse_room("bearings", "/bearings/0/at", "an object");
  }
  if constexpr (!has_room("vehicles")) {
    if (!scene.vehicles.empty()) refuse_room("vehicles", "/vehicles", "an array");
  }
  if constexpr (!has_room("remesh")) {
    const bool slides = scene.length_control.enabled && (sliding_joint(scene) != nullptr || fed(scene));
    if (slides && cut_policy(scene) == CutPolicy::relaxed) {
      refuse_room("remesh", "/length_control/cut", quoted(CutPolicy::relaxed));
    }
    if (slides && merge_policy(scene) == MergePolicy::relaxed) {
      refuse_room("remesh", "/length_control/merge", quoted(MergePolicy::relaxed));
    }
  }
  if constexpr (!has_room("conserving")) {
    const IntegratorType type = scene.integrator.type;
    if (type == IntegratorType::energy_momentum) refuse_room("conserving", "/integrator/type", quoted(type));
  }
}

bool knows_sundials() {
  if constexpr (has_room("sundials")) {
    return have_sundials();
  } else {
    return false;
  }
}

}  // namespace vlbeam
