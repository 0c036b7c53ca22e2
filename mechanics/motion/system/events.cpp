// What an event makes of a beam and its state.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/motion/system/event_limits.hpp"

namespace vlbeam {
namespace {

constexpr double kept_energy = 1e-9;  // of the energies there are

}  // namespace

template <int D>
Guards BeamSystem<D>::guards(const Eigen::VectorXd& y, double t) const {
  Guards guards;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const std::size_t first = guards.size();
    sources_[i]->add_guards(y, t, guards);
    for (std::size_t k = first; k < guards.size(); ++k) guards[k].source = static_cast<int>(i);
  }
  return guards;
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
    records[i].joint = dues[i].joint;
    records[i].joint_position = dues[i].x;
    records[i].conserved = true;
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
  int reach = 0;
  for (const auto& source : sources_) reach = std::max(reach, source->reach());
  const int elements = mesh().elements() - part.before - part.behind;
  EventReach result{elements, 0};
  for (const PendingEvent& due : dues) {
    const int middle = due.node - part.before, to = std::max(reach, due.reach);
    result.lowest = std::min(result.lowest, std::max(0, middle - to));
    result.highest = std::max(result.highest, std::min(elements, middle + to));
  }
  return result;
}

template <int D>
bool BeamSystem<D>::has_free_joint() const {
  return Beam::held(0) == nullptr && !Beam::guides(0) && !Beam::ties(0) && !model().driven();
}

template <int D>
typename BeamSystem<D>::EventScope BeamSystem<D>::scope_of(const std::vector<PendingEvent>& dues) const {
  const LengthControl& control = model().length_control;
  const PendingEvent& due = dues.front();
  EventScope scope;
  scope.observes_all = due.observes_all || links_.holds_points() ||
                       std::ranges::any_of(sources_, [](const auto& source) { return source->observes_all(); });
  scope.transfers = due.remeshes && control.velocities != VelocityTransfer::nodal;
  scope.conserves = scope.transfers && control.velocities == VelocityTransfer::conservative;
  scope.always_transfers = due.always_transfers;
  scope.keeps_momenta = due.keeps_momenta;
  scope.changes_nodes_alone = (due.remeshes || due.goes_on) && !scope.observes_all;
  scope.goes_on = due.goes_on;
  scope.is_local = scope.changes_nodes_alone && places().size() == 1 && links_.all().empty() &&
                   mesh().elements() > control.most_whole && (!scope.conserves || (conservation_ && has_free_joint()));
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
    before.own.kinetic = conservation_->kinetic_energy(*this, mass_, scope.part, y, t);
  } else if (scope.observes_all || scope.conserves) {
    before.own = observe(y, t, own_points).energy;
  }
  before.momenta = velocities_.momenta(y, t, scope.part);
  before.work = dofs().balance.of(y).supports;
  return before;
}

template <int D>
void BeamSystem<D>::change_chain(EventSource<D>& source, const std::vector<PendingEvent>& dues, const EventScope& scope,
                                 std::vector<EventRecord<D>>& records, Eigen::VectorXd& y, double t) {
  EventRecord<D>& record = records.front();
  const auto merged = source.apply(dues, record.after, y, t);
  for (std::size_t i = 0; i < records.size(); ++i) records[i].merged = merged[i];
  for (const auto& other : sources_) other->complete(record.before, y, record.after);
  std::vector<Reshaped> where;
  for (const PendingEvent& due : dues) where.push_back(source.reshaped(due, record.after));
  for (const auto& other : sources_) {
    record.given_way += other->give_way(where, scope.reach, t, record.before, record.after);
  }
}

template <int D>
void BeamSystem<D>::change_velocities(const EventScope& scope, const BeforeEvent& before, EventRecord<D>& record,
                                      Eigen::VectorXd& y, double t) {
  if (scope.transfers) {
    const int more = record.after.mesh.elements() - record.before.mesh.elements();
    velocities_.project(record.before, record.after, scope.reach.lowest, scope.reach.highest + more, y, t);
    for (const auto& source : sources_) source->transfer(old_, y);
  } else if (scope.always_transfers) {
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
      conservation_->conserve(*this, mass_, scope.part, lacking, gained, y, t);
    } else {
      velocities_.conserve(before.momenta, gained, y, t);
    }
  }
  if (scope.transfers || scope.always_transfers) Beam::take_rates(y, record.after);
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
    record.conserved = std::abs(record.discrete_jump) <= kept_energy * size;
  }
  if (model().driven()) {  // what supports do in an impact is no jump
    const double work = dofs().balance.of(y).supports - before.work;
    record.jump.kinetic -= work;
    record.jump.supplied -= work;
    record.discrete_jump -= work;
  }
  if (scope.keeps_momenta) {
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
  const Guard guard = guards(y, t)[static_cast<std::size_t>(index)];
  EventSource<D>& source = *sources_[static_cast<std::size_t>(guard.source)];
  if (source.settles(guard, y)) return;
  const bool ramped = ramp_.due(model().gravity_ramp);
  if (ramped) ramp_.advance(t, moment(y, t));
  const std::vector<PendingEvent> dues = source.due(guard, y, t);
  const EventScope scope = scope_of(dues);
  std::vector<EventRecord<D>> records = records_of(dues, scope.part, y, t);
  EventRecord<D>& record = records.front();
  const BeforeEvent before = look_before(scope, y, t);
  change_chain(source, dues, scope, records, y, t);

  const std::vector<JointPlace> places_before = places();
  const DofMap<D> layout_before = dofs();
  for (const auto& other : sources_) other->keep();
  take(record.after);
  Beam::orient(t);
  if (scope.changes_nodes_alone) {
    Beam::write_nodes(record.after, y);
  } else {
    old_.swap(y);
    Beam::write_state(record.after, old_, y);
  }
  change_velocities(scope, before, record, y, t);
  if (links_.holds_points()) {
    come_back_to_links(y, t);
    record.after = Beam::chain(y, t);
  }
  book_jumps(scope, before, record, y, t);

  if (ramped) ramp_.restart(t, moment(y, t));
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  tell(records);
  if (scope.goes_on) accelerations_.last_event().remember({std::move(record.before), places_before, layout_before});
  spare_chain_ = std::move(record.after);
}

template Guards BeamSystem<2>::guards(const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::check_order(const Eigen::VectorXd&, double) const;
template BeamPart BeamSystem<2>::part_around_joint() const;
template std::vector<EventRecord<2>> BeamSystem<2>::records_of(const std::vector<PendingEvent>&, const BeamPart&,
                                                               const Eigen::VectorXd&, double);
template EventReach BeamSystem<2>::reach_of(const std::vector<PendingEvent>&, const BeamPart&) const;
template bool BeamSystem<2>::has_free_joint() const;
template typename BeamSystem<2>::EventScope BeamSystem<2>::scope_of(const std::vector<PendingEvent>&) const;
template typename BeamSystem<2>::BeforeEvent BeamSystem<2>::look_before(const EventScope&, const Eigen::VectorXd&,
                                                                        double);
template void BeamSystem<2>::change_chain(EventSource<2>&, const std::vector<PendingEvent>&, const EventScope&,
                                          std::vector<EventRecord<2>>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::change_velocities(const EventScope&, const BeforeEvent&, EventRecord<2>&, Eigen::VectorXd&,
                                               double);
template void BeamSystem<2>::book_jumps(const EventScope&, const BeforeEvent&, EventRecord<2>&, const Eigen::VectorXd&,
                                        double);
template void BeamSystem<2>::tell(std::vector<EventRecord<2>>&) const;
template void BeamSystem<2>::handle_event(int, Eigen::VectorXd&, double);
template Guards BeamSystem<3>::guards(const Eigen::VectorXd&, double) const;
template void BeamSystem<3>::check_order(const Eigen::VectorXd&, double) const;
template BeamPart BeamSystem<3>::part_around_joint() const;
template std::vector<EventRecord<3>> BeamSystem<3>::records_of(const std::vector<PendingEvent>&, const BeamPart&,
                                                               const Eigen::VectorXd&, double);
template EventReach BeamSystem<3>::reach_of(const std::vector<PendingEvent>&, const BeamPart&) const;
template bool BeamSystem<3>::has_free_joint() const;
template typename BeamSystem<3>::EventScope BeamSystem<3>::scope_of(const std::vector<PendingEvent>&) const;
template typename BeamSystem<3>::BeforeEvent BeamSystem<3>::look_before(const EventScope&, const Eigen::VectorXd&,
                                                                        double);
template void BeamSystem<3>::change_chain(EventSource<3>&, const std::vector<PendingEvent>&, const EventScope&,
                                          std::vector<EventRecord<3>>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::change_velocities(const EventScope&, const BeforeEvent&, EventRecord<3>&, Eigen::VectorXd&,
                                               double);
template void BeamSystem<3>::book_jumps(const EventScope&, const BeforeEvent&, EventRecord<3>&, const Eigen::VectorXd&,
                                        double);
template void BeamSystem<3>::tell(std::vector<EventRecord<3>>&) const;
template void BeamSystem<3>::handle_event(int, Eigen::VectorXd&, double);

}  // namespace vlbeam
