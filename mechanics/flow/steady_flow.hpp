#pragma once

#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/statics/linear_motion.hpp"

namespace vlbeam {

/// The beam of a model whose nodes travel, along a straight line at time t, from `start` in the unit direction `along`,
/// stretched by `stretch`; its material moves at `velocity` [m/s] along the line. Unit weights.
template <int D>
ChainState<D> straight_chain(const BeamModel<D>& model, const Vec<double, D>& start = Vec<double, D>::Zero(),
                             const Vec<double, D>& along = Vec<double, D>::UnitX(), double stretch = 1,
                             double velocity = 0, double t = 0);
/// The state of that beam. If the model has spin, the beam turns at `spin` [rad/s], and its angles are zero.
template <int D>
Eigen::VectorXd straight_state(const BeamSystem<D>& beam, const Vec<double, D>& start, const Vec<double, D>& along,
                               double stretch, double velocity, double spin, double t = 0);

/// A steady flow: the nodes stand still in space (or, the angles, turn at a constant rate) while the beam flows through
/// them. Newton's method from the state `guess`, whose velocities are kept; time enters through the loads.
/// Throws ComputationFailed where there is no such state: Newton's method does not converge, the tangent is singular,
/// or, unless `unstable` is allowed, the state is no minimum any more: the beam flows at or above its critical speed,
/// or is loaded beyond its buckling load.
template <int D>
Eigen::VectorXd steady_state(BeamSystem<D>& beam, const Eigen::VectorXd& guess, double t = 0, bool unstable = false);

/// The small motions about a steady flow, of the axis and of the angles, which do not couple; the latter are empty
/// without spin.
struct LinearFlows {
  LinearMotion axis, angles;
};
/// About the state `y` at time t, exactly (no difference quotients).
template <int D>
LinearFlows linear_flows(BeamSystem<D>& beam, const Eigen::VectorXd& y, double t = 0);

extern template ChainState<2> straight_chain(const BeamModel<2>&, const Vec<double, 2>&, const Vec<double, 2>&, double,
                                             double, double);
extern template ChainState<3> straight_chain(const BeamModel<3>&, const Vec<double, 3>&, const Vec<double, 3>&, double,
                                             double, double);
extern template Eigen::VectorXd straight_state(const BeamSystem<2>&, const Vec<double, 2>&, const Vec<double, 2>&,
                                               double, double, double, double);
extern template Eigen::VectorXd straight_state(const BeamSystem<3>&, const Vec<double, 3>&, const Vec<double, 3>&,
                                               double, double, double, double);
extern template Eigen::VectorXd steady_state(BeamSystem<2>&, const Eigen::VectorXd&, double, bool);
extern template Eigen::VectorXd steady_state(BeamSystem<3>&, const Eigen::VectorXd&, double, bool);
extern template LinearFlows linear_flows(BeamSystem<2>&, const Eigen::VectorXd&, double);
extern template LinearFlows linear_flows(BeamSystem<3>&, const Eigen::VectorXd&, double);

}  // namespace vlbeam
