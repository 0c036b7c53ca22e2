// What can happen to a beam with a sliding mass, when it is due, and what it does to the state.
#include <algorithm>
#include <chrono>

#include "core/error.hpp"
#include "core/length_control/least_change.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {
namespace {

constexpr double smallest_weight = 1e-3;   // of the largest of the same element
constexpr double contact_distance = 1e-6;  // of L_std: the joint has run into a node that does not give way

/// How far the weights of an element are below the smallest share of each other that is allowed; positive is too far.
double lost_weight(const Weights<double>& w) {
  return smallest_weight - *std::min_element(w.begin(), w.end()) / *std::max_element(w.begin(), w.end());
}

}  // namespace

template <int D>
Guards BeamSystem<D>::guards(const Eigen::VectorXd& y, double /*t*/) const {
  Guards value;
  value.fill(-1);
  if (!has_joint()) return value;
  const auto& control = model_.length_control;
  const auto j = static_cast<std::size_t>(joint_);
  const double x = y[nodal_], unit = control.standard_length;
  const double behind = x - mesh_.x[j - 1], ahead = mesh_.x[j + 1] - x;
  const bool to_end = joint_ + 1 == mesh_.last(), to_start = joint_ == 1;
  if (control.enabled) {
    if (!to_end) value[0] = (behind - control.trigger_length()) / unit;
    if (!to_start) value[1] = (ahead - control.trigger_length()) / unit;
  }
  auto reach = [&](bool releases, bool at_last) {
    return releases && at_last ? model_.separation_distance / unit : contact_distance;
  };
  value[2] = reach(model_.end_releases, to_end) - ahead / unit;
  value[3] = reach(model_.start_releases, to_start) - behind / unit;
  if (model_.transport == WeightTransport::transported) {
    value[4] = std::max(lost_weight(mesh_.weights[j - 1].on(mesh_.x[j - 1], x)),
                        lost_weight(mesh_.weights[j].on(x, mesh_.x[j + 1])));
  }
  return value;
}

template <int D>
MergedWeights BeamSystem<D>::renew_weights(ChainState<D>& chain, double t) const {
  const ChainState<D> before = chain;
  MergedWeights renewed;
  for (const int k : {joint_ - 1, joint_}) {
    const auto i = static_cast<std::size_t>(k);
    const auto& x = chain.mesh.x;
    if (lost_weight(chain.mesh.weights[i].on(x[i], x[i + 1])) < -0.5 * smallest_weight) continue;
    renewed = least_change(chain, before, k, true, model_.strain_law, moving_law(t));
  }
  return renewed;
}

template <int D>
void BeamSystem<D>::handle_event(int index, Eigen::VectorXd& y, double t) {
  const auto started = std::chrono::steady_clock::now();
  impose(y, t);
  const Direction direction = index == 0 || index == 2 ? Direction::forward : Direction::backward;
  const EventType type = index == 4   ? EventType::reweighting
                         : index >= 2 ? EventType::separation
                                      : EventType::segment_merge;
  const bool leaving = type == EventType::separation;
  if (leaving) {
    const bool forward = direction == Direction::forward;
    const bool at_last = forward ? joint_ + 1 == mesh_.last() : joint_ == 1;
    if (!at_last)
      throw ComputationFailed("tangled mesh: the sliding mass ran into a node; switch length control on", t);
    if (!(forward ? model_.end_releases : model_.start_releases)) {
      throw ComputationFailed(
          std::string("the sliding mass ran into the support at the beam's ") + (forward ? "end" : "start"), t);
    }
  }
  EventRecord<D> record;
  record.t = t;
  record.type = type;
  record.before = chain(y);
  record.joint_position = y[nodal_];
  record.after = record.before;
  // an event changes the two elements on either side, or, where slopes change too, one more
  const bool reshapes = type == EventType::reweighting || model_.length_control.merge == MergePolicy::least_change;
  const int reach = reshapes ? 3 : 2;
  const int lowest = std::max(0, joint_ - reach), highest = std::min(mesh_.elements(), joint_ + reach);
  auto energies = [&](const ChainState<D>& state, int points) {
    Observation<D> seen;
    observe_elements(state, lowest, highest, t, points, seen);
    return seen.energy;
  };
  const bool transfers = !leaving && model_.length_control.velocities != VelocityTransfer::nodal;
  // a projection changes velocities everywhere
  const Energy before = transfers ? observe(y, t, ledger_points).energy : energies(record.before, ledger_points);
  const double own_before =
      (transfers ? observe(y, t, model_.quadrature_points).energy : energies(record.before, model_.quadrature_points))
          .total();

  const Eigen::VectorXd momenta_before = momenta(y, t);

  const Eigen::VectorXd old = y;
  switch (type) {
    case EventType::separation:
      separate(record.after, direction, model_.length_control, model_.transport);
      break;
    case EventType::segment_merge:
      record.merged =
          segment_and_merge(record.after, direction, model_.length_control, model_.strain_law, moving_law(t));
      break;
    case EventType::reweighting:
      record.merged = renew_weights(record.after, t);
      break;
  }
  const Eigen::Index joint_at = node_size<D> * joint_, old_coordinates = coordinates_;
  adopt(record.after);
  y = state_of(record.after, old);
  if (leaving) {
    y.segment<D>(nodal_) = old.segment<D>(joint_at);
    y.segment<D>(coordinates_ + nodal_) = old.segment<D>(old_coordinates + joint_at);
  }
  if (transfers) {
    project_velocities(record.before, lowest, highest, y, t);
    if (model_.length_control.velocities == VelocityTransfer::conservative) {
      restore(momenta_before, own_before, y, t);
    }
    record.after = this->chain(y);
    record.jump = observe(y, t, ledger_points).energy - before;
    record.discrete_jump = observe(y, t, model_.quadrature_points).energy.total() - own_before;
  } else {
    record.jump = energies(record.after, ledger_points) - before;
    record.discrete_jump = energies(record.after, model_.quadrature_points).total() - own_before;
  }
  if (!leaving) record.momentum_jump = momenta(y, t) - momenta_before;
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (on_event) on_event(record);
}

template Guards BeamSystem<2>::guards(const Eigen::VectorXd&, double) const;
template MergedWeights BeamSystem<2>::renew_weights(ChainState<2>&, double) const;
template void BeamSystem<2>::handle_event(int, Eigen::VectorXd&, double);
template Guards BeamSystem<3>::guards(const Eigen::VectorXd&, double) const;
template MergedWeights BeamSystem<3>::renew_weights(ChainState<3>&, double) const;
template void BeamSystem<3>::handle_event(int, Eigen::VectorXd&, double);

}  // namespace vlbeam
