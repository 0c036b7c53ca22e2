#pragma once

#include <optional>

#include "core/beam/span.hpp"
#include "core/beam/support.hpp"
#include "core/element/moving_element.hpp"
#include "mechanics/motion/joint/friction.hpp"
#include "mechanics/motion/joint/joint_law.hpp"
#include "mechanics/motion/joint/slope_conditions.hpp"

namespace vlbeam {

/// What the equations of a joint need to know of its motion.
template <int D>
struct JointMotion {
  Contact<double, D> contact(const SlidingJoint& joint) const {
    return {slopes.template head<D>(), slopes.template tail<D>(), joint.turns()};
  }

  Eigen::Matrix<double, 2 * D, 1> slopes, slope_rates;  ///< r_x before and behind the joint
  double x_rate;                                        ///< [m/s]
  Vec<double, D> gravity;                               ///< [m/s^2]
  std::optional<double> x_acceleration = std::nullopt;  ///< [m/s^2], where a guide prescribes it
  double x_inertia = 0;                                 ///< against x'' itself: of what turns [kg]
};

/// Solves M a = f of two spans joined by a sliding joint at node left.open() + 1, friction included. On entry `force`
/// is the nodal array of forces and `joint_force` those on the joint's material coordinate and, where the joint is
/// kinked, on the slope behind it (that of the node is the one before it); on return they are the accelerations. With
/// nothing moving in `motion`, the same solves M v = p for velocities that agree with the conditions on the slopes.
/// Where nothing acts on the nodes outside a part, they are left out of it all. `held`, unless null, is what holds the
/// joint's node in space: a ring its place, a sleeve its direction, too; what it holds does not accelerate. Cost: one
/// sweep over each span and a dense system of 2 D + 1 unknowns, 3 D + 1 where the joint is kinked. Returns the power
/// lost to friction [W]; nothing where the joint's mass matrix is not positive definite (a massless joint where
/// curvature is continuous) or friction jams.
template <int D>
std::optional<double> solve_with_joint(const Span<D>& left, const Span<D>& right,
                                       const MovingEquations<double, D>& left_element,
                                       const MovingEquations<double, D>& right_element, const SlidingJoint& joint,
                                       const JointMotion<D>& motion, const Support<D>* held, double* force,
                                       double* joint_force, const BeamPart& part = {});

/// Solves M a = f of two spans that share their open node, in place.
template <int D>
void solve_without_joint(const Span<D>& left, const Span<D>& right, double* force);

}  // namespace vlbeam
