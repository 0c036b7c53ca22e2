#include "scene/validate_nut.hpp"

#include <cmath>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

void check_parts_of_nut(const Scene& scene, const std::string& at) {
  if (!scene.spin) refuse("/spin", InvalidInput::missing, at + " is that of a nut: it needs a beam that spins");
  if (flows(scene)) refuse(at, "this key", "it goes together with neither /flow nor rotary inertia");
  if (scene.spin->angles != AngleField::hermite) {
    refuse(
        "/spin/angles", quoted(scene.spin->angles),
        "with a nut it must be " + quoted(AngleField::hermite) + ": the nut's speed would jump where the twist does");
  }
  if (scene.length_control.velocities == VelocityTransfer::conservative) {
    refuse("/length_control/velocities", quoted(scene.length_control.velocities), "with a nut take \"projected\"");
  }
  if (scene.length_control.end_merge.value_or(0) > 0) {
    refuse("/length_control/end_merge", number_text(*scene.length_control.end_merge),
           "a nut keeps its node to the last: it must be 0");
  }
}

}  // namespace

void validate_nut(const Scene& scene) {
  int nuts = 0;
  for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
    const SlidingJointSpec& joint = scene.sliding_joints[i];
    if (!joint.pitch) continue;
    const std::string key = joint_key(scene, i), at = key + "/pitch";
    if (!std::isfinite(*joint.pitch) || *joint.pitch == 0) {
      refuse(at, number_text(*joint.pitch), "it must be a number other than 0 [m]: > 0 is right-handed");
    }
    if (++nuts > 1) refuse(at, "a second nut", "a beam bears one at most");
    check_parts_of_nut(scene, at);
    if (joint.x) refuse(at, "this key", "beside /x, which guides the joint, it cannot be");
    if (joint.velocity != 0) {
      refuse(key + "/velocity", number_text(joint.velocity), "of a nut it must be 0: the spin gives it its speed");
    }
    if (joint.support != SupportType::free && initial_spin(scene) != 0) {
      refuse("/spin/rate", number_text(initial_spin(scene)),
             "where a nut is held, the beam must start without spin: 0");
    }
    if (joint.at_support != AtSupport::stop) {
      refuse(key + "/at_support", quoted(joint.at_support), "of a nut it must be \"stop\"");
    }
  }
}

}  // namespace vlbeam
