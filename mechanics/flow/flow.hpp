#pragma once

#include <vector>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// What flows through the ends of a beam whose nodes all travel along it as prescribed, and what it brings.
template <int D>
class Flow {
 public:
  using Vector = Vec<double, D>;
  using JointElements = typename CurrentBeam<D>::JointElements;

  /// `beam` must outlive this object.
  explicit Flow(CurrentBeam<D>& beam) : beam_(beam) {}

  /// M a - Q of the elements and of what comes in, of the nodal accelerations `a`, added to an array like q; returns
  /// the power lost to damping [W].
  double add_residual(const double* q, const double* rate, const double* a, double t, double* r);
  /// M a of the elements of the last add_residual(), added to an array like q.
  void add_inertia(const double* a, double* r) const { beam_.moving_mesh()->add_inertia(elements_, a, r); }
  /// What the beam is given in a second at the accelerations `a`; `elements` are those of the last evaluation.
  Tally power(const JointElements& elements, const double* q, const double* rate, const double* a, double t);
  /// The same of the elements of the last add_residual().
  Tally power(const double* q, const double* rate, const double* a, double t) {
    return power(elements_, q, rate, a, t);
  }

 private:
  CurrentBeam<D>& beam_;
  JointElements elements_;
  Eigen::VectorXd residual_, forces_;  ///< of power()
  std::vector<double> on_marks_;       ///< the same
};

extern template class Flow<2>;
extern template class Flow<3>;

}  // namespace vlbeam
