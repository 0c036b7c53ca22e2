#pragma once

#include "mechanics/frames/frame_unknowns.hpp"
#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// Frames at the events of a beam: what angles are counted from follows the tangents before these have turned too far,
/// and an event that makes new nodes gives them sections, with spins.
class FrameEvents final : public EventSource<3> {
 public:
  explicit FrameEvents(const BeamInside<3>& inside) : beam_(inside.beam), accelerations_(inside.accelerations) {}

  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override;
  bool settles(const Guard& guard, Eigen::VectorXd& y) override;
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double t) const override;
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<3>& chain, Eigen::VectorXd& y,
                                   double t) override;

  bool observes_all() const override { return true; }
  /// Gives the nodes of `after` their sections: new ones those that were there in the beam.
  void complete(const ChainState<3>& before, const Eigen::VectorXd& y, ChainState<3>& after) const override;
  void keep() override { before_ = frames_of(beam_); }
  void transfer(const Eigen::VectorXd& old, Eigen::VectorXd& y) const override;

 private:
  CurrentBeam<3>& beam_;
  Accelerations<3>& accelerations_;
  std::shared_ptr<Frames> before_;  ///< the last event
};

}  // namespace vlbeam
