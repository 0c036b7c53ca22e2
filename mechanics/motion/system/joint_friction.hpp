#pragma once

#include "core/beam/beam_matrix.hpp"
#include "core/element/active.hpp"
#include "mechanics/motion/joint/kinks.hpp"
#include "mechanics/motion/joint/sliding_joint.hpp"

namespace vlbeam {

/// Friction on the material coordinate of a joint, at which the beam pulls by `pull` [N].
template <int D>
FrictionForce<double> friction_at(const SlidingJoint& joint, const JointPlace& place, const Vec<double, D>& pull,
                                  const double* q, const double* rate) {
  const auto slopes = slopes_at<D>(place, q);
  const Contact<double, D> contact(slopes.template head<D>(), slopes.template tail<D>(), joint.turns());
  return friction_force<double, D>(*joint.friction, pull, contact, rate[place.mark]);
}

/// Adds its tangent. Friction acts on the material coordinate alone. Where the node is held, the beam pulls at it by
/// what the node's own equations lack, whose rows stand in the tangent: all else must be in it already.
template <int D>
void add_friction_tangent(const SlidingJoint& joint, const JointPlace& place, const Vec<double, D>& pull, bool held,
                          const double* q, const double* rate, const TangentWeights& by, BeamMatrix<D>& tangent) {
  constexpr int B = node_size<D>, N = 3 * D + 1;  // by the pull, the slopes and x'
  using Real = Active<N>;
  const auto slopes = slopes_at<D>(place, q);
  Vec<Real, D> active_pull, before, behind;
  for (int c = 0; c < D; ++c) {
    active_pull[c] = Real(pull[c], c);
    before[c] = Real(slopes[c], D + c);
    behind[c] = Real(slopes[D + c], 2 * D + c);
  }
  const Contact<Real, D> contact(before, behind, joint.turns());
  const Real force =
      friction_force<Real, D>(*joint.friction, active_pull, contact, Real(rate[place.mark], 3 * D)).force;
  if (force.derivatives().size() == 0 || force.value() == 0) return;
  const Eigen::Matrix<double, N, 1>& change = force.derivatives();
  const Vec<double, D> by_pull = change.template head<D>();
  const Eigen::Index at_node = Eigen::Index{B} * place.node, mark = place.mark;
  for (int c = 0; c < D; ++c) {
    const Eigen::Index slope = at_node + D + c;
    tangent.entry(mark, slope) -= by.q * change[D + c];
    tangent.entry(mark, place.behind < 0 ? slope : place.behind + c) -= by.q * change[2 * D + c];
    tangent.entry(mark, at_node + c) -= by.a * joint.mass * by_pull[c];
  }
  tangent.entry(mark, mark) -= by.v * change[3 * D];
  if (!held) return;
  const Eigen::Index own = mark - tangent.nodal();
  auto& border = tangent.border[static_cast<std::size_t>(own)];
  const auto k = static_cast<std::size_t>(place.node);
  const auto add = [&](int to, const auto& block) {
    border.row[static_cast<std::size_t>(to - border.first)] += block.template topRows<D>().transpose() * by_pull;
  };
  add(place.node - 1, tangent.lower[k]);
  add(place.node, tangent.diagonal[k]);
  add(place.node + 1, tangent.upper[k]);
  for (int other = 0; other < tangent.borders(); ++other) {
    const auto& column = tangent.border[static_cast<std::size_t>(other)];
    const int i = place.node - column.first;
    if (i < 0 || i >= BeamMatrix<D>::reach) continue;
    tangent.corner(own, other) += by_pull.dot(column.column[static_cast<std::size_t>(i)].template head<D>());
  }
}

}  // namespace vlbeam
