#include "mechanics/motion/system/joint_limits.hpp"

#include <sstream>
#include <string>

#include "mechanics/motion/system/joint_neighbours.hpp"

namespace vlbeam {
namespace {

constexpr double contact_distance = 1e-6;  // of L_std: the joint has run into a node that does not give way
constexpr double least_left = 0.1;         // of L_std: an element of a feed that cannot be merged

}  // namespace

ComputationFailed ran_into_support(bool held, Direction direction, double t) {
  return {std::string(held ? "the joint" : "the sliding mass") + " ran into the support at the beam's " +
              (direction == Direction::forward ? "end" : "start"),
          t};
}

template <int D>
void JointLimits<D>::add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    if (beam_.feeds(i)) {
      add_feed_guards(i, y, t, guards);
    } else {
      add_joint_guards(i, y, t, guards);
    }
  }
}

template <int D>
void JointLimits<D>::add_joint_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const BeamModel<D>& model = beam_.model();
  const double unit = model.length_control.standard_length;
  const bool several = beam_.places().size() > 1;
  const JointNeighbours<D> at(beam_, which, y, t);
  const auto add = [&](Kind kind, double value, double rate) {
    guards.push_back({kind, static_cast<int>(which), value, rounding_of(beam_.mesh()) / unit, rate / unit});
  };
  const auto add_limit = [&](Kind kind, bool leaves, double left, double rate) {
    add(kind, (leaves ? beam_.joint(which).separation_distance / unit : contact_distance) - left / unit, rate);
    if (several && !leaves) guards.back().room = contact_distance / 2;  // no step over a node
  };
  if (!at.joint_ahead) add_limit(end, model.end_releases && at.to_end, at.ahead, at.here.rate);
  if (!at.joint_behind) add_limit(start, model.start_releases && at.to_start, at.behind, -at.here.rate);
  if (at.joint_ahead && (model.joints_stop_each_other() || beam_.feeds(which + 1))) {
    add(meeting, model.contact_distance - at.ahead / unit, at.here.rate - at.high.rate);
    guards.back().room = model.contact_distance / 2;
  }
}

template <int D>
void JointLimits<D>::add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const BeamModel<D>& model = beam_.model();
  const double unit = model.length_control.standard_length;
  const FeedNeighbour<D> at(beam_, which, y, t);
  const auto add = [&](Kind kind, double value, double rate) {
    guards.push_back({kind, static_cast<int>(which), value, rounding_of(beam_.mesh()) / unit, rate / unit});
  };
  if (at.joint_next) {
    if (!at.at_start) return;  // that joint looks ahead
    add(meeting, model.contact_distance - at.length / unit, at.here.rate - at.there.rate);
    guards.back().room = model.contact_distance / 2;
  } else if (at.next == 0 || at.next == beam_.mesh().last() || !model.length_control.enabled) {
    add(used_up, least_left - at.length / unit, at.at_start ? at.here.rate : -at.here.rate);
  }
}

template <int D>
std::vector<PendingEvent> JointLimits<D>::due(const Guard& first, const Eigen::VectorXd& y, double t) const {
  const auto which = static_cast<std::size_t>(first.part);
  if (first.kind == meeting) joints_met(which, t);
  if (first.kind == used_up) has_drawn_in_all(which, t);
  const JointPlace& place = beam_.places()[which];
  const Direction direction = first.kind == start ? Direction::backward : Direction::forward;
  check_leaving(which, direction, t);
  return {{.type = EventType::separation,
           .direction = direction,
           .which = which,
           .joint = beam_.joint_index(which),
           .node = place.node,
           .x = y[place.mark],
           .keeps_momenta = false}};
}

template <int D>
void JointLimits<D>::check_leaving(std::size_t which, Direction direction, double t) const {
  const bool forward = direction == Direction::forward;
  const int node = beam_.places()[which].node;
  if (!(forward ? node + 1 == beam_.mesh().last() : node == 1)) {
    throw ComputationFailed("tangled mesh: the sliding mass ran into a node; switch length control on", t);
  }
  if (!(forward ? beam_.model().end_releases : beam_.model().start_releases)) {
    throw ran_into_support(beam_.held(which) != nullptr, direction, t);
  }
  if (!links_.in_block(beam_.joint_index(which))) return;
  throw ComputationFailed("the joint " + std::to_string(beam_.joint_index(which)) +
                              ", which a block holds, comes to a free end: take a longer beam, or a shorter duration",
                          t);
}

template <int D>
std::vector<MergedWeights> JointLimits<D>::apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain,
                                                 Eigen::VectorXd& y, double /*t*/) {
  const PendingEvent& due = dues.front();
  separate(chain, due.direction, beam_.model().length_control, beam_.model().transport);
  if (!chain.joints.empty()) chain.joints.back().touches[1] = {};
  let_go(beam_, due.joint, y, chain);
  return {{}};
}

template <int D>
void JointLimits<D>::joints_met(std::size_t which, double t) const {
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
  const bool held = beam_.held(which) != nullptr || beam_.held(which + 1) != nullptr;
  const std::string remedy =
      held && !feed ? R"(; a support that others pass over stands in /supports, as {"at": {"x": 10}, "type": "roller"})"
                    : "";
  throw ComputationFailed(met + " met: they are as near each other as " + share.str() + " standard elements" + remedy,
                          t);
}

template <int D>
void JointLimits<D>::has_drawn_in_all(std::size_t which, double t) const {
  const bool at_start = beam_.places()[which].node == 0;
  throw ComputationFailed(std::string("the feed at the beam's ") + (at_start ? "start" : "end") +
                              " has drawn in what there was: its element is shorter than a tenth of a standard one, "
                              "and " +
                              (beam_.model().length_control.enabled ? "there is no other to merge it with"
                                                                    : "without length control it is not merged"),
                          t);
}

template class JointLimits<2>;
template class JointLimits<3>;

}  // namespace vlbeam
