#pragma once

#include <complex>
#include <vector>

#include "mechanics/motion/system/beam_system.hpp"

namespace vlbeam {

/// Stretch |r_x| of a straight beam of axial stiffness `EA` under the axial force `force` [N]:
/// F = EA (lambda^2 - 1) lambda/2 (green) or EA (lambda - 1) (engineering). Throws ModelError where there is none: a
/// green beam bears no compression beyond EA/(3 sqrt 3).
double stretch_under(double force, double EA, StrainLaw law = StrainLaw::green);

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

/// The motion about a steady flow, M x'' + C x' + K x = 0, of the free coordinates. C is gyroscopic where there is no
/// damping.
struct LinearFlow {
  Eigen::MatrixXd M, C, K;
};
/// Of the axis and of the angles, which do not couple; the latter are empty without spin.
struct LinearFlows {
  LinearFlow axis, angles;
};
/// About the state `y` at time t, exactly (no difference quotients).
template <int D>
LinearFlows linear_flows(BeamSystem<D>& beam, const Eigen::VectorXd& y, double t = 0);

/// Eigenvalues lambda of lambda^2 M + lambda C + K [1/s], those of least modulus first and to the highest accuracy.
/// Throws ComputationFailed where K is singular.
std::vector<std::complex<double>> eigenvalues(const LinearFlow& flow);
/// Frequencies [Hz], increasing: Im(lambda)/(2 pi) of the eigenvalues that oscillate.
std::vector<double> frequencies(const std::vector<std::complex<double>>& eigenvalues);
/// The largest real part [1/s]: positive where the flow diverges or flutters.
double growth_rate(const std::vector<std::complex<double>>& eigenvalues);

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
