#pragma once

#include "core/error.hpp"
#include "mechanics/flow/moving_mesh.hpp"
#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// Nodes that travel as prescribed end a run where they tangle, or where a transported weight is about to vanish.
template <int D>
class TravelEvents final : public EventSource<D> {
 public:
  explicit TravelEvents(const BeamInside<D>& inside) : beam_(inside.beam) {}

  void add_guards(const Eigen::VectorXd& /*y*/, double t, Guards& guards) const override {
    beam_.move_nodes(t);
    const bool reshapes = beam_.model().transport == WeightTransport::transported;
    guards.push_back({tangle, 0, moving_mesh_of(beam_).tangle()});
    guards.push_back({weight, 0, reshapes ? moving_mesh_of(beam_).least_weight(beam_.mesh().weights) : -1});
  }
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& /*y*/, double t) const override {
    beam_.move_nodes(t);
    throw ComputationFailed(
        first.kind == weight ? "a transported weight is about to vanish" : moving_mesh_of(beam_).tangled(t), t);
  }
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& /*dues*/, ChainState<D>& /*chain*/,
                                   Eigen::VectorXd& /*y*/, double /*t*/) override {
    return {};
  }

 private:
  enum Kind { tangle, weight };

  const CurrentBeam<D>& beam_;
};

}  // namespace vlbeam
