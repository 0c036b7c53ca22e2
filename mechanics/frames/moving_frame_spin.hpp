#pragma once

#include "mechanics/frames/moving_frame.hpp"

namespace vlbeam {

// Spin about the tangent along an element of a beam with frames whose ends move. The triad of a node spins by
// Omega = phi' + A.s'. It is that of the material point at the mark; the material point itself spins by
//   omega = Omega - tau x',  tau = Delta/l,
// Delta the twist of the element. It is linear between the ends, as it is in elements whose ends rest:
//   T = rho I_p l (omega_A^2 + omega_A omega_B + omega_B^2)/6.
// With the momenta p_A = rho I_p l (2 omega_A + omega_B)/6, p_B, and P = p_A x_A' + p_B x_B' Lagrange's equations are
//   p_A' + P dtau/dchi_A                                     on phi_A,
//   A (that) + p_A s_A' x C + P dtau/ds_A                    on s_A,
//   P dtau/dr_A                                              on r_A,
//   -(tau p_A)' + P dtau/dx_A + T/l                          on x_A, with -T/l on x_B.

/// The twist per length [rad/m] with its gradient at fixed nodal coordinates; by spins it is -1/l and 1/l.
template <class Real>
struct TwistRate {
  Real l, tau;
  Vec<Real, 3> by_chord, by_s_a, by_s_b;  ///< while sections have no spin about their tangents
  Real by_length;

  /// `middle` are the shape functions of a table of length 1.
  TwistRate(const std::array<double, 3>& middle, const FrameEnds<Real>& ends, const Real& length) : l(length) {
    using std::sqrt;
    using Vector = Vec<Real, 3>;
    const Vector mid = ends.chord * Real(middle[0]) + (ends.s_a * Real(middle[1]) + ends.s_b * Real(middle[2])) * l;
    const Real size = sqrt(mid.dot(mid)), size_a = sqrt(ends.s_a.dot(ends.s_a)), size_b = sqrt(ends.s_b.dot(ends.s_b));
    const Vector m = mid / size, t_a = ends.s_a / size_a, t_b = ends.s_b / size_b;
    const Vector d_a = carried<Real>(t_a, m, ends.d_a), d_b = carried<Real>(t_b, m, ends.d_b);
    const auto expected = sine_cosine(ends.turned);
    const Real along = d_a.dot(d_b), across = m.dot(d_a.cross(d_b));
    const Real twist = angle_of(Real(across * expected.cosine - along * expected.sine),
                                Real(along * expected.cosine + across * expected.sine)) +
                       ends.turned;
    const Vector w_a = t_a.cross(m) / Real(Real(1) + t_a.dot(m)), w_b = t_b.cross(m) / Real(Real(1) + t_b.dot(m));
    const Vector g = (w_a - w_b) / size;
    tau = twist / l;
    by_chord = g * Real(Real(middle[0]) / l);
    by_s_a = w_a / Real(size_a * l) + g * Real(middle[1]);
    by_s_b = g * Real(middle[2]) - w_b / Real(size_b * l);
    by_length = (g.dot(ends.s_a * Real(middle[1]) + ends.s_b * Real(middle[2])) - tau) / l;
  }
};

/// How an end moves: rates of its place and slope, the spin of its triad, the rate of its mark.
template <class Real>
struct FrameEndRates {
  Vec<Real, 3> r, s;
  Real spin, x;
};

/// Spins and momenta of an element, and what of the equations above knows no acceleration.
template <class Real>
struct MovingFrameSpin {
  Real share, grows;  ///< rho I_p l/6 [kg m^2], rate of l over l [1/s]
  Real tau, tau_rate, omega_a, omega_b, p_a, p_b, kinetic, flux;
  Vec<Real, 3> on_r_b, on_s_a, on_s_b;  ///< P dtau/d.; on r_A the opposite
  Real on_x_a, on_x_b;                  ///< -tau' p + P dtau/dx and T/l

  MovingFrameSpin(const TwistRate<Real>& twist, const FrameEndRates<Real>& a, const FrameEndRates<Real>& b,
                  double rhoIp)
      : share(twist.l * Real(rhoIp / 6)),
        grows((b.x - a.x) / twist.l),
        tau(twist.tau),
        tau_rate(twist.by_chord.dot(b.r - a.r) + twist.by_s_a.dot(a.s) + twist.by_s_b.dot(b.s) +
                 (b.spin - a.spin) / twist.l + twist.by_length * (b.x - a.x)),
        omega_a(a.spin - tau * a.x),
        omega_b(b.spin - tau * b.x),
        p_a(share * (omega_a + omega_a + omega_b)),
        p_b(share * (omega_a + omega_b + omega_b)),
        kinetic((omega_a * p_a + omega_b * p_b) * Real(0.5)),
        flux(p_a * a.x + p_b * b.x),
        x_rate_a(a.x),
        x_rate_b(b.x) {
    on_r_b = twist.by_chord * flux;
    on_s_a = twist.by_s_a * flux;
    on_s_b = twist.by_s_b * flux;
    const Real per_length = kinetic / twist.l, longer = flux * twist.by_length;
    on_x_a = per_length - longer - tau_rate * p_a;
    on_x_b = longer - per_length - tau_rate * p_b;
  }
  /// p' of both ends, whose triads spin up by these, and whose marks are accelerated so.
  std::array<Real, 2> momentum_rates(const Real& spin_a, const Real& spin_b, const Real& x_a, const Real& x_b) const {
    const Real a = spin_a - tau * x_a - tau_rate * x_rate_a, b = spin_b - tau * x_b - tau_rate * x_rate_b;
    return {share * (a + a + b) + grows * p_a, share * (a + b + b) + grows * p_b};
  }

 private:
  Real x_rate_a, x_rate_b;
};

/// M a - Q of the spin of one element, without elasticity, and its tangent with weights `by`. The arrays are those of
/// MovingFrame's coordinates, their rates and accelerations.
struct MovingFrameInertia {
  const TriadReference &from_a, &from_b;
  const std::array<double, 3>& middle;
  double turned, rhoIp;

  template <class Real>
  struct Node {
    Vec<Real, 3> s, A, d;
  };
  template <class Real>
  static Node<Real> node(const TriadReference& from, const Eigen::Matrix<Real, 16, 1>& q, int at) {
    Node<Real> node;
    node.s = q.template segment<3>(at + 3);
    node.A = from.spin_by_slope<Real>(node.s);
    node.d = from.direction<Real>(node.s, q[at + 6]);
    return node;
  }
  template <class Real>
  TwistRate<Real> twist(const Node<Real>& a, const Node<Real>& b, const Eigen::Matrix<Real, 16, 1>& q) const {
    const Vec<Real, 3> chord = q.template segment<3>(7) - q.template segment<3>(0);
    return {middle, FrameEnds<Real>{chord, a.s, b.s, a.d, b.d, turned}, Real(q[15] - q[14])};
  }

  template <class Real>
  Eigen::Matrix<Real, 16, 1> residual(const Eigen::Matrix<Real, 16, 1>& q, const Eigen::Matrix<Real, 16, 1>& rate,
                                      const Eigen::Matrix<Real, 16, 1>& a) const {
    using Vector = Vec<Real, 3>;
    const Real l = q[15] - q[14];
    struct Seen : Node<Real> {
      Vector v;
      Real bent;  ///< of the spin's rate what s'' and s' s' do
    };
    const auto see = [&](const TriadReference& from, int at) {
      Seen seen{node<Real>(from, q, at), rate.template segment<3>(at + 3), Real(0)};
      const Vector turning = from.spin_by_slope_gradient<Real>(seen.s) * seen.v,
                   bending = a.template segment<3>(at + 3);
      seen.bent = seen.A.dot(bending) + seen.v.dot(turning);
      return seen;
    };
    const Seen at_a = see(from_a, 0), at_b = see(from_b, 7);
    const auto rates = [&](const Seen& seen, int at, int x) -> FrameEndRates<Real> {
      return {rate.template segment<3>(at), seen.v, rate[at + 6] + seen.A.dot(seen.v), rate[x]};
    };
    const FrameEndRates<Real> rates_a = rates(at_a, 0, 14), rates_b = rates(at_b, 7, 15);
    const MovingFrameSpin<Real> spin(twist<Real>(at_a, at_b, q), rates_a, rates_b, rhoIp);
    Eigen::Matrix<Real, 16, 1> r;
    const auto p_rates = spin.momentum_rates(a[6] + at_a.bent, a[13] + at_b.bent, a[14], a[15]);
    const auto put = [&](const Seen& seen, int at, int x, const Real& p, const Real& p_rate, const Vector& on_s,
                         const Real& on_x, double sign) {
      using std::sqrt;
      const Real on_angle = p_rate + spin.flux / l * Real(sign), size = sqrt(seen.s.dot(seen.s));
      const Vector curl = seen.s / Real(size * size * size);
      r.template segment<3>(at) = spin.on_r_b * Real(sign);
      r.template segment<3>(at + 3) = seen.A * on_angle + seen.v.cross(curl) * p + on_s;
      r[at + 6] = on_angle;
      r[x] = on_x - spin.tau * p_rate;
    };
    put(at_a, 0, 14, spin.p_a, p_rates[0], spin.on_s_a, spin.on_x_a, -1);
    put(at_b, 7, 15, spin.p_b, p_rates[1], spin.on_s_b, spin.on_x_b, 1);
    return r;
  }

  /// What a torque about the tangent at u does, on the material point there.
  template <class Real>
  Eigen::Matrix<Real, 16, 1> torque(const Eigen::Matrix<Real, 16, 1>& q, const Real& u, const Real& size) const {
    const Node<Real> a = node<Real>(from_a, q, 0), b = node<Real>(from_b, q, 7);
    const Real on_a = (Real(1) - u) * size, on_b = u * size, tau = twist<Real>(a, b, q).tau;
    Eigen::Matrix<Real, 16, 1> f;
    f.template segment<3>(0).setZero();
    f.template segment<3>(7).setZero();
    f.template segment<3>(3) = a.A * on_a;
    f.template segment<3>(10) = b.A * on_b;
    f[6] = on_a;
    f[13] = on_b;
    f[14] = -(tau * on_a);
    f[15] = -(tau * on_b);
    return f;
  }
};

}  // namespace vlbeam
