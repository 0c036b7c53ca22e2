#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <optional>

#include "core/element/active.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/joint/sliding_joint.hpp"

namespace vlbeam {

// A lumped mass that slides along the beam inside an element of fixed length, at the material coordinate x of no node:
//   r = S(x) e,   r' = S e' + r_x x',   r'' = S e'' + r_x x'' + r_v,   r_v = 2 r_x' x' + r_xx x'^2,   r_x' = S_x e'.
// It adds m r'.r'/2 + m g.r to the Lagrangian, and so m N^T (r'' - g), N = [S, r_x], to the equations of motion. Strain
// energy does not depend on x: no configurational force. A rider that a support holds has x' = 0 and no equation of x.

/// The element of a rider.
struct RiderElement {
  double x_a = 0, length = 1;  ///< [m]
  Weights<double> weights = unit_weights;
};

/// Motion of a rider, and derivatives of the beam along x there.
template <class Real, int D>
struct RiderMotion {
  std::array<Real, 4> s, s_x, s_xx;  ///< shape functions of (r_A, s_A, r_B, s_B)
  Vec<Real, D> r, r_x, r_xx, r_xxx;
  Vec<Real, D> r_x_rate, r_xx_rate;  ///< at the material point
  Real x_rate;
  Vec<Real, D> v;          ///< velocity of the mass
  Vec<Real, D> remainder;  ///< r_v
};

/// The shape functions at x and their first three derivatives along the beam.
template <class Real>
std::array<std::array<Real, 4>, 4> rider_shape(const RiderElement& element, const Real& x) {
  const Real u = (x - element.x_a) * (1 / element.length);
  ShapeTable<Real> f;
  if (element.weights == unit_weights) {
    f = hermite_shape(u);
  } else {
    const auto& w = element.weights;
    f = rational_shape(Weights<Real>{Real(w[0]), Real(w[1]), Real(w[2]), Real(w[3])}, u);
  }
  std::array<std::array<Real, 4>, 4> s;
  double scale = 1;
  for (std::size_t n = 0; n < 4; ++n, scale /= element.length) {
    for (std::size_t i = 0; i < 4; ++i) s[n][i] = f[i][n] * (i % 2 == 0 ? scale : scale * element.length);
  }
  return s;
}

template <class Real, int D>
RiderMotion<Real, D> rider_motion(const RiderElement& element, const NodalCubic<Real, D>& e,
                                  const NodalCubic<Real, D>& rate, const Real& x, const Real& x_rate) {
  const auto s = rider_shape(element, x);
  RiderMotion<Real, D> at;
  at.s = s[0];
  at.s_x = s[1];
  at.s_xx = s[2];
  at.r = combine_nodes<Real, D>(s[0], e);
  at.r_x = combine_nodes<Real, D>(s[1], e);
  at.r_xx = combine_nodes<Real, D>(s[2], e);
  at.r_xxx = combine_nodes<Real, D>(s[3], e);
  at.r_x_rate = combine_nodes<Real, D>(s[1], rate);
  at.r_xx_rate = combine_nodes<Real, D>(s[2], rate);
  at.x_rate = x_rate;
  at.v = combine_nodes<Real, D>(s[0], rate) + at.r_x * x_rate;
  at.remainder = at.r_x_rate * Real(Real(2) * x_rate) + at.r_xx * Real(x_rate * x_rate);
  return at;
}

/// What a rider adds to M a - Q of its element's nodes and of x.
template <class Real, int D>
struct RiderForce {
  std::array<Vec<Real, D>, 4> nodes;
  Real x;
  Real dissipation;  ///< [W]
};

/// `a`, `a_x` are accelerations of the element's nodes and of x. Of a held rider x'' takes the place of its equation.
template <class Real, int D>
RiderForce<Real, D> rider_residual(const RiderMotion<Real, D>& at, const NodalCubic<Real, D>& a, const Real& a_x,
                                   const SlidingJoint& joint, const Vec<double, D>& gravity, bool held) {
  Vec<Real, D> pull = combine_nodes<Real, D>(at.s, a) - gravity.template cast<Real>();
  if (!held) pull += at.r_x * a_x + at.remainder;
  RiderForce<Real, D> force;
  for (std::size_t i = 0; i < 4; ++i) force.nodes[i] = pull * Real(at.s[i] * joint.mass);
  force.dissipation = Real(0);
  force.x = held ? Real(a_x * joint.mass) : Real(at.r_x.dot(pull) * joint.mass);
  if (!held && joint.friction) {
    const auto friction =
        friction_force<Real, D>(*joint.friction, pull * Real(joint.mass), Contact<Real, D>(at.r_x), at.x_rate);
    force.x -= friction.force;
    force.dissipation = friction.dissipation;
  }
  return force;
}

/// Tangent of rider_residual(), q = (r_A, s_A, r_B, s_B, x).
template <int D>
Eigen::Matrix<double, 4 * D + 1, 4 * D + 1> rider_tangent(const RiderMotion<double, D>& at,
                                                          const NodalCubic<double, D>& a, double a_x,
                                                          const SlidingJoint& joint, const Vec<double, D>& gravity,
                                                          bool held, const TangentWeights& by) {
  using Vector = Vec<double, D>;
  constexpr int x = 4 * D;
  Eigen::Matrix<double, 4 * D + 1, 4 * D + 1> tangent = Eigen::Matrix<double, 4 * D + 1, 4 * D + 1>::Zero();
  const double m = joint.mass;
  std::array<double, 4> by_node;  // of the acceleration: times the identity
  for (std::size_t j = 0; j < 4; ++j) {
    by_node[j] = by.a * at.s[j];
    if (!held) {
      by_node[j] +=
          by.v * 2 * at.s_x[j] * at.x_rate + by.q * (at.s_x[j] * a_x) + by.q * (at.s_xx[j] * at.x_rate * at.x_rate);
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      tangent.template block<D, D>(D * i, D * j)
          .diagonal()
          .setConstant(m * at.s[static_cast<std::size_t>(i)] * by_node[static_cast<std::size_t>(j)]);
    }
  }
  if (held) {
    tangent(x, x) = by.a * m;
    return tangent;
  }
  const Vector pull = combine_nodes<double, D>(at.s, a) + at.r_x * a_x + at.remainder - gravity;
  const Vector along = combine_nodes<double, D>(at.s_x, a) + at.r_xx * a_x + 2 * at.x_rate * at.r_xx_rate +
                       at.x_rate * at.x_rate * at.r_xxx;
  const Vector by_x = by.q * along + by.v * 2 * (at.r_x_rate + at.x_rate * at.r_xx) + by.a * at.r_x;
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    tangent.template block<D, 1>(D * i, x) = m * (by.q * at.s_x[k] * pull + at.s[k] * by_x);
    tangent.template block<1, D>(x, D * i) = m * (by.q * at.s_x[k] * pull + by_node[k] * at.r_x).transpose();
  }
  tangent(x, x) = m * (by.q * at.r_xx.dot(pull) + at.r_x.dot(by_x));
  if (!joint.friction) return tangent;

  constexpr int N = 2 * D + 1;  // friction by pull, slope and x'
  using Real = Active<N>;
  Vec<Real, D> active_pull, active_slope;
  for (int c = 0; c < D; ++c) {
    active_pull[c] = Real(pull[c], c);
    active_slope[c] = Real(at.r_x[c], D + c);
  }
  const Real force = friction_force<Real, D>(*joint.friction, active_pull * Real(m), Contact<Real, D>(active_slope),
                                             Real(at.x_rate, 2 * D))
                         .force;
  if (force.derivatives().size() == 0) return tangent;
  const Vector by_pull = force.derivatives().template head<D>(), by_slope = force.derivatives().template segment<D>(D);
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    tangent.template block<1, D>(x, D * i) -= (by_node[k] * by_pull + by.q * at.s_x[k] * by_slope).transpose();
  }
  tangent(x, x) -= by_pull.dot(by_x) + by.q * by_slope.dot(at.r_xx) + by.v * force.derivatives()[2 * D];
  return tangent;
}

/// What a beam without its rider answers to forces on the rider's element: the columns of M^-1 there.
template <int D>
class RiderMass {
 public:
  static constexpr int B = node_size<D>;
  using Answer = Eigen::Matrix<double, D, D>;

  /// Two spans that share their open node, and one of their elements.
  RiderMass(const Span<D>& left, const Span<D>& right, int nodes, int element) : first_(Eigen::Index{B} * element) {
    answer_.resize(Eigen::Index{B} * nodes, 2 * B);
    update(left, right);
  }

  /// Anew, for supports that stand otherwise.
  void update(const Span<D>& left, const Span<D>& right) {
    answer_.setZero();
    for (int i = 0; i < 2 * B; ++i) {
      answer_(first_ + i, i) = 1;
      solve_without_joint(left, right, answer_.col(i).data());
    }
  }

  /// Acceleration of the point with shape functions `s` under a force there.
  Answer at(const std::array<double, 4>& s) const {
    Answer sum = Answer::Zero();
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        sum += s[static_cast<std::size_t>(i)] * s[static_cast<std::size_t>(j)] *
               answer_.template block<D, D>(first_ + Eigen::Index{D} * i, Eigen::Index{D} * j);
      }
    }
    return sum;
  }

  /// Adds the accelerations under that force to the nodal array `a`.
  void add(const std::array<double, 4>& s, const Vec<double, D>& force, double* a) const {
    Eigen::Matrix<double, 2 * B, 1> nodal;
    for (int i = 0; i < 4; ++i) nodal.template segment<D>(Eigen::Index{D} * i) = s[static_cast<std::size_t>(i)] * force;
    Eigen::Map<Eigen::VectorXd>(a, answer_.rows()).noalias() += answer_ * nodal;
  }

 private:
  Eigen::Index first_;
  Eigen::Matrix<double, Eigen::Dynamic, 2 * B> answer_;
};

template <int D>
struct RiderSolution {
  Vec<double, D> force;  ///< on the mass [N]
  double x;              ///< acceleration of x [m/s^2]
  double dissipation;    ///< by friction [W]
  double contact;        ///< generalized force of the support on the x of a held rider [N]
};

/// Solves M a = f of a beam and its rider: `a` holds the accelerations of the beam's nodes without the rider and is
/// completed, `offset` is r_v - g of the mass, `x_force` the force on x without friction. With an offset of zero, a
/// momentum on x and `friction` off the same gives velocities. Empty where friction jams.
template <int D>
std::optional<RiderSolution<D>> solve_with_rider(const RiderMass<D>& mass, const SlidingJoint& joint,
                                                 const RiderMotion<double, D>& at, const NodalCubic<double, D>& nodes,
                                                 const Vec<double, D>& offset, double x_force, bool held, bool friction,
                                                 double* a) {
  using Vector = Vec<double, D>;
  // F = m (S a_0 - C F + r_x x'' + offset), r_x.F = force on x
  typename RiderMass<D>::Answer compliance = mass.at(at.s);
  compliance.diagonal().array() += 1 / joint.mass;
  const Eigen::LLT<typename RiderMass<D>::Answer> factor(compliance);
  if (factor.info() != Eigen::Success) return std::nullopt;
  RiderSolution<D> solved{factor.solve(combine_nodes<double, D>(at.s, nodes) + offset), 0, 0, 0};
  if (held) {
    solved.contact = at.r_x.dot(solved.force);
  } else {
    const Vector by_x = factor.solve(at.r_x);
    const double stiffness = at.r_x.dot(by_x);
    solved.x = (x_force - at.r_x.dot(solved.force)) / stiffness;
    solved.force += solved.x * by_x;
    if (friction && joint.friction) {
      const Contact<double, D> contact(at.r_x);
      const double share = contact.share(*joint.friction, at.x_rate), x_1 = contact.stretch() / stiffness;
      const auto pressing = pressing_force<D>(contact.pressing(solved.force), contact.pressing(x_1 * by_x), share);
      if (!pressing) return std::nullopt;
      solved.x -= share * *pressing * x_1;
      solved.force -= share * *pressing * x_1 * by_x;
      solved.dissipation = share * *pressing * contact.stretch() * at.x_rate;
    }
  }
  mass.add(at.s, -solved.force, a);
  return solved;
}

}  // namespace vlbeam
