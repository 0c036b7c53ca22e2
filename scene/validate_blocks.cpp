#include "scene/validate_blocks.hpp"

#include <set>

#include "core/error.hpp"
#include "scene/derived.hpp"
#include "scene/model_errors.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

/// A joint that a block holds moves with it, and by nothing else.
void check_tied(const Scene& scene, std::size_t which) {
  const SlidingJointSpec& joint = scene.sliding_joints[which];
  const std::string key = "/sliding_joints/" + std::to_string(which);
  if (joint.support != SupportType::free) {
    refuse(key + "/support", quoted(joint.support), "a block holds this joint: it must be \"free\"");
  }
  if (joint.velocity != 0) {
    refuse(key + "/velocity", number_text(joint.velocity), "a block holds this joint: it starts at rest, with 0");
  }
}

}  // namespace

void validate_blocks(const Scene& scene) {
  if (scene.blocks.empty()) return;
  std::set<int> tied;
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    const BlockSpec& block = scene.blocks[i];
    const std::string at = "/blocks/" + std::to_string(i) + "/joints";
    if (block.joints.size() < 2) {
      refuse(at, std::to_string(block.joints.size()) + " entries", "a block ties at least two joints");
    }
    for (std::size_t k = 0; k < block.joints.size(); ++k) {
      const int joint = block.joints[k];
      const std::string entry = at + "/" + std::to_string(k);
      const int last = static_cast<int>(scene.sliding_joints.size()) - 1;
      if (joint > last) {
        refuse(entry, std::to_string(joint),
               "/sliding_joints has " + std::to_string(last + 1) + " entries: it must be one of 0 to " +
                   std::to_string(last));
      }
      if (!tied.insert(joint).second) {
        refuse(entry, std::to_string(joint), "this joint is in a block already: each may be in one, once");
      }
    }
    for (const int joint : block.joints) check_tied(scene, static_cast<std::size_t>(joint));
  }
  if (scene.initial_velocity && scene.initial_velocity->rotation != 0) {
    refuse("/initial_velocity/rotation", number_text(scene.initial_velocity->rotation),
           "blocks do not turn: it must be 0");
  }
  if (scene.analysis == Analysis::statics) {
    refuse("/blocks", "this key", "statics knows none: hold the joints, or leave it out");
  }
  if (starts_in_equilibrium(scene)) {
    refuse("/initial_shape", "\"equilibrium\"", "with /blocks a motion starts as \"built\"");
  }
  if (!joints_may_rest(scene)) {  // blocks are held by the same forces
    refuse("/blocks", "this key",
           "it goes together with explicit integrators and \"generalized-alpha\", and with neither friction nor a nut: "
           "leave one "
           "of the two out");
  }
}

}  // namespace vlbeam
