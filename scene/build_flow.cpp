#include "scene/build_flow.hpp"

#include <cmath>

#include "core/error.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/time/stepper.hpp"
#include "scene/build.hpp"
#include "scene/stretch.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

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
void add_flow([[maybe_unused]] const Scene& scene, [[maybe_unused]] const Vec<double, D>& along,
              [[maybe_unused]] BeamModel<D>& model) {
  if constexpr (has_room("flow")) {
    FlowRoom<D>& room = flow_in(model);
    if (scene.beam.rotary_inertia != BendingInertia::none) {
      const double rhoIp = build_spin(scene.beam).rhoIp;
      room.rotary = {.rhoJ = rhoIp / 2, .gyroscopic = 0, .direction = along};
      if (scene.beam.rotary_inertia == BendingInertia::gyroscopic) room.rotary.gyroscopic = rhoIp * initial_spin(scene);
    }
    room.motion = MeshMotion(build_guides(scene));
    if (!scene.flow) return;
    for (const auto& guide : scene.flow->nodes) {
      if (guide.support == SupportType::free) continue;
      model.held_nodes.push_back({guide.node, build_support<D>({guide.support, ClampType::direction}, along)});
    }
  }
}

namespace {

/// Matter that moves along its axis as it was built.
template <int D>
ChainState<D> curved_chain(const Scene& scene, const Axis<D>& axis, const BeamModel<D>& model) {
  std::vector<Prescribed> marks;
  room_of<FlowRoom<D>>(model)->motion.at(0, marks);
  ChainState<D> chain;
  for (const Prescribed& x : marks) {
    chain.mesh.x.push_back(x.value);
    chain.mark_rates.push_back(x.rate);
  }
  const CubicChain<D> shape = even_chain(axis, chain.mesh.x, !is_polynomial(scene.beam.element));
  chain.q.resize(marks.size() * static_cast<std::size_t>(node_size<D>));
  chain.rate.resize(chain.q.size());
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const int node = static_cast<int>(k);
    position<D>(chain.q.data(), node) = shape.r[k];
    slope<D>(chain.q.data(), node) = shape.r_x[k];
    const double along = initial_velocity(scene) + marks[k].rate;
    const auto at = axis.derivatives(marks[k].value);
    position<D>(chain.rate.data(), node) = along * at[1];
    slope<D>(chain.rate.data(), node) = along * at[2];
    if (k > 0) chain.mesh.weights.push_back({shape.weights[k - 1], marks[k - 1].value, marks[k].value});
  }
  if (model.rest) chain.rest = chain.q;
  return chain;
}

}  // namespace

template <int D>
ChainState<D> flowing_chain([[maybe_unused]] const Scene& scene, [[maybe_unused]] const BeamModel<D>& model) {
  ChainState<D> chain;
  if constexpr (has_room("flow")) {
    const Axis<D> axis = build_axis<D>(scene);
    if (!axis.straight()) return curved_chain(scene, axis, model);
    const Vec<double, D> along = axis.tangent(0).normalized();
    const double stretch = initial_stretch(scene), first = room_of<FlowRoom<D>>(model)->motion.first(0).value;
    const Vec<double, D> start = axis.position(0) + along * (stretch * first);
    chain = straight_chain<D>(model, start, along, stretch, initial_velocity(scene));
    for (WeightFunction& weights : chain.mesh.weights) weights.w = scene.beam.weights;
    if (model.rest) chain.rest = chain.q;
  }
  return chain;
}

template void add_flow(const Scene&, const Vec<double, 2>&, BeamModel<2>&);
template void add_flow(const Scene&, const Vec<double, 3>&, BeamModel<3>&);
template ChainState<2> flowing_chain(const Scene&, const BeamModel<2>&);
template ChainState<3> flowing_chain(const Scene&, const BeamModel<3>&);

}  // namespace vlbeam
