#pragma once

#include <algorithm>
#include <map>

#include "mechanics/motion/system/event_source.hpp"
#include "mechanics/motion/system/joint_neighbours.hpp"

namespace vlbeam {

/// Joints that pass over a place where the section changes: nothing jumps but accelerations.
template <int D>
class SectionChanges final : public EventSource<D> {
 public:
  explicit SectionChanges(const BeamInside<D>& inside) : beam_(inside.beam) {}

  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override {
    const auto& pieces = beam_.model().pieces.pieces();
    const double unit = beam_.model().length_control.standard_length;
    for (std::size_t i = 0; i < beam_.places().size(); ++i) {
      if (beam_.feeds(i)) continue;
      const double x = beam_.mark_at(i, y, t);
      const std::size_t in = piece(i, x);
      const auto add = [&](Kind kind, double way) {
        guards.push_back({kind, static_cast<int>(i), way / unit, rounding_of(beam_.mesh()) / unit});
      };
      if (in + 1 < pieces.size()) add(forward, x - pieces[in].end);
      if (in > 0) add(backward, pieces[in - 1].end - x);
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
             .x = y[place.mark]}};
  }
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& /*chain*/,
                                   Eigen::VectorXd& /*y*/, double /*t*/) override {
    std::size_t& in = piece_.at(dues.front().joint);
    in = dues.front().direction == Direction::forward ? in + 1 : in - 1;
    return {{}};
  }

 private:
  enum Kind { forward, backward };

  /// In which piece of the beam a joint is: it is in the next one once it has passed.
  std::size_t piece(std::size_t which, double x) const {
    const auto& pieces = beam_.model().pieces.pieces();
    const auto at = std::ranges::lower_bound(pieces.begin(), pieces.end() - 1, x, {}, &SectionPieces::Piece::end);
    return piece_.try_emplace(beam_.joint_index(which), static_cast<std::size_t>(at - pieces.begin())).first->second;
  }

  CurrentBeam<D>& beam_;
  mutable std::map<int, std::size_t> piece_;  ///< of joints of the model, once they have been seen
};

}  // namespace vlbeam
