#pragma once

#include <array>
#include <vector>

#include "core/element/fixed_element.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// One step of a beam system that changes momentum by the discrete gradient of its Lagrangian and so keeps its total
/// energy (mechanics/conserving/discrete_gradient.hpp), as a residual in the state at the end of the step.
template <int D>
class ConservingStep {
 public:
  /// `system` must outlive this object; its events may change it at any time.
  explicit ConservingStep(CurrentBeam<D>& beam) : beam_(beam) {}

  /// r = (p_1 - p_0)/h - f, with gravity as it is in the middle of the step. Returns the mean power lost to damping
  /// [W].
  double residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                  const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r);

 private:
  struct FixedElement {
    int index;
    FixedBasis<double> basis;
    FixedInertia inertia;
  };

  void refresh();

  CurrentBeam<D>& beam_;
  std::size_t revision_ = static_cast<std::size_t>(-1);
  std::vector<FixedElement> fixed_;
};

extern template class ConservingStep<2>;
extern template class ConservingStep<3>;

}  // namespace vlbeam
