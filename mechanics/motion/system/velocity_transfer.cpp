#include "mechanics/motion/system/velocity_transfer.hpp"

#include <algorithm>
#include <cmath>

#include "core/element/quadrature.hpp"
#include "core/geometry/dense.hpp"
#include "core/length_control/chain_motion.hpp"
#include "core/pieces.hpp"

namespace vlbeam {
namespace {

// On each piece between nodes of either mesh: of cubics, whose products they integrate exactly, and of rational ones.
constexpr int cubic_points = 4, rational_points = 12;
constexpr double largest_scaling = 1;  // of the fluctuation, more than it is

/// What of a point's motion counts here.
template <int D>
struct CarriedPoint {
  std::array<double, 4> s;
  Vec<double, D> y_a, y_b, v;
};

/// Inlined, so that nothing else of the motion is computed.
template <int D>
[[gnu::flatten]] CarriedPoint<D> carried_at(const MovingKinematics<double, D>& element, double x) {
  const PointMotion<double, D> at = motion_at(element, x);
  return {at.s, at.y_a, at.y_b, at.v};
}

}  // namespace

template <int D>
void VelocityProjection<D>::find_excess_momentum(const ChainState<D>& before, const ChainState<D>& after, int first,
                                                 int last) {
  momentum_.resize(beam_.coordinates());
  beam_.clear(momentum_.data(), after.part);
  const double start = after.mesh.x[static_cast<std::size_t>(first)],
               end = after.mesh.x[static_cast<std::size_t>(last)];
  std::vector<double> pieces = common_pieces(before.mesh, after.mesh, start, end);
  const std::vector<double> changes = beam_.model().pieces.changes_between(start, end);  // of the section
  pieces.insert(pieces.end(), changes.begin(), changes.end());
  std::ranges::sort(pieces);
  const ChainView<D> places = beam_.view(nullptr, nullptr);
  const auto add = [&](int element, const auto& is, const Vector& excess) {
    const int to = after.part.before + element;
    for (int i = 0; i < 4; ++i) {
      momentum_.segment<D>(places.vector(to, i)) += is.s[static_cast<std::size_t>(i)] * excess;
    }
    if (const JointPlace* b = places.joint_at(to + 1)) momentum_[b->mark] += is.y_b.dot(excess);
    if (const JointPlace* a = places.joint_at(to)) momentum_[a->mark] += is.y_a.dot(excess);
  };
  for (std::size_t piece = 0; piece + 1 < pieces.size(); ++piece) {
    const double a = pieces[piece], length = pieces[piece + 1] - a;
    const int from = before.mesh.element_at(a + length / 2), to = after.mesh.element_at(a + length / 2);
    const auto was = kinematics_of(before, from, beam_.model().transport),
               is = kinematics_of(after, to, beam_.model().transport);
    const bool cubic = was.weights() == unit_weights && is.weights() == unit_weights;
    for (const auto& [u, weight] : gauss_legendre(cubic ? cubic_points : rational_points)) {
      const double x = a + u * length;
      const CarriedPoint<D> now = carried_at(is, x);
      add(to, now, (carried_at(was, x).v - now.v) * (weight * length * beam_.model().mass_at(x)));
    }
  }
  for (const PointMass& point : beam_.model().masses.points) {
    if (point.x < start || point.x > end) continue;
    const int to = after.mesh.element_at(point.x);
    const auto is = motion_at(after, to, point.x, beam_.model().transport);
    const Vector was = motion_at(before, before.mesh.element_at(point.x), point.x, beam_.model().transport).v;
    add(to, is, point.mass * (was - is.v));
  }
}

template <int D>
void VelocityProjection<D>::project(const ChainState<D>& before, const ChainState<D>& after, int first, int last,
                                    Eigen::VectorXd& y, double t) {
  find_excess_momentum(before, after, first, last);
  if (const auto* loose = beam_.loose(); loose != nullptr && !before.joints.empty()) {  // a node moves otherwise
    const double *const q = y.data(), *const of_now = q + beam_.coordinates();
    const Vector was = position<D>(before.rate.data(), before.joints.front().node);
    loose->add_momentum(q, of_now, was - loose->place(q, of_now).v, momentum_.data());
  }
  if (!mass_.solve(beam_.masses_at(y, t), y.data(), momentum_.data(), after.part)) return;
  auto rate = y.segment(beam_.coordinates(), beam_.coordinates());
  const Eigen::Index nodes = Eigen::Index{node_size<D>} * after.part.before, count = std::ssize(after.q);
  const Eigen::Index others = beam_.dofs().mark(), of_them = beam_.coordinates() - others;
  rate.segment(nodes, count) += momentum_.segment(nodes, count);
  rate.segment(others, of_them) += momentum_.segment(others, of_them);
}

template <int D>
void VelocityProjection<D>::rigid_rates(int mode, const Eigen::VectorXd& y, Eigen::VectorXd& rigid) const {
  rigid.setZero(beam_.coordinates());
  const std::array<int, 2> axes = axes_of(mode);
  auto rotate = [&](Eigen::Index vector) {
    rigid[vector + axes[0]] = -y[vector + axes[1]];
    rigid[vector + axes[1]] = y[vector + axes[0]];
  };
  for (Eigen::Index node = 0; node < beam_.dofs().mark(); node += node_size<D>) {
    if (mode < D) {
      rigid[node + mode] = 1;
    } else {
      rotate(node);
      rotate(node + D);
    }
  }
  for (const JointPlace& place : beam_.places()) {
    if (mode >= D && place.behind >= 0) rotate(place.behind);
  }
}

template <int D>
Eigen::MatrixXd VelocityProjection<D>::rigid_momenta(const JointElements& elements, const Eigen::VectorXd& y) const {
  Eigen::MatrixXd momenta(beam_.coordinates(), rigid_modes);
  Eigen::VectorXd rigid;
  for (int mode = 0; mode < rigid_modes; ++mode) {
    rigid_rates(mode, y, rigid);
    mass_.multiply(elements, y.data(), rigid.data(), momenta.col(mode).data());
  }
  return momenta;
}

template <int D>
Eigen::VectorXd VelocityProjection<D>::momenta(const Eigen::VectorXd& y, double t, const BeamPart& part) {
  momentum_.resize(beam_.coordinates());
  mass_.multiply(beam_.masses_at(y, t), y.data(), y.data() + beam_.coordinates(), momentum_.data(), part);
  using Sum = Eigen::Matrix<double, rigid_modes, 1>;
  const auto turning = [&](Sum& sum, Eigen::Index vector) {  // moment about the origin
    for (int i = D; i < rigid_modes; ++i) {
      const auto [a, b] = axes_of(i);
      sum[i] += y[vector + a] * momentum_[vector + b] - y[vector + b] * momentum_[vector + a];
    }
  };
  const Eigen::Index nodes = beam_.dofs().nodes - part.before - part.behind;
  Eigen::VectorXd sum = sum_in_pieces<Sum>(nodes, node_size<D>, [&](Eigen::Index first, Eigen::Index n) {
    Sum of_some = Sum::Zero();
    for (Eigen::Index node = part.before + first; node < part.before + first + n; ++node) {
      const Eigen::Index vector = node * node_size<D>;
      of_some.template head<D>() += momentum_.segment<D>(vector);
      turning(of_some, vector);
      turning(of_some, vector + D);
    }
    return of_some;
  });
  Sum behind = Sum::Zero();
  for (const JointPlace& place : beam_.places()) {
    if (place.behind >= 0) turning(behind, place.behind);
  }
  sum += behind;
  if constexpr (D == 3) sum.tail<3>() += own_momentum(y);
  return sum;
}

template <int D>
void VelocityProjection<D>::conserve(const Eigen::VectorXd& momenta, const EnergyGained& gained, Eigen::VectorXd& y,
                                     double t) {
  conserve_axis(momenta, gained, y, t);
  const bool follow = beam_.unknowns() != nullptr && beam_.unknowns()->couples_joints();  // marks, a little
  if (follow) conserve_axis(momenta, gained, y, t);
}

template <int D>
void VelocityProjection<D>::conserve_axis(const Eigen::VectorXd& all, const EnergyGained& gained, Eigen::VectorXd& y,
                                          double t) {
  Eigen::VectorXd momenta;
  momenta = all;
  if constexpr (D == 3) momenta.tail<3>() -= own_momentum(y);
  const JointElements elements = beam_.masses_at(y, t);
  auto rate = y.segment(beam_.coordinates(), beam_.coordinates());
  // momenta of the rigid motions, and of these motions what the supports leave
  const Eigen::MatrixXd rigid = rigid_momenta(elements, y);
  Eigen::MatrixXd motion = rigid;
  for (Eigen::Index mode = 0; mode < motion.cols(); ++mode) {
    if (!mass_.solve(elements, y.data(), motion.col(mode).data())) return;
  }
  // turning has another unit: pivots, and with them the rounding, must not depend on it
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(rigid.cols());
  unit.tail(rigid.cols() - D).setConstant(std::ldexp(1.0, -std::ilogb(beam_.mesh().length())));
  const Eigen::MatrixXd metric = unit.asDiagonal() * (rigid.transpose() * motion) * unit.asDiagonal();
  const auto velocities_of = [&](const Eigen::VectorXd& of) -> Eigen::VectorXd {
    return unit.cwiseProduct(solve_pivoting(metric, unit.cwiseProduct(of)));
  };
  rate += motion * velocities_of(momenta - rigid.transpose() * rate);

  Eigen::VectorXd fluctuation = rate - motion * velocities_of(momenta);
  fluctuation.tail(beam_.dofs().turning).setZero();
  fluctuation.segment(beam_.dofs().free_mass(), D * beam_.dofs().free_masses).setZero();  // they fly on
  Eigen::VectorXd of_fluctuation(beam_.coordinates());
  mass_.multiply(elements, y.data(), fluctuation.data(), of_fluctuation.data());
  const double twice_kinetic = fluctuation.dot(of_fluctuation);
  if (!(twice_kinetic > 0)) return;
  // T(v + s w) = T(v) + (s + s^2/2) w.M w, for w is orthogonal to what else there is
  const double missing = -gained();
  const double root = 1 + 2 * missing / twice_kinetic;
  const double scaling = root > 0 ? std::min(std::sqrt(root) - 1, largest_scaling) : -1;
  rate += scaling * fluctuation;
}

template class VelocityProjection<2>;
template class VelocityProjection<3>;

}  // namespace vlbeam
