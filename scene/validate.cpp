#include "scene/validate.hpp"
#include "scene/bearings.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/error.hpp"
#include "core/geometry/nurbs.hpp"
#include "mechanics/rooms.hpp"
#include "scene/build.hpp"
#include "scene/build_flow.hpp"
#include "scene/corners.hpp"
#include "scene/model_errors.hpp"
#include "scene/options.hpp"
#include "scene/rooms.hpp"
#include "scene/scene_options.hpp"
#include "scene/shared_checks.hpp"
#include "scene/time_function.hpp"
#include "scene/validate_assembly.hpp"
#include "scene/validate_beam.hpp"
#include "scene/validate_blocks.hpp"
#include "scene/validate_feed.hpp"
#include "scene/validate_flow.hpp"
#include "scene/validate_frames.hpp"
#include "scene/validate_joints.hpp"
#include "scene/validate_loads.hpp"
#include "scene/validate_nut.hpp"
#include "scene/vehicles.hpp"

namespace vlbeam {
namespace {

constexpr double most_steps = 1e9;

/// Checks every option against the range of its line in the option table.
class RangeCheck {
 public:
  template <class T>
  void operator()(const Option& option, const T& member) const {
    if (option.when.holds) check<T>(option, member, std::string(option.pointer));
  }

  template <class T>
  bool present(const Option&, const std::optional<T>& part) const {
    return part.has_value();
  }

  template <class T>
  bool number_or(const Option& option, double number, const std::optional<T>& part) const {
    if (!part) (*this)(option, number);
    return part.has_value();
  }

  template <class T>
  void list(const Option&, const std::vector<T>&) const {}
  void time_function(const std::string& at, const TimeSpec& f) const { check_time_function(at, f); }
  void section(const Option&) const {}

 private:
  static bool within(const Range& range, double part) { return range.contains(part); }
  static bool within(const Range& range, const Point& part) {
    return std::ranges::all_of(part, [&range](double x) { return range.contains(x); });
  }

  /// `T` is the option's type, `part` the option or, of an array, an entry.
  template <class T, class Part>
  static void check(const Option& option, const Part& part, const std::string& field) {
    if constexpr (std::same_as<Part, double> || std::same_as<Part, int>) {
      if (!option.range.contains(part)) refuse(field, number_text(part), "it must be " + allowed_text<T>(option));
    } else if constexpr (OptionalNumber<Part>) {
      if (part) check<T>(option, *part, field);
    } else if constexpr (!NamedEnum<Part> && !OptionalEnum<Part> && !std::same_as<Part, bool> &&
                         !std::same_as<Part, std::string>) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        if (!within(option.range, part[i])) check<T>(option, part[i], field + "/" + std::to_string(i));
      }
    }
  }
};

void check_plane(const Scene& scene) {
  if (scene.dimension == 3) return;
  const auto in_plane = [](const std::string& field, const Point& p) {
    if (p[2] != 0) refuse(field + "/2", number_text(p[2]), "a planar scene has two components");
  };
  in_plane("/gravity", scene.gravity);
  const CurveSpec& curve = scene.beam.curve;
  in_plane("/beam/curve/start", curve.start);
  in_plane("/beam/curve/end", curve.end);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    in_plane("/beam/curve/points/" + std::to_string(i), curve.points[i]);
  }
  in_plane("/beam/curve/center", curve.center);
  for (std::size_t i = 0; i < curve.control_points.size(); ++i) {
    in_plane("/beam/curve/control_points/" + std::to_string(i), curve.control_points[i]);
  }
  if (scene.start.motion) in_plane("/supports/at=start/motion/direction", scene.start.motion->direction);
  if (scene.end.motion) in_plane("/supports/at=end/motion/direction", scene.end.motion->direction);
  for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
    const auto& motion = scene.sliding_joints[i].motion;
    if (motion) in_plane(joint_key(scene, i) + "/motion/direction", motion->direction);
  }
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    in_plane("/loads/" + std::to_string(i) + "/direction", scene.loads[i].direction);
  }
  if (!scene.initial_velocity) return;
  in_plane("/initial_velocity/translation", scene.initial_velocity->translation);
  in_plane("/initial_velocity/about", scene.initial_velocity->about);
  if (scene.initial_velocity->axis != InitialVelocitySpec{}.axis) {
    refuse("/initial_velocity/axis", "this key", "a planar scene turns in its plane: leave it out");
  }
}

void check_energy_momentum(const Scene& scene) {
  if (scene.integrator.type != IntegratorType::energy_momentum) return;
  if (has_rest_shape(scene)) {
    refuse("/beam/rest_shape", quoted(scene.beam.rest_shape),
           "\"energy-momentum\" measures strains from a straight beam: take \"paper\", or another integrator");
  }
  if (!scene.loads.empty()) {
    refuse("/integrator/type", quoted(scene.integrator.type),
           "it keeps an energy that loads change: take any other integrator");
  }
  if (scene.drag || scene.beam.material.mass_damping > 0) {
    refuse("/integrator/type", quoted(scene.integrator.type),
           "it keeps an energy that /drag and mass_damping take: take any other integrator");
  }
  if (scene.beam.compression == Compression::none) {
    refuse("/integrator/type", quoted(scene.integrator.type),
           "it knows no rope that goes slack (/beam/compression \"none\"): take any other integrator");
  }
  if (!scene.point_masses.empty()) {
    refuse("/integrator/type", quoted(scene.integrator.type), "it knows no /point_masses: take any other integrator");
  }
  if (!sliding_joint(scene)) return;
  if (scene.formulation != Formulation::variational) {
    refuse("/formulation", quoted(scene.formulation),
           "\"energy-momentum\" with a sliding mass needs \"variational\": the virtual work has no energy to keep");
  }
  if (weight_transport(scene) == WeightTransport::transported && scene.beam.element == ElementKind::ale_rancf) {
    refuse("/weights", quoted(weight_transport(scene)),
           "\"energy-momentum\" with a sliding mass needs \"frozen\" weights, or \"ALE-ANCF\" elements");
  }
}

void check_integrator(const Scene& scene) {
  const IntegratorSpec& integrator = scene.integrator;
  const std::string type = quoted(integrator.type);
  if (of_sundials(integrator.type) && !knows_sundials()) {
    refuse("/integrator/type", type,
           "this program is built without SUNDIALS: install it (Debian: libsundials-dev) and build with "
           "-DVLBEAM_SUNDIALS=ON, or take another integrator");
  }
  if (scene.constraints == Constraints::multipliers && integrator.type != IntegratorType::generalized_alpha &&
      integrator.type != IntegratorType::ida) {
    refuse("/constraints", "\"multipliers\"",
           type + " integrates minimal coordinates: take \"eliminated\", or the integrator \"generalized-alpha\"");
  }
  if (scene.constraints == Constraints::eliminated && integrator.type == IntegratorType::ida) {
    refuse("/constraints", "\"eliminated\"", "\"ida\" integrates with constraints: take \"multipliers\"");
  }
  if (has_fixed_step(integrator.type) && integrator.step > scene.duration) {
    refuse("/integrator/step", number_text(integrator.step),
           "it must be at most the duration, " + number_text(scene.duration) + " [s]");
  }
  if (has_fixed_step(integrator.type) && scene.duration / integrator.step > most_steps) {
    if (integrator.automatic) {
      refuse("/duration", number_text(scene.duration),
             "the longest step for this scene, " + six_digits(integrator.step) +
                 " s, must leave at most 1e9 of them: it must be at most " + six_digits(most_steps * integrator.step) +
                 " [s]");
    }
    refuse("/integrator/step", number_text(integrator.step),
           "it must leave at most 1e9 steps in the duration of " + number_text(scene.duration) + " s");
  }
}

/// How fast the beam turns at t = 0 where a clamp holds it: in its plane, or about its tangent [rad/s].
double initial_turning(const Scene& scene, bool at_end) {
  if (!scene.initial_velocity) return 0;
  if (scene.dimension == 2) return scene.initial_velocity->rotation;
  const Axis<3> axis = build_axis<3>(scene);
  const Vec<double, 3> about = vector_of<3>(scene.initial_velocity->axis).normalized();
  return scene.initial_velocity->rotation * about.dot(axis.tangent(at_end ? axis.length() : 0).normalized());
}

/// Of a support's angle; `at` is where its motion stands.
void check_turning(const Scene& scene, const std::string& at, const SupportSpec& support) {
  const std::string key = at + "/angle";
  if (support.type != SupportType::clamp) {
    refuse(key, "this key", "only a \"clamp\" can turn: a " + quoted(support.type) + " holds no direction");
  }
  const bool frames = has_frames(scene);  // it turns about the beam's tangent then
  if (scene.dimension == 3 && !frames) {
    refuse(key, "this key", "a clamp turns in a planar scene, or one with /beam/space_law \"frames\"");
  }
  if (scene.analysis == Analysis::statics && !frames) refuse(key, "this key", "statics knows none: leave it out");
  if (scene.analysis == Analysis::statics) return;
  if (frames && scene.integrator.type != IntegratorType::generalized_alpha) {
    refuse("/integrator/type", quoted(scene.integrator.type),
           "a clamp that turns in space needs \"generalized-alpha\"");
  }
  if (scene.integrator.type == IntegratorType::ida) {
    refuse("/integrator/type", quoted(scene.integrator.type),
           "it knows no clamp that turns: take any other but \"energy-momentum\"");
  }
  const double rate = time_function(*support.motion->angle)(0).rate;
  const double beam = initial_turning(scene, &support == &scene.end);
  if (std::abs(rate - beam) > 1e-12 * (largest_rate(*support.motion->angle) + std::abs(beam))) {
    refuse(key, "a rate of " + number_text(rate) + " rad/s at t = 0",
           "a clamp turns at first as the beam does, by " + number_text(beam) +
               " rad/s: give it a ramp > 0 [s], or the beam this /initial_velocity/rotation");
  }
}

/// Of what moves as `motion`, which stands at `at`.
void check_motion(const Scene& scene, const std::string& at, SupportType type, const SupportMotionSpec& motion) {
  if (type != SupportType::clamp && type != SupportType::pin) {
    refuse(at, "this key", "only a \"clamp\" or a \"pin\" can be moved, not a " + quoted(type));
  }
  const bool other = motion.angle || motion.along_axes();
  if (motion.direction == Point{} && !(other && is_zero(motion.displacement))) {
    refuse(at + "/direction", "a vector of zeros", "it must have a direction");
  }
  const bool in_time = scene.analysis == Analysis::dynamics;
  motion.each_way([&](const char* key, const TimeSpec& way) {
    const bool named = *key != '\0';
    if (in_time && is_constant(way) && (named || !(other && is_zero(way)))) {
      refuse(at + key, "a constant displacement",
             "it counts from t = 0, so that a constant does nothing: give it a ramp > 0 [s], a rate_ramp, an amplitude "
             "or a table");
    }
    const double most = largest_rate(way);
    if (const double rate = time_function(way)(0).rate; std::abs(rate) > 1e-12 * most) {
      refuse(at + key, "a velocity of " + number_text(rate) + " m/s at t = 0",
             "a support starts from rest: give the displacement a ramp > 0 [s], or its oscillation a phase of 90 "
             "degrees");
    }
  });
  if (scene.integrator.type == IntegratorType::energy_momentum) {
    refuse("/integrator/type", quoted(scene.integrator.type),
           "it keeps an energy that moving supports change: take any other integrator");
  }
  if (sliding_joint(scene) && scene.length_control.velocities == VelocityTransfer::conservative) {
    refuse("/length_control/velocities", quoted(scene.length_control.velocities),
           "with moving supports it must be \"nodal\" or \"projected\": they give energy and momentum away");
  }
  if (scene.beam.rotary_inertia != BendingInertia::none) refuse(at, "this key", "it does not go with rotary inertia");
  if (flows(scene) && motion.angle) refuse(at + "/angle", "this key", "it does not go with /flow");
}

void check_support_motion(const Scene& scene) {
  const auto check = [&](const std::string& at, const SupportSpec& support) {
    if (!support.motion) return;
    if (support.motion->angle) check_turning(scene, at, support);
    check_motion(scene, at, support.type, *support.motion);
  };
  check("/supports/at=start/motion", scene.start);
  check("/supports/at=end/motion", scene.end);
  for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
    const SlidingJointSpec& joint = scene.sliding_joints[i];
    if (!joint.motion) continue;
    const std::string at = joint_key(scene, i) + "/motion";
    if (scene.integrator.type == IntegratorType::ida) {
      refuse("/integrator/type", "\"ida\"", "it knows no joint that is moved: take any other");
    }
    check_motion(scene, at, joint.support, *joint.motion);
  }
}

template <int D>
void check_initial_velocity(const Scene& scene) {
  if (!scene.initial_velocity) return;
  const InitialVelocitySpec& motion = *scene.initial_velocity;
  for (std::size_t i = 0; scene.flow && i < scene.flow->nodes.size(); ++i) {
    if (scene.flow->nodes[i].support == SupportType::free) continue;
    refuse("/initial_velocity", "this key", "it does not go with /flow/nodes/" + std::to_string(i) + "/support");
  }
  if (motion.axis == Point{}) refuse("/initial_velocity/axis", "a vector of zeros", "it must have a direction");
  const Axis<D> axis = build_axis<D>(scene);
  const auto check = [&](const std::string& at, const SupportSpec& spec, double x) {
    const Support<D> support = build_support<D>(spec, axis.tangent(x));
    const Vec<double, D> velocity = initial_velocity<D>(scene, axis.derivatives(x)[0]);
    const Vec<double, D> passes = x == 0 ? axis.tangent(x) : Vec<double, D>(-axis.tangent(x));
    const Vec<double, D> coming = spec.pays_out() ? Vec<double, D>(feed_rate(spec) * passes) : Vec<double, D>::Zero();
    const double held = (support.into_frame(velocity - coming).array() * (1 - support.free_position)).matrix().norm();
    const double size =
        Eigen::Map<const Eigen::Vector3d>(motion.translation.data()).norm() + std::abs(motion.rotation) * axis.length();
    if (held <= 1e-9 * size) return;
    refuse("/initial_velocity", "a velocity of " + number_text(held) + " m/s against " + at,
           spec.pays_out()
               ? "at t = 0 the beam comes in there at " + number_text(feed_rate(spec)) + " m/s, along its tangent"
               : "what holds it there stands still at t = 0: let the beam turn about it" +
                     std::string(spec.type == SupportType::slide ? ", or run along its tangent" : ""));
  };
  check("/supports/at=start", scene.start, 0);
  check("/supports/at=end", scene.end, axis.length());
  // the beam may run through a ring, along its tangent: in an equilibrium only a sleeve says which that is
  const auto joints = sliding_joints(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].support == SupportType::free) continue;
    SupportSpec through;
    const bool turned = starts_in_equilibrium(scene) && joints[i].support == SupportType::pin;
    through.type = turned ? SupportType::pin : SupportType::slide;
    check(joint_key(scene, i), through, joints[i].position);
  }
}

/// What has an equilibrium that can be found.
void check_equilibrium(const Scene& scene) {
  const bool starts = starts_in_equilibrium(scene);
  if (scene.analysis != Analysis::statics && !starts) return;
  const std::string who = starts ? "\"initial_shape\": \"equilibrium\"" : "statics";
  const auto none = [&](bool there, const std::string& key, const std::string& why) {
    if (there) refuse(key, "this key", who + " knows none: " + why);
  };
  if (sliding_joint(scene) && scene.formulation != Formulation::variational) {
    refuse("/formulation", quoted(scene.formulation),
           "in " + std::string(starts ? "the equilibrium to start from" : "statics") +
               " with a joint that slides it must be \"variational\": the virtual work has no potential");
  }
  none(scene.spin.has_value(), "/spin", "leave it out");
  none(scene.flow.has_value(), "/flow",
       starts ? "leave one of the two out" : "leave it out, or start a motion from its \"steady\" flow");
  if (scene.beam.rotary_inertia != BendingInertia::none) {
    refuse("/beam/rotary_inertia", quoted(scene.beam.rotary_inertia), "with " + who + " it must be \"none\"");
  }
  const bool loaded = !scene.loads.empty() || scene.gravity != Point{};
  const auto held = [&](SupportType by) {
    return std::ranges::count(scene.sliding_joints, by, &SlidingJointSpec::support) > 0;
  };
  const bool in_ring = held(SupportType::clamp) || held(SupportType::pin) || !scene.bearings.empty();
  if (scene.start.type == SupportType::free && scene.end.type == SupportType::free && loaded && !in_ring) {
    refuse("/supports", "a beam that nothing holds",
           "under loads or gravity it has no equilibrium: hold an end, or lay it over a ring");
  }
  if (scene.statics.control == LoadControl::arc_length) {
    if (!loaded) refuse("/statics/control", "\"arc-length\"", "it needs gravity or /loads to scale: take \"load\"");
    const auto moves = [](const SlidingJointSpec& joint) { return joint.motion || joint.x; };
    if (!starts && (scene.start.motion || scene.end.motion || std::ranges::any_of(scene.sliding_joints, moves))) {
      refuse("/statics/control", "\"arc-length\"", "supports and joints are moved with \"load\"");
    }
  }
}

/// What a motion that starts from an equilibrium does not go together with.
void check_start(const Scene& scene) {
  if (!starts_in_equilibrium(scene)) return;
  if (scene.gravity_ramp > 0) {
    refuse("/gravity_ramp", number_text(scene.gravity_ramp),
           "with \"initial_shape\": \"equilibrium\", which is under all of gravity, it must be 0");
  }
  const auto joints = sliding_joints(scene);
  const bool all_guided =
      std::ranges::all_of(joints, [](const SlidingJointSpec& joint) { return joint.x.has_value(); });
  if (guided(scene) && all_guided && static_joints(scene) == StaticJoints::released) {
    refuse("/statics/joints", "\"released\"",
           joint_key(scene) + "/x says where the joint is: it must be \"held\", or left out");
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double rate = joints[i].x ? time_function(*joints[i].x)(0).rate : joints[i].velocity;
    if (rate == 0 || joints[i].slopes == JointSlopes::continuous) continue;
    refuse(joint_key(scene, i) + "/slopes", quoted(joints[i].slopes),
           "what starts from an equilibrium with a velocity along the beam, here " + number_text(rate) +
               " m/s, needs \"continuous\" ones: the beam is not at rest where a kink moves along it");
  }
}

void check_statics(const Scene& scene) {
  if (scene.analysis != Analysis::statics) return;
  const auto none = [&](bool there, const std::string& key, const char* why) {
    if (there) refuse(key, "this key", std::string("statics knows none: ") + why);
  };
  const auto joints = sliding_joints(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::string key = joint_key(scene, i);
    none(joints[i].friction.has_value(), key + "/friction", "in equilibrium nothing slides; leave it out");
    if (joints[i].velocity != 0) refuse(key + "/velocity", number_text(joints[i].velocity), "in statics it must be 0");
    if (joints[i].at_support != AtSupport::stop) {
      refuse(key + "/at_support", quoted(joints[i].at_support), "in statics it must be \"stop\"");
    }
  }
  none(scene.contact.has_value(), "/contact", "nothing strikes; leave it out");
  if (!joints.empty()) {
    if (scene.length_control.end_merge.value_or(0) > 0) {
      refuse("/length_control/end_merge", number_text(*scene.length_control.end_merge), "in statics it must be 0");
    }
    if (joints.size() < 2 && scene.length_control.lower.value_or(0) > 0) {
      refuse("/length_control/lower", number_text(*scene.length_control.lower), "in statics it must be 0");
    }
  }
  none(scene.initial_velocity.has_value(), "/initial_velocity", "leave it out");
  if (scene.constraints != Constraints::eliminated) {
    refuse("/constraints", quoted(scene.constraints), "in statics it must be \"eliminated\"");
  }
  const auto constant = [&](const std::string& at, const TimeSpec& f) {
    const auto zero = [&](const char* key, double value) {
      if (value != 0)
        refuse(at + "/" + key, number_text(value), "in statics there is a value only, with or without a ramp");
    };
    zero("rate", f.rate);
    zero("acceleration", f.acceleration);
    zero("amplitude", f.amplitude);
    if (!f.table.empty()) refuse(at + "/table", "this key", "in statics there is a value only, with or without a ramp");
  };
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const std::string at = "/loads/" + std::to_string(i);
    constant(at + "/magnitude", scene.loads[i].magnitude);
    constant(at + "/x", scene.loads[i].x);
    constant(at + "/turn", scene.loads[i].turn);
  }
  for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
    const auto& joint = scene.sliding_joints[i];
    if (joint.x) constant(joint_key(scene, i) + "/x", *joint.x);
    if (!joint.motion) continue;
    joint.motion->each_way(
        [&](const char* key, const TimeSpec& way) { constant(joint_key(scene, i) + "/motion" + key, way); });
  }
  const auto moves = [&](const std::string& at, const SupportSpec& support) {
    if (!support.motion) return;
    support.motion->each_way([&](const char* key, const TimeSpec& way) { constant(at + key, way); });
    if (support.motion->angle) constant(at + "/angle", *support.motion->angle);
  };
  moves("/supports/at=start/motion", scene.start);
  moves("/supports/at=end/motion", scene.end);
  constexpr int most = 500;  // the matrices are dense
  if (scene.statics.frequencies > 0 && scene.beam.elements > most) {
    refuse("/statics/frequencies", std::to_string(scene.statics.frequencies),
           "they are there for at most " + std::to_string(most) + " elements");
  }
}

void check_output(const Scene& scene) {
  constexpr double most_samples = 1e7;
  if (scene.duration / scene.output.interval > most_samples) {
    refuse("/output/interval", number_text(scene.output.interval),
           "it must leave at most 1e7 samples in the duration of " + number_text(scene.duration) + " s");
  }
  const auto& times = scene.output.configurations;
  constexpr double most_nodes = 1e8;
  if (static_cast<double>(times.size()) * (scene.beam.elements + 1) > most_nodes) {
    refuse("/output/configurations", std::to_string(times.size()) + " entries",
           "with " + std::to_string(scene.beam.elements) + " elements there can be at most " +
               number_text(std::floor(most_nodes / (scene.beam.elements + 1))) + " shapes");
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::string field = "/output/configurations/" + std::to_string(i);
    if (times[i] > scene.duration) {
      refuse(field, number_text(times[i]),
             "it must be within the duration, [0, " + number_text(scene.duration) + "] s");
    }
    if (i > 0 && times[i] <= times[i - 1]) refuse(field, number_text(times[i]), "times must be ascending");
  }
}

void check_places(const Scene& scene) {
  const auto joints = static_cast<int>(sliding_joints(scene).size());
  const auto masses = static_cast<int>(scene.point_masses.size());
  for (std::size_t i = 0; i < scene.places.size(); ++i) {
    const PlaceSpec& place = scene.places[i];
    const std::string at = "/places/" + std::to_string(i);
    if (place.name.empty() || !is_plain_name(place.name)) {
      refuse(at + "/name", "\"" + place.name + "\"", "it must be letters, digits and underscores");
    }
    const auto first = std::ranges::find(scene.places, place.name, &PlaceSpec::name) - scene.places.begin();
    if (first != static_cast<std::ptrdiff_t>(i)) {
      refuse(at + "/name", "\"" + place.name + "\"", "place " + std::to_string(first) + " has that name");
    }
    const int given = (place.x ? 1 : 0) + (place.end ? 1 : 0) + (place.joint ? 1 : 0) + (place.point_mass ? 1 : 0);
    if (given != 1) {
      refuse(at, std::to_string(given) + " keys that say where", "it must have one of x, end, joint and point_mass");
    }
    const auto of_list = [&](const std::optional<int>& number, const char* key, int count, const char* what) {
      if (!number || *number < count) return;
      refuse(at + "/" + key, std::to_string(*number),
             "the scene has " + std::to_string(count) + " " + what + ", numbered from 0");
    };
    of_list(place.joint, "joint", joints, "sliding joints");
    of_list(place.point_mass, "point_mass", masses, "point masses");
    if (place.x && !fed(scene) && !scene.flow && *place.x > beam_length(scene)) {
      refuse(at + "/x", number_text(*place.x), "the beam ends at " + number_text(beam_length(scene)) + " m");
    }
  }
}

void check_all(const Scene& scene) {
  visit_options(RangeCheck{}, scene);
  check_plane(scene);
  refuse_missing_rooms(scene);
  validate_beam(scene);
  validate_frames(scene);
  validate_joints(scene);
  validate_blocks(scene);
  validate_bearings(scene);
  validate_vehicles(scene);
  validate_nut(scene);
  validate_length_control(scene);
  check_integrator(scene);
  validate_joint_choices(scene);
  check_energy_momentum(scene);
  check_support_motion(scene);
  validate_surroundings(scene);
  validate_feeds(scene);
  check_output(scene);
  check_places(scene);
  validate_loads(scene);
  scene.dimension == 2 ? check_initial_velocity<2>(scene) : check_initial_velocity<3>(scene);
  check_equilibrium(scene);
  check_start(scene);
  check_statics(scene);
  if (flows(scene) || scene.spin) validate_flow(scene);
  validate_resting_parts(scene);
}

}  // namespace

void validate(const Scene& scene) {
  of_scene([&scene] {
    if (scene.assembly) {
      refuse_missing_rooms(scene);
      check_output(scene);
      if constexpr (has_room("assembly")) validate_assembly(scene);
    } else {
      check_all(scene);
    }
  });
}

}  // namespace vlbeam
