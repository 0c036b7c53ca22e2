#include "mechanics/ride/ride_events.hpp"

#include <algorithm>
#include <limits>

#include "mechanics/contact/contact_room.hpp"
#include "mechanics/motion/system/event_limits.hpp"
#include "mechanics/motion/system/joint_limits.hpp"
#include "mechanics/motion/system/joint_neighbours.hpp"
#include "mechanics/ride/riding_mass.hpp"

namespace vlbeam {

using namespace event_limits;

template <int D>
void RideEvents<D>::adopt() {
  const LengthControl& control = beam_.model().length_control;
  end_limit_ = {0, 0};
  cut_limit_ = std::numeric_limits<double>::infinity();
  if (!control.enabled || control.end_merge == 0) return;
  if (const auto* rider = rider_of(beam_)) {
    cut_limit_ = control.end_cut() * std::min(control.standard_length, rider->curve().length);
  }
  if (!beam_.has_joint()) return;
  const int node = beam_.places().front().node;
  const auto j = static_cast<std::size_t>(node);
  const double unit = std::min(control.standard_length, (beam_.mesh().x[j + 1] - beam_.mesh().x[j - 1]) / 2);
  const auto limit = [&](double length) {  // an element that is shorter from the start has to halve first
    const double due = control.end_merge * unit;
    return length > due ? due : length / 2;
  };
  if (node + 1 == beam_.mesh().last()) end_limit_[0] = limit(beam_.mesh().x[j + 1] - beam_.mesh().x[j]);
  if (node == 1) end_limit_[1] = limit(beam_.mesh().x[j] - beam_.mesh().x[j - 1]);
}

template <int D>
void RideEvents<D>::add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  if (beam_.loose() != nullptr) {
    add_rider_guards(y, t, guards);
  } else if (beam_.places().size() == 1) {
    add_joint_guards(y, t, guards);
  }
}

template <int D>
void RideEvents<D>::add_joint_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  if (end_limit_[0] == 0 && end_limit_[1] == 0) return;
  const double unit = beam_.model().length_control.standard_length, known = rounding_of(beam_.mesh()) / unit;
  const JointNeighbours<D> at(beam_, 0, y, t);
  if (end_limit_[0] > 0) guards.push_back({near_end, 0, (end_limit_[0] - at.ahead) / unit, known});
  if (end_limit_[1] > 0) guards.push_back({near_start, 0, (end_limit_[1] - at.behind) / unit, known});
}

template <int D>
void RideEvents<D>::add_rider_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  const RidingMass<D>& rider = *rider_of(beam_);
  const bool at_end = rider.at_end();
  const double unit = beam_.model().length_control.standard_length;
  if (rider.held()) {
    const double stiffness = beam_.model().section.stiffness.EA;
    guards.push_back({lifts_off, 0, (at_end ? 1 : -1) * accelerations_.contact_force(y, t) / stiffness});
    return;
  }
  const double x = y[beam_.dofs().mark()], rate = y[beam_.coordinates() + beam_.dofs().mark()];
  const double distance = at_end ? rider.end() - x : x - rider.end();
  const bool releases = at_end ? beam_.model().end_releases : beam_.model().start_releases;
  const double least = releases ? beam_.model().joints.front().separation_distance : 0;
  const double known = rounding_of(beam_.mesh()) / unit;
  guards.push_back({reaches_end, 0, (least - distance) / unit, known, (at_end ? rate : -rate) / unit});
  guards.push_back({away, 0, (distance - cut_limit_) / unit, known});
}

template <int D>
std::vector<PendingEvent> RideEvents<D>::due(const Guard& first, const Eigen::VectorXd& y, double /*t*/) const {
  const auto* rider = rider_of(beam_);
  PendingEvent due{.type = EventType::end_merge, .joint = rider != nullptr ? 0 : beam_.joint_index(0)};
  due.node = rider != nullptr ? rider->element() : beam_.places().front().node;
  due.x = y[rider != nullptr ? beam_.dofs().mark() : beam_.places().front().mark];
  if (first.kind == near_start || (rider != nullptr && !rider->at_end())) due.direction = Direction::backward;
  switch (first.kind) {
    case near_end:
    case near_start:
      due.remeshes = due.always_transfers = due.observes_all = true;
      break;
    case away:
      due.type = EventType::end_cut;
      due.remeshes = true;
      break;
    case lifts_off:
      due.type = EventType::lift_off;
      break;
    default: {
      const bool releases = rider->at_end() ? beam_.model().end_releases : beam_.model().start_releases;
      due.type = releases ? EventType::separation : EventType::contact;
      due.observes_all = !releases;
      due.keeps_momenta = !releases;
    }
  }
  return {due};
}

template <int D>
double RideEvents<D>::clear_of_end() const {
  const RidingMass<D>& rider = *rider_of(beam_);
  return rider.end() + (rider.at_end() ? -1 : 1) * clearance * beam_.model().length_control.standard_length;
}

template <int D>
std::vector<MergedWeights> RideEvents<D>::apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain,
                                                Eigen::VectorXd& y, double t) {
  const PendingEvent& due = dues.front();
  const LengthControl& control = beam_.model().length_control;
  switch (due.type) {
    case EventType::end_merge:
      return {merge_at_end(chain, due.direction, control, beam_.moving_law(t))};
    case EventType::end_cut: {
      const MergedWeights merged = cut_at_end(chain, control, beam_.moving_law(t));
      if (beam_.model().joints.front().law.kinked()) {
        auto& node = chain.joints.front();
        node.kink = {slope<D>(chain.q.data(), node.node), slope<D>(chain.rate.data(), node.node)};
      }
      return {merged};
    }
    case EventType::separation:
      chain.loose.reset();
      let_go(beam_, due.joint, y, chain);
      break;
    case EventType::contact: {
      const bool rests = hit(y, t);
      chain = beam_.chain(y, t);
      chain.loose->held = rests;
      chain.loose->x = rests ? rider_of(beam_)->end() : clear_of_end();
      if (rests) chain.loose->rate = 0;
      break;
    }
    default:
      chain.loose->held = false;
      chain.loose->x = clear_of_end();
  }
  return {{}};
}

template <int D>
Reshaped RideEvents<D>::reshaped(const PendingEvent& due, const ChainState<D>& after) const {
  const bool forward = due.direction == Direction::forward;
  if (due.type == EventType::end_merge) {
    const int element = after.loose->element;
    return {forward ? element : element + 1, element};
  }
  if (due.type != EventType::end_cut) return {};
  const int node = after.joints.front().node;
  return {-1, forward ? node - 1 : node};
}

template <int D>
bool RideEvents<D>::hit(Eigen::VectorXd& y, double t) {
  const Impact impact = impact_at_support(beam_.model(), 0);
  const int outwards = rider_of(beam_)->at_end() ? 1 : -1;
  if (impact.law == AtSupport::stop) {
    throw ran_into_support(false, outwards > 0 ? Direction::forward : Direction::backward, t);
  }
  // a momentum J on x changes velocities by J M^-1 e_x
  const Eigen::Index count = beam_.coordinates(), mark = beam_.dofs().mark(), x = count + mark;
  Eigen::VectorXd answer = Eigen::VectorXd::Unit(count, mark), momentum(count);
  if (!mass_.solve({}, y.data(), answer.data())) throw ran_into_support(false, Direction::forward, t);
  mass_.multiply({}, y.data(), answer.data(), momentum.data());
  auto strike = [&](double restitution) {
    auto rate = y.segment(count, count);
    const double change = -(1 + restitution) * rate[mark] / answer[mark];
    beam_.dofs().balance.add({.supports = change * (momentum.dot(rate) - momentum[mark] * rate[mark])}, y);
    rate += change * answer;
  };
  bool rests = impact.law == AtSupport::rest || impact.restitution == 0;
  if (!rests) {
    strike(impact.restitution);
    Eigen::VectorXd rates(y.size());
    accelerations_.rates(y, rates, t);
    const double falls = outwards * rates[x];
    rests = falls > 0 && y[x] * y[x] < 2 * falls * least_bounce * beam_.model().length_control.standard_length;
  }
  if (rests) strike(0);
  return rests;
}

template class RideEvents<2>;
template class RideEvents<3>;

}  // namespace vlbeam
