// What an event makes of a beam and its state.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "core/length_control/least_change.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/motion/system/event_limits.hpp"
#include "mechanics/remesh/relaxation.hpp"
#include "mechanics/remesh/restore_beside_joint.hpp"

namespace vlbeam {
namespace {

constexpr double restored_energy = 1e-9;  // of the energies there are

/// Whether nodes give way at events.
bool relaxes(const LengthControl& control) {
  return control.cut == CutPolicy::relaxed || control.merge == MergePolicy::relaxed;
}

/// Whether an event changes the mesh.
bool remeshes(EventType type) {
  using enum EventType;
  return type == segment_merge || type == segmentation || type == merging || type == reweighting || type == end_merge ||
         type == end_cut;
}

}  // namespace

/// The element there is cut and merged as those at a joint are, but for the other side.
template <int D>
MergedWeights BeamSystem<D>::renew_weights(ChainState<D>& chain, std::size_t which, double t) const {
  const ChainState<D> before = chain;
  const int node = chain.joints[which].node;
  MergedWeights renewed;
  for (const int k : {node - 1, node}) {
    if (k < 0 || k == chain.mesh.elements()) continue;
    const auto i = static_cast<std::size_t>(k);
    const auto& x = chain.mesh.x;
    if (lost_weight(chain.mesh.weights[i].on(x[i], x[i + 1])) < -0.5 * smallest_weight) continue;
    renewed = least_change(chain, before, k, true, Beam::moving_law(t));
  }
  return renewed;
}

template <int D>
double BeamSystem<D>::clear_of_end() const {
  return rider()->end + (rider()->at_end() ? -1 : 1) * event_limits::clearance * model().length_control.standard_length;
}

template <int D>
void BeamSystem<D>::check_leaving(const PendingEvent& due, double t) const {
  const bool forward = due.direction == Direction::forward;
  const int node = places()[due.which].node;
  if (!(forward ? node + 1 == mesh().last() : node == 1)) {
    throw ComputationFailed("tangled mesh: the sliding mass ran into a node; switch length control on", t);
  }
  if (!(forward ? model().end_releases : model().start_releases)) {
    throw ran_into_support(joint(due.which).support.has_value(), due.direction, t);
  }
  if (!links_.in_block(joint_index(due.which))) return;
  throw ComputationFailed("the joint " + std::to_string(joint_index(due.which)) +
                              ", which a block holds, comes to a free end: take a longer beam, or a shorter duration",
                          t);
}

template <int D>
void BeamSystem<D>::check_order(const Eigen::VectorXd& y, double t) const {
  for (std::size_t i = 1; i < places().size(); ++i) {
    if (Beam::mark_at(i - 1, y, t) < Beam::mark_at(i, y, t)) continue;
    throw ComputationFailed("the joints " + std::to_string(joint_index(i - 1)) + " and " +
                                std::to_string(joint_index(i)) +
                                " have passed each other unseen: this is an error of the program, please report it",
                            t);
  }
}

template <int D>
MergedWeights BeamSystem<D>::change(const PendingEvent& due, ChainState<D>& chain, Eigen::VectorXd& y, double t) {
  const auto& control = model().length_control;
  switch (due.type) {
    case EventType::separation: {
      const int index = rider() ? 0 : joint_index(due.which);
      const auto mass = Beam::mass_motion(y, index);
      if (rider()) {
        chain.rider.reset();
      } else {
        separate(chain, due.direction, control, model().transport);
        if (!chain.joints.empty()) chain.joints.back().touches[1] = {};
      }
      const ModelJoint<D>& left = model().joints[static_cast<std::size_t>(index)];
      if (!left.support && left.law.mass > 0) chain.departed.push_back({index, mass->r, mass->v});
      return {};
    }
    case EventType::segment_merge:
    case EventType::segmentation:
    case EventType::merging:
      return segment_and_merge(chain, due.which, due.direction, due.remeshing, control, Beam::moving_law(t));
    case EventType::reweighting:
      return renew_weights(chain, due.which, t);
    case EventType::end_merge:
      return merge_at_end(chain, due.direction, control, Beam::moving_law(t));
    case EventType::end_cut: {
      const MergedWeights merged = cut_at_end(chain, control, Beam::moving_law(t));
      if (Beam::rider_law().kinked()) {
        auto& node = chain.joints.front();
        node.kink = {slope<D>(chain.q.data(), node.node), slope<D>(chain.rate.data(), node.node)};
      }
      return merged;
    }
    case EventType::contact:
      if (rider()) {
        const bool rests = impacts_.hit(y, t);
        chain = Beam::chain(y, t);
        chain.rider->held = rests;
        chain.rider->x = rests ? rider()->end : clear_of_end();
        if (rests) chain.rider->rate = 0;
      } else {
        impacts_.strike(y, t);
        chain = Beam::chain(y, t);
      }
      return {};
    case EventType::lift_off:
      if (rider()) {
        chain.rider->held = false;
        chain.rider->x = clear_of_end();
      } else {
        const bool at_start = due.direction == Direction::backward;
        const auto parts = std::ranges::find_if(links_.resting(), [&](const NodeContact<D>& contact) {
          return contact.which == due.which && (contact.support < 0) == at_start;
        });
        links_.open(NodeContact<D>(*parts), y);
        chain = Beam::chain(y, t);
      }
      return {};
    case EventType::passage:
      Beam::pass(due.which, due.direction == Direction::forward ? 1 : -1);
      return {};
  }
  return {};
}

template <int D>
int BeamSystem<D>::relax_after(const std::vector<PendingEvent>& dues, ChainState<D>& chain, double t,
                               double excess) const {
  const auto& control = model().length_control;
  std::vector<GivingNode> giving;
  const auto slope_is_free = [&](int node) {
    if (node == 0 || node == chain.mesh.last()) {
      const auto& support = node == 0 ? model().start : model().end;
      if ((support.free_slope == 0).any()) return false;
    }
    const auto* const at = chain.joint_at(node);
    if (at == nullptr) return true;
    const auto& support = model().joints[static_cast<std::size_t>(at->index)].support;
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
  return relax(chain, giving, Beam::rules(), Beam::moving_law(t), excess);
}

template <int D>
void BeamSystem<D>::change_mesh(const std::vector<PendingEvent>& dues, std::vector<EventRecord<D>>& records,
                                double t) const {
  ChainState<D>& chain = records.front().after;
  const auto remesh = [&](const PendingEvent& due, const Remeshing& what) {
    return segment_and_merge(chain, due.which, due.direction, what, model().length_control, Beam::moving_law(t));
  };
  // cuts first, at places that no merge has moved: mirror images stay mirror images
  for (const PendingEvent& due : dues) {
    if (due.remeshing.cut) remesh(due, {true, false});
  }
  for (std::size_t i = 0; i < dues.size(); ++i) {
    if (dues[i].remeshing.merge) records[i].merged = remesh(dues[i], {false, true});
  }
}

/// Its bounds are those of packs of elements, as sums over a part need them.
template <int D>
BeamPart BeamSystem<D>::part_around_joint() const {
  const auto left_out = [](int elements) {
    return std::max(0, elements - event_limits::elements_beside) / Pack::width * Pack::width;
  };
  const int node = places().front().node;
  return {left_out(node - 1), left_out(mesh().last() - (node + 1))};
}

template <int D>
std::vector<EventRecord<D>> BeamSystem<D>::records_of(const std::vector<PendingEvent>& dues, const BeamPart& part,
                                                      const Eigen::VectorXd& y, double t) {
  std::vector<EventRecord<D>> records(dues.size());
  for (std::size_t i = 0; i < dues.size(); ++i) {
    records[i].t = t;
    records[i].type = dues[i].type;
    records[i].joint = rider() ? 0 : joint_index(dues[i].which);
    records[i].joint_position = y[rider() ? layout().mark() : places()[dues[i].which].mark];
    records[i].restored = true;
  }
  EventRecord<D>& first = records.front();
  first.before = accelerations_.last_event().release();
  first.after = std::move(spare_chain_);
  Beam::write_chain(y, t, part, first.before);
  first.after = first.before;
  return records;
}

template <int D>
EventReach BeamSystem<D>::reach_of(const std::vector<PendingEvent>& dues, const BeamPart& part) const {
  const LengthControl& control = model().length_control;
  const bool reshapes =
      dues.front().type == EventType::reweighting || control.merge == MergePolicy::least_change || relaxes(control);
  const int reach = reshapes ? 3 : 2;
  const int elements = mesh().elements() - part.before - part.behind;
  EventReach result{elements, 0};
  for (const PendingEvent& due : dues) {
    const int middle = (rider() ? rider()->element : places()[due.which].node) - part.before;
    result.lowest = std::min(result.lowest, std::max(0, middle - reach));
    result.highest = std::max(result.highest, std::min(elements, middle + reach));
  }
  return result;
}

template <int D>
void BeamSystem<D>::transfer_velocities(const EventRecord<D>& record, const EventReach& reach,
                                        const std::shared_ptr<Frames>& old_frames, Eigen::VectorXd& y, double t) {
  velocities_.project(record.before, record.after, reach.lowest, reach.highest, y, t);
  if (old_frames == nullptr || !(model().frames->section.rhoIp > 0)) return;
  const double* const old = old_.data();
  const Eigen::Index before = (old_.size() - layout().tallies.count()) / 2;
  Beam::frames()->project_spins(*old_frames, old, old + before, y.data(), y.data() + coordinates());
}

template <int D>
bool BeamSystem<D>::has_free_joint() const {
  return Beam::held(0) == nullptr && !Beam::guides(0) && Beam::joint(0).pitch == 0 && !model().driven();
}

template <int D>
typename BeamSystem<D>::EventScope BeamSystem<D>::scope_of(const std::vector<PendingEvent>& dues) const {
  const LengthControl& control = model().length_control;
  const EventType type = dues.front().type;
  EventScope scope;
  scope.type = type;
  scope.observes_all =
      type == EventType::contact || type == EventType::end_merge || rider().has_value() || Beam::frames() != nullptr;
  scope.transfers = remeshes(type) && control.velocities != VelocityTransfer::nodal;
  scope.conserves = scope.transfers && control.velocities == VelocityTransfer::conservative;
  scope.changes_nodes_alone = (remeshes(type) || type == EventType::passage) && !scope.observes_all;
  scope.goes_on = type == EventType::passage || (remeshes(type) && !rider() && type != EventType::end_merge);
  scope.is_local = scope.changes_nodes_alone && places().size() == 1 && links_.all().empty() &&
                   mesh().elements() > control.most_whole && (!scope.conserves || has_free_joint());
  if (scope.is_local) scope.part = part_around_joint();
  scope.reach = reach_of(dues, scope.part);
  return scope;
}

template <int D>
typename BeamSystem<D>::BeforeEvent BeamSystem<D>::look_before(const EventScope& scope, const Eigen::VectorXd& y,
                                                               double t) {
  BeforeEvent before;
  if (scope.observes_all) before.energy = observe(y, t, ledger_points).energy;
  if (scope.conserves && scope.is_local) {
    before.own.kinetic = kinetic_energy(*this, mass_, scope.part, y, t);
  } else if (scope.observes_all || scope.conserves) {
    before.own = observe(y, t, own_points).energy;
  }
  before.momenta = velocities_.momenta(y, t, scope.part);
  before.work = layout().tallies.of(y).supports;
  return before;
}

template <int D>
void BeamSystem<D>::change_chain(const std::vector<PendingEvent>& dues, const EventScope& scope,
                                 std::vector<EventRecord<D>>& records, Eigen::VectorXd& y, double t) {
  EventRecord<D>& record = records.front();
  if (dues.size() == 1) {
    record.merged = change(dues.front(), record.after, y, t);
  } else {
    change_mesh(dues, records, t);
  }
  if (Beam::frames() != nullptr) Beam::turn_sections(record.before, y, record.after);
  if (remeshes(scope.type) && relaxes(model().length_control)) {
    const Energy stored = energy_jump(*this, record.before, record.after, scope.reach, t, own_points);
    record.relaxation = relax_after(dues, record.after, t, stored.axial + stored.bending);
  }
}

template <int D>
void BeamSystem<D>::change_velocities(const EventScope& scope, const BeforeEvent& before,
                                      const std::shared_ptr<Frames>& old_frames, EventRecord<D>& record,
                                      Eigen::VectorXd& y, double t) {
  if (scope.transfers) {
    EventReach after = scope.reach;
    after.highest += record.after.mesh.elements() - record.before.mesh.elements();
    transfer_velocities(record, after, old_frames, y, t);
  } else if (scope.type == EventType::end_merge) {  // nodes keep their velocities, the mass keeps its momentum
    velocities_.project(record.before, record.after, scope.reach.lowest, scope.reach.lowest, y, t);
  }
  if (scope.conserves) {
    const auto gained = [&] {
      Beam::take_rates(y, record.after);
      if (scope.observes_all) return (observe(y, t, own_points).energy - before.own).total();
      return energy_jump(*this, record.before, record.after, scope.reach, t, own_points).total();
    };
    if (scope.is_local) {
      const Eigen::VectorXd lacking = before.momenta - velocities_.momenta(y, t, scope.part);
      restore_beside_joint<D>(*this, mass_, scope.part, lacking, gained, y, t);
    } else {
      velocities_.restore(before.momenta, gained, y, t);
    }
  }
  if (scope.transfers || scope.type == EventType::end_merge) Beam::take_rates(y, record.after);
}

template <int D>
void BeamSystem<D>::book_jumps(const EventScope& scope, const BeforeEvent& before, EventRecord<D>& record,
                               const Eigen::VectorXd& y, double t) {
  if (scope.observes_all) {
    record.jump = observe(y, t, ledger_points).energy - before.energy;
    record.discrete_jump = (observe(y, t, own_points).energy - before.own).total();
  } else {
    const auto jumps =
        energy_jumps(*this, record.before, record.after, scope.reach, t, std::array{ledger_points, own_points});
    record.jump = jumps[0];
    record.discrete_jump = jumps[1].total();
  }
  if (scope.conserves) {
    const Energy& own = before.own;
    const double size = std::abs(own.kinetic) + own.axial + own.bending + std::abs(own.gravity);
    record.restored = std::abs(record.discrete_jump) <= restored_energy * size;
  }
  if (model().driven()) {  // what supports do in an impact is no jump
    const double work = layout().tallies.of(y).supports - before.work;
    record.jump.kinetic -= work;
    record.jump.supplied -= work;
    record.discrete_jump -= work;
  }
  if (scope.type != EventType::separation) {
    record.momentum_jump = velocities_.momenta(y, t, scope.part) - before.momenta;
  }
}

template <int D>
void BeamSystem<D>::tell(std::vector<EventRecord<D>>& records) const {
  if (!on_event) return;
  const EventRecord<D>& first = records.front();
  on_event(first);
  for (std::size_t i = 1; i < records.size(); ++i) {
    records[i].before = records[i].after = first.after;
    records[i].momentum_jump = Eigen::VectorXd::Zero(first.momentum_jump.size());
    on_event(records[i]);
  }
}

template <int D>
void BeamSystem<D>::handle_event(int index, Eigen::VectorXd& y, double t) {
  const auto started = std::chrono::steady_clock::now();
  Beam::impose(y, t);
  Beam::orient(t);
  if (guards_.turns_away(index, y, t)) {
    accelerations_.last_event().forget();  // angles count from elsewhere now
    return Beam::frames()->follow(y.data(), y.data() + coordinates());
  }
  const bool ramped = ramp_.due(model().gravity_ramp);
  if (ramped) ramp_.advance(t, moment(y, t));
  const std::vector<PendingEvent> dues = guards_.due(index, y, t);
  if (dues.front().type == EventType::separation && has_joint()) check_leaving(dues.front(), t);

  const EventScope scope = scope_of(dues);
  std::vector<EventRecord<D>> records = records_of(dues, scope.part, y, t);
  EventRecord<D>& record = records.front();
  const BeforeEvent before = look_before(scope, y, t);
  change_chain(dues, scope, records, y, t);

  const std::vector<JointPlace> places_before = places();
  const Layout<D> layout_before = layout();
  const std::shared_ptr<Frames> old_frames = Beam::shared_frames();
  take(record.after);
  Beam::orient(t);
  if (scope.changes_nodes_alone) {
    Beam::write_nodes(record.after, y);
  } else {
    old_.swap(y);
    Beam::write_state(record.after, old_, y);
  }
  change_velocities(scope, before, old_frames, record, y, t);
  book_jumps(scope, before, record, y, t);

  if (ramped) ramp_.restart(t, moment(y, t));
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  tell(records);
  if (scope.goes_on) accelerations_.last_event().remember({std::move(record.before), places_before, layout_before});
  spare_chain_ = std::move(record.after);
}

template MergedWeights BeamSystem<2>::renew_weights(ChainState<2>&, std::size_t, double) const;
template double BeamSystem<2>::clear_of_end() const;
template void BeamSystem<2>::check_leaving(const PendingEvent&, double) const;
template void BeamSystem<2>::check_order(const Eigen::VectorXd&, double) const;
template MergedWeights BeamSystem<2>::change(const PendingEvent&, ChainState<2>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::change_mesh(const std::vector<PendingEvent>&, std::vector<EventRecord<2>>&, double) const;
template int BeamSystem<2>::relax_after(const std::vector<PendingEvent>&, ChainState<2>&, double, double) const;
template BeamPart BeamSystem<2>::part_around_joint() const;
template std::vector<EventRecord<2>> BeamSystem<2>::records_of(const std::vector<PendingEvent>&, const BeamPart&,
                                                               const Eigen::VectorXd&, double);
template EventReach BeamSystem<2>::reach_of(const std::vector<PendingEvent>&, const BeamPart&) const;
template void BeamSystem<2>::transfer_velocities(const EventRecord<2>&, const EventReach&,
                                                 const std::shared_ptr<Frames>&, Eigen::VectorXd&, double);
template bool BeamSystem<2>::has_free_joint() const;
template typename BeamSystem<2>::EventScope BeamSystem<2>::scope_of(const std::vector<PendingEvent>&) const;
template typename BeamSystem<2>::BeforeEvent BeamSystem<2>::look_before(const EventScope&, const Eigen::VectorXd&,
                                                                        double);
template void BeamSystem<2>::change_chain(const std::vector<PendingEvent>&, const EventScope&,
                                          std::vector<EventRecord<2>>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::change_velocities(const EventScope&, const BeforeEvent&, const std::shared_ptr<Frames>&,
                                               EventRecord<2>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::book_jumps(const EventScope&, const BeforeEvent&, EventRecord<2>&, const Eigen::VectorXd&,
                                        double);
template void BeamSystem<2>::tell(std::vector<EventRecord<2>>&) const;
template void BeamSystem<2>::handle_event(int, Eigen::VectorXd&, double);
template MergedWeights BeamSystem<3>::renew_weights(ChainState<3>&, std::size_t, double) const;
template double BeamSystem<3>::clear_of_end() const;
template void BeamSystem<3>::check_leaving(const PendingEvent&, double) const;
template void BeamSystem<3>::check_order(const Eigen::VectorXd&, double) const;
template MergedWeights BeamSystem<3>::change(const PendingEvent&, ChainState<3>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::change_mesh(const std::vector<PendingEvent>&, std::vector<EventRecord<3>>&, double) const;
template int BeamSystem<3>::relax_after(const std::vector<PendingEvent>&, ChainState<3>&, double, double) const;
template BeamPart BeamSystem<3>::part_around_joint() const;
template std::vector<EventRecord<3>> BeamSystem<3>::records_of(const std::vector<PendingEvent>&, const BeamPart&,
                                                               const Eigen::VectorXd&, double);
template EventReach BeamSystem<3>::reach_of(const std::vector<PendingEvent>&, const BeamPart&) const;
template void BeamSystem<3>::transfer_velocities(const EventRecord<3>&, const EventReach&,
                                                 const std::shared_ptr<Frames>&, Eigen::VectorXd&, double);
template bool BeamSystem<3>::has_free_joint() const;
template typename BeamSystem<3>::EventScope BeamSystem<3>::scope_of(const std::vector<PendingEvent>&) const;
template typename BeamSystem<3>::BeforeEvent BeamSystem<3>::look_before(const EventScope&, const Eigen::VectorXd&,
                                                                        double);
template void BeamSystem<3>::change_chain(const std::vector<PendingEvent>&, const EventScope&,
                                          std::vector<EventRecord<3>>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::change_velocities(const EventScope&, const BeforeEvent&, const std::shared_ptr<Frames>&,
                                               EventRecord<3>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::book_jumps(const EventScope&, const BeforeEvent&, EventRecord<3>&, const Eigen::VectorXd&,
                                        double);
template void BeamSystem<3>::tell(std::vector<EventRecord<3>>&) const;
template void BeamSystem<3>::handle_event(int, Eigen::VectorXd&, double);

}  // namespace vlbeam
