#pragma once

#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// Cuts behind joints and merges ahead of them, by length control, and new weights before transported ones are lost.
template <int D>
class JointCuts final : public EventSource<D> {
 public:
  explicit JointCuts(const BeamInside<D>& inside) : beam_(inside.beam) {}

  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override;
  /// And all other cuts and merges that are due at the same instant, in the order of their guards.
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double t) const override;
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain, Eigen::VectorXd& y,
                                   double t) override;
  Reshaped reshaped(const PendingEvent& due, const ChainState<D>& after) const override;

 private:
  enum Kind { forward, backward, weights, merge_ahead, merge_behind };

  void add_joint_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  void add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  PendingEvent event_of(const Guard& guard, const Eigen::VectorXd& y) const;
  /// Neighbouring joints ask for the same cut or the same merge: one of them does it.
  void drop_doubles(std::vector<PendingEvent>& dues) const;
  /// What a joint, moving in a direction, asks for of the mesh: a cut behind it, a merge ahead.
  Remeshing wanted(std::size_t which, Direction direction, const Eigen::VectorXd& y) const;
  /// Gives elements at a joint whose transported weights are about to be lost new ones, by the least change.
  MergedWeights renew_weights(ChainState<D>& chain, std::size_t which, double t) const;

  const CurrentBeam<D>& beam_;
};

extern template class JointCuts<2>;
extern template class JointCuts<3>;

}  // namespace vlbeam
