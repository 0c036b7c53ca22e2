#include "scene/validate_loads.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include "core/error.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "scene/build.hpp"
#include "scene/build_flow.hpp"
#include "scene/corners.hpp"
#include "scene/options.hpp"
#include "scene/section_data.hpp"
#include "scene/time_function.hpp"
#include "scene/validate_feed.hpp"

namespace vlbeam {
namespace {

/// In space a moment turns the section of a node that no joint moves along the beam.
void check_moment(const Scene& scene, const LoadSpec& load, const std::string& at) {
  if (scene.dimension == 2) {
    if (load.at == LoadPlace::beam) refuse(at + "/at", quoted(load.at), "a moment is at a \"node\" or a \"point\"");
    if (load.follows) refuse(at + "/follows", "true", "in a planar scene a moment has no axis to turn: leave it out");
    return;
  }
  if (!has_frames(scene)) {
    refuse(at + "/type", "\"moment\"", "in space only sections with /beam/space_law \"frames\" can be turned");
  }
  if (load.at != LoadPlace::node) refuse(at + "/at", quoted(load.at), "in space a moment is at a \"node\"");
  const int last = scene.beam.elements;
  const bool moves = !sliding_joints(scene).empty() || fed(scene), at_end = load.node == 0 || load.node == last;
  if (moves && !at_end) {
    refuse(at + "/node", std::to_string(load.node),
           "where joints move along the beam a moment is at one of its ends, 0 or " + std::to_string(last));
  }
  if ((load.node == 0 && scene.start.pays_out()) || (load.node == last && scene.end.pays_out())) {
    refuse(at + "/node", std::to_string(load.node), "the beam is fed there: a moment is at an end that nothing feeds");
  }
}

void check_loads(const Scene& scene) {
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadSpec& load = scene.loads[i];
    const std::string at = "/loads/" + std::to_string(i);
    if (load.at == LoadPlace::node && load.node > scene.beam.elements) {
      refuse(at + "/node", std::to_string(load.node),
             "the last node is " + std::to_string(scene.beam.elements) + ": beyond the ends there is none");
    }
    if (load.at == LoadPlace::point && is_zero(load.x)) {
      refuse(at + "/x", InvalidInput::missing,
             "a point needs its material coordinate [m]; what acts at the start of the beam is at node 0");
    }
    if (load.at == LoadPlace::beam && load.type == LoadType::follower) {
      refuse(at + "/at", quoted(load.at), "a follower is at a \"node\" or a \"point\"");
    }
    if (load.type == LoadType::moment) check_moment(scene, load, at);
    const bool directed = load.type == LoadType::force || (load.type == LoadType::moment && scene.dimension == 3);
    if (directed && load.direction == Point{}) {
      refuse(at + "/direction", "a vector of zeros", "it must have a direction");
    }
    if (load.type == LoadType::torque && !scene.spin && !has_frames(scene)) {
      refuse("/spin", InvalidInput::missing,
             at + " is a torque, which turns the section about the axis: it needs this object, or /beam/space_law "
                  "\"frames\"");
    }
    const TimeSpec& size = load.magnitude;
    if (is_zero(size)) {
      refuse(at + "/magnitude", "zero at all times", "give its value, rate, acceleration or amplitude");
    }
  }
}

/// A load that travels may come onto the beam and leave it; it must be on it at some time.
void check_that_loads_come(const Scene& scene, double beyond) {
  constexpr int instants = 2000;
  const double length = beam_length(scene);
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadSpec& load = scene.loads[i];
    if (load.at != LoadPlace::point) continue;
    const bool stays = load.type == LoadType::torque || scene.analysis == Analysis::statics;
    const TimeFunction x = beside_loads(load.x, scene.analysis);
    bool comes = false;
    for (int k = 0; k <= instants; ++k) {
      const double t = scene.duration * k / instants, at = x(t).value;
      const bool on = at >= -beyond && at <= length + beyond;
      comes = comes || on;
      if (on || !stays) continue;
      refuse("/loads/" + std::to_string(i) + "/x", number_text(at) + " m at t = " + number_text(t) + " s",
             "a torque, or a load in statics, must be on the beam, at 0 to " + number_text(length) + " m");
    }
    if (comes) continue;
    refuse("/loads/" + std::to_string(i) + "/x", number_text(x(0).value) + " m at t = 0",
           "it is never on the beam, at 0 to " + number_text(length) + " m, within /duration");
  }
}

/// Of a beam whose nodes rest, or all of which but one do.
template <int D>
void check_resting_parts(const Scene& scene) {
  const BeamModel<D> model = build_model<D>(scene);
  const double beyond = 1e-9 * standard_length(scene);
  if (fed(scene) || scene.spin) {
    check_places<D>(model.loads.points, scene.duration, beyond, beam_ends(scene));
  } else {
    check_that_loads_come(scene, beyond);
  }
  if constexpr (has_room("spin")) {
    const SpinModel* const spin = spin_model(model);
    if (spin == nullptr) return;
    check_drives(spin->drives, scene.beam.elements);
    for (const LoadSpec& load : scene.loads) {
      const auto at_drive = [&load](const DrivenAngle& drive) { return drive.node == load.node; };
      if (load.type != LoadType::torque || load.at != LoadPlace::node) continue;
      if (std::ranges::any_of(spin->drives, at_drive)) {
        refuse("/loads", "a torque at node " + std::to_string(load.node), "the angle there is prescribed already");
      }
    }
  }
}

void check_fluid(const Scene& scene) {
  if (!scene.fluid) return;
  const FluidSpec& fluid = *scene.fluid;
  if (fluid.velocity != Point{} && scene.analysis == Analysis::statics) {
    refuse(scene.drag ? "/drag" : "/fluid/velocity", "this key",
           "statics knows no drag, so no current either: leave both out, or let a motion with mass_damping come to "
           "rest in "
           "it");
  }
  if (fluid.velocity != Point{} && !scene.drag) {
    refuse("/fluid/velocity", "this key", "without /drag it does nothing: give the coefficients, or leave it out");
  }
  if (fluid.velocity != Point{} && flows(scene)) {
    refuse("/fluid/velocity", "this key", "it goes together with neither /flow nor rotary inertia");
  }
  if (scene.dimension == 2 && fluid.velocity[2] != 0) {
    refuse("/fluid/velocity/2", number_text(fluid.velocity[2]), "a planar scene has two components");
  }
  const auto& pieces = scene.beam.sections;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string at = "/beam/sections/" + std::to_string(i) + "/area";
    if (displaces(pieces[i].section.type)) {
      if (pieces[i].area) refuse(at, "this key", "the section has its own: leave it out");
    } else if (fluid.density > 0 && !pieces[i].area) {
      refuse(at, InvalidInput::missing, "in a fluid with a density it must be given for such a section, > 0 [m^2]");
    }
  }
  if (!pieces.empty()) {
    if (fluid.area) refuse("/fluid/area", "this key", "the pieces of /beam/sections have their own: leave it out");
    return;
  }
  const bool known = displaces(scene.beam.section.type);
  if (known && fluid.area) refuse("/fluid/area", "this key", "the section has its own: leave it out");
  if (!known && fluid.density > 0 && !fluid.area) {
    refuse("/fluid/area", InvalidInput::missing, "with a density and such a section it must be given, > 0 [m^2]");
  }
}

void check_ground(const Scene& scene) {
  if (!scene.ground) return;
  if (scene.gravity == Point{}) {
    refuse("/ground", "this key", "gravity says which way is up: /gravity must not be zero");
  }
  if (flows(scene)) refuse("/ground", "this key", "it goes together with neither /flow nor rotary inertia");
  if (scene.integrator.type == IntegratorType::energy_momentum) {
    refuse("/integrator/type", quoted(scene.integrator.type), "it knows no /ground: take any other");
  }
  // an end that is held below the floor would be pushed with all its stiffness
  const Axis<3> drawn = drawn_axis<3>(scene.beam.curve);
  const Eigen::Map<const Vec<double, 3>> gravity(scene.gravity.data());
  const double slack = scene.ground->depth.value_or(0) + 1e-3 * drawn.length();
  for (const auto& [end, x, name] : {std::tuple(&scene.start, 0.0, "start"), {&scene.end, drawn.length(), "end"}}) {
    if (end->type == SupportType::free) continue;
    const double height = -drawn.derivatives(x)[0].dot(gravity.normalized());
    if (height < scene.ground->height - slack) {
      refuse("/ground/height", number_text(scene.ground->height),
             "the support at the " + std::string(name) + " of the beam would be below the floor: it must be at most " +
                 number_text(height == 0 ? 0 : height) + " [m]");  // not -0
    }
  }
}

/// Lumped masses, and the joints that would pass them.
void check_point_masses(const Scene& scene) {
  for (std::size_t i = 0; i < scene.point_masses.size(); ++i) {
    if (scene.point_masses[i].position || scene.point_masses[i].node <= scene.beam.elements) continue;
    refuse("/point_masses/" + std::to_string(i) + "/node", std::to_string(scene.point_masses[i].node),
           "the last node is " + std::to_string(scene.beam.elements) + ": beyond the ends there is none");
  }
  if (scene.point_masses.empty()) return;
  if (flows(scene)) refuse("/point_masses", "this key", "it goes together with neither /flow nor rotary inertia");
  // joints with kinks cannot pass them, where they are knots
  const auto joints = sliding_joints(scene);
  const auto its_knots = knots(scene);
  const std::vector<int> masses = place_nodes(scene, build_axis<3>(scene).breaks()).masses;
  const auto stops = [&](int node) {
    const bool at_end = node == 0 || node == scene.beam.elements;
    return at_end || std::ranges::find(its_knots, node, &Knot::node) != its_knots.end();
  };
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].slopes == JointSlopes::continuous) continue;
    const auto passed = std::ranges::find_if_not(masses, stops);
    if (passed == masses.end()) continue;
    refuse(joint_key(scene, i) + "/slopes", quoted(joints[i].slopes),
           "a kink that passes over a mass, here that of /point_masses/" + std::to_string(passed - masses.begin()) +
               ", is an impact: take \"continuous\", or give the mass a node where no joint is, all joints a kink, and "
               "the scene an explicit integrator or \"generalized-alpha\"");
  }
}

}  // namespace

void validate_loads(const Scene& scene) { check_loads(scene); }

void validate_resting_parts(const Scene& scene) {
  if (flows(scene)) return;
  scene.dimension == 2 ? check_resting_parts<2>(scene) : check_resting_parts<3>(scene);
}

void validate_surroundings(const Scene& scene) {
  check_fluid(scene);
  check_ground(scene);
  check_point_masses(scene);
}

}  // namespace vlbeam
