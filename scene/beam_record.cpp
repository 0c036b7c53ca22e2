#include "scene/beam_record.hpp"

#include <algorithm>

#include "mechanics/rooms.hpp"
#include "mechanics/spin/spin_unknowns.hpp"
#include "scene/build.hpp"
#include "scene/build_winch.hpp"
#include "scene/derived.hpp"
#include "scene/section_sample.hpp"

namespace vlbeam {

template <int D>
Configuration configuration_of(const ChainState<D>& chain, double t, WeightTransport transport, const NodeRange& of) {
  const int first = std::max(of.first, 0), last = std::min(of.last, chain.mesh.last());
  Configuration shape;
  shape.t = t;
  shape.x.assign(chain.mesh.x.begin() + first, chain.mesh.x.begin() + last + 1);
  for (auto* nodal : {&shape.r, &shape.r_x, &shape.rates.v, &shape.rates.r_x}) nodal->reserve(shape.x.size());
  shape.rates.x.reserve(shape.x.size());
  shape.weights.reserve(shape.x.size());
  for (int k = first; k <= last; ++k) {
    shape.r.push_back(point_of<D>(position<D>(chain.q.data(), k)));
    shape.r_x.push_back(point_of<D>(slope<D>(chain.q.data(), k)));
  }
  for (int k = first; chain.curved_at_rest() && k <= last; ++k) {
    shape.rest.r.push_back(point_of<D>(position<D>(chain.rest.data(), k)));
    shape.rest.r_x.push_back(point_of<D>(slope<D>(chain.rest.data(), k)));
  }
  for (const auto& joint : chain.joints) {
    if (!joint.kink || joint.node < first || joint.node > last) continue;
    shape.kinks.push_back(
        {static_cast<std::size_t>(joint.node - first), point_of<D>(joint.kink->slope), point_of<D>(joint.kink->rate)});
  }
  for (int k = first; k < last; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto& weights = chain.mesh.weights[i];
    const bool restricted = transport == WeightTransport::transported && weights.w != unit_weights;
    shape.weights.push_back(restricted ? weights.on(chain.mesh.x[i], chain.mesh.x[i + 1]) : weights.w);
  }
  for (int k = first; k <= last; ++k) {
    const double x_rate = chain.mark_rate(k);
    shape.rates.x.push_back(x_rate);
    shape.rates.v.push_back(point_of<D>(position<D>(chain.rate.data(), k) - x_rate * slope<D>(chain.q.data(), k)));
    shape.rates.r_x.push_back(point_of<D>(slope<D>(chain.rate.data(), k)));
  }
  return shape;
}

template Configuration configuration_of(const ChainState<2>&, double, WeightTransport, const NodeRange&);
template Configuration configuration_of(const ChainState<3>&, double, WeightTransport, const NodeRange&);

namespace {

constexpr int nodes_beside_event = 8;  // on either side, of a longer one

}  // namespace

template <int D>
BeamRecord<D>::BeamRecord(const Scene& scene, BeamSystem<D>& system, const RunOutput& output)
    : scene_(scene), system_(system), output_(output), places_(resolved_places(scene)) {}

template <int D>
Configuration BeamRecord<D>::shape(const Eigen::VectorXd& y, double t) const {
  Configuration shape = shape_of(scene_, system_, y, t, system_.forces(y, t));
  if constexpr (has_room("spin")) add_angles(y, shape);
  return shape;
}

/// Of a section that spins, at the nodes.
template <int D>
void BeamRecord<D>::add_angles([[maybe_unused]] const Eigen::VectorXd& y, [[maybe_unused]] Configuration& shape) const {
  if constexpr (has_room("spin")) {
    const Spin* const spin = spin_of(system_);
    for (std::size_t k = 0; spin != nullptr && k < shape.x.size(); ++k) {
      const double *angles = y.data() + system_.angles(), *rates = angles + system_.coordinates();
      if (system_.marks() != nullptr) {
        const Eigen::Index angle = spin->angle(static_cast<int>(k));
        shape.angles.push_back(angles[angle]);
        shape.rates.spins.push_back(rates[angle]);
        continue;
      }
      const auto section = spin->section(angles, rates, shape.x[k]).at;
      shape.angles.push_back(section.angle);
      shape.rates.spins.push_back(section.spin);
    }
  }
}

template <int D>
typename BeamRecord<D>::Seen BeamRecord<D>::seen(const Eigen::VectorXd& y, double t) const {
  const Observation<D> seen = system_.observe(y, t, ledger_points, true);
  const Observation<D> own = system_.observe(y, t, own_points);
  Sample sample;
  sample.t = t;
  sample.end = point_of<D>(position<D>(y.data(), system_.mesh().last()));
  sample.beam_length = seen.beam_length;
  sample.beam_length_rate = seen.beam_length_rate;
  sample.energy = seen.energy;
  sample.discrete_total = own.energy.total();
  sample.momentum = point_of<D>(seen.momentum);
  sample.angular_momentum = point_of<3>(seen.angular_momentum);
  sample.strains = strain_sample(*seen.extremes);
  const OuterForces<D> forces = system_.forces(y, t);
  if (has_flow_sample(scene_)) sample.flow = flow_sample(y, t, seen, forces);
  for (std::size_t i = 0; i < 2; ++i) sample.reactions[i] = reaction_of<D>(forces.supports[i]);
  look_at_mass(y, forces, sample);
  sample.sections =
      section_sample(scene_, places_, system_, y, shape_of(scene_, system_, y, t, forces), forces, sample.winches);
  return {std::move(sample), seen.energy.supplied + seen.load_work + seen.end_work + seen.mesh_work};
}

template <int D>
void BeamRecord<D>::look_at_mass(const Eigen::VectorXd& y, const OuterForces<D>& forces, Sample& sample) const {
  const std::size_t count = sliding_joints(scene_).size();  // the model's at its ends come behind them
  for (std::size_t i = 0; i < count; ++i) {
    const int index = static_cast<int>(i);
    SlidingSample joint;
    joint.position = mark_of(y, index);
    if (const auto mass = system_.mass_motion(y, index)) joint.mass_position = point_of<D>(mass->r);
    if (system_.on_beam(index)) joint.on_beam = joint_sample(y, index, forces);
    if (i == 0) {
      sample.joint_position = joint.position;
      sample.mass_position = joint.mass_position;
      sample.joint = joint.on_beam;
    }
    if (count > 1) sample.joints.push_back(joint);
  }
  const auto winch = [&](bool at_start) {
    const JointPlace& place = at_start ? system_.places().front() : system_.places().back();
    const JointNow<D> joint{at_start ? system_.joint_index(0) : system_.joint_index(system_.places().size() - 1),
                            y[place.mark],
                            y[system_.coordinates() + place.mark],
                            position<D>(y.data(), place.node),
                            slope<D>(y.data(), place.node),
                            slope<D>(y.data() + system_.coordinates(), place.node)};
    return look_at_winch<D>(scene_, at_start, system_.model(), joint, forces, system_.gravity(sample.t), sample.t);
  };
  if (scene_.start.pays_out()) sample.winches[0] = winch(true);
  if (scene_.end.pays_out()) sample.winches[1] = winch(false);
}

template <int D>
std::shared_ptr<const FlowSample> BeamRecord<D>::flow_sample(const Eigen::VectorXd& y, double t,
                                                             const Observation<D>& seen,
                                                             const OuterForces<D>& forces) const {
  FlowSample flow;
  flow.mass = seen.mass;
  if constexpr (has_room("spin")) {
    if (spin_of(system_) != nullptr) {
      flow.end_angles = {y[angle_of(system_, 0)], y[angle_of(system_, scene_.beam.elements)]};
      flow.spin_momentum = seen.momentum_about_axis;
      flow.torques = forces.drives;
    }
  }
  for (const auto& place : system_.load_places(y, t)) flow.loads.push_back(point_of<D>(place));
  for (const auto& force : forces.guides) flow.supports.push_back(reaction_of<D>(force));
  flow.ledger = {seen.mass_in, seen.end_work, seen.load_work, seen.mesh_work};
  return std::make_shared<const FlowSample>(std::move(flow));
}

template <int D>
JointSample BeamRecord<D>::joint_sample(const Eigen::VectorXd& y, int index, const OuterForces<D>& forces) const {
  const Vec<double, D>& force = forces.on_masses[static_cast<std::size_t>(index)];
  Vec<double, D> tangent;
  if (const auto* loose = system_.loose()) {
    tangent = loose->place(y.data(), y.data() + system_.coordinates()).r_x.normalized();
  } else {
    const JointPlace& place = system_.place_of(index);
    tangent = slope<D>(y.data(), place.node).normalized();
    if (place.behind >= 0) tangent = between<Vec<double, D>>(tangent, y.segment<D>(place.behind).normalized());
  }
  const double along = force.dot(tangent);
  return {y[system_.coordinates() + mark(index)], point_of<D>(force), along, (force - along * tangent).norm(),
          forces.guiding[static_cast<std::size_t>(index)]};
}

template <int D>
Configuration BeamRecord<D>::shape_beside(const ChainState<D>& chain, const EventRecord<D>& record) const {
  NodeRange nodes;
  const ChainState<D>& before = record.before;  // it was that beam which decided what is in both
  const int elements = before.part.before + before.mesh.elements() + before.part.behind;
  if (elements > system_.model().length_control.most_whole &&
      chain.joints.size() <= 1) {  // events of several may be one
    const int k = chain.mesh.element_at(record.joint_position);
    nodes = {k - nodes_beside_event, k + 1 + nodes_beside_event};
  }
  return configuration_of(chain, record.t, weight_transport(scene_), nodes);
}

template <int D>
Event BeamRecord<D>::event(const EventRecord<D>& record) const {
  Event event;
  event.t = record.t;
  event.type = record.type;
  event.joint = record.joint;
  event.joint_position = record.joint_position;
  event.weights = record.merged.k;
  event.unit_fallback = record.merged.unit_fallback;
  event.energy_jump = record.jump;
  event.discrete_jump = record.discrete_jump;
  event.momentum_jump.assign(record.momentum_jump.begin(), record.momentum_jump.end());
  event.restored = record.conserved;
  event.relaxation = record.given_way;
  if (output_.event_shapes) {
    event.before = shape_beside(record.before, record);
    event.after = shape_beside(record.after, record);
  }
  return event;
}

template class BeamRecord<2>;
template class BeamRecord<3>;

}  // namespace vlbeam
