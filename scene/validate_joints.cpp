#include "scene/validate_joints.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/build_flow.hpp"
#include "scene/model_errors.hpp"
#include "scene/options.hpp"
#include "scene/time_function.hpp"
#include "scene/validate_feed.hpp"

namespace vlbeam {
namespace {

constexpr int samples_of_a_way = 1000;
constexpr double least_apart = 0.2;  // of an element's length: joints at the start

/// Of several joints; `key` is what lets them rest.
void check_rest(const Scene& scene, const std::string& key) {
  if (joints_may_rest(scene)) return;
  const bool by_restitution = key.ends_with("/restitution");
  refuse(
      key, by_restitution ? "0" : "\"rest\"",
      "several joints rest with explicit integrators and \"generalized-alpha\", and with neither friction nor a nut: "
      "take " +
          std::string(by_restitution ? "a number > 0" : "\"rebound\" or \"stop\""));
}

/// One of several joints that strikes supports.
void check_strike(const Scene& scene, std::size_t which) {
  const SlidingJointSpec& joint = scene.sliding_joints[which];
  if (joint.at_support == AtSupport::stop) return;
  const std::string key = joint_key(scene, which);
  if (joint.at_support == AtSupport::rest) check_rest(scene, key + "/at_support");
  if (joint.at_support == AtSupport::rebound && joint.restitution == 0) check_rest(scene, key + "/restitution");
  const double least = contact_distance(scene) * standard_length(scene), length = beam_length(scene);
  const bool near_start = scene.start.type != SupportType::free && joint.position <= least;
  const bool near_end = scene.end.type != SupportType::free && joint.position >= length - least;
  if (near_start || near_end) {
    refuse(key + "/position", number_text(joint.position),
           "it strikes a support at a distance of /contact/distance elements, " + number_text(least) +
               " [m], and must start farther from it");
  }
}

void check_contact(const Scene& scene) {
  const auto& joints = scene.sliding_joints;
  if (joints.size() < 2) refuse("/contact", "this key", "it is of several /sliding_joints: leave it out");
  if (scene.contact->joints == AtSupport::stop) return;
  if (scene.contact->joints == AtSupport::rest) check_rest(scene, "/contact/joints");
  if (scene.contact->joints == AtSupport::rebound && scene.contact->restitution == 0) {
    check_rest(scene, "/contact/restitution");
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!joints[i].pitch) continue;
    refuse("/contact/joints", quoted(scene.contact->joints),
           "with a nut, " + joint_key(scene, i) + ", whose shaft takes part in the impact, it must be \"stop\"");
  }
}

/// What several joints do not go together with.
void check_several_joints(const Scene& scene) {
  if (scene.sliding_mass && !scene.sliding_joints.empty()) {
    refuse("/sliding_joints", "this key", "it does not go together with /sliding_mass, which is one of them");
  }
  const auto& joints = scene.sliding_joints;
  if (scene.contact) check_contact(scene);
  if (joints.size() < 2) return;
  // those that strike each other start farther apart than they touch
  const bool strike = scene.contact && scene.contact->joints != AtSupport::stop;
  const double share = strike ? std::max(least_apart, contact_distance(scene) * (1 + 1e-9)) : least_apart;
  const double apart = share * standard_length(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::string key = joint_key(scene, i);
    if (i > 0 && !(joints[i].position >= joints[i - 1].position + apart)) {
      refuse(key + "/position", number_text(joints[i].position),
             std::string("joints stand in order along the beam and ") +
                 (share > least_apart ? "farther apart than /contact/distance" : "a fifth of an element apart") +
                 ": at least " + number_text(joints[i - 1].position + apart) + " [m], by that of " +
                 joint_key(scene, i - 1));
    }
    check_strike(scene, i);
  }
  if (scene.length_control.end_merge.value_or(0) > 0) {
    refuse("/length_control/end_merge", number_text(*scene.length_control.end_merge),
           "with several joints each keeps its node: it must be 0");
  }
  if (scene.integrator.type == IntegratorType::energy_momentum) {
    refuse("/integrator/type", quoted(scene.integrator.type), "it knows one sliding mass at most: take any other");
  }
  if (axis_form(scene) == AxisForm::exact && scene.beam.curve.type != CurveType::line) {
    refuse("/beam/axis", "\"exact\"", "with several joints it must be \"even\"");
  }
}

/// A ring or a sleeve.
void check_held_joint(const Scene& scene, std::size_t which) {
  const std::string key = joint_key(scene, which);
  const SlidingJointSpec& joint = scene.sliding_joints[which];
  const std::string support = quoted(joint.support);
  if (joint.support == SupportType::free) {
    if (!(joint.mass > 0) && !joint.x && !in_block(scene, which)) {
      refuse(key + "/mass", number_text(joint.mass),
             "nothing holds this joint: without a mass it has no motion of its own");
    }
    return;
  }
  if (joint.support == SupportType::slide) {  // of a scene that was not read
    refuse(key + "/support", support, "it must be \"free\", \"pin\" (a ring) or \"clamp\" (a sleeve)");
  }
  if (joint.velocity != 0) {
    refuse(key + "/velocity", number_text(joint.velocity), "what is held starts at rest, with the beam in it");
  }
  if (joint.friction && joint.slopes == JointSlopes::equal_stretch) {
    refuse(key + "/slopes", quoted(joint.slopes),
           "friction makes the tensions differ on the two sides of what is held: take \"free\"");
  }
  if (joint.at_support != AtSupport::stop) {
    refuse(key + "/at_support", quoted(joint.at_support), "of a joint that is held it must be \"stop\"");
  }
  if (scene.length_control.end_merge.value_or(0) > 0) {
    refuse("/length_control/end_merge", number_text(*scene.length_control.end_merge),
           "a joint that is held keeps its node to the last: it must be 0");
  }
  if (scene.integrator.type == IntegratorType::energy_momentum) {
    refuse("/integrator/type", quoted(scene.integrator.type), "it knows no joint that is held: take any other");
  }
  if (joint.support == SupportType::pin) return;
  const bool tangent = scene.analysis == Analysis::statics && joint.slopes == JointSlopes::tangent;
  if (joint.slopes != JointSlopes::continuous && !tangent) {
    refuse(key + "/slopes", quoted(joint.slopes),
           "in a sleeve they must be \"continuous\", or in statics \"tangent\", which they are there");
  }
  if (merge_policy(scene) == MergePolicy::least_change) {
    refuse("/length_control/merge", "\"least-change\"", "it changes slopes that a sleeve holds: take another policy");
  }
}

/// A ring that is a wheel.
void check_pulley(const Scene& scene, std::size_t which) {
  const SlidingJointSpec& joint = scene.sliding_joints[which];
  if (!joint.pulley) return;
  const std::string key = joint_key(scene, which);
  if (joint.support != SupportType::pin) {
    refuse(key + "/support", quoted(joint.support), "what has a /pulley must be a ring, \"pin\"");
  }
  if (joint.friction) {
    refuse(key + "/friction", "this key", "over a /pulley the beam does not slip: leave one of the two out");
  }
  if (joint.slopes == JointSlopes::equal_stretch) {
    refuse(key + "/slopes", quoted(joint.slopes),
           "a /pulley makes the tensions differ on its two sides: take \"free\"");
  }
  if (joint.pitch) refuse(key + "/pitch", "this key", "a nut has no /pulley: leave one of the two out");
}

/// A guide may lead off a free end, but not into a support.
void check_way(const Scene& scene, const SlidingJointSpec& joint, const std::string& at) {
  const TimeFunction way = acting(*joint.x, scene.analysis);
  const auto ends = beam_ends(scene);
  const double until = scene.analysis == Analysis::statics ? 1 : scene.duration;  // the load factor
  for (int i = 0; i <= samples_of_a_way; ++i) {
    const double t = until * i / samples_of_a_way, x = joint.position + way(t).value;
    const auto [first, last] = ends(t);
    const bool beyond_start = x <= first, beyond_end = x >= last;
    if (!beyond_start && !beyond_end) continue;
    if ((beyond_start ? scene.start : scene.end).type == SupportType::free) return;
    refuse(at, "a material coordinate of " + number_text(x) + " m at t = " + number_text(t) + " s",
           "the beam's " + std::string(beyond_start ? "start, " : "end, ") + number_text(beyond_start ? first : last) +
               " m, is held: the joint must not reach it within /duration");
  }
}

/// A joint whose way along the beam is given.
void check_guided_joint(const Scene& scene, std::size_t which) {
  const SlidingJointSpec& joint = scene.sliding_joints[which];
  if (!joint.x) return;
  const std::string key = joint_key(scene, which), at = key + "/x";
  if (joint.velocity != 0) {
    refuse(key + "/velocity", number_text(joint.velocity),
           "beside /x, which gives the joint its velocity, it must be 0");
  }
  if (joint.support != SupportType::free) {
    const double rate = time_function(*joint.x)(0).rate;
    if (std::abs(rate) > 1e-12 * largest_rate(*joint.x)) {
      refuse(at, "a velocity of " + number_text(rate) + " m/s at t = 0",
             "the beam starts from rest in what is held: give it a \"rate_ramp\" > 0 [s], or an oscillation a phase of "
             "90 degrees");
    }
    if (scene.initial_velocity)
      refuse(at, "this key", "of a joint that is held it does not go together with /initial_velocity");
  }
  if (joint.at_support != AtSupport::stop) {
    refuse(key + "/at_support", quoted(joint.at_support), "of a joint that is guided it must be \"stop\"");
  }
  check_way(scene, joint, at);
  if (scene.length_control.end_merge.value_or(0) > 0) {
    refuse("/length_control/end_merge", number_text(*scene.length_control.end_merge),
           "a joint that is guided keeps its node to the last: it must be 0");
  }
  if (scene.length_control.velocities == VelocityTransfer::conservative) {
    refuse("/length_control/velocities", "\"conservative\"", "with a joint that is guided take \"projected\"");
  }
  const IntegratorType type = scene.integrator.type;
  if (type == IntegratorType::energy_momentum || type == IntegratorType::ida) {
    refuse("/integrator/type", quoted(type), "it knows no joint that is guided: take any other");
  }
}

void check_sliding_mass(const Scene& scene) {
  if (!sliding_joint(scene)) return;
  const double length = beam_length(scene);
  if (scene.beam.element == ElementKind::rancf || scene.beam.element == ElementKind::ancf) {
    refuse("/beam/element", quoted(scene.beam.element),
           "a sliding mass needs an element of variable length: \"ALE-RANCF\" or \"ALE-ANCF\"");
  }
  const auto joints = sliding_joints(scene);
  const double half_element = standard_length(scene) / 2;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    // A mass on a node of the support, or of the free tip, would leave an element without length.
    const double margin = 1e-9 * length;
    if (!(joints[i].position > margin && joints[i].position < length - margin)) {
      refuse(joint_key(scene, i) + "/position", number_text(joints[i].position),
             "the mass must be inside the beam and not on its ends: more than " + number_text(margin) +
                 " and less than " + number_text(length - margin) + " [m]");
    }
  }
  place_nodes(scene, build_axis<3>(scene).breaks());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].separation_distance && !(*joints[i].separation_distance < half_element)) {
      refuse(joint_key(scene, i) + "/separation_distance", number_text(*joints[i].separation_distance),
             "it must be less than half an element, " + number_text(half_element) + " [m]");
    }
  }
}

void check_joint(const Scene& scene, std::size_t which) {
  const SlidingJointSpec mass = sliding_joints(scene)[which];
  const std::string key = joint_key(scene, which);
  const IntegratorType type = scene.integrator.type;
  if (mass.slopes != JointSlopes::continuous) {
    if (type == IntegratorType::rosenbrock4 || type == IntegratorType::energy_momentum ||
        type == IntegratorType::cvode) {
      refuse(key + "/slopes", quoted(mass.slopes),
             quoted(type) + " needs \"continuous\" slopes: take an explicit integrator, or \"generalized-alpha\"");
    }
  }
  if (mass.friction && type == IntegratorType::energy_momentum) {
    refuse(key + "/friction", "this key",
           "\"energy-momentum\" has no friction: take another integrator, or leave it out");
  }
}

}  // namespace

void validate_joints(const Scene& scene) {
  check_several_joints(scene);
  for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
    check_held_joint(scene, i);
    check_guided_joint(scene, i);
    check_pulley(scene, i);
  }
  check_sliding_mass(scene);
}

void validate_length_control(const Scene& scene) {
  const LengthControlSpec& control = scene.length_control;
  const double trigger = control.upper * (1 + control.hysteresis);
  if (!(trigger >= 1.5 && trigger < 2)) {
    refuse("/length_control/upper", number_text(control.upper),
           "upper (1 + hysteresis) = " + number_text(trigger) +
               " must be in [1.5, 2): below, an event re-fires at once in the other direction; from 2 on, the element "
               "ahead vanishes first");
  }
  if (!(merge_below(scene) < trigger - 1)) {
    refuse(control.lower ? "/length_control/lower" : "/length_control/hysteresis",
           control.lower ? number_text(*control.lower) : number_text(control.hysteresis),
           "/length_control/lower, here " + number_text(merge_below(scene)) +
               ", must be less than upper (1 + hysteresis) - 1 = " + number_text(trigger - 1) +
               ": what a cut leaves would be merged at once");
  }
  if (scene.sliding_joints.size() > 1 && control.enabled && control.lower == 0.0) {
    refuse("/length_control/lower", "0", "with several joints it must be > 0: each merges by itself");
  }
  if (control.end_merge && *control.end_merge > 0 && !control.enabled) {
    refuse("/length_control/end_merge", number_text(*control.end_merge),
           "without length control it must be 0: take \"enabled\": true, or leave it out");
  }
  const bool own = control.merge == MergePolicy::own;
  if (own && !control.merge_rule) {
    refuse("/length_control/merge", "\"own\"",
           "a scene file cannot hold a rule: a program that links the library gives it one, as merge_rule");
  }
  if (own && is_polynomial(scene.beam.element)) {
    refuse("/length_control/merge", "\"own\"",
           "weights are those of \"ale-rancf\": " + quoted(scene.beam.element) + " has none");
  }
  if (control.merge_rule && !own) {
    refuse("/length_control/merge", control.merge ? quoted(*control.merge) : "left out",
           "with a merge rule it must be \"own\"");
  }
  const bool several = scene.sliding_joints.size() > 1;  // they keep their nodes and strike at a distance
  if (!several && sliding_joint(scene) && sliding_joint(scene)->at_support != AtSupport::stop &&
      end_merge(scene) == 0) {
    refuse(control.enabled ? "/length_control/end_merge" : "/length_control/enabled", control.enabled ? "0" : "false",
           "\"at_support\": " + quoted(sliding_joint(scene)->at_support) +
               " needs a mass that reaches the support: take " + (control.enabled ? "a number in (0, 0.9]" : "true") +
               ", or \"at_support\": \"stop\"");
  }
}

void validate_joint_choices(const Scene& scene) {
  for (std::size_t i = 0; i < sliding_joints(scene).size(); ++i) check_joint(scene, i);
}

}  // namespace vlbeam
