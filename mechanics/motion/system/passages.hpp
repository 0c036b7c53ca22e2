#pragma once

#include "mechanics/motion/system/event_source.hpp"
#include "mechanics/motion/system/joint_neighbours.hpp"

namespace vlbeam {

/// Joints that pass over point masses: nothing jumps but accelerations.
template <int D>
class Passages final : public EventSource<D> {
 public:
  explicit Passages(const BeamInside<D>& inside) : beam_(inside.beam) {}

  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override {
    const auto& masses = beam_.model().masses.points;
    const double unit = beam_.model().length_control.standard_length;
    for (std::size_t i = 0; i < beam_.places().size(); ++i) {
      if (beam_.feeds(i)) continue;
      const auto passed = static_cast<std::size_t>(beam_.places()[i].passed);
      if (passed == 0 && masses.empty()) continue;
      const double x = beam_.mark_at(i, y, t);
      const auto add = [&](Kind kind, double way) {
        guards.push_back({kind, static_cast<int>(i), way / unit, rounding_of(beam_.mesh()) / unit});
      };
      if (passed < masses.size()) add(forward, x - masses[passed].x);
      if (passed > 0) add(backward, masses[passed - 1].x - x);
    }
  }
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double /*t*/) const override {
    const auto which = static_cast<std::size_t>(first.part);
    const JointPlace& place = beam_.places()[which];
    return {{.type = EventType::passage,
             .direction = first.kind == forward ? Direction::forward : Direction::backward,
             .which = which,
             .joint = beam_.joint_index(which),
             .node = place.node,
             .x = y[place.mark],
             .goes_on = true}};
  }
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& /*chain*/,
                                   Eigen::VectorXd& /*y*/, double /*t*/) override {
    beam_.pass(dues.front().which, dues.front().direction == Direction::forward ? 1 : -1);
    return {{}};
  }

 private:
  enum Kind { forward, backward };

  CurrentBeam<D>& beam_;
};

}  // namespace vlbeam
