#include "mechanics/motion/system/event_guards.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "mechanics/motion/system/event_limits.hpp"

namespace vlbeam {
namespace {

using namespace event_limits;

constexpr double contact_distance = 1e-6;  // of L_std: the joint has run into a node that does not give way
constexpr double least_left = 0.1;         // of L_std: an element of a feed that cannot be merged; used_up() says so

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

/// Guards of a mesh all of whose nodes travel.
enum TravelGuard { nodes_tangle, weight_is_lost };

constexpr int number(Kind kind) { return static_cast<int>(kind); }

/// Of material coordinates [m].
double rounding_of(const Mesh& mesh) {
  return 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(mesh.x.front()), std::abs(mesh.x.back()));
}

EventType type_of(const Remeshing& what) {
  return what.cut && what.merge ? EventType::segment_merge : what.cut ? EventType::segmentation : EventType::merging;
}

}  // namespace

template <int D>
void EventGuards<D>::adopt() {
  const auto& control = beam_.model().length_control;
  end_limit_ = {0, 0};
  cut_limit_ = std::numeric_limits<double>::infinity();
  if (!control.enabled || control.end_merge == 0) return;
  if (beam_.rider()) cut_limit_ = control.end_cut() * std::min(control.standard_length, beam_.rider()->curve.length);
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
Guards EventGuards<D>::at(const Eigen::VectorXd& y, double t) const {
  if (beam_.moving_mesh()) return travel_guards(t);
  Guards guards;
  if (beam_.rider()) {
    guards = rider_guards(y, t);
  } else {
    for (std::size_t i = 0; i < beam_.places().size(); ++i) {
      if (beam_.feeds(i)) {
        add_feed_guards(i, y, t, guards);
      } else {
        add_joint_guards(i, y, t, guards);
      }
    }
    add_contact_guards(y, t, guards);
  }
  if (beam_.frames()) guards.push_back({number(Kind::turned_away), 0, beam_.frames()->turned_away(y.data())});
  return guards;
}

template <int D>
void EventGuards<D>::add_joint_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const BeamModel<D>& model = beam_.model();
  const Mesh& mesh = beam_.mesh();
  const LengthControl& control = model.length_control;
  const double unit = control.standard_length;
  const bool several = beam_.places().size() > 1;
  const int node = beam_.places()[which].node;
  const auto add = [&](Kind kind, double value) {
    guards.push_back({number(kind), static_cast<int>(which), value, rounding_of(beam_.mesh()) / unit});
  };
  const bool to_end = node + 1 == mesh.last(), to_start = node == 1;
  const bool joint_ahead = beam_.at_joint(node + 1), joint_behind = beam_.at_joint(node - 1);
  using Mark = typename CurrentBeam<D>::MarkMotion;
  const auto neighbour = [&](bool is_joint, std::size_t joint, int at) {
    return is_joint ? beam_.mark_motion(joint, y, t) : Mark{beam_.mark_of(at, y.data()), 0};
  };
  const auto [x, rate] = beam_.mark_motion(which, y, t);
  const auto [low, low_rate] = neighbour(joint_behind, which - 1, node - 1);
  const auto [high, high_rate] = neighbour(joint_ahead, which + 1, node + 1);
  const double behind = x - low, ahead = high - x;
  if (control.enabled) {
    if (!to_end) add(Kind::forward, (behind - control.trigger_length()) / unit);
    if (!to_start) add(Kind::backward, (ahead - control.trigger_length()) / unit);
  }
  auto reach = [&](bool releases, bool at_last) {
    return releases && at_last ? beam_.joint(which).separation_distance / unit : contact_distance;
  };
  if (!joint_ahead) {
    add(Kind::end, reach(model.end_releases, to_end) - ahead / unit);
    guards.back().rate = rate / unit;
    if (several && !(to_end && model.end_releases)) guards.back().room = contact_distance / 2;  // no step over a node
  }
  if (!joint_behind) {
    add(Kind::start, reach(model.start_releases, to_start) - behind / unit);
    guards.back().rate = -rate / unit;
    if (several && !(to_start && model.start_releases)) guards.back().room = contact_distance / 2;
  }
  if (joint_ahead && (model.at_meeting.law == AtSupport::stop || beam_.feeds(which + 1))) {
    add(Kind::meeting, model.contact_distance - ahead / unit);
    guards.back().rate = (rate - high_rate) / unit;
    guards.back().room = model.contact_distance / 2;
  }
  if (model.transport == WeightTransport::transported) {
    const auto j = static_cast<std::size_t>(node);
    add(Kind::weights, std::max(lost_weight(mesh.weights[j - 1].on(low, x)), lost_weight(mesh.weights[j].on(x, high))));
  }
  if (!several && end_limit_[0] > 0) add(Kind::near_end, (end_limit_[0] - ahead) / unit);
  if (!several && end_limit_[1] > 0) add(Kind::near_start, (end_limit_[1] - behind) / unit);
  const auto& masses = model.masses.points;
  const auto passed = static_cast<std::size_t>(beam_.places()[which].passed);
  if (passed < masses.size()) add(Kind::pass_forward, (x - masses[passed].x) / unit);
  if (passed > 0) add(Kind::pass_backward, (masses[passed - 1].x - x) / unit);
  if (control.enabled && control.lower > 0) {
    const double least = control.merge_length() * (1 - merge_margin);
    if (!to_end && !joint_ahead) add(Kind::merge_ahead, (least - ahead) / unit);
    if (!to_start && !joint_behind) add(Kind::merge_behind, (least - behind) / unit);
  }
}

template <int D>
void EventGuards<D>::add_contact_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  const double unit = beam_.model().length_control.standard_length;
  const std::vector<Contact> contacts = links_.contacts();
  Eigen::VectorXd forces;
  if (!links_.resting().empty()) forces = accelerations_.forces_of_links(y, t);
  auto rests = static_cast<Eigen::Index>(links_.of_blocks().size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const int part = static_cast<int>(i);
    if (contacts[i].rests) {
      guards.push_back({number(Kind::lift_off), part, -forces[rests++] / beam_.model().section.stiffness.EA});
      continue;
    }
    const auto gap = links_.gap(contacts[i], y);
    // beyond each other they are less than no distance apart
    const bool crossed = beam_.mark_of(contacts[i].ahead, y.data()) < beam_.mark_of(contacts[i].behind, y.data());
    const double side = crossed ? -1 : 1, rate = side * gap.rate;
    const double value = (contacts[i].distance - side * gap.distance) / unit;
    guards.push_back({.kind = number(Kind::contact),
                      .part = part,
                      .value = rate > 0 ? value - clearance : value,  // what parts is clear of each other
                      .rate = -rate / unit,
                      .room = contacts[i].distance / (2 * unit)});
  }
}

template <int D>
bool EventGuards<D>::turns_away(int index, const Eigen::VectorXd& y, double t) const {
  return beam_.frames() && static_cast<Kind>(at(y, t)[static_cast<std::size_t>(index)].kind) == Kind::turned_away;
}

template <int D>
void EventGuards<D>::add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const auto& control = beam_.model().length_control;
  const bool at_start = beam_.places()[which].node == 0;
  const int next = at_start ? 1 : beam_.mesh().last() - 1;
  const bool joint_next = beam_.at_joint(next);
  using Mark = typename CurrentBeam<D>::MarkMotion;
  const auto [x, rate] = beam_.mark_motion(which, y, t);
  const auto [x_next, next_rate] =
      joint_next ? beam_.mark_motion(at_start ? which + 1 : which - 1, y, t) : Mark{beam_.mark_of(next, y.data()), 0};
  const double unit = control.standard_length, length = at_start ? x_next - x : x - x_next;
  const auto add = [&](Kind kind, double value) {
    guards.push_back({number(kind), static_cast<int>(which), value, rounding_of(beam_.mesh()) / unit});
  };
  if (control.enabled) add(at_start ? Kind::backward : Kind::forward, (length - control.trigger_length()) / unit);
  if (beam_.model().transport == WeightTransport::transported) {
    const WeightFunction& weights = beam_.mesh().weights[at_start ? 0 : beam_.mesh().weights.size() - 1];
    add(Kind::weights, lost_weight(at_start ? weights.on(x, x_next) : weights.on(x_next, x)));
  }
  if (joint_next) {
    if (at_start) {
      add(Kind::meeting, beam_.model().contact_distance - length / unit);
      guards.back().rate = (rate - next_rate) / unit;
      guards.back().room = beam_.model().contact_distance / 2;
    }
  } else if (next != 0 && next != beam_.mesh().last() && control.enabled) {
    add(at_start ? Kind::merge_ahead : Kind::merge_behind,
        (control.merge_length() * (1 - merge_margin) - length) / unit);
  } else {
    add(Kind::used_up, least_left - length / unit);
    guards.back().rate = (at_start ? rate : -rate) / unit;
  }
}

template <int D>
void EventGuards<D>::joints_met(std::size_t which, double t) const {
  const auto name = [&](std::size_t i) {
    if (beam_.feeds(i)) return std::string("the feed at the beam's ") + (beam_.places()[i].node == 0 ? "start" : "end");
    return "the sliding joint " + std::to_string(beam_.joint_index(i));
  };
  const bool feed = beam_.feeds(which) || beam_.feeds(which + 1);
  const std::string met = feed ? name(which) + " and " + name(which + 1)
                               : "the sliding joints " + std::to_string(beam_.joint_index(which)) + " and " +
                                     std::to_string(beam_.joint_index(which + 1));
  std::ostringstream share;
  share << beam_.model().contact_distance;
  throw ComputationFailed(met + " met: they are as near each other as " + share.str() + " standard elements", t);
}

template <int D>
void EventGuards<D>::used_up(std::size_t which, double t) const {
  const bool at_start = beam_.places()[which].node == 0;
  throw ComputationFailed(std::string("the feed at the beam's ") + (at_start ? "start" : "end") +
                              " has drawn in what there was: its element is shorter than a tenth of a standard one, "
                              "and " +
                              (beam_.model().length_control.enabled ? "there is no other to merge it with"
                                                                    : "without length control it is not merged"),
                          t);
}

template <int D>
Guards EventGuards<D>::rider_guards(const Eigen::VectorXd& y, double t) const {
  const bool at_end = beam_.rider()->at_end();
  const double unit = beam_.model().length_control.standard_length;
  if (beam_.rider()->held) {
    const double stiffness = beam_.model().section.stiffness.EA;
    return {{number(Kind::lift_off), 0, (at_end ? 1 : -1) * accelerations_.contact_force(y, t) / stiffness}};
  }
  const double distance =
      at_end ? beam_.rider()->end - y[beam_.layout().mark()] : y[beam_.layout().mark()] - beam_.rider()->end;
  const bool releases = at_end ? beam_.model().end_releases : beam_.model().start_releases;
  const double least = releases ? beam_.model().joints.front().separation_distance : 0;
  const double known = rounding_of(beam_.mesh()) / unit;
  const double rate = y[beam_.coordinates() + beam_.layout().mark()];
  return {
      {number(at_end ? Kind::end : Kind::start), 0, (least - distance) / unit, known, (at_end ? rate : -rate) / unit},
      {number(Kind::away), 0, (distance - cut_limit_) / unit, known}};
}

template <int D>
Remeshing EventGuards<D>::wanted(std::size_t which, Direction direction, const Eigen::VectorXd& y) const {
  const auto& control = beam_.model().length_control;
  if (control.lower == 0) return {};  // the event of the paper: both
  const bool forward = direction == Direction::forward;
  const int node = beam_.places()[which].node, far = forward ? node - 1 : node + 1,
            next = forward ? node + 1 : node - 1;
  const double x = y[beam_.places()[which].mark];
  const auto reach = [&](int to) { return std::abs(beam_.mark_of(to, y.data()) - x); };
  const bool may_cut = far >= 0 && far <= beam_.mesh().last(),
             may_merge = next > 0 && next < beam_.mesh().last() && !beam_.at_joint(next);
  return {may_cut && reach(far) > control.trigger_length() - same_instant * control.standard_length,
          may_merge && reach(next) < control.merge_length() * (1 + merge_margin)};
}

template <int D>
PendingEvent EventGuards<D>::event_of(const Guard& guard, const Eigen::VectorXd& y) const {
  const auto kind = static_cast<Kind>(guard.kind);
  const auto which = static_cast<std::size_t>(guard.part);
  const bool backward = kind == Kind::backward || kind == Kind::start || kind == Kind::near_start ||
                        kind == Kind::merge_behind || kind == Kind::pass_backward ||
                        (beam_.rider() && !beam_.rider()->at_end());
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
      if (beam_.rider()) return {EventType::lift_off, direction, which, {}};
      const Contact contact = links_.contacts()[which];
      const Direction to = contact.support < 0 ? Direction::backward : Direction::forward;
      return {EventType::lift_off, to, contact.which, {}};
    }
    case Kind::contact:
      return {EventType::contact, direction, links_.contacts()[which].which, {}};
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
  const bool releases = backward ? beam_.model().start_releases : beam_.model().end_releases;
  return {beam_.rider() && !releases ? EventType::contact : EventType::separation, direction, which, {}};
}

template <int D>
std::vector<PendingEvent> EventGuards<D>::due(int index, const Eigen::VectorXd& y, double t) const {
  if (beam_.moving_mesh() != nullptr) stop_travelling(index, t);
  const Guards now = at(y, t);
  const Guard& first = now[static_cast<std::size_t>(index)];
  if (static_cast<Kind>(first.kind) == Kind::meeting) joints_met(static_cast<std::size_t>(first.part), t);
  if (static_cast<Kind>(first.kind) == Kind::used_up) used_up(static_cast<std::size_t>(first.part), t);
  const auto remeshes = [](int kind) {
    const auto of = static_cast<Kind>(kind);
    return of == Kind::forward || of == Kind::backward || of == Kind::merge_ahead || of == Kind::merge_behind;
  };
  std::vector<PendingEvent> result{event_of(first, y)};
  if (beam_.places().size() < 2 || !remeshes(first.kind)) return result;
  for (const Guard& guard : now) {
    const auto which = static_cast<std::size_t>(guard.part);
    if (!remeshes(guard.kind) || guard.value < -same_instant) continue;
    if (std::any_of(result.begin(), result.end(), [&](const PendingEvent& other) { return other.which == which; }))
      continue;
    result.push_back(event_of(guard, y));
  }
  drop_doubles(result);
  return result;
}

template <int D>
void EventGuards<D>::drop_doubles(std::vector<PendingEvent>& dues) const {
  const auto cut_of = [&](const PendingEvent& due) {
    const int node = beam_.places()[due.which].node;
    return due.direction == Direction::forward ? node - 1 : node;
  };
  const auto deleted_by = [&](const PendingEvent& due) {
    const int node = beam_.places()[due.which].node;
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

template <int D>
Guards EventGuards<D>::travel_guards(double t) const {
  beam_.travel(t);
  const bool reshapes = beam_.model().transport == WeightTransport::transported;
  return {{nodes_tangle, 0, beam_.moving_mesh()->tangle()},
          {weight_is_lost, 0, reshapes ? beam_.moving_mesh()->least_weight(beam_.mesh().weights) : -1}};
}

template <int D>
void EventGuards<D>::stop_travelling(int index, double t) const {
  beam_.travel(t);
  throw ComputationFailed(
      index == weight_is_lost ? "a transported weight is about to vanish" : beam_.moving_mesh()->tangled(t), t);
}

template class EventGuards<2>;
template class EventGuards<3>;

}  // namespace vlbeam
