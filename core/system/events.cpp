// What can happen to a beam with a sliding mass, when it is due, and what it does to the state.
#include <algorithm>
#include <chrono>
#include <sstream>

#include "core/error.hpp"
#include "core/geometry/dense.hpp"
#include "core/length_control/least_change.hpp"
#include "core/length_control/relaxation.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {
namespace {

constexpr double restored_energy = 1e-9;   // of the energies there are
constexpr double contact_distance = 1e-6;  // of L_std: the joint has run into a node that does not give way
constexpr double clearance = 1e-11;        // of L_std: by which a mass leaves a support, so that the guard is negative
constexpr double least_bounce = 1e-9;      // of L_std: a lower one is the last
constexpr double rounding = 1e-9;          // of the largest momentum of an impact
constexpr double least_left = 0.1;         // of L_std: an element of a feed that cannot be merged; all_due() says so
constexpr double same_instant = 1e-9;      // of L_std: what is this near is due at once
constexpr double merge_slack = 1e-6;       // of the length below which is merged: a cut comes first

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
  pass_backward
};

/// Whether nodes give way at events.
bool relaxes(const LengthControl& control) {
  return control.cut == CutPolicy::relaxed || control.merge == MergePolicy::relaxed;
}

constexpr int number(Kind kind) { return static_cast<int>(kind); }

EventType type_of(const Remeshing& what) {
  return what.cut && what.merge ? EventType::segment_merge : what.cut ? EventType::segmentation : EventType::merging;
}

ComputationFailed ran_into_support(bool held, Direction direction, double t) {
  return {std::string(held ? "the joint" : "the sliding mass") + " ran into the support at the beam's " +
              (direction == Direction::forward ? "end" : "start"),
          t};
}

}  // namespace

template <int D>
Guards BeamSystem<D>::guards(const Eigen::VectorXd& y, double t) const {
  if (rider_) return rider_guards(y, t);
  if (moving_) return travel_guards(t);
  Guards guards;
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
  if (!resting_.empty()) forces = forces_at_contacts(y, t);
  Eigen::Index rests = 0;
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
  return guards;
}

template <int D>
std::vector<typename BeamSystem<D>::Contact> BeamSystem<D>::contacts() const {
  std::vector<Contact> found;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (feeds(i)) continue;
    const int node = places_[i].node;
    const auto add = [&](int behind, int support, const Impact& impact) {
      const auto& touch = touches_[i][support < 0 ? 0 : 1];
      found.push_back(
          {behind, behind + 1, i, support, impact, touch.distance > 0 ? touch.distance : touching(), touch.rests});
    };
    const Impact& at_support = joint(i).at_support;
    const bool strikes = at_support.law != AtSupport::stop && model_.length_control.end_merge == 0;
    if (strikes && node == 1 && !model_.start_releases) add(0, -1, at_support);
    if (model_.at_meeting.law != AtSupport::stop && at_joint(node + 1) && !feeds(i + 1))
      add(node, 0, model_.at_meeting);
    if (strikes && node + 1 == mesh_.last() && !model_.end_releases) add(node, 1, at_support);
  }
  return found;
}

template <int D>
typename BeamSystem<D>::Gap BeamSystem<D>::gap(const Contact& contact, const Eigen::VectorXd& y) const {
  const Vector apart = contact.difference(y.data()), direction = apart.normalized();
  return {apart.norm(), direction.dot(contact.difference(y.data() + coordinates())), direction};
}

/// The element there is cut and merged as those at a joint are, but for the other side.
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
void BeamSystem<D>::find_resting() {
  resting_ = contacts();
  std::erase_if(resting_, [](const Contact& contact) { return !contact.rests; });
  resting_forces_.setZero(static_cast<Eigen::Index>(resting_.size()));
}

template <int D>
void BeamSystem<D>::open_contact(const Contact& contact, const Eigen::VectorXd& y) {
  const double clear = gap(contact, y).distance - clearance * model_.length_control.standard_length;
  touches_[contact.which][contact.support < 0 ? 0 : 1] = {clear, false};
  find_resting();
}

template <int D>
void BeamSystem<D>::close_contact(const Contact& contact, const Eigen::VectorXd& y) {
  touches_[contact.which][contact.support < 0 ? 0 : 1] = {gap(contact, y).distance, true};
  find_resting();
}

template <int D>
std::optional<Eigen::VectorXd> BeamSystem<D>::press(const std::vector<Contact>& contacts, const JointElements& elements,
                                                    const double* q, const Eigen::VectorXd& wanted, double* a) const {
  const auto count = static_cast<Eigen::Index>(contacts.size());
  Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(coordinates(), count), by(count, count);  // M^-1 L, L^T M^-1 L
  Eigen::VectorXd lacking = wanted;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Contact& contact = contacts[static_cast<std::size_t>(i)];
    const Vector line = contact.line(q);
    position<D>(answers.col(i).data(), contact.behind) = -line;
    position<D>(answers.col(i).data(), contact.ahead) = line;
    if (!solve_mass_apart(elements, q, answers.col(i).data())) return std::nullopt;
    lacking[i] -= line.dot(contact.difference(a));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const Contact& contact = contacts[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < count; ++k) by(i, k) = contact.line(q).dot(contact.difference(answers.col(k).data()));
  }
  const Eigen::VectorXd forces = solve_pivoting(by, lacking);
  Eigen::Map<Eigen::VectorXd>(a, coordinates()) += answers * forces;
  return forces;
}

template <int D>
double BeamSystem<D>::work_of_prescribed(const std::vector<Contact>& contacts, const Eigen::VectorXd& forces,
                                         const JointElements& elements, const double* q, const double* rate,
                                         const Eigen::VectorXd& change) const {
  Eigen::VectorXd all(coordinates());
  multiply_mass(elements, q, change.data(), all.data());
  double work = all.dot(Eigen::Map<const Eigen::VectorXd>(rate, coordinates()));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    work -= forces[static_cast<Eigen::Index>(i)] * contacts[i].line(q).dot(contacts[i].difference(rate));
  }
  return work;
}

template <int D>
Eigen::VectorXd BeamSystem<D>::bending_in(const double* rate) const {
  Eigen::VectorXd wanted(static_cast<Eigen::Index>(resting_.size()));
  for (std::size_t i = 0; i < resting_.size(); ++i) {
    wanted[static_cast<Eigen::Index>(i)] = -resting_[i].difference(rate).squaredNorm() / resting_[i].distance;
  }
  return wanted;
}

template <int D>
void BeamSystem<D>::comes_to_rest(const Contact& contact, double t) const {
  const std::string first = "the sliding joint " + std::to_string(index_[contact.which]) + " comes to rest against ";
  throw ComputationFailed(first + (contact.support == 0 ? "the joint " + std::to_string(index_[contact.which + 1])
                                                        : std::string("the support at the beam's ") +
                                                              (contact.support < 0 ? "start" : "end")),
                          t);
}

template <int D>
void BeamSystem<D>::collide(const std::vector<Contact>& contacts, Eigen::VectorXd& y, double t) {
  const JointElements elements = elements_at(y, t);
  auto rate = y.segment(coordinates(), coordinates());
  std::vector<Contact> bearing = contacts;  // what rests pushes, but does not pull
  while (!bearing.empty()) {
    Eigen::VectorXd wanted(static_cast<Eigen::Index>(bearing.size())), after = rate;
    for (std::size_t i = 0; i < bearing.size(); ++i) {
      const double restitution = bearing[i].rests ? 0 : bearing[i].impact.restitution;
      wanted[static_cast<Eigen::Index>(i)] = -restitution * gap(bearing[i], y).rate;
    }
    const auto momenta = press(bearing, elements, y.data(), wanted, after.data());
    if (!momenta) throw ComputationFailed("joints strike each other that have no inertia", t);
    const double pull = -rounding * momenta->cwiseAbs().maxCoeff();
    const auto pulls = [&](std::size_t i) {
      return bearing[i].rests && (*momenta)[static_cast<Eigen::Index>(i)] < pull;
    };
    std::size_t pulled = 0;
    while (pulled < bearing.size() && !pulls(pulled)) ++pulled;
    if (pulled < bearing.size()) {
      open_contact(bearing[pulled], y);
      bearing.erase(bearing.begin() + static_cast<std::ptrdiff_t>(pulled));
      continue;
    }
    const double work = work_of_prescribed(bearing, *momenta, elements, y.data(), rate.data(), after - rate);
    layout_.tallies.add({.supports = work}, y);
    rate = after;
    return;
  }
}

template <int D>
void BeamSystem<D>::strike(Eigen::VectorXd& y, double t) {
  const double unit = model_.length_control.standard_length;
  std::vector<Contact> bearing;  // what rests bears what strikes
  for (Contact contact : contacts()) {
    const Gap gap = this->gap(contact, y);
    const bool strikes = gap.distance <= contact.distance + same_instant * unit && gap.rate < 0;
    if (!strikes && !contact.rests) continue;
    if (!contact.rests) contact.distance = gap.distance;
    if (contact.impact.law == AtSupport::rest) contact.impact.restitution = 0;
    bearing.push_back(contact);
  }
  const Eigen::VectorXd before = y;
  const auto stays = [](const Contact& contact) { return !contact.rests && contact.impact.restitution == 0; };
  const auto collides = [&] {
    collide(bearing, y, t);
    for (const Contact& contact : bearing) {
      if (stays(contact)) close_contact(contact, y);
    }
  };
  collides();

  Eigen::VectorXd rates(y.size());
  rhs(y, rates, t);
  bool lower = false;
  for (Contact& contact : bearing) {
    if (contact.rests || stays(contact)) continue;
    const Gap gap = this->gap(contact, y);
    const double across = contact.difference(y.data() + coordinates()).squaredNorm() - gap.rate * gap.rate;
    const double falls = -gap.direction.dot(contact.difference(rates.data() + coordinates())) - across / gap.distance;
    if (!(falls > 0 && gap.rate * gap.rate < 2 * falls * least_bounce * unit)) continue;
    if (!model_.joints_rest) comes_to_rest(contact, t);
    contact.impact.restitution = 0;
    lower = true;
  }
  if (!lower) return;
  y = before;
  collides();
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
  const bool everywhere = transfers || type == EventType::contact || type == EventType::end_merge || rider_;
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
  if (remeshes && relaxes(model_.length_control)) {
    const auto stored = [&](const ChainState<D>& state) {
      const Energy energy = energies(state, model_.quadrature_points);
      return energy.axial + energy.bending;
    };
    record.relaxation = relax_after(dues, record.after, t, stored(record.after) - stored(record.before));
  }
  const Eigen::VectorXd old = y;
  adopt(record.after);
  orient(t);
  y = state_of(record.after, old);
  const int highest_after = highest + record.after.mesh.elements() - record.before.mesh.elements();
  if (transfers) {
    project_velocities(record.before, lowest, highest_after, y, t);
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

template Guards BeamSystem<2>::guards(const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::add_feed_guards(std::size_t, const Eigen::VectorXd&, double, Guards&) const;
template void BeamSystem<2>::joints_met(std::size_t, double) const;
template Guards BeamSystem<2>::rider_guards(const Eigen::VectorXd&, double) const;
template Remeshing BeamSystem<2>::wanted(std::size_t, Direction, const Eigen::VectorXd&) const;
template BeamSystem<2>::PendingEvent BeamSystem<2>::due(const Guard&, const Eigen::VectorXd&) const;
template std::vector<BeamSystem<2>::PendingEvent> BeamSystem<2>::all_due(int, const Eigen::VectorXd&, double) const;
template void BeamSystem<2>::drop_doubles(std::vector<PendingEvent>&) const;
template double BeamSystem<2>::clear_of_end() const;
template MergedWeights BeamSystem<2>::renew_weights(ChainState<2>&, std::size_t, double) const;
template void BeamSystem<2>::check_leaving(const PendingEvent&, double) const;
template MergedWeights BeamSystem<2>::change(const PendingEvent&, ChainState<2>&, Eigen::VectorXd&, double);
template std::vector<BeamSystem<2>::Contact> BeamSystem<2>::contacts() const;
template BeamSystem<2>::Gap BeamSystem<2>::gap(const Contact&, const Eigen::VectorXd&) const;
template void BeamSystem<2>::strike(Eigen::VectorXd&, double);
template void BeamSystem<2>::find_resting();
template void BeamSystem<2>::comes_to_rest(const Contact&, double) const;
template void BeamSystem<2>::open_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<2>::close_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<2>::collide(const std::vector<Contact>&, Eigen::VectorXd&, double);
template std::optional<Eigen::VectorXd> BeamSystem<2>::press(const std::vector<Contact>&, const JointElements&,
                                                             const double*, const Eigen::VectorXd&, double*) const;
template double BeamSystem<2>::work_of_prescribed(const std::vector<Contact>&, const Eigen::VectorXd&,
                                                  const JointElements&, const double*, const double*,
                                                  const Eigen::VectorXd&) const;
template Eigen::VectorXd BeamSystem<2>::bending_in(const double*) const;
template int BeamSystem<2>::relax_after(const std::vector<PendingEvent>&, ChainState<2>&, double, double) const;
template void BeamSystem<2>::hit(ChainState<2>&, Eigen::VectorXd&, double);
template void BeamSystem<2>::handle_event(int, Eigen::VectorXd&, double);
template Guards BeamSystem<3>::guards(const Eigen::VectorXd&, double) const;
template void BeamSystem<3>::add_feed_guards(std::size_t, const Eigen::VectorXd&, double, Guards&) const;
template void BeamSystem<3>::joints_met(std::size_t, double) const;
template Guards BeamSystem<3>::rider_guards(const Eigen::VectorXd&, double) const;
template Remeshing BeamSystem<3>::wanted(std::size_t, Direction, const Eigen::VectorXd&) const;
template BeamSystem<3>::PendingEvent BeamSystem<3>::due(const Guard&, const Eigen::VectorXd&) const;
template std::vector<BeamSystem<3>::PendingEvent> BeamSystem<3>::all_due(int, const Eigen::VectorXd&, double) const;
template void BeamSystem<3>::drop_doubles(std::vector<PendingEvent>&) const;
template double BeamSystem<3>::clear_of_end() const;
template MergedWeights BeamSystem<3>::renew_weights(ChainState<3>&, std::size_t, double) const;
template void BeamSystem<3>::check_leaving(const PendingEvent&, double) const;
template MergedWeights BeamSystem<3>::change(const PendingEvent&, ChainState<3>&, Eigen::VectorXd&, double);
template std::vector<BeamSystem<3>::Contact> BeamSystem<3>::contacts() const;
template BeamSystem<3>::Gap BeamSystem<3>::gap(const Contact&, const Eigen::VectorXd&) const;
template void BeamSystem<3>::strike(Eigen::VectorXd&, double);
template void BeamSystem<3>::find_resting();
template void BeamSystem<3>::comes_to_rest(const Contact&, double) const;
template void BeamSystem<3>::open_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<3>::close_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<3>::collide(const std::vector<Contact>&, Eigen::VectorXd&, double);
template std::optional<Eigen::VectorXd> BeamSystem<3>::press(const std::vector<Contact>&, const JointElements&,
                                                             const double*, const Eigen::VectorXd&, double*) const;
template double BeamSystem<3>::work_of_prescribed(const std::vector<Contact>&, const Eigen::VectorXd&,
                                                  const JointElements&, const double*, const double*,
                                                  const Eigen::VectorXd&) const;
template Eigen::VectorXd BeamSystem<3>::bending_in(const double*) const;
template int BeamSystem<3>::relax_after(const std::vector<PendingEvent>&, ChainState<3>&, double, double) const;
template void BeamSystem<3>::hit(ChainState<3>&, Eigen::VectorXd&, double);
template void BeamSystem<3>::handle_event(int, Eigen::VectorXd&, double);

}  // namespace vlbeam
