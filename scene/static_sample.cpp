#include "scene/static_sample.hpp"

#include "scene/build.hpp"
#include "scene/section_sample.hpp"

namespace vlbeam {

template <int D>
Sample static_sample(BeamSystem<D>& system, const AtRest& at, double number, const Scene& scene,
                     const std::vector<PlaceSpec>& places, const OuterForces<D>& forces, const Configuration& shape) {
  const std::size_t joints = sliding_joints(scene).size();
  const auto seen = system.observe(at.y, at.factor, ledger_points, true);
  const ChainState<D> chain = system.chain(at.y, number);
  Sample sample;
  sample.t = number;
  sample.equilibrium = at.equilibrium;
  sample.end = point_of<D>(position<D>(chain.q.data(), chain.mesh.last()));
  sample.beam_length = seen.beam_length;
  sample.energy = seen.energy;
  sample.discrete_total = system.observe(at.y, at.factor, own_points).energy.total();
  sample.strains = strain_sample(*seen.extremes);
  for (std::size_t i = 0; i < 2; ++i) sample.reactions[i] = reaction_of<D>(forces.supports[i]);
  sample.sections = section_sample(scene, places, system, at.y, shape, forces, {});
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const auto& joint = chain.joints[i];
    const auto index = static_cast<std::size_t>(joint.index);
    if (index >= joints) continue;  // a knot
    const Vec<double, D> place = position<D>(chain.q.data(), joint.node), &force = forces.on_masses[index];
    Vec<double, D> tangent = slope<D>(chain.q.data(), joint.node).normalized();
    if (joint.kink) tangent = between<Vec<double, D>>(tangent, joint.kink->slope.normalized());
    const double along = force.dot(tangent), held = joints > 1 && i < at.holding.size() ? at.holding[i] : 0;
    const SlidingSample seen_there{chain.mesh.x[static_cast<std::size_t>(joint.node)], point_of<D>(place),
                                   JointSample{0, point_of<D>(force), along, (force - along * tangent).norm(), held}};
    if (index == 0) {
      sample.joint_position = seen_there.position;
      sample.mass_position = seen_there.mass_position;
      sample.joint = seen_there.on_beam;
    }
    if (joints > 1) sample.joints.push_back(seen_there);
  }
  if (!has_flow_sample(scene)) return sample;
  FlowSample flow;
  flow.mass = seen.mass;
  const ChainView<D> beam = system.view(at.y.data(), at.y.data() + system.coordinates());
  for (const auto& place : system.model().loads.places(beam, at.factor)) flow.loads.push_back(point_of<D>(place));
  flow.ledger = {.mass = 0, .ends = 0, .loads = 0, .mesh = 0};
  sample.flow = std::make_shared<const FlowSample>(std::move(flow));
  return sample;
}

template Sample static_sample(BeamSystem<2>&, const AtRest&, double, const Scene&, const std::vector<PlaceSpec>&,
                              const OuterForces<2>&, const Configuration&);
template Sample static_sample(BeamSystem<3>&, const AtRest&, double, const Scene&, const std::vector<PlaceSpec>&,
                              const OuterForces<3>&, const Configuration&);

}  // namespace vlbeam
