#pragma once

#include <vector>

#include "core/error.hpp"
#include "core/length_control/length_control.hpp"
#include "mechanics/motion/system/accelerations.hpp"

namespace vlbeam {

/// The joint, or the mass without a support, cannot go on at that end.
ComputationFailed ran_into_support(bool held, Direction direction, double t);

/// New velocities where joints, or the supports at the ends, strike each other.
template <int D>
class Impacts {
 public:
  using Contact = NodeContact<D>;

  /// All must outlive this object.
  Impacts(CurrentBeam<D>& beam, BeamLinks<D>& links, BeamMass<D>& mass, Accelerations<D>& accelerations)
      : beam_(beam), links_(links), mass_(mass), accelerations_(accelerations) {}

  /// All that touch and come nearer strike each other at once, and what rests bears it: new velocities, and what rests
  /// then. Throws ComputationFailed where it cannot.
  void strike(Eigen::VectorXd& y, double t);
  /// The mass that rides hits a support: new velocities. Returns whether it is then held. Throws ComputationFailed
  /// where the run is to stop.
  bool hit(Eigen::VectorXd& y, double t);

 private:
  using Gap = typename BeamLinks<D>::Gap;

  /// Velocities after an impact of these.
  void collide(const std::vector<Contact>& contacts, Eigen::VectorXd& y, double t);
  /// Throws ComputationFailed.
  [[noreturn]] void comes_to_rest(const Contact& contact, double t) const;

  CurrentBeam<D>& beam_;
  BeamLinks<D>& links_;
  BeamMass<D>& mass_;
  Accelerations<D>& accelerations_;
};

extern template class Impacts<2>;
extern template class Impacts<3>;

}  // namespace vlbeam
