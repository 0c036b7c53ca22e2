#include "scene/validate_assembly.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

#include "core/error.hpp"
#include "scene/assembly_names.hpp"
#include "scene/build.hpp"
#include "scene/build_assembly.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/time_function.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

constexpr double meets_within = 1e-6;  // of the longest beam: ends of a link are written with so many digits

const AssemblySpec& parts_of(const Scene& whole) { return *whole.assembly; }

bool knows_links(IntegratorType type) {
  return type == IntegratorType::generalized_alpha || type == IntegratorType::dopri5 ||
         type == IntegratorType::cash_karp || type == IntegratorType::fehlberg78;
}

void check_body(const Scene& whole, const BodySpec& body, const std::string& at) {
  if (!(body.mass > 0)) refuse(at + "/mass", number_text(body.mass), "it must be a number > 0 [kg]");
  const std::size_t wanted = whole.dimension == 2 ? 1 : 3;
  if (!body.inertia.empty() && body.inertia.size() != wanted) {
    refuse(at + "/inertia", std::to_string(body.inertia.size()) + " numbers",
           whole.dimension == 2 ? "it must be a number > 0 [kg m^2]"
                                : "it must be three numbers > 0 [kg m^2], about the body axes");
  }
  for (const double moment : body.inertia) {
    if (!(moment > 0))
      refuse(at + "/inertia", number_text(moment), "it must be > 0 [kg m^2]; leave it out for a point mass");
  }
  if (wanted == 3 && !body.inertia.empty()) {
    const auto [a, b, c] = std::tuple{body.inertia[0], body.inertia[1], body.inertia[2]};
    if (!(a < b + c && b < a + c && c < a + b)) {
      refuse(at + "/inertia", number_text(a) + ", " + number_text(b) + ", " + number_text(c),
             "no body has one moment of inertia as large as the two others together");
    }
  }
  const bool point_mass = body.inertia.empty();
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    if (point_mass && body.points[i].at != Point{}) {
      refuse(at + "/points/" + body.points[i].name, "a place beside the center",
             "a body without \"inertia\" is a point mass: give it one, or take [0, 0]");
    }
  }
  if (point_mass && body.rotation != Point{})
    refuse(at + "/rotation", "this key", "a point mass does not turn: give it an inertia");
  if (point_mass && body.angular_velocity != Point{}) {
    refuse(at + "/angular_velocity", "this key", "a point mass does not turn: give it an inertia");
  }
  for (std::size_t i = 0; i < body.loads.size(); ++i) {
    const BodyLoadSpec& load = body.loads[i];
    const std::string key = at + "/loads/" + std::to_string(i);
    check_time_function(key + "/magnitude", load.magnitude);
    if (load.type == BodyLoadSpec::Type::torque && point_mass) {
      refuse(key + "/type", "\"torque\"", "a point mass does not turn: give it an inertia");
    }
    if (load.direction == Point{}) refuse(key + "/direction", "a vector of zeros", "it must have a direction");
    if (!load.point.empty() && std::ranges::find(body.points, load.point, &BodyPointSpec::name) == body.points.end()) {
      refuse(key + "/point", "\"" + load.point + "\"", "the body has no point of that name");
    }
  }
}

bool is_beam_end(const LinkEndSpec& end) {
  return end.of == LinkEndSpec::Of::beam_start || end.of == LinkEndSpec::Of::beam_end;
}
/// Whether a link may take hold there.
void check_end(const Scene& whole, const LinkSpec& link, const LinkEndSpec& end, const std::string& at) {
  if (!end.is_of_beam()) return;
  const AssemblySpec::Beam& beam = parts_of(whole).beams[end.which];
  const Scene& scene = beam.scene;
  if (is_beam_end(end)) {
    const bool start = end.of == LinkEndSpec::Of::beam_start;
    const SupportSpec& support = start ? scene.start : scene.end;
    if (support.type != SupportType::free || support.pays_out()) {
      refuse(at, "the " + std::string(start ? "start" : "end") + " of \"" + beam.name + "\"",
             "a support holds it: what a link holds must be free");
    }
  }
  const auto joints = sliding_joints(scene);
  if (end.of == LinkEndSpec::Of::node) {
    if (end.joint < 0 || end.joint > scene.beam.elements) {
      refuse(at + "/at/node", std::to_string(end.joint),
             "\"" + beam.name + "\" has the nodes 0 to " + std::to_string(scene.beam.elements));
    }
    if (!joints.empty()) {
      refuse(at + "/at/node", std::to_string(end.joint),
             "nodes come and go beside a sliding joint: take \"start\", \"end\" or the joint");
    }
  }
  if (end.of == LinkEndSpec::Of::joint) {
    if (end.joint < 0 || end.joint >= static_cast<int>(joints.size())) {
      refuse(at + "/joint", std::to_string(end.joint),
             "\"" + beam.name + "\" has " + std::to_string(joints.size()) + " sliding joints, numbered from 0");
    }
    const SlidingJointSpec& joint = joints[static_cast<std::size_t>(end.joint)];
    if (joint.support != SupportType::free) {
      refuse(at + "/joint", std::to_string(end.joint), "a support holds it: what a link holds must be free");
    }
    if (joint.friction) refuse(at + "/joint", std::to_string(end.joint), "a joint with friction carries no link yet");
    if (joint.at_support != AtSupport::stop) {
      refuse(at + "/joint", std::to_string(end.joint), "a joint that rebounds or rests carries no link yet");
    }
  }
  if (link.type != LinkType::clamp) return;
  if (has_frames(scene)) {
    refuse(at, "a clamp of \"" + beam.name + "\"",
           "sections with frames are not clamped to others yet: take a \"pin\"");
  }
  if (end.of == LinkEndSpec::Of::joint &&
      joints[static_cast<std::size_t>(end.joint)].slopes != JointSlopes::continuous) {
    refuse(at + "/joint", std::to_string(end.joint), "a clamp needs a joint without a kink");
  }
}

void check_link(const Scene& whole, const LinkSpec& link, const std::string& at) {
  const std::array<std::string, 2> ends{at + "/between/0", at + "/between/1"};
  const auto& [a, b] = link.between;
  for (std::size_t i = 0; i < 2; ++i) check_end(whole, link, link.between[i], ends[i]);
  if (a.of == LinkEndSpec::Of::ground && b.of == LinkEndSpec::Of::ground) {
    refuse(at + "/between", "the ground twice", "a link ties a beam or a body to something");
  }
  if (a.of == b.of && a.which == b.which && a.joint == b.joint && a.place == b.place) {
    refuse(at + "/between", "the same place twice", "a link ties two places");
  }
  const bool grounded = a.of == LinkEndSpec::Of::ground || b.of == LinkEndSpec::Of::ground;
  if (link.type == LinkType::slide && a.of != LinkEndSpec::Of::joint && b.of != LinkEndSpec::Of::joint) {
    refuse(at + "/between", "two ends of which none is a joint",
           "a \"slide\" is carried by a joint: {\"beam\", \"joint\"}");
  }
  if (link.type == LinkType::rail && b.of != LinkEndSpec::Of::ground) {
    refuse(ends[1], "this end", "a \"rail\" is a line of the ground: {\"ground\": place}");
  }
  if (link.type == LinkType::rail && link.direction == Point{}) {
    refuse(at + "/direction", "a vector of zeros", "it must have a direction");
  }
  if (link.type == LinkType::clamp) {
    if (grounded && (a.is_of_beam() || b.is_of_beam())) {
      refuse(at + "/type", "\"clamp\"", "a support of the beam clamps it to the ground: /supports");
    }
    if (whole.dimension == 3 && a.is_of_beam() && b.is_of_beam() && !are_one_beam(whole, a, b)) {
      refuse(at + "/type", "\"clamp\"",
             "in space beams of one section that go on straight are clamped to each other; a small body between others "
             "holds their directions, and lets each turn about its axis");
    }
    for (const LinkEndSpec* end : {&a, &b}) {
      if (end->of == LinkEndSpec::Of::body && parts_of(whole).bodies[end->which].inertia.empty()) {
        refuse(
            at + "/type", "\"clamp\"",
            "\"" + parts_of(whole).bodies[end->which].name + "\" is a point mass and has no direction: take a \"pin\"");
      }
    }
  }
  if (link.type == LinkType::spring && !(link.stiffness >= 0 && link.damping >= 0)) {
    refuse(at + (link.stiffness >= 0 ? "/damping" : "/stiffness"), "a number < 0", "it must be >= 0");
  }
  if (link.type == LinkType::spring && link.stiffness == 0 && link.damping == 0) {
    refuse(at + "/stiffness", InvalidInput::missing, "a spring needs a stiffness or a damping");
  }
  const Point from = place_of(whole, a), to = place_of(whole, b);
  double apart = 0;
  for (std::size_t c = 0; c < 3; ++c) apart += (to[c] - from[c]) * (to[c] - from[c]);
  apart = std::sqrt(apart);
  const double rounding = meets_within * beam_length(parts_of(whole).beams[parts_of(whole).longest].scene);
  const bool meet = link.type == LinkType::pin || link.type == LinkType::clamp || link.type == LinkType::slide;
  if (meet && apart > rounding) {
    refuse(at + "/between", "ends " + six_digits(apart) + " m apart at t = 0",
           "they must meet: one is at " + place_text(from, whole.dimension) + ", the other at " +
               place_text(to, whole.dimension));
  }
  if (link.type == LinkType::distance && !(apart > rounding)) {
    refuse(at + "/between", "two ends at one place", "a \"distance\" is > 0; for 0 take a \"pin\"");
  }
  if (link.type == LinkType::distance && link.length && std::abs(*link.length - apart) > rounding) {
    refuse(at + "/length", number_text(*link.length), "the ends are " + six_digits(apart) + " m apart at t = 0");
  }
  if (link.type == LinkType::spring && link.length && *link.length < 0) {
    refuse(at + "/length", number_text(*link.length), "it must be >= 0 [m]");
  }
}

void check_at_rest(const Scene& scene, const std::string& at) {
  const auto joints = sliding_joints(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].x && !is_zero(*joints[i].x)) {
      refuse(at + joint_key(scene, i) + "/x", "a joint that moves along the beam",
             "in statics of several beams joints keep their places: leave it out, and give it another \"position\"");
    }
  }
  if (fed(scene)) refuse(at + "/supports", "a winch", "statics of several beams knows none yet");
  for (const BearingSpec& bearing : scene.bearings) {
    if (bearing.type == BearingType::spring) continue;
    refuse(at + "/supports", "a " + std::string(to_string(bearing.type)) + " at x = " + number_text(bearing.x) + " m",
           "statics of several beams knows springs between the ends, but no pins and rollers yet");
  }
}

/// The error of a beam's scene, with its key where it stands in the whole.
[[noreturn]] void refuse_in_beam(std::size_t which, const InvalidInput& error) {
  throw InvalidInput(key_in_assembly(which, error.field), error.value, error.allowed);
}

}  // namespace

void validate_assembly(const Scene& whole) {
  const AssemblySpec& parts = parts_of(whole);
  const bool statics = whole.analysis == Analysis::statics;
  if (whole.initial_shape != InitialShape::built) {
    refuse("/initial_shape", quoted(whole.initial_shape),
           "several beams and bodies start as they are drawn: \"built\"");
  }
  if (!statics && !knows_links(whole.integrator.type)) {
    refuse("/integrator/type", quoted(whole.integrator.type),
           "it knows no links: take \"generalized-alpha\" or an explicit method, or leave the integrator out");
  }
  check_names(parts);
  for (std::size_t i = 0; i < parts.beams.size(); ++i) {
    Scene scene = beam_scene(whole, i);
    if (flows(scene)) {
      refuse("/beams/" + std::to_string(i) + (scene.flow ? "/flow" : "/rotary_inertia"), "this key",
             "beams that flow are not linked to others");
    }
    if (statics) {
      check_at_rest(parts.beams[i].scene, "/beams/" + std::to_string(i));
      const bool floats = scene.start.type == SupportType::free && scene.end.type == SupportType::free;
      if (floats) scene.start.type = SupportType::pin;  // links hold it
    }
    try {
      validate(scene);
    } catch (const InvalidInput& error) {
      refuse_in_beam(i, error);
    }
  }
  for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
    const std::string at = "/bodies/" + std::to_string(i);
    check_body(whole, parts.bodies[i], at);
  }
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    const std::string at = "/links/" + std::to_string(i);
    check_link(whole, parts.links[i], at);
  }
}

}  // namespace vlbeam
