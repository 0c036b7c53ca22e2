#pragma once

#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// Nodes beside what an event has cut and merged give way, as length control says, until the strain energy that the
/// event has created is gone.
template <int D>
class GivingWay final : public EventSource<D> {
 public:
  explicit GivingWay(const BeamInside<D>& inside) : beam_(inside.beam) {}

  void add_guards(const Eigen::VectorXd& /*y*/, double /*t*/, Guards& /*guards*/) const override {}
  std::vector<PendingEvent> due(const Guard& /*first*/, const Eigen::VectorXd& /*y*/, double /*t*/) const override {
    return {};
  }
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& /*dues*/, ChainState<D>& /*chain*/,
                                   Eigen::VectorXd& /*y*/, double /*t*/) override {
    return {};
  }

  int reach() const override { return 3; }
  int give_way(const std::vector<Reshaped>& where, const EventReach& reach, double t, const ChainState<D>& before,
               ChainState<D>& after) const override;

 private:
  const CurrentBeam<D>& beam_;
};

extern template class GivingWay<2>;
extern template class GivingWay<3>;

}  // namespace vlbeam
