#include "mechanics/motion/system/joint_cuts.hpp"

#include <algorithm>

#include "core/length_control/least_change.hpp"
#include "mechanics/motion/system/event_limits.hpp"
#include "mechanics/motion/system/joint_neighbours.hpp"

namespace vlbeam {
namespace {

using namespace event_limits;

EventType type_of(const Remeshing& what) {
  return what.cut && what.merge ? EventType::segment_merge : what.cut ? EventType::segmentation : EventType::merging;
}

}  // namespace

template <int D>
void JointCuts<D>::add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    if (beam_.feeds(i)) {
      add_feed_guards(i, y, t, guards);
    } else {
      add_joint_guards(i, y, t, guards);
    }
  }
}

template <int D>
void JointCuts<D>::add_joint_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const Mesh& mesh = beam_.mesh();
  const LengthControl& control = beam_.model().length_control;
  const double unit = control.standard_length;
  const JointNeighbours<D> at(beam_, which, y, t);
  const auto add = [&](Kind kind, double value) {
    guards.push_back({kind, static_cast<int>(which), value, rounding_of(mesh) / unit});
  };
  if (control.enabled) {
    if (!at.to_end) add(forward, (at.behind - control.trigger_length()) / unit);
    if (!at.to_start) add(backward, (at.ahead - control.trigger_length()) / unit);
  }
  if (beam_.model().transport == WeightTransport::transported) {
    const auto j = static_cast<std::size_t>(at.node);
    add(weights, std::max(lost_weight(mesh.weights[j - 1].on(at.low.x, at.here.x)),
                          lost_weight(mesh.weights[j].on(at.here.x, at.high.x))));
  }
  if (control.enabled && control.lower > 0) {
    const double least = control.merge_length() * (1 - merge_margin);
    if (!at.to_end && !at.joint_ahead) add(merge_ahead, (least - at.ahead) / unit);
    if (!at.to_start && !at.joint_behind) add(merge_behind, (least - at.behind) / unit);
  }
}

template <int D>
void JointCuts<D>::add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const {
  const LengthControl& control = beam_.model().length_control;
  const double unit = control.standard_length;
  const FeedNeighbour<D> at(beam_, which, y, t);
  const auto add = [&](Kind kind, double value) {
    guards.push_back({kind, static_cast<int>(which), value, rounding_of(beam_.mesh()) / unit});
  };
  if (control.enabled) add(at.at_start ? backward : forward, (at.length - control.trigger_length()) / unit);
  if (beam_.model().transport == WeightTransport::transported) {
    const WeightFunction& of = beam_.mesh().weights[at.at_start ? 0 : beam_.mesh().weights.size() - 1];
    add(weights, lost_weight(at.at_start ? of.on(at.here.x, at.there.x) : of.on(at.there.x, at.here.x)));
  }
  if (control.enabled && !at.joint_next && at.next != 0 && at.next != beam_.mesh().last()) {
    add(at.at_start ? merge_ahead : merge_behind, (control.merge_length() * (1 - merge_margin) - at.length) / unit);
  }
}

template <int D>
Remeshing JointCuts<D>::wanted(std::size_t which, Direction direction, const Eigen::VectorXd& y) const {
  const LengthControl& control = beam_.model().length_control;
  if (control.lower == 0) return {};  // the event of the paper: both
  const bool ahead = direction == Direction::forward;
  const int node = beam_.places()[which].node, far = ahead ? node - 1 : node + 1, next = ahead ? node + 1 : node - 1;
  const double x = y[beam_.places()[which].mark];
  const auto reach = [&](int to) { return std::abs(beam_.mark_of(to, y.data()) - x); };
  const bool may_cut = far >= 0 && far <= beam_.mesh().last(),
             may_merge = next > 0 && next < beam_.mesh().last() && !beam_.at_joint(next);
  return {may_cut && reach(far) > control.trigger_length() - same_instant * control.standard_length,
          may_merge && reach(next) < control.merge_length() * (1 + merge_margin)};
}

template <int D>
PendingEvent JointCuts<D>::event_of(const Guard& guard, const Eigen::VectorXd& y) const {
  const auto which = static_cast<std::size_t>(guard.part);
  const JointPlace& place = beam_.places()[which];
  PendingEvent due{.type = EventType::reweighting,
                   .which = which,
                   .joint = beam_.joint_index(which),
                   .node = place.node,
                   .x = y[place.mark],
                   .remeshes = true,
                   .goes_on = true};
  const bool least = beam_.model().length_control.merge == MergeShape::least_change;
  if (guard.kind == weights || least) due.reach = 3;
  if (guard.kind == weights) return due;
  if (guard.kind == backward || guard.kind == merge_behind) due.direction = Direction::backward;
  due.remeshing = wanted(which, due.direction, y);
  due.type = type_of(due.remeshing);
  return due;
}

template <int D>
std::vector<PendingEvent> JointCuts<D>::due(const Guard& first, const Eigen::VectorXd& y, double t) const {
  std::vector<PendingEvent> result{event_of(first, y)};
  if (beam_.places().size() < 2 || first.kind == weights) return result;
  Guards now;
  add_guards(y, t, now);
  for (const Guard& guard : now) {
    if (guard.kind == weights || guard.value < -same_instant) continue;
    const auto which = static_cast<std::size_t>(guard.part);
    if (std::ranges::find(result, which, &PendingEvent::which) == result.end()) result.push_back(event_of(guard, y));
  }
  drop_doubles(result);
  return result;
}

template <int D>
void JointCuts<D>::drop_doubles(std::vector<PendingEvent>& dues) const {
  const auto cut_of = [](const PendingEvent& due) {
    return due.direction == Direction::forward ? due.node - 1 : due.node;
  };
  const auto deleted_by = [](const PendingEvent& due) {
    return due.direction == Direction::forward ? due.node + 1 : due.node - 1;
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
std::vector<MergedWeights> JointCuts<D>::apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain,
                                               Eigen::VectorXd& /*y*/, double t) {
  const PendingEvent& first = dues.front();
  if (first.type == EventType::reweighting) return {renew_weights(chain, first.which, t)};
  const auto remesh = [&](const PendingEvent& due, const Remeshing& what) {
    return segment_and_merge(chain, due.which, due.direction, what, beam_.model().length_control, beam_.moving_law(t));
  };
  if (dues.size() == 1) return {remesh(first, first.remeshing)};
  std::vector<MergedWeights> merged(dues.size());
  // cuts first, at places that no merge has moved: mirror images stay mirror images
  for (const PendingEvent& due : dues) {
    if (due.remeshing.cut) remesh(due, {true, false});
  }
  for (std::size_t i = 0; i < dues.size(); ++i) {
    if (dues[i].remeshing.merge) merged[i] = remesh(dues[i], {false, true});
  }
  return merged;
}

/// The element there is cut and merged as those at a joint are, but for the other side.
template <int D>
MergedWeights JointCuts<D>::renew_weights(ChainState<D>& chain, std::size_t which, double t) const {
  const ChainState<D> before = chain;
  const int node = chain.joints[which].node;
  MergedWeights renewed;
  for (const int k : {node - 1, node}) {
    if (k < 0 || k == chain.mesh.elements()) continue;
    const auto i = static_cast<std::size_t>(k);
    const auto& x = chain.mesh.x;
    if (lost_weight(chain.mesh.weights[i].on(x[i], x[i + 1])) < -0.5 * smallest_weight) continue;
    renewed = least_change(chain, before, k, true, beam_.moving_law(t));
  }
  return renewed;
}

template <int D>
Reshaped JointCuts<D>::reshaped(const PendingEvent& due, const ChainState<D>& after) const {
  if (due.type == EventType::reweighting) return {};
  const int node = after.joints[due.which].node;
  const bool ahead = due.direction == Direction::forward;
  Reshaped where;
  if (due.remeshing.cut) where.new_node = ahead ? node - 1 : node + 1;
  if (due.remeshing.merge) where.merged_element = ahead ? node : node - 1;
  return where;
}

template class JointCuts<2>;
template class JointCuts<3>;

}  // namespace vlbeam
