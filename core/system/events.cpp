// What an event makes of a beam and its state.
#include <algorithm>
#include <chrono>

#include "core/error.hpp"
#include "core/length_control/least_change.hpp"
#include "core/length_control/relaxation.hpp"
#include "core/system/beam_system.hpp"
#include "core/system/event_limits.hpp"

namespace vlbeam {
namespace {

using namespace event_limits;

constexpr double restored_energy = 1e-9;  // of the energies there are

/// Whether nodes give way at events.
bool relaxes(const LengthControl& control) {
  return control.cut == CutPolicy::relaxed || control.merge == MergePolicy::relaxed;
}

ComputationFailed ran_into_support(bool held, Direction direction, double t) {
  return {std::string(held ? "the joint" : "the sliding mass") + " ran into the support at the beam's " +
              (direction == Direction::forward ? "end" : "start"),
          t};
}

}  // namespace

/// The element there is cut and merged as those at a joint are, but for the other side.
template <int D>
MergedWeights BeamSystem<D>::renew_weights(ChainState<D>& chain, std::size_t which, double t) const {
  const ChainState<D> before = chain;
  const int node = places_[which].node;
  MergedWeights renewed;
  for (const int k : {node - 1, node}) {
    if (k < 0 || k == chain.mesh.elements()) continue;
    const auto i = static_cast<std::size_t>(k);
    const auto& x = chain.mesh.x;
    if (lost_weight(chain.mesh.weights[i].on(x[i], x[i + 1])) < -0.5 * smallest_weight) continue;
    renewed = least_change(chain, before, k, true, moving_law(t));
  }
  return renewed;
}

template <int D>
double BeamSystem<D>::clear_of_end() const {
  return rider_->end + (rider_->at_end() ? -1 : 1) * clearance * model_.length_control.standard_length;
}

template <int D>
void BeamSystem<D>::hit(ChainState<D>& chain, Eigen::VectorXd& y, double t) {
  const Impact& impact = model_.joints.front().at_support;
  const int outwards = rider_->at_end() ? 1 : -1;
  if (impact.law == AtSupport::stop) {
    throw ran_into_support(false, outwards > 0 ? Direction::forward : Direction::backward, t);
  }
  // a momentum J on x changes velocities by J M^-1 e_x
  const Eigen::Index x = coordinates() + layout_.mark();
  Eigen::VectorXd answer = Eigen::VectorXd::Unit(coordinates(), layout_.mark()), momentum(coordinates());
  if (!solve_mass({}, y.data(), answer.data())) throw ran_into_support(false, Direction::forward, t);
  multiply_mass({}, y.data(), answer.data(), momentum.data());
  auto strike = [&](double restitution) {
    auto rate = y.segment(coordinates(), coordinates());
    const double change = -(1 + restitution) * rate[layout_.mark()] / answer[layout_.mark()];
    layout_.tallies.add({.supports = change * (momentum.dot(rate) - momentum[layout_.mark()] * rate[layout_.mark()])},
                        y);
    rate += change * answer;
  };
  bool rests = impact.law == AtSupport::rest || impact.restitution == 0;
  if (!rests) {
    strike(impact.restitution);
    Eigen::VectorXd rates(y.size());
    rhs(y, rates, t);
    const double falls = outwards * rates[x];
    rests = falls > 0 && y[x] * y[x] < 2 * falls * least_bounce * model_.length_control.standard_length;
  }
  if (rests) strike(0);
  chain = this->chain(y, t);
  chain.rider->held = rests;
  chain.rider->x = rests ? rider_->end : clear_of_end();
  if (rests) chain.rider->rate = 0;
}

template <int D>
void BeamSystem<D>::check_leaving(const PendingEvent& due, double t) const {
  const bool forward = due.direction == Direction::forward;
  const int node = places_[due.which].node;
  if (!(forward ? node + 1 == mesh_.last() : node == 1)) {
    throw ComputationFailed("tangled mesh: the sliding mass ran into a node; switch length control on", t);
  }
  if (!(forward ? model_.end_releases : model_.start_releases)) {
    throw ran_into_support(joint(due.which).support.has_value(), due.direction, t);
  }
  for (const Tie& tie : ties_) {
    if (tie.behind != index_[due.which] && tie.ahead != index_[due.which]) continue;
    throw ComputationFailed("the joint " + std::to_string(index_[due.which]) +
                                ", which a block holds, comes to a free end: take a longer beam, or a shorter duration",
                            t);
  }
}

template <int D>
MergedWeights BeamSystem<D>::change(const PendingEvent& due, ChainState<D>& chain, Eigen::VectorXd& y, double t) {
  const auto& control = model_.length_control;
  switch (due.type) {
    case EventType::separation: {
      const int index = rider_ ? 0 : index_[due.which];
      const auto mass = mass_motion(y, index);
      if (rider_) {
        chain.rider.reset();
      } else {
        separate(chain, due.direction, control, model_.transport);
        if (!chain.joints.empty()) chain.joints.back().touches[1] = {};
      }
      const ModelJoint<D>& left = model_.joints[static_cast<std::size_t>(index)];
      if (!left.support && left.law.mass > 0) chain.departed.push_back({index, mass->r, mass->v});
      return {};
    }
    case EventType::segment_merge:
    case EventType::segmentation:
    case EventType::merging:
      return segment_and_merge(chain, due.which, due.direction, due.remeshing, control, moving_law(t));
    case EventType::reweighting:
      return renew_weights(chain, due.which, t);
    case EventType::end_merge:
      return merge_at_end(chain, due.direction, control, moving_law(t));
    case EventType::end_cut: {
      const MergedWeights merged = cut_at_end(chain, control, moving_law(t));
      if (rider_law().kinked()) {
        auto& node = chain.joints.front();
        node.kink = {slope<D>(chain.q.data(), node.node), slope<D>(chain.rate.data(), node.node)};
      }
      return merged;
    }
    case EventType::contact:
      if (rider_) {
        hit(chain, y, t);
      } else {
        strike(y, t);
        chain = this->chain(y, t);
      }
      return {};
    case EventType::lift_off:
      if (rider_) {
        chain.rider->held = false;
        chain.rider->x = clear_of_end();
      } else {
        const auto parts = std::ranges::find_if(resting_, [&](const Contact& contact) {
          return contact.which == due.which && (contact.support < 0) == (due.direction == Direction::backward);
        });
        open_contact(Contact(*parts), y);
        chain = this->chain(y, t);
      }
      return {};
    case EventType::passage:
      passed_[static_cast<std::size_t>(index_[due.which])] += due.direction == Direction::forward ? 1 : -1;
      return {};
  }
  return {};
}

template <int D>
int BeamSystem<D>::relax_after(const std::vector<PendingEvent>& dues, ChainState<D>& chain, double t,
                               double excess) const {
  const auto& control = model_.length_control;
  std::vector<GivingNode> giving;
  const auto slope_is_free = [&](int node) {
    if (node == 0 || node == chain.mesh.last()) {
      const auto& support = node == 0 ? model_.start : model_.end;
      if ((support.free_slope == 0).any()) return false;
    }
    const auto* const at = chain.joint_at(node);
    if (at == nullptr) return true;
    const auto& support = model_.joints[static_cast<std::size_t>(at->index)].support;
    return !at->kink && !(support && (support->free_slope == 0).any());
  };
  const auto place_is_free = [&](int node) {
    return node > 0 && node < chain.mesh.last() && chain.joint_at(node) == nullptr;
  };
  const auto cut_at = [&](int node) {
    if (control.cut == CutPolicy::relaxed && place_is_free(node)) giving.push_back({node, true, true});
  };
  const auto merged = [&](int element) {
    if (control.merge != MergePolicy::relaxed) return;
    for (const int node : {element, element + 1}) {
      giving.push_back({node, place_is_free(node), slope_is_free(node)});
    }
  };
  for (const PendingEvent& due : dues) {
    const bool forward = due.direction == Direction::forward;
    switch (due.type) {
      case EventType::segment_merge:
      case EventType::segmentation:
      case EventType::merging: {
        const int node = chain.joints[due.which].node;
        if (due.remeshing.cut) cut_at(forward ? node - 1 : node + 1);
        if (due.remeshing.merge) merged(forward ? node : node - 1);
        break;
      }
      case EventType::end_merge: {
        const int element = chain.rider->element;
        cut_at(forward ? element : element + 1);
        merged(element);
        break;
      }
      case EventType::end_cut:
        merged(forward ? chain.joints.front().node - 1 : chain.joints.front().node);
        break;
      default:
        break;
    }
  }
  if (giving.empty()) return 0;
  return relax(chain, giving, beam_rule(model_.quadrature_points, model_.axial_strain), moving_law(t), excess);
}

template <int D>
void BeamSystem<D>::handle_event(int index, Eigen::VectorXd& y, double t) {
  if (moving_) stop_travelling(index, t);
  const auto started = std::chrono::steady_clock::now();
  impose(y, t);
  orient(t);
  if (turns_away(index, y, t)) return frames_->follow(y.data(), y.data() + coordinates());
  const bool ramped = ramp_.due(model_.gravity_ramp);
  if (ramped) ramp_.advance(t, moment(y, t));
  const std::vector<PendingEvent> dues = all_due(index, y, t);
  const EventType type = dues.front().type;
  const bool leaving = type == EventType::separation;
  if (leaving && has_joint()) check_leaving(dues.front(), t);
  std::vector<EventRecord<D>> records(dues.size());
  for (std::size_t i = 0; i < dues.size(); ++i) {
    records[i].t = t;
    records[i].type = dues[i].type;
    records[i].joint = rider_ ? 0 : index_[dues[i].which];
    records[i].joint_position = y[rider_ ? layout_.mark() : places_[dues[i].which].mark];
    records[i].restored = true;
  }
  EventRecord<D>& record = records.front();
  record.before = chain(y, t);
  record.after = record.before;
  // an event of the mesh changes the two elements on either side, or, where slopes change too, one more
  const bool reshapes = type == EventType::reweighting || model_.length_control.merge == MergePolicy::least_change ||
                        relaxes(model_.length_control);
  const int reach = reshapes ? 3 : 2;
  int lowest = mesh_.elements(), highest = 0;
  for (const PendingEvent& due : dues) {
    const int middle = rider_ ? rider_->element : places_[due.which].node;
    lowest = std::min(lowest, std::max(0, middle - reach));
    highest = std::max(highest, std::min(mesh_.elements(), middle + reach));
  }
  auto energies = [&](const ChainState<D>& state, int points) {
    Observation<D> seen;
    const int more = state.mesh.elements() - record.before.mesh.elements();
    observe_elements(state, lowest, highest + more, t, points, seen);
    return seen.energy;
  };
  const bool remeshes = type == EventType::segment_merge || type == EventType::segmentation ||
                        type == EventType::merging || type == EventType::reweighting || type == EventType::end_merge ||
                        type == EventType::end_cut;
  const bool transfers = remeshes && model_.length_control.velocities != VelocityTransfer::nodal;
  // a projection or an impact changes velocities everywhere, and a rider's is not a node's
  const bool everywhere = transfers || type == EventType::contact || type == EventType::end_merge || rider_ || frames_;
  const Energy before = everywhere ? observe(y, t, ledger_points).energy : energies(record.before, ledger_points);
  const double own_before =
      (everywhere ? observe(y, t, model_.quadrature_points).energy : energies(record.before, model_.quadrature_points))
          .total();

  const Eigen::VectorXd momenta_before = momenta(y, t);
  const double work_before = layout_.tallies.of(y).supports;

  if (dues.size() == 1) {
    records.front().merged = change(dues.front(), record.after, y, t);
  } else {  // cuts first, at places that no merge has moved: mirror images stay mirror images
    const auto remesh = [&](const PendingEvent& due, const Remeshing& what) {
      return segment_and_merge(record.after, due.which, due.direction, what, model_.length_control, moving_law(t));
    };
    for (const PendingEvent& due : dues) {
      if (due.remeshing.cut) remesh(due, {true, false});
    }
    for (std::size_t i = 0; i < dues.size(); ++i) {
      if (dues[i].remeshing.merge) records[i].merged = remesh(dues[i], {false, true});
    }
  }
  if (frames_) turn_sections(record.before, y, record.after);
  if (remeshes && relaxes(model_.length_control)) {
    const auto stored = [&](const ChainState<D>& state) {
      const Energy energy = energies(state, model_.quadrature_points);
      return energy.axial + energy.bending;
    };
    record.relaxation = relax_after(dues, record.after, t, stored(record.after) - stored(record.before));
  }
  const Eigen::VectorXd old = y;
  const std::shared_ptr<Frames> old_frames = frames_;
  const Eigen::Index old_coordinates = coordinates();
  adopt(record.after);
  orient(t);
  y = state_of(record.after, old);
  const int highest_after = highest + record.after.mesh.elements() - record.before.mesh.elements();
  if (transfers) {
    project_velocities(record.before, lowest, highest_after, y, t);
    if (frames_ && model_.frames->section.rhoIp > 0) {
      frames_->project_spins(*old_frames, old.data(), old.data() + old_coordinates, y.data(), y.data() + coordinates());
    }
    if (model_.length_control.velocities == VelocityTransfer::conservative) {
      restore(momenta_before, own_before, y, t);
    }
    record.after = this->chain(y, t);
    record.jump = observe(y, t, ledger_points).energy - before;
    record.discrete_jump = observe(y, t, model_.quadrature_points).energy.total() - own_before;
    if (model_.length_control.velocities == VelocityTransfer::conservative) {
      const double size = std::abs(before.kinetic) + before.axial + before.bending + std::abs(before.gravity);
      record.restored = std::abs(record.discrete_jump) <= restored_energy * size;
    }
  } else if (everywhere) {
    if (type == EventType::end_merge) {  // nodes keep their velocities, the mass keeps its momentum
      project_velocities(record.before, lowest, lowest, y, t);
      record.after = this->chain(y, t);
    }
    record.jump = observe(y, t, ledger_points).energy - before;
    record.discrete_jump = observe(y, t, model_.quadrature_points).energy.total() - own_before;
  } else {
    record.jump = energies(record.after, ledger_points) - before;
    record.discrete_jump = energies(record.after, model_.quadrature_points).total() - own_before;
  }
  if (model_.driven()) {  // what supports do in an impact is no jump
    const double work = layout_.tallies.of(y).supports - work_before;
    record.jump.kinetic -= work;
    record.jump.supplied -= work;
    record.discrete_jump -= work;
  }
  if (!leaving) record.momentum_jump = momenta(y, t) - momenta_before;
  if (ramped) ramp_.restart(t, moment(y, t));
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!on_event) return;
  on_event(record);
  for (std::size_t i = 1; i < records.size(); ++i) {  // what happened with it is in the first one
    records[i].before = records[i].after = record.after;
    records[i].momentum_jump = Eigen::VectorXd::Zero(record.momentum_jump.size());
    on_event(records[i]);
  }
}

template double BeamSystem<2>::clear_of_end() const;
template MergedWeights BeamSystem<2>::renew_weights(ChainState<2>&, std::size_t, double) const;
template void BeamSystem<2>::check_leaving(const PendingEvent&, double) const;
template MergedWeights BeamSystem<2>::change(const PendingEvent&, ChainState<2>&, Eigen::VectorXd&, double);
template int BeamSystem<2>::relax_after(const std::vector<PendingEvent>&, ChainState<2>&, double, double) const;
template void BeamSystem<2>::hit(ChainState<2>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::handle_event(int, Eigen::VectorXd&, double);
template double BeamSystem<3>::clear_of_end() const;
template MergedWeights BeamSystem<3>::renew_weights(ChainState<3>&, std::size_t, double) const;
template void BeamSystem<3>::check_leaving(const PendingEvent&, double) const;
template MergedWeights BeamSystem<3>::change(const PendingEvent&, ChainState<3>&, Eigen::VectorXd&, double);
template int BeamSystem<3>::relax_after(const std::vector<PendingEvent>&, ChainState<3>&, double, double) const;
template void BeamSystem<3>::hit(ChainState<3>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::handle_event(int, Eigen::VectorXd&, double);

}  // namespace vlbeam
