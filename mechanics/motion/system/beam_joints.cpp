#include "mechanics/motion/system/beam_joints.hpp"

namespace vlbeam {

template <int D>
ConstraintResidual BeamJoints<D>::slope_residual(const Eigen::VectorXd& y) const {
  ConstraintResidual largest;
  for (std::size_t j = 0; j < places_.size(); ++j) {
    if (places_[j].behind < 0) continue;
    const auto slopes = joint_slopes(j, y.data()), rates = joint_slopes(j, y.data() + coordinates());
    const SlopeConditions<D> conditions(joint(j).law.slopes, longest_axis<D>(slopes.template head<D>()));
    for (int i = 0; i < conditions.count(); ++i) {
      largest.position = std::max(largest.position, std::abs(conditions.value(i, slopes)));
      largest.velocity = std::max(largest.velocity, std::abs(conditions.rate(i, slopes, rates)));
    }
  }
  return largest;
}

template class BeamJoints<2>;
template class BeamJoints<3>;

}  // namespace vlbeam
