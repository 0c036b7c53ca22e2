#include "core/scene/build_flow.hpp"

#include <cmath>

#include "core/dynamics/stepper.hpp"
#include "core/error.hpp"
#include "core/scene/build.hpp"
#include "core/scene/time_function.hpp"
#include "core/system/steady_flow.hpp"

namespace vlbeam {
namespace {

template <int D>
Vec<double, D> direction_of(const Scene& scene) {
  return build_axis<D>(scene).tangent(0).normalized();
}

std::vector<MeshMotion::Guide> build_guides(const Scene& scene) {
  const int last = scene.beam.elements;
  if (!scene.flow || scene.flow->nodes.empty()) return {{0, steadily(0, 0)}, {last, steadily(beam_length(scene), 0)}};
  std::vector<MeshMotion::Guide> guides;
  for (const auto& guide : scene.flow->nodes) guides.push_back({guide.node, time_function(guide.x)});
  return guides;
}

double initial_stretch(const Scene& scene) {
  if (!scene.flow) return 1;
  return stretch_under(scene.flow->tension, build_section(scene.beam).stiffness.EA, scene.beam.strain_law);
}

}  // namespace

double initial_spin(const Scene& scene) {
  if (!scene.spin) return 0;
  const auto& drives = scene.spin->drives;
  return scene.spin->rate.value_or(drives.empty() ? 0 : time_function(drives.front().angle)(0).rate);
}

double initial_velocity(const Scene& scene) {
  if (!scene.flow) return 0;
  const double rate = build_guides(scene).front().x(0).rate;
  return scene.flow->velocity.value_or(rate == 0 ? 0 : -initial_stretch(scene) * rate);
}

template <int D>
FlowingModel<D> build_flowing_model(const Scene& scene) {
  const BeamModel<D> beam = build_model<D>(scene);
  const Vec<double, D> along = direction_of<D>(scene);
  FlowingModel<D> model;
  model.section = beam.section;
  model.spin = beam.spin;
  if (scene.beam.rotary_inertia != BendingInertia::none) {
    const double rhoIp = build_spin(scene.beam).rhoIp;
    model.rotary = {.rhoJ = rhoIp / 2, .gyroscopic = 0, .direction = along};
    if (scene.beam.rotary_inertia == BendingInertia::gyroscopic) model.rotary.gyroscopic = rhoIp * initial_spin(scene);
  }
  model.formulation = scene.formulation;
  model.transport = weight_transport(scene);
  model.quadrature_points = quadrature_points(scene);
  model.gravity = beam.gravity;
  model.gravity_ramp = scene.gravity_ramp;
  model.motion = MeshMotion(build_guides(scene));
  std::vector<Prescribed> nodes;
  model.motion.at(0, nodes);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    model.weights.push_back({scene.beam.weights, nodes[k].value, nodes[k + 1].value});
  }
  const int last = model.motion.last();
  if (scene.start.type != SupportType::free) model.supports.push_back({0, beam.start});
  if (scene.end.type != SupportType::free) model.supports.push_back({last, beam.end});
  if (scene.flow) {
    for (const auto& guide : scene.flow->nodes) {
      if (guide.support == SupportType::free) continue;
      model.supports.push_back({guide.node, build_support<D>({guide.support, ClampType::direction}, along)});
    }
  }
  model.loads = beam.loads;
  model.rest = beam.rest;
  model.ledger = true;
  return model;
}

template <int D>
Eigen::VectorXd initial_flow(const Scene& scene, FlowingBeam<D>& beam) {
  const Vec<double, D> start = build_axis<D>(scene).position(0), along = direction_of<D>(scene);
  const double stretch = initial_stretch(scene);
  const Vec<double, D> origin = start + along * (stretch * beam.nodes_at(0).front().value);
  Eigen::VectorXd y = beam.straight_state(origin, along, stretch, initial_velocity(scene), initial_spin(scene));
  if (const Spin* spin = beam.spin())
    spin->start(y.data() + beam.angle(0), y.data() + beam.coordinates() + beam.angle(0));
  return scene.flow && scene.flow->steady ? steady_state(beam, y) : y;
}

template FlowingModel<2> build_flowing_model(const Scene&);
template FlowingModel<3> build_flowing_model(const Scene&);
template Eigen::VectorXd initial_flow(const Scene&, FlowingBeam<2>&);
template Eigen::VectorXd initial_flow(const Scene&, FlowingBeam<3>&);

}  // namespace vlbeam
