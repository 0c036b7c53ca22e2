#pragma once

#include "mechanics/frames/frame_room.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// The angles of a beam whose sections have frames, one a node.
class FrameUnknowns final : public Unknowns<3> {
 public:
  /// `beam` must outlive this object.
  explicit FrameUnknowns(const CurrentBeam<3>& beam) : beam_(beam) {}

  /// Those that there are until the next event, and on while someone holds them.
  const std::shared_ptr<Frames>& frames() const { return frames_; }

  Eigen::Index count() const override { return frames_->coordinates(); }
  bool of_nodes() const override { return true; }
  std::shared_ptr<const Part<3>> part() const override { return frames_; }
  void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const override {
    runs.push_back({Field::angle, first, 1, 1, count()});
  }

  void take(const ChainState<3>& chain) override;
  void adopt() override;
  void start(double* /*q*/, double* /*rate*/) override {}
  void write(const ChainState<3>& chain, const double* old_q, const double* old_rate, double* q,
             double* rate) const override;
  void read(const double* q, const double* rate, ChainState<3>& chain) const override;
  void settle(const double* q) override { frames_->follow(q, nullptr); }
  void exchange(Archive& memory) override { frames_->exchange(memory); }

  bool accelerate(const double* q, const double* rate, double /*t*/, double* a, double& /*dissipated*/) override {
    frames_->solve_spins(q, rate, a);
    return true;
  }
  bool load(const double* q, const double* rate, double* a, std::vector<JointMotion<3>>& joints) override;
  void follow(const double* q, const double* rate, double* a) override { frames_->complete(q, rate, a); }
  bool couples_joints() const override { return true; }
  double coupling(std::size_t on, std::size_t by) const override { return frames_->mark_inertia(on, by); }

  double residual(const double* q, const double* v, const double* a, double /*t*/, double* r) override {
    frames_->add_inertia(q, v, a, r);
    return 0;
  }
  void observe(const double* q, const double* rate, int points, Observation<3>& seen) const override;
  Vec<double, 3> momentum(const double* q, const double* rate) const override {
    return frames_->observe(q, rate).momentum;
  }

 private:
  const CurrentBeam<3>& beam_;
  std::shared_ptr<Frames> frames_;
  std::vector<SectionState> rest_;
  std::shared_ptr<const RestTriads> rest_triads_;
};

/// The frames of a beam that has them.
inline const std::shared_ptr<Frames>& frames_of(const CurrentBeam<3>& beam) {
  return dynamic_cast<const FrameUnknowns&>(*beam.unknowns()).frames();
}

}  // namespace vlbeam
