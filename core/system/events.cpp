// What can happen to a beam with a sliding mass, when it is due, and what it does to the state.
#include <algorithm>
#include <chrono>

#include "core/error.hpp"
#include "core/length_control/least_change.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {
namespace {

constexpr double smallest_weight = 1e-3;   // of the largest of the same element
constexpr double restored_energy = 1e-9;   // of the energies there are
constexpr double contact_distance = 1e-6;  // of L_std: the joint has run into a node that does not give way
constexpr double clearance = 1e-11;        // of L_std: by which a mass leaves a support, so that the guard is negative
constexpr double least_bounce = 1e-9;      // of L_std: a lower one is the last

/// How far the weights of an element are below the smallest share of each other that is allowed; positive is too far.
double lost_weight(const Weights<double>& w) {
  return smallest_weight - *std::min_element(w.begin(), w.end()) / *std::max_element(w.begin(), w.end());
}

ComputationFailed ran_into_support(Direction direction, double t) {
  return {std::string("the sliding mass ran into the support at the beam's ") +
              (direction == Direction::forward ? "end" : "start"),
          t};
}

/// Places of the guard functions.
enum class Guard { forward, backward, end, start, weights, near_end, near_start, away, lift_off };

constexpr std::size_t at(Guard guard) { return static_cast<std::size_t>(guard); }
static_assert(at(Guard::lift_off) + 1 == max_guards);

}  // namespace

template <int D>
Guards BeamSystem<D>::guards(const Eigen::VectorXd& y, double t) const {
  if (rider_) return rider_guards(y, t);
  Guards value;
  value.fill(-1);
  if (!has_joint()) return value;
  const auto& control = model_.length_control;
  const auto j = static_cast<std::size_t>(joint_);
  const double x = y[nodal_], unit = control.standard_length;
  const double behind = x - mesh_.x[j - 1], ahead = mesh_.x[j + 1] - x;
  const bool to_end = joint_ + 1 == mesh_.last(), to_start = joint_ == 1;
  if (control.enabled) {
    if (!to_end) value[at(Guard::forward)] = (behind - control.trigger_length()) / unit;
    if (!to_start) value[at(Guard::backward)] = (ahead - control.trigger_length()) / unit;
  }
  auto reach = [&](bool releases, bool at_last) {
    return releases && at_last ? model_.separation_distance / unit : contact_distance;
  };
  value[at(Guard::end)] = reach(model_.end_releases, to_end) - ahead / unit;
  value[at(Guard::start)] = reach(model_.start_releases, to_start) - behind / unit;
  if (model_.transport == WeightTransport::transported) {
    value[at(Guard::weights)] = std::max(lost_weight(mesh_.weights[j - 1].on(mesh_.x[j - 1], x)),
                                         lost_weight(mesh_.weights[j].on(x, mesh_.x[j + 1])));
  }
  if (end_limit_[0] > 0) value[at(Guard::near_end)] = (end_limit_[0] - ahead) / unit;
  if (end_limit_[1] > 0) value[at(Guard::near_start)] = (end_limit_[1] - behind) / unit;
  return value;
}

template <int D>
Guards BeamSystem<D>::rider_guards(const Eigen::VectorXd& y, double t) const {
  Guards value;
  value.fill(-1);
  const bool at_end = rider_->at_end();
  const double unit = model_.length_control.standard_length;
  if (rider_->held) {
    const double stiffness = model_.section.stiffness.EA;
    value[at(Guard::lift_off)] = (at_end ? 1 : -1) * contact_force(y, t) / stiffness;
    return value;
  }
  const double distance = at_end ? rider_->end - y[nodal_] : y[nodal_] - rider_->end;
  const bool releases = at_end ? model_.end_releases : model_.start_releases;
  value[at(at_end ? Guard::end : Guard::start)] = ((releases ? model_.separation_distance : 0) - distance) / unit;
  value[at(Guard::away)] = (distance - cut_limit_) / unit;
  return value;
}

template <int D>
typename BeamSystem<D>::Due BeamSystem<D>::due(int guard) const {
  const auto which = static_cast<Guard>(guard);
  const bool backward =
      which == Guard::backward || which == Guard::start || which == Guard::near_start || (rider_ && !rider_->at_end());
  const Direction direction = backward ? Direction::backward : Direction::forward;
  switch (which) {
    case Guard::forward:
    case Guard::backward:
      return {EventType::segment_merge, direction};
    case Guard::weights:
      return {EventType::reweighting, direction};
    case Guard::near_end:
    case Guard::near_start:
      return {EventType::end_merge, direction};
    case Guard::away:
      return {EventType::end_cut, direction};
    case Guard::lift_off:
      return {EventType::lift_off, direction};
    case Guard::end:
    case Guard::start:
      break;
  }
  const bool releases = backward ? model_.start_releases : model_.end_releases;
  return {rider_ && !releases ? EventType::contact : EventType::separation, direction};
}

template <int D>
MergedWeights BeamSystem<D>::renew_weights(ChainState<D>& chain, double t) const {
  const ChainState<D> before = chain;
  MergedWeights renewed;
  for (const int k : {joint_ - 1, joint_}) {
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
  const Impact& impact = model_.at_support;
  const int outwards = rider_->at_end() ? 1 : -1;
  if (impact.law == AtSupport::stop) throw ran_into_support(outwards > 0 ? Direction::forward : Direction::backward, t);
  // a momentum J on x changes velocities by J M^-1 e_x
  const Eigen::Index x = coordinates_ + nodal_;
  Eigen::VectorXd answer = Eigen::VectorXd::Unit(coordinates_, nodal_), momentum(coordinates_);
  if (!solve_mass(nullptr, y.data(), answer.data())) throw ran_into_support(Direction::forward, t);
  multiply_mass(nullptr, y.data(), answer.data(), momentum.data());
  auto strike = [&](double restitution) {
    auto rate = y.segment(coordinates_, coordinates_);
    const double change = -(1 + restitution) * rate[nodal_] / answer[nodal_];
    model_.tallies().add({.supports = change * (momentum.dot(rate) - momentum[nodal_] * rate[nodal_])}, y);
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
  chain = this->chain(y);
  chain.rider->held = rests;
  chain.rider->x = rests ? rider_->end : clear_of_end();
  if (rests) chain.rider->rate = 0;
}

template <int D>
void BeamSystem<D>::handle_event(int index, Eigen::VectorXd& y, double t) {
  const auto started = std::chrono::steady_clock::now();
  impose(y, t);
  const bool ramped = ramp_.due(model_.gravity_ramp);
  if (ramped) ramp_.advance(t, moment(y, t));
  const auto [type, direction] = due(index);
  const bool leaving = type == EventType::separation;
  if (leaving && has_joint()) {
    const bool forward = direction == Direction::forward;
    const bool at_last = forward ? joint_ + 1 == mesh_.last() : joint_ == 1;
    if (!at_last)
      throw ComputationFailed("tangled mesh: the sliding mass ran into a node; switch length control on", t);
    if (!(forward ? model_.end_releases : model_.start_releases)) throw ran_into_support(direction, t);
  }
  EventRecord<D> record;
  record.t = t;
  record.type = type;
  record.before = chain(y);
  record.joint_position = y[nodal_];
  record.after = record.before;
  record.restored = true;
  // an event of the mesh changes the two elements on either side, or, where slopes change too, one more
  const bool reshapes = type == EventType::reweighting || model_.length_control.merge == MergePolicy::least_change;
  const int reach = reshapes ? 3 : 2;
  const int middle = rider_ ? rider_->element : joint_;
  const int lowest = std::max(0, middle - reach), highest = std::min(mesh_.elements(), middle + reach);
  auto energies = [&](const ChainState<D>& state, int points) {
    Observation<D> seen;
    observe_elements(state, lowest, highest, t, points, seen);
    return seen.energy;
  };
  const bool remeshes = type == EventType::segment_merge || type == EventType::reweighting ||
                        type == EventType::end_merge || type == EventType::end_cut;
  const bool transfers = remeshes && model_.length_control.velocities != VelocityTransfer::nodal;
  // a projection or an impact changes velocities everywhere, and a rider's is not a node's
  const bool everywhere = transfers || type == EventType::contact || type == EventType::end_merge || rider_;
  const Energy before = everywhere ? observe(y, t, ledger_points).energy : energies(record.before, ledger_points);
  const double own_before =
      (everywhere ? observe(y, t, model_.quadrature_points).energy : energies(record.before, model_.quadrature_points))
          .total();

  const Eigen::VectorXd momenta_before = momenta(y, t);
  const double work_before = model_.tallies().of(y).supports;

  const auto mass = mass_motion(y);
  switch (type) {
    case EventType::separation:
      if (rider_) {
        record.after.rider.reset();
      } else {
        separate(record.after, direction, model_.length_control, model_.transport);
      }
      break;
    case EventType::segment_merge:
      record.merged = segment_and_merge(record.after, direction, model_.length_control, moving_law(t));
      break;
    case EventType::reweighting:
      record.merged = renew_weights(record.after, t);
      break;
    case EventType::end_merge:
      record.merged = merge_at_end(record.after, direction, model_.length_control, moving_law(t));
      break;
    case EventType::end_cut: {
      const auto rest = model_.rest ? model_.rest->derivatives(record.after.rider->x) : std::array<Vector, 4>{};
      record.merged = cut_at_end(record.after, model_.length_control, moving_law(t), model_.rest ? &rest : nullptr);
      if (model_.joint->kinked()) {
        record.after.kink = {slope<D>(record.after.q.data(), record.after.joint),
                             slope<D>(record.after.rate.data(), record.after.joint)};
      }
      break;
    }
    case EventType::contact:
      hit(record.after, y, t);
      break;
    case EventType::lift_off:
      record.after.rider->held = false;
      record.after.rider->x = clear_of_end();
      break;
  }
  const Eigen::VectorXd old = y;
  adopt(record.after);
  y = state_of(record.after, old);
  if (free_mass_ && leaving) {
    y.segment<D>(nodal_) = mass->r;
    y.segment<D>(coordinates_ + nodal_) = mass->v;
  }
  if (transfers) {
    project_velocities(record.before, lowest, highest, y, t);
    if (model_.length_control.velocities == VelocityTransfer::conservative) {
      restore(momenta_before, own_before, y, t);
    }
    record.after = this->chain(y);
    record.jump = observe(y, t, ledger_points).energy - before;
    record.discrete_jump = observe(y, t, model_.quadrature_points).energy.total() - own_before;
    if (model_.length_control.velocities == VelocityTransfer::conservative) {
      const double size = std::abs(before.kinetic) + before.axial + before.bending + std::abs(before.gravity);
      record.restored = std::abs(record.discrete_jump) <= restored_energy * size;
    }
  } else if (everywhere) {
    if (type == EventType::end_merge) {  // nodes keep their velocities, the mass keeps its momentum
      project_velocities(record.before, lowest, lowest, y, t);
      record.after = this->chain(y);
    }
    record.jump = observe(y, t, ledger_points).energy - before;
    record.discrete_jump = observe(y, t, model_.quadrature_points).energy.total() - own_before;
  } else {
    record.jump = energies(record.after, ledger_points) - before;
    record.discrete_jump = energies(record.after, model_.quadrature_points).total() - own_before;
  }
  if (model_.driven()) {  // what supports do in an impact is no jump
    const double work = model_.tallies().of(y).supports - work_before;
    record.jump.kinetic -= work;
    record.jump.supplied -= work;
    record.discrete_jump -= work;
  }
  if (!leaving) record.momentum_jump = momenta(y, t) - momenta_before;
  if (ramped) ramp_.restart(t, moment(y, t));
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (on_event) on_event(record);
}

template Guards BeamSystem<2>::guards(const Eigen::VectorXd&, double) const;
template Guards BeamSystem<2>::rider_guards(const Eigen::VectorXd&, double) const;
template BeamSystem<2>::Due BeamSystem<2>::due(int) const;
template double BeamSystem<2>::clear_of_end() const;
template MergedWeights BeamSystem<2>::renew_weights(ChainState<2>&, double) const;
template void BeamSystem<2>::hit(ChainState<2>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::handle_event(int, Eigen::VectorXd&, double);
template Guards BeamSystem<3>::guards(const Eigen::VectorXd&, double) const;
template Guards BeamSystem<3>::rider_guards(const Eigen::VectorXd&, double) const;
template BeamSystem<3>::Due BeamSystem<3>::due(int) const;
template double BeamSystem<3>::clear_of_end() const;
template MergedWeights BeamSystem<3>::renew_weights(ChainState<3>&, double) const;
template void BeamSystem<3>::hit(ChainState<3>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::handle_event(int, Eigen::VectorXd&, double);

}  // namespace vlbeam
