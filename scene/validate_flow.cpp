#include "scene/validate_flow.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "mechanics/flow/moving_mesh.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "scene/build.hpp"
#include "scene/build_flow.hpp"
#include "scene/integrator_type.hpp"
#include "scene/options.hpp"
#include "scene/section_data.hpp"
#include "scene/stretch.hpp"

namespace vlbeam {
namespace {

constexpr double length_tolerance = 0.01;  // of the nodes' initial distance against the curve's length

void check_parts(const Scene& scene) {
  if (sliding_joint(scene) && flows(scene)) {
    refuse(joint_key(scene), "this key", "it goes together with neither /flow nor rotary inertia");
  }
  if (scene.beam.curve.type != CurveType::line) {
    if (scene.beam.rotary_inertia != BendingInertia::none) {
      refuse("/beam/curve/type", quoted(scene.beam.curve.type), "with rotary inertia it must be \"line\"");
    }
    if (scene.flow && scene.flow->tension != 0) {
      refuse("/flow/tension", number_text(scene.flow->tension), "of a curved beam it must be 0");
    }
  }
  const Section section = with_stiffness(scene.beam.section);
  const BendingInertia rotary = scene.beam.rotary_inertia;
  if (section.type == Section::Type::stiffness) {
    if (scene.spin && !(section.GIp > 0)) {
      refuse("/beam/section/GIp", number_text(section.GIp), "with /spin it must be > 0 [N m^2]");
    }
    if ((scene.spin || rotary != BendingInertia::none) && !(section.rhoIp > 0)) {
      refuse("/beam/section/rhoIp", number_text(section.rhoIp), "with /spin or rotary inertia it must be > 0 [kg m]");
    }
  }
  if (rotary == BendingInertia::gyroscopic && (!scene.spin || scene.dimension == 2)) {
    refuse("/beam/rotary_inertia", quoted(rotary), "it needs /spin and three dimensions");
  }
  const IntegratorType type = scene.integrator.type;
  if ((scene.spin && type == IntegratorType::rosenbrock4) || type == IntegratorType::energy_momentum ||
      of_sundials(type)) {
    refuse("/integrator/type", quoted(type),
           std::string("with ") + (scene.spin ? "/spin" : "/flow or rotary inertia") +
               " take an explicit method of Odeint" + (scene.spin ? "" : ", \"rosenbrock4\"") +
               " or \"generalized-alpha\"");
  }
  if (scene.spin && scene.constraints != Constraints::eliminated) {
    refuse("/constraints", quoted(scene.constraints), "with /spin it must be \"eliminated\"");
  }
}

void check_guides(const Scene& scene) {
  if (!scene.flow) return;
  const FlowSpec& flow = *scene.flow;
  const int last = scene.beam.elements;
  if (scene.beam.element == ElementKind::rancf || scene.beam.element == ElementKind::ancf) {
    refuse("/beam/element", quoted(scene.beam.element),
           "a flow needs an element of variable length: \"ALE-RANCF\" or \"ALE-ANCF\"");
  }
  if (flow.nodes.empty()) return;
  int before = -1;
  for (std::size_t i = 0; i < flow.nodes.size(); ++i) {
    const std::string at = "/flow/nodes/" + std::to_string(i);
    const int node = flow.nodes[i].node;
    if (i == 0 && node != 0) refuse(at + "/node", std::to_string(node), "the first of them must be node 0");
    if (node <= before || node > last) {
      refuse(at + "/node", std::to_string(node),
             "it must be more than " + std::to_string(before) + ", the one before, and at most " +
                 std::to_string(last) + ", the last node");
    }
    if (flow.nodes[i].support != SupportType::free && (node == 0 || node == last)) {
      refuse(at + "/support", quoted(flow.nodes[i].support), "supports of the ends stand in /supports");
    }
    before = node;
  }
  if (before != last) {
    refuse("/flow/nodes", "a list that ends with node " + std::to_string(before),
           "the last of them must be node " + std::to_string(last));
  }
}

/// The curve says how the beam is built: there is none beyond its ends.
[[maybe_unused]] void check_within_curve(const Scene& scene, const MeshMotion& motion) {
  constexpr int looks = 2000;
  const double length = beam_length(scene), slack = 1e-9 * length;
  std::vector<Prescribed> nodes;
  for (int i = 0; i <= looks; ++i) {
    const double t = scene.duration * i / looks;
    motion.at(t, nodes);
    for (const std::size_t end : {std::size_t{0}, nodes.size() - 1}) {
      const double x = nodes[end].value;
      if (x >= -slack && x <= length + slack) continue;
      refuse("/flow/nodes",
             "node " + std::to_string(end) + " at " + number_text(x) + " m at t = " + number_text(t) + " s",
             "a curved beam is built from 0 to " + number_text(length) + " m: its end nodes must stay there");
    }
  }
}

template <int D>
void check_model(const Scene& scene) {
  if constexpr (has_room("flow")) {
    const BeamModel<D> model = build_model<D>(scene);
    const ChainState<D> chain = flowing_chain(scene, model);
    const MovingMesh<D> mesh(model, chain.mesh.weights);
    if (scene.flow) {
      const double stretch =
          stretch_under(scene.flow->tension, model.section.stiffness.EA, model.section.stiffness.law);
      const double length = stretch * chain.mesh.length(), curve = beam_length(scene);
      if (!(std::abs(length - curve) <= length_tolerance * curve)) {
        refuse("/flow/nodes", "a stretched length of " + number_text(length) + " m at t = 0",
               "it must be that of /beam/curve, " + number_text(curve) + " m, within 1 %");
      }
    }
    if (model.rest && scene.beam.curve.type != CurveType::line)
      check_within_curve(scene, room_of<FlowRoom<D>>(model)->motion);
    if (const SpinModel* const spin = spin_model(model)) check_drives(spin->drives, chain.mesh.last());
    mesh.check_motion(scene.duration);
  }
}

}  // namespace

void validate_flow(const Scene& scene) {
  check_parts(scene);
  if (!flows(scene)) return;
  check_guides(scene);
  scene.dimension == 2 ? check_model<2>(scene) : check_model<3>(scene);
}

}  // namespace vlbeam
