#pragma once

#include <cmath>

#include "core/element/fixed_element.hpp"
#include "core/element/moving_element.hpp"

/// Discrete gradients of an element's Lagrangian between two states of motion (Gonzalez 1996), in closed form: every
/// energy is a sum of products of functions of one argument, and the change of a product is
///   d(a b) = (mean of a) d(b) + (mean of b) d(a),
/// exactly. Each is symmetric in its two states, becomes the gradient where they meet and needs no division by their
/// distance.
namespace vlbeam {

template <class Real>
struct TwoStates {
  Real before, after;
  Real mean() const { return (before + after) * 0.5; }
};

template <class Vector>
Vector mean(const Vector& a, const Vector& b) {
  return (a + b) * 0.5;
}

/// Generalized stresses p [N] and m [N m] with p . d(r_x) + m . d(r_xx) = d(W), the change of strain energy per length.
/// With g = r_x.r_x and F = r_x x r_xx, which is bilinear, W = phi(g) + EI F.F/(2 g^n), n = 3 (green) or 2
/// (engineering).
template <int D>
struct MeanStress {
  using Vector = Vec<double, D>;
  Vector p, m;
  double energy;  ///< W, mean of the two states [J/m]

  MeanStress(const TwoStates<Vector>& r_x, const TwoStates<Vector>& r_xx, const Stiffness& k) {
    const double g0 = r_x.before.dot(r_x.before), g1 = r_x.after.dot(r_x.after);
    const Vector slope = mean(r_x.before, r_x.after);  // d(g) = 2 slope . d(r_x)
    double along;
    if (k.green()) {
      const double strain0 = 0.5 * (g0 - 1), strain1 = 0.5 * (g1 - 1);
      along = k.EA * 0.5 * (strain0 + strain1);
      energy = 0.25 * k.EA * (strain0 * strain0 + strain1 * strain1);
    } else {
      const double stretch0 = std::sqrt(g0), stretch1 = std::sqrt(g1);
      along = k.EA * (1 - 2 / (stretch0 + stretch1));
      energy = 0.25 * k.EA * ((stretch0 - 1) * (stretch0 - 1) + (stretch1 - 1) * (stretch1 - 1));
    }
    m.setZero();
    if (k.bends()) {
      // b(g) = g^-n: its two values and its divided difference
      const double i0 = 1 / g0, i1 = 1 / g1;
      double b0 = i0 * i0, b1 = i1 * i1, b_by_g = -i0 * i1 * (i0 + i1);
      if (k.green()) {
        b_by_g = -i0 * i1 * (b0 + i0 * i1 + b1);
        b0 *= i0;
        b1 *= i1;
      }
      const auto F0 = cross(r_x.before, r_xx.before), F1 = cross(r_x.after, r_xx.after);
      const double squared0 = F0.dot(F0), squared1 = F1.dot(F1);
      along += 0.5 * k.EI * (squared0 + squared1) * b_by_g;
      const double scale = 0.5 * k.EI * (b0 + b1);
      const auto F = (0.5 * (F0 + F1)).eval();
      p = across(F, mean(r_xx.before, r_xx.after)) * -scale;
      m = across(F, slope) * scale;
      energy += 0.25 * k.EI * (squared0 * b0 + squared1 * b1);
    } else {
      p.setZero();
    }
    p += slope * along;
  }

 private:
  using Axis = Vec<double, D == 2 ? 1 : 3>;
  static Axis cross(const Vector& a, const Vector& b) {
    if constexpr (D == 2) {
      return Axis(a[0] * b[1] - a[1] * b[0]);
    } else {
      return a.cross(b);
    }
  }
  /// F x a, such that F . (a x b) = b . (F x a).
  static Vector across(const Axis& f, const Vector& a) {
    if constexpr (D == 2) {
      return {-f[0] * a[1], f[0] * a[0]};
    } else {
      return f.cross(a);
    }
  }
};

/// Forces of a fixed-length element whose work between two states is minus the change of strain energy, and the viscous
/// ones of the mean state moving at the mean rate.
template <int D>
FixedForce<double, D> mean_fixed_force(const FixedBasis<double>& basis, const TwoStates<NodalCubic<double, D>>& e,
                                       const NodalCubic<double, D>& mean_rate, const BeamSection& section) {
  using Vector = Vec<double, D>;
  FixedForce<double, D> force{Vector::Zero(), Vector::Zero(), Vector::Zero(), 0};
  auto at = [](const std::array<double, 3>& s, const NodalCubic<double, D>& c) -> Vector {
    return (c.r_b - c.r_a) * s[0] + c.s_a * s[1] + c.s_b * s[2];
  };
  basis.visit(section, [&](const auto& point, const BeamSection& felt, std::size_t /*index*/) {
    const TwoStates<Vector> r_x{at(point.s_x, e.before), at(point.s_x, e.after)};
    const TwoStates<Vector> r_xx{at(point.s_xx, e.before), at(point.s_xx, e.after)};
    const MeanStress<D> stress(r_x, r_xx, felt.stiffness);
    Vector p = stress.p, m = stress.m;
    if (felt.damped()) {
      const DampingStress<double, D> viscous(mean(r_x.before, r_x.after), mean(r_xx.before, r_xx.after),
                                             at(point.s_x, mean_rate), at(point.s_xx, mean_rate), felt.stiffness,
                                             felt.damping, felt.curvature_regularization);
      p += viscous.p;
      m += viscous.m;
      force.dissipation += point.weight * viscous.power;
    }
    force.r_b -= (p * point.s_x[0] + m * point.s_xx[0]) * point.weight;
    force.s_a -= (p * point.s_x[1] + m * point.s_xx[1]) * point.weight;
    force.s_b -= (p * point.s_x[2] + m * point.s_xx[2]) * point.weight;
  });
  return force;
}

/// A force, or a change of momentum, on the nodal coordinates (r_A, s_A, r_B, s_B) and the moving end of an element.
template <int D>
struct MovingForce {
  std::array<Vec<double, D>, 4> nodes;
  double end;
  double dissipation;  ///< [W]
};

/// Residual of one step of length h of a variable-length element of which one end moves, weights frozen:
/// (p_1 - p_0)/h - f with the momentum p = dL/dq' of the discrete Lagrangian, L = T - V, and f the discrete gradient in
/// q of v_0.M(q) v_1/2 - V(q). Where q_1 - q_0 = h (v_0 + v_1)/2 the work of f is then minus the change of T + V: with
/// T = v.p/2 and a symmetric M,
///   T_1 - T_0 = (v_0 + v_1)/2 . (p_1 - p_0) - v_0.(M_1 - M_0) v_1/2.
template <MovingEnds Ends, int D>
MovingForce<D> conserving_residual(const TwoStates<MovingCoordinates<double, D>>& q,
                                   const TwoStates<MovingCoordinates<double, D>>& rate, double h,
                                   const WeightFunction& weights, const ShapeTabulation& table,
                                   const MovingLaw<D>& law) {
  using Vector = Vec<double, D>;
  static_assert(Ends != MovingEnds::both);
  constexpr double sign = Ends == MovingEnds::b ? 1 : -1;  // of dl/dx at the moving end
  const FeltSections sections(law.section);
  auto length = [](const MovingCoordinates<double, D>& c) { return c.x_b - c.x_a; };
  auto end_of = [](const MovingCoordinates<double, D>& c) { return Ends == MovingEnds::b ? c.x_b : c.x_a; };
  auto chord = [](const NodalCubic<double, D>& e) -> Vector { return e.r_b - e.r_a; };
  const NodalCubic<double, D>&e0 = q.before.e, &e1 = q.after.e;
  const double l0 = length(q.before), l1 = length(q.after), l = 0.5 * (l0 + l1);
  const double i0 = 1 / l0, i1 = 1 / l1;
  // means of 1/l and 1/l^2, and their divided differences by l
  const double i = 0.5 * (i0 + i1), ii = 0.5 * (i0 * i0 + i1 * i1), i_by_l = -i0 * i1, ii_by_l = -i0 * i1 * (i0 + i1);
  const Vector chord0 = chord(e0), chord1 = chord(e1), chord_mean = mean(chord0, chord1);
  const Vector s_a = mean(e0.s_a, e1.s_a), s_b = mean(e0.s_b, e1.s_b);

  MovingForce<D> r;
  for (auto& node : r.nodes) node.setZero();
  r.end = r.dissipation = 0;

  const MovingCoordinates<double, D> middle{{mean(e0.r_a, e1.r_a), s_a, mean(e0.r_b, e1.r_b), s_b},
                                            0.5 * (q.before.x_a + q.after.x_a),
                                            0.5 * (q.before.x_b + q.after.x_b)};
  const MovingCoordinates<double, D> middle_rate{
      {mean(rate.before.e.r_a, rate.after.e.r_a), mean(rate.before.e.s_a, rate.after.e.s_a),
       mean(rate.before.e.r_b, rate.after.e.r_b), mean(rate.before.e.s_b, rate.after.e.s_b)},
      0.5 * (rate.before.x_a + rate.after.x_a),
      0.5 * (rate.before.x_b + rate.after.x_b)};
  const MovingKinematics<double, D, Ends> kinematics(middle, middle_rate, WeightTransport::frozen, weights);

  for (std::size_t g = 0; g < table.rule.size(); ++g) {
    const BeamPoint& here = table.rule[g];
    const double u = here.u, w = here.weight;  // no structured binding: clang 14 lets no lambda hold one
    const BeamSection& section = sections[here.feels];
    const double rhoA = section.rhoA;
    const ShapeTable<double>& f = table.shape[g];
    const double reach = Ends == MovingEnds::b ? u : 1 - u;  // share of the end's material velocity at u
    auto slopes = [&](std::size_t n, const NodalCubic<double, D>& e) -> Vector {
      return e.s_a * f[1][n] + e.s_b * f[3][n];
    };
    auto r_of = [&](const NodalCubic<double, D>& e, double length_) -> Vector {
      return e.r_a * f[0][0] + e.r_b * f[2][0] + slopes(0, e) * length_;
    };
    const Vector g0 = slopes(0, e0), g1 = slopes(0, e1), g_mean = mean(g0, g1);
    const TwoStates<Vector> r_x{chord0 * (f[2][1] * i0) + slopes(1, e0), chord1 * (f[2][1] * i1) + slopes(1, e1)};
    const TwoStates<Vector> r_xx{(chord0 * (f[2][2] * i0) + slopes(2, e0)) * i0,
                                 (chord1 * (f[2][2] * i1) + slopes(2, e1)) * i1};

    // material velocity in a configuration, of the rates of either state
    auto velocity = [&](const MovingCoordinates<double, D>& motion, double length_, const Vector& slope_sum,
                        const Vector& tangent) -> Vector {
      return r_of(motion.e, length_) + (slope_sum * sign - tangent * reach) * end_of(motion);
    };
    const Vector a0 = velocity(rate.before, l0, g0, r_x.before), a1 = velocity(rate.before, l1, g1, r_x.after);
    const Vector b0 = velocity(rate.after, l0, g0, r_x.before), b1 = velocity(rate.after, l1, g1, r_x.after);

    // change of momentum over h
    auto add_momentum = [&](const Vector& v, double length_, const Vector& slope_sum, const Vector& tangent,
                            double scale) {
      const Vector mv = v * (scale * rhoA * w * length_ / h);
      r.nodes[0] += mv * f[0][0];
      r.nodes[1] += mv * (f[1][0] * length_);
      r.nodes[2] += mv * f[2][0];
      r.nodes[3] += mv * (f[3][0] * length_);
      r.end += mv.dot(slope_sum * sign - tangent * reach);
    };
    add_momentum(b1, l1, g1, r_x.after, 1);
    add_momentum(a0, l0, g0, r_x.before, -1);

    // discrete gradient of l (rhoA a.b/2 - W + rhoA g.r): forces conjugate to a, b, r, r_x, r_xx and l
    const MeanStress<D> stress(r_x, r_xx, section.stiffness);
    const Vector f_a = mean(b0, b1) * (0.5 * rhoA * w * l), f_b = mean(a0, a1) * (0.5 * rhoA * w * l);
    const Vector f_r = law.gravity * (rhoA * w * l);
    const Vector f_x = stress.p * (-w * l) - (f_a * end_of(rate.before) + f_b * end_of(rate.after)) * reach;
    const Vector f_xx = stress.m * (-w * l);
    const Vector f_slopes = f_r * l + (f_a * end_of(rate.before) + f_b * end_of(rate.after)) * sign;
    const Vector f_chord = f_x * (f[2][1] * i) + f_xx * (f[2][2] * ii);
    const double per_length = 0.25 * rhoA * (a0.dot(b0) + a1.dot(b1)) - stress.energy +
                              0.5 * rhoA * law.gravity.dot(r_of(e0, l0) + r_of(e1, l1));
    const Vector slopes2 = s_a * f[1][2] + s_b * f[3][2];
    const double f_l = w * per_length + f_a.dot(slopes(0, rate.before.e)) + f_b.dot(slopes(0, rate.after.e)) +
                       f_r.dot(g_mean) + f_x.dot(chord_mean) * (f[2][1] * i_by_l) +
                       f_xx.dot(chord_mean * (f[2][2] * ii_by_l) + slopes2 * i_by_l);
    r.nodes[0] -= f_r * f[0][0] - f_chord;
    r.nodes[1] -= f_slopes * f[1][0] + f_x * f[1][1] + f_xx * (f[1][2] * i);
    r.nodes[2] -= f_r * f[2][0] + f_chord;
    r.nodes[3] -= f_slopes * f[3][0] + f_x * f[3][1] + f_xx * (f[3][2] * i);
    r.end -= sign * f_l;

    if (section.damped()) {
      const PointMotion<double, D> at = kinematics.at(u, f);
      const DampingStress<double, D> viscous(at.r_x, at.r_xx, at.v_x, at.v_xx, section.stiffness, section.damping,
                                             section.curvature_regularization);
      const double wl = w * kinematics.length();
      for (std::size_t c = 0; c < 4; ++c) r.nodes[c] += (viscous.p * at.s_x[c] + viscous.m * at.s_xx[c]) * wl;
      r.end += wl * (Ends == MovingEnds::b ? viscous.p.dot(at.y_b_x) + viscous.m.dot(at.y_b_xx)
                                           : viscous.p.dot(at.y_a_x) + viscous.m.dot(at.y_a_xx));
      r.dissipation += wl * viscous.power;
    }
  }
  return r;
}

}  // namespace vlbeam
