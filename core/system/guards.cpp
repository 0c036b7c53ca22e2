// When something is due that changes a beam's mesh or how it moves, and what it is.
#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/system/beam_system.hpp"
#include "core/system/event_limits.hpp"

namespace vlbeam {
namespace {

using namespace event_limits;

constexpr double contact_distance = 1e-6;  // of L_std: the joint has run into a node that does not give way
constexpr double least_left = 0.1;         // of L_std: an element of a feed that cannot be merged; all_due() says so

/// Guards of one joint, or of the mass that rides.
enum class Kind {
  forward,
  backward,
  end,
  start,
  weights,
  near_end,
  near_start,
  away,
  lift_off,
  merge_ahead,
  merge_behind,
  meeting,
  contact,
  used_up,
  pass_forward,
  pass_backward,
  turned_away
};

constexpr int number(Kind kind) { return static_cast<int>(kind); }

EventType type_of(const Remeshing& what) {
  return what.cut && what.merge ? EventType::segment_merge : what.cut ? EventType::segmentation : EventType::merging;
}

}  // namespace

template <int D>
Guards BeamSystem<D>::guards(const Eigen::VectorXd& y, double t) const {
  if (moving_) return travel_guards(t);
  Guards guards;
  const auto add_turned_away = [&] {
    if (frames_) guards.push_back({number(Kind::turned_away), 0, frames_->turned_away(y.data())});
  };
  if (rider_) {
    guards = rider_guards(y, t);
    add_turned_away();
    return guards;
  }
  const auto& control = model_.length_control;
  const double unit = control.standard_length;
  const bool several = places_.size() > 1;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const int part = static_cast<int>(i), node = places_[i].node;
    const auto add = [&](Kind kind, double value) { guards.push_back({number(kind), part, value}); };
    if (feeds(i)) {
      add_feed_guards(i, y, t, guards);
      continue;
    }
    const bool to_end = node + 1 == mesh_.last(), to_start = node == 1;
    const bool joint_ahead = at_joint(node + 1), joint_behind = at_joint(node - 1);
    const double x = mark_at(i, y, t);
    const double low = joint_behind ? mark_at(i - 1, y, t) : mark_of(node - 1, y.data());
    const double high = joint_ahead ? mark_at(i + 1, y, t) : mark_of(node + 1, y.data());
    const double behind = x - low, ahead = high - x;
    if (control.enabled) {
      if (!to_end) add(Kind::forward, (behind - control.trigger_length()) / unit);
      if (!to_start) add(Kind::backward, (ahead - control.trigger_length()) / unit);
    }
    auto reach = [&](bool releases, bool at_last) {
      return releases && at_last ? joint(i).separation_distance / unit : contact_distance;
    };
    if (!joint_ahead) add(Kind::end, reach(model_.end_releases, to_end) - ahead / unit);
    if (!joint_behind) add(Kind::start, reach(model_.start_releases, to_start) - behind / unit);
    if (joint_ahead && (model_.at_meeting.law == AtSupport::stop || feeds(i + 1))) {
      add(Kind::meeting, model_.contact_distance - ahead / unit);
    }
    if (model_.transport == WeightTransport::transported) {
      const auto j = static_cast<std::size_t>(node);
      add(Kind::weights,
          std::max(lost_weight(mesh_.weights[j - 1].on(low, x)), lost_weight(mesh_.weights[j].on(x, high))));
    }
    if (!several && end_limit_[0] > 0) add(Kind::near_end, (end_limit_[0] - ahead) / unit);
    if (!several && end_limit_[1] > 0) add(Kind::near_start, (end_limit_[1] - behind) / unit);
    const auto& masses = model_.masses.points;
    const auto passed = static_cast<std::size_t>(places_[i].passed);
    if (passed < masses.size()) add(Kind::pass_forward, (x - masses[passed].x) / unit);
    if (passed > 0) add(Kind::pass_backward, (masses[passed - 1].x - x) / unit);
    if (control.enabled && control.lower > 0) {
      const double least = control.merge_length() * (1 - merge_slack);
      if (!to_end && !joint_ahead) add(Kind::merge_ahead, (least - ahead) / unit);
      if (!to_start && !joint_behind) add(Kind::merge_behind, (least - behind) / unit);
    }
  }
  const std::vector<Contact> contacts = this->contacts();
  Eigen::VectorXd forces;
  if (!resting_.empty()) forces = forces_of_links(y, t);
  auto rests = static_cast<Eigen::Index>(links_.size() - resting_.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const int part = static_cast<int>(i);
    if (contacts[i].rests) {
      guards.push_back({number(Kind::lift_off), part, -forces[rests++] / model_.section.stiffness.EA});
      continue;
    }
    const Gap gap = this->gap(contacts[i], y);
    const double value = (contacts[i].distance - gap.distance) / unit;  // what parts is clear of each other
    guards.push_back({number(Kind::contact), part, gap.rate > 0 ? value - clearance : value});
  }
  add_turned_away();
  return guards;
}

template <int D>
bool BeamSystem<D>::turns_away(int index, const Eigen::VectorXd& y, double t) const {
  return frames_ && static_cast<Kind>(guards(y, t)[static_cast<std::size_t>(index)].kind) == Kind::turned_away;
}

template <int D>
void BeamSystem<D>::add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const auto& control = model_.length_control;
  const bool at_start = places_[which].node == 0;
  const int next = at_start ? 1 : mesh_.last() - 1;
  const bool joint_next = at_joint(next);
  const double x = mark_at(which, y, t);
  const double x_next = joint_next ? mark_at(at_start ? which + 1 : which - 1, y, t) : mark_of(next, y.data());
  const double unit = control.standard_length, length = at_start ? x_next - x : x - x_next;
  const auto add = [&](Kind kind, double value) { guards.push_back({number(kind), static_cast<int>(which), value}); };
  if (control.enabled) add(at_start ? Kind::backward : Kind::forward, (length - control.trigger_length()) / unit);
  if (model_.transport == WeightTransport::transported) {
    const WeightFunction& weights = mesh_.weights[at_start ? 0 : mesh_.weights.size() - 1];
    add(Kind::weights, lost_weight(at_start ? weights.on(x, x_next) : weights.on(x_next, x)));
  }
  if (joint_next) {
    if (at_start) add(Kind::meeting, model_.contact_distance - length / unit);
  } else if (next != 0 && next != mesh_.last() && control.enabled) {
    add(at_start ? Kind::merge_ahead : Kind::merge_behind,
        (control.merge_length() * (1 - merge_slack) - length) / unit);
  } else {
    add(Kind::used_up, least_left - length / unit);
  }
}

template <int D>
void BeamSystem<D>::joints_met(std::size_t which, double t) const {
  const auto name = [&](std::size_t i) {
    if (feeds(i)) return std::string("the feed at the beam's ") + (places_[i].node == 0 ? "start" : "end");
    return "the sliding joint " + std::to_string(index_[i]);
  };
  const bool feed = feeds(which) || feeds(which + 1);
  const std::string met =
      feed ? name(which) + " and " + name(which + 1)
           : "the sliding joints " + std::to_string(index_[which]) + " and " + std::to_string(index_[which + 1]);
  std::ostringstream share;
  share << model_.contact_distance;
  throw ComputationFailed(met + " met: they are as near each other as " + share.str() + " standard elements", t);
}

template <int D>
Guards BeamSystem<D>::rider_guards(const Eigen::VectorXd& y, double t) const {
  const bool at_end = rider_->at_end();
  const double unit = model_.length_control.standard_length;
  if (rider_->held) {
    const double stiffness = model_.section.stiffness.EA;
    return {{number(Kind::lift_off), 0, (at_end ? 1 : -1) * contact_force(y, t) / stiffness}};
  }
  const double distance = at_end ? rider_->end - y[layout_.mark()] : y[layout_.mark()] - rider_->end;
  const bool releases = at_end ? model_.end_releases : model_.start_releases;
  const double least = releases ? model_.joints.front().separation_distance : 0;
  return {{number(at_end ? Kind::end : Kind::start), 0, (least - distance) / unit},
          {number(Kind::away), 0, (distance - cut_limit_) / unit}};
}

template <int D>
Remeshing BeamSystem<D>::wanted(std::size_t which, Direction direction, const Eigen::VectorXd& y) const {
  const auto& control = model_.length_control;
  if (control.lower == 0) return {};  // the event of the paper: both
  const bool forward = direction == Direction::forward;
  const int node = places_[which].node, far = forward ? node - 1 : node + 1, next = forward ? node + 1 : node - 1;
  const double x = y[places_[which].mark];
  const auto reach = [&](int to) { return std::abs(mark_of(to, y.data()) - x); };
  const bool may_cut = far >= 0 && far <= mesh_.last(), may_merge = next > 0 && next < mesh_.last() && !at_joint(next);
  return {may_cut && reach(far) > control.trigger_length() - same_instant * control.standard_length,
          may_merge && reach(next) < control.merge_length() * (1 + merge_slack)};
}

template <int D>
typename BeamSystem<D>::PendingEvent BeamSystem<D>::due(const Guard& guard, const Eigen::VectorXd& y) const {
  const auto kind = static_cast<Kind>(guard.kind);
  const auto which = static_cast<std::size_t>(guard.part);
  const bool backward = kind == Kind::backward || kind == Kind::start || kind == Kind::near_start ||
                        kind == Kind::merge_behind || kind == Kind::pass_backward || (rider_ && !rider_->at_end());
  const Direction direction = backward ? Direction::backward : Direction::forward;
  switch (kind) {
    case Kind::forward:
    case Kind::backward:
    case Kind::merge_ahead:
    case Kind::merge_behind: {
      const Remeshing what = wanted(which, direction, y);
      return {type_of(what), direction, which, what};
    }
    case Kind::weights:
      return {EventType::reweighting, direction, which, {}};
    case Kind::near_end:
    case Kind::near_start:
      return {EventType::end_merge, direction, which, {}};
    case Kind::away:
      return {EventType::end_cut, direction, which, {}};
    case Kind::lift_off: {
      if (rider_) return {EventType::lift_off, direction, which, {}};
      const Contact contact = contacts()[which];
      const Direction to = contact.support < 0 ? Direction::backward : Direction::forward;
      return {EventType::lift_off, to, contact.which, {}};
    }
    case Kind::contact:
      return {EventType::contact, direction, contacts()[which].which, {}};
    case Kind::pass_forward:
    case Kind::pass_backward:
      return {EventType::passage, direction, which, {}};
    case Kind::meeting:
    case Kind::used_up:
    case Kind::turned_away:
    case Kind::end:
    case Kind::start:
      break;
  }
  const bool releases = backward ? model_.start_releases : model_.end_releases;
  return {rider_ && !releases ? EventType::contact : EventType::separation, direction, which, {}};
}

template <int D>
std::vector<typename BeamSystem<D>::PendingEvent> BeamSystem<D>::all_due(int index, const Eigen::VectorXd& y,
                                                                         double t) const {
  const Guards now = guards(y, t);
  const Guard& first = now[static_cast<std::size_t>(index)];
  if (static_cast<Kind>(first.kind) == Kind::meeting) joints_met(static_cast<std::size_t>(first.part), t);
  if (static_cast<Kind>(first.kind) == Kind::used_up) {
    const bool at_start = places_[static_cast<std::size_t>(first.part)].node == 0;
    throw ComputationFailed(std::string("the feed at the beam's ") + (at_start ? "start" : "end") +
                                " has drawn in what there was: its element is shorter than a tenth of a standard one, "
                                "and " +
                                (model_.length_control.enabled ? "there is no other to merge it with"
                                                               : "without length control it is not merged"),
                            t);
  }
  const auto remeshes = [](int kind) {
    const auto of = static_cast<Kind>(kind);
    return of == Kind::forward || of == Kind::backward || of == Kind::merge_ahead || of == Kind::merge_behind;
  };
  std::vector<PendingEvent> result{due(first, y)};
  if (places_.size() < 2 || !remeshes(first.kind)) return result;
  for (const Guard& guard : now) {
    const auto which = static_cast<std::size_t>(guard.part);
    if (!remeshes(guard.kind) || guard.value < -same_instant) continue;
    if (std::any_of(result.begin(), result.end(), [&](const PendingEvent& other) { return other.which == which; }))
      continue;
    result.push_back(due(guard, y));
  }
  drop_doubles(result);
  return result;
}

template <int D>
void BeamSystem<D>::drop_doubles(std::vector<PendingEvent>& dues) const {
  const auto cut_of = [&](const PendingEvent& due) {
    const int node = places_[due.which].node;
    return due.direction == Direction::forward ? node - 1 : node;
  };
  const auto deleted_by = [&](const PendingEvent& due) {
    const int node = places_[due.which].node;
    return due.direction == Direction::forward ? node + 1 : node - 1;
  };
  for (auto due = dues.begin(); due != dues.end(); ++due) {
    for (auto other = dues.begin(); other != due; ++other) {
      if (other->remeshing.cut && cut_of(*other) == cut_of(*due)) due->remeshing.cut = false;
      if (other->remeshing.merge && deleted_by(*other) == deleted_by(*due)) due->remeshing.merge = false;
    }
    due->type = type_of(due->remeshing);
  }
  const auto nothing_left = [](const PendingEvent& due) { return !due.remeshing.cut && !due.remeshing.merge; };
  dues.erase(std::remove_if(dues.begin() + 1, dues.end(), nothing_left), dues.end());
}

template Guards BeamSystem<2>::guards(const Eigen::VectorXd&, double) const;
template bool BeamSystem<2>::turns_away(int, const Eigen::VectorXd&, double) const;
template bool BeamSystem<3>::turns_away(int, const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::add_feed_guards(std::size_t, const Eigen::VectorXd&, double, Guards&) const;
template void BeamSystem<2>::joints_met(std::size_t, double) const;
template Guards BeamSystem<2>::rider_guards(const Eigen::VectorXd&, double) const;
template Remeshing BeamSystem<2>::wanted(std::size_t, Direction, const Eigen::VectorXd&) const;
template BeamSystem<2>::PendingEvent BeamSystem<2>::due(const Guard&, const Eigen::VectorXd&) const;
template std::vector<BeamSystem<2>::PendingEvent> BeamSystem<2>::all_due(int, const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::drop_doubles(std::vector<PendingEvent>&) const;
template Guards BeamSystem<3>::guards(const Eigen::VectorXd&, double) const;
template void BeamSystem<3>::add_feed_guards(std::size_t, const Eigen::VectorXd&, double, Guards&) const;
template void BeamSystem<3>::joints_met(std::size_t, double) const;
template Guards BeamSystem<3>::rider_guards(const Eigen::VectorXd&, double) const;
template Remeshing BeamSystem<3>::wanted(std::size_t, Direction, const Eigen::VectorXd&) const;
template BeamSystem<3>::PendingEvent BeamSystem<3>::due(const Guard&, const Eigen::VectorXd&) const;
template std::vector<BeamSystem<3>::PendingEvent> BeamSystem<3>::all_due(int, const Eigen::VectorXd&, double) const;
template void BeamSystem<3>::drop_doubles(std::vector<PendingEvent>&) const;

}  // namespace vlbeam
