#pragma once

#include "core/error.hpp"
#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// The joint, or the mass without a support, cannot go on at that end.
ComputationFailed ran_into_support(bool held, Direction direction, double t);

/// A joint comes to a place where it can go no farther: an end of the beam, which it leaves where it may; a node that
/// does not give way; another joint; the end of what a feed can draw in.
template <int D>
class JointLimits final : public EventSource<D> {
 public:
  explicit JointLimits(const BeamInside<D>& inside) : beam_(inside.beam), links_(inside.links) {}

  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override;
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double t) const override;
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain, Eigen::VectorXd& y,
                                   double t) override;

 private:
  enum Kind { end, start, meeting, used_up };

  void add_joint_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  void add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  /// Throws ComputationFailed where the joint may not leave the beam there.
  void check_leaving(std::size_t which, Direction direction, double t) const;
  [[noreturn]] void joints_met(std::size_t which, double t) const;
  [[noreturn]] void has_drawn_in_all(std::size_t which, double t) const;

  const CurrentBeam<D>& beam_;
  const BeamLinks<D>& links_;
};

/// The mass of a joint of the model, which has just left the beam, goes on: writes it into the chain.
template <int D>
void let_go(const CurrentBeam<D>& beam, int joint, const Eigen::VectorXd& y, ChainState<D>& chain) {
  const ModelJoint<D>& left = beam.model().joints[static_cast<std::size_t>(joint)];
  if (left.support || !(left.law.mass > 0)) return;
  const auto mass = beam.mass_motion(y, joint);
  chain.free_masses.push_back({joint, mass->r, mass->v});
}

extern template class JointLimits<2>;
extern template class JointLimits<3>;

}  // namespace vlbeam
