#pragma once

#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// The only joint comes near an end of the beam, and its mass rides on inside the last element: there it leaves the
/// beam, or hits the support, or gets a node again.
template <int D>
class RideEvents final : public EventSource<D> {
 public:
  explicit RideEvents(const BeamInside<D>& inside)
      : beam_(inside.beam), mass_(inside.mass), accelerations_(inside.accelerations) {}

  void adopt() override;
  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override;
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double t) const override;
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain, Eigen::VectorXd& y,
                                   double t) override;
  Reshaped reshaped(const PendingEvent& due, const ChainState<D>& after) const override;
  bool observes_all() const override { return beam_.loose() != nullptr; }

 private:
  enum Kind { near_end, near_start, reaches_end, away, lifts_off };

  void add_joint_guards(const Eigen::VectorXd& y, double t, Guards& guards) const;
  void add_rider_guards(const Eigen::VectorXd& y, double t, Guards& guards) const;
  /// The mass hits a support: new velocities. Returns whether it is then held. Throws ComputationFailed where the run
  /// is to stop.
  bool hit(Eigen::VectorXd& y, double t);
  /// Where a mass is that has just left a support [m].
  double clear_of_end() const;

  CurrentBeam<D>& beam_;
  BeamMass<D>& mass_;
  Accelerations<D>& accelerations_;
  std::array<double, 2> end_limit_{};  ///< length of the last and of the first element where an end-merge is due [m]
  double cut_limit_ = 0;               ///< distance of a rider from the end at which it gets a node [m]
};

extern template class RideEvents<2>;
extern template class RideEvents<3>;

}  // namespace vlbeam
