#pragma once

#include <algorithm>

#include "scene/scene.hpp"

namespace vlbeam {

// What follows from a scene where it does not say.

/// A scene of which only the setting is given. Options that depend on others stay open; the functions below say what
/// they stand for.
Scene scene_in(SceneSetting setting);

/// Gauss points an element: those that the scene asks for, or its element's default; and those of an element whose
/// weights are 1, which needs fewer by default unless its rope goes slack.
int quadrature_points(const Scene& scene);
int points_of_polynomials(const Scene& scene);

/// Where the axial strain of the scene's elements is summed. By default: at nodes and middle if EA l^2/EI of an element
/// of standard length is above 100; so of ropes (EI = 0) without a bare end or a winch that runs freely; else at all.
AxialStrain axial_strain(const Scene& scene);

/// Length of the beam [m] and standard element length L_std [m].
double beam_length(const Scene& scene);
double standard_length(const Scene& scene);

/// Whether the beam's axis is curved. Corners at joints and knots do not count.
bool is_curved(const Scene& scene);

/// Whether strains are measured from a shape other than a straight, unstrained one.
bool has_rest_shape(const Scene& scene);

/// Whether sections have frames, so that the beam bends about two axes and twists. By default they have, in space, if
/// the two bending stiffnesses differ, or if the beam is curved at rest and bends, unless the scene says that nothing
/// leaves its plane.
bool has_frames(const Scene& scene);

/// How the elements of the scene follow a curved axis: evenly. In the paper's setting exactly, if its elements can, and
/// if no mass slides along a beam that is curved at rest.
AxisForm axis_form(const Scene& scene);

/// Where a cut's new node is, and how the scene's elements are merged. By default both are relaxed with sampled axial
/// strain. Without it cuts are exact; merges are by the paper's fit, or with the weights of the arc if the beam is
/// curved at rest, or with unit weights if its sections have frames or it is a rope.
CutPolicy cut_policy(const Scene& scene);
MergePolicy merge_policy(const Scene& scene);
/// Whether a merge fits weights. Of a rope, or of sections with frames, only where the scene names how to merge.
bool merges_rationally(const Scene& scene);

/// Whether an element's weights are 1 and stay 1.
inline bool is_polynomial(ElementKind kind) { return kind == ElementKind::ale_ancf || kind == ElementKind::ancf; }

/// What slides along the beam, in order; a sliding mass is one that is free.
inline std::vector<SlidingJointSpec> sliding_joints(const Scene& scene) {
  if (!scene.sliding_mass) return scene.sliding_joints;
  SlidingJointSpec free;
  static_cast<SlidingMassSpec&>(free) = *scene.sliding_mass;
  return {free};
}
/// The first of them, or null; how it is held, and the pointer of the options of one.
inline const SlidingMassSpec* sliding_joint(const Scene& scene) {
  if (!scene.sliding_joints.empty()) return &scene.sliding_joints.front();
  return scene.sliding_mass ? &*scene.sliding_mass : nullptr;
}
inline SupportType joint_support(const Scene& scene) {
  return scene.sliding_joints.empty() ? SupportType::free : scene.sliding_joints.front().support;
}
/// Whether something guides a joint along the beam.
inline bool guided(const Scene& scene) {
  return std::any_of(scene.sliding_joints.begin(), scene.sliding_joints.end(),
                     [](const SlidingJointSpec& joint) { return joint.x.has_value(); });
}
/// Whether one of the joints is a nut.
inline bool threaded(const Scene& scene) {
  return std::any_of(scene.sliding_joints.begin(), scene.sliding_joints.end(),
                     [](const SlidingJointSpec& joint) { return joint.pitch.has_value(); });
}
/// Whether an end feeds the beam: a winch there pays beam out or draws beam in.
inline bool fed(const Scene& scene) { return scene.start.pays_out() || scene.end.pays_out(); }
/// Whether there are more nodes that can move along the beam than that of one sliding joint.
bool has_several_joints(const Scene& scene);
/// Whether a block holds that one of the sliding joints.
inline bool in_block(const Scene& scene, std::size_t joint) {
  return std::ranges::any_of(scene.blocks, [joint](const BlockSpec& block) {
    return std::ranges::find(block.joints, static_cast<int>(joint)) != block.joints.end();
  });
}

inline std::string joint_key(const Scene& scene, std::size_t which = 0) {
  return scene.sliding_joints.empty() ? "/sliding_mass" : "/sliding_joints/" + std::to_string(which);
}

/// The condition on the beam's slopes at the joint. In statics a beam has two slopes in a sleeve, one on each side.
/// Both have the sleeve's direction; their lengths may differ, so that the stretch jumps where the tension does.
inline JointSlopes joint_slopes(const Scene& scene, const SlidingJointSpec& joint) {
  const bool sleeve = scene.analysis == Analysis::statics && joint.support == SupportType::clamp;
  return sleeve ? JointSlopes::tangent : joint.slopes;
}

/// Whether a motion starts from an equilibrium.
inline bool starts_in_equilibrium(const Scene& scene) {
  return scene.analysis == Analysis::dynamics && scene.initial_shape == InitialShape::equilibrium;
}

/// What becomes of joints while an equilibrium is sought: released in statics. Where a motion starts from it they are
/// held, but for a rope that runs through rings alone: an equilibrium is one of the rings, too.
StaticJoints static_joints(const Scene& scene);

/// How weights follow the ends of the scene's elements: by default they are frozen, but transported if the beam is
/// curved at rest.
WeightTransport weight_transport(const Scene& scene);

/// Whether several joints may come to rest against supports and each other.
bool joints_may_rest(const Scene& scene);
/// Distance of the nodes of joints that touch, or of a joint and the support that it strikes, over an element's length.
inline double contact_distance(const Scene& scene) { return scene.contact.value_or(ContactSpec{}).distance; }
/// Distance from a free end at which a joint of the scene leaves [m].
double separation_distance(const Scene& scene, const SlidingMassSpec& joint);

/// Length of the last element, over L_std, at which the sliding mass of the scene loses its node; 0 for never.
double end_merge(const Scene& scene);
/// Length of an element beside a joint, over L_std, below which it is merged with the next one; 0 for never.
double merge_below(const Scene& scene);
/// With what is not given.
AbsoluteTolerances with_defaults(AbsoluteTolerances atol, const Scene& scene);

/// Whether a scene flows or has rotary inertia: the nodes of its beam then travel as prescribed, or stand still so.
inline bool flows(const Scene& scene) { return scene.flow || scene.beam.rotary_inertia != BendingInertia::none; }

/// Whether springs hold points between the ends of its beam.
inline bool has_springs(const Scene& scene) {
  return std::any_of(scene.bearings.begin(), scene.bearings.end(),
                     [](const BearingSpec& bearing) { return bearing.type == BearingType::spring; });
}

/// Whether its samples have a FlowSample: anything but supports works on the beam.
inline bool has_flow_sample(const Scene& scene) {
  const bool acts =
      !scene.loads.empty() || scene.fluid || scene.ground || has_springs(scene) || !scene.vehicles.empty();
  return flows(scene) || scene.spin || acts || scene.start.winds_freely() || scene.end.winds_freely();
}

/// What such a scene starts with by default: the spin of its first drive [rad/s], and the velocity of the matter along
/// the axis with which node 0 stands still [m/s].
double initial_spin(const Scene& scene);
double initial_velocity(const Scene& scene);

}  // namespace vlbeam
