#pragma once

#include <optional>
#include <vector>

#include "scene/run_support.hpp"

namespace vlbeam {

/// What is recorded of one beam: samples, shapes and events.
template <int D>
class BeamRecord {
 public:
  /// `scene` is that of the beam; all must outlive this object.
  BeamRecord(const Scene& scene, BeamSystem<D>& system, const RunOutput& output);

  /// Without extremes and what a run makes of several samples.
  struct Seen {
    Sample sample;
    double supplied;  ///< to the beam until then [J]
  };
  Seen seen(const Eigen::VectorXd& y, double t) const;
  Configuration shape(const Eigen::VectorXd& y, double t) const;
  Event event(const EventRecord<D>& record) const;

 private:
  void add_angles(const Eigen::VectorXd& y, Configuration& shape) const;
  void look_at_mass(const Eigen::VectorXd& y, const OuterForces<D>& forces, Sample& sample) const;
  std::shared_ptr<const FlowSample> flow_sample(const Eigen::VectorXd& y, double t, const Observation<D>& seen,
                                                const OuterForces<D>& forces) const;
  /// Where the material coordinate of a joint that is on the beam stands in a state.
  Eigen::Index mark(int index) const {
    return system_.loose() != nullptr ? system_.dofs().mark() : system_.place_of(index).mark;
  }
  /// Material coordinate of a joint, while it is on the beam.
  std::optional<double> mark_of(const Eigen::VectorXd& y, int index) const {
    return system_.on_beam(index) ? std::optional(y[mark(index)]) : std::nullopt;
  }
  JointSample joint_sample(const Eigen::VectorXd& y, int index, const OuterForces<D>& forces) const;
  /// The whole shape, or of a long beam what an event may have changed of it: a run may have thousands of events.
  Configuration shape_beside(const ChainState<D>& chain, const EventRecord<D>& record) const;

  const Scene& scene_;
  BeamSystem<D>& system_;
  const RunOutput& output_;
  std::vector<PlaceSpec> places_;
};

extern template class BeamRecord<2>;
extern template class BeamRecord<3>;

}  // namespace vlbeam
