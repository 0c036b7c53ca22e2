#include "core/scene/validate_flow.hpp"

#include <algorithm>
#include <cmath>

#include "core/dynamics/sundials_stepper.hpp"
#include "core/error.hpp"
#include "core/scene/build.hpp"
#include "core/scene/build_flow.hpp"
#include "core/scene/options.hpp"
#include "core/system/steady_flow.hpp"

namespace vlbeam {
namespace {

constexpr double length_tolerance = 0.01;  // of the nodes' initial distance against the curve's length

void check_parts(const Scene& scene) {
  if (sliding_joint(scene) && flows(scene)) {
    refuse(joint_key(scene), "this key", "it goes together with neither /flow nor rotary inertia");
  }
  if (flows(scene) && scene.beam.curve.type != CurveType::line) {
    refuse("/beam/curve/type", quoted(scene.beam.curve.type), "with /flow or rotary inertia it must be \"line\"");
  }
  const auto& section = scene.beam.section;
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
  if (type == IntegratorType::rosenbrock4 || type == IntegratorType::energy_momentum || of_sundials(type)) {
    refuse("/integrator/type", quoted(type),
           "with /spin, /flow or rotary inertia take an explicit method of Odeint or \"generalized-alpha\"");
  }
  if (scene.constraints != Constraints::eliminated) {
    refuse("/constraints", quoted(scene.constraints), "with /spin, /flow or rotary inertia it must be \"eliminated\"");
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

template <int D>
void check_model(const Scene& scene) {
  const FlowingBeam<D> beam(build_flowing_model<D>(scene));
  if (scene.flow) {
    const double stretch =
        stretch_under(scene.flow->tension, beam.model().section.stiffness.EA, beam.model().section.stiffness.law);
    const auto nodes = beam.nodes_at(0);
    const double length = stretch * (nodes.back().value - nodes.front().value), curve = beam_length(scene);
    if (!(std::abs(length - curve) <= length_tolerance * curve)) {
      refuse("/flow/nodes", "a stretched length of " + number_text(length) + " m at t = 0",
             "it must be that of /beam/curve, " + number_text(curve) + " m, within 1 %");
    }
  }
  beam.check_motion(scene.duration);
}

}  // namespace

void validate_flow(const Scene& scene) {
  check_parts(scene);
  if (!flows(scene)) return;
  check_guides(scene);
  scene.dimension == 2 ? check_model<2>(scene) : check_model<3>(scene);
}

}  // namespace vlbeam
