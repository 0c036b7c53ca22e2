#pragma once

#include <array>

#include "core/element/shape_functions.hpp"
#include "core/element/transport.hpp"

namespace vlbeam {

// A variable-length element: the rational cubic of an ordinary element between two ends whose material coordinates
// x_A(t), x_B(t) move (ALE-RANCF, Ding & Ouyang 2022, section 3). Its position at a material point x is
//   r(x, t) = S(x; x_A, x_B) e,   velocity v = S e' + y_A x_A' + y_B x_B',   acceleration S e'' + y_A x_A'' + y_B x_B''
//   + r_v,
// where y_A = dr/dx_A and y_B = dr/dx_B at fixed x (N = [S, y_A, y_B], Eq. 14-15).

/// Which ends' material coordinates may change; what the other would add is then not computed.
enum class MovingEnds { a, b, both };

/// Generalized coordinates of one element, or their rates.
template <class Real, int D>
struct MovingCoordinates {
  NodalCubic<Real, D> e;
  Real x_a, x_b;
};

/// The rational cubic W(x) of `transported` weights: Bernstein coefficients on a reference interval of material
/// coordinates. With `frozen` weights only the coefficients count, whatever the element's current interval.
struct WeightFunction {
  Weights<double> w = unit_weights;
  double x_a = 0, x_b = 1;

  /// The weights on the interval [a, b], its W continued analytically where it reaches beyond the reference.
  template <class Real>
  Weights<Real> on(const Real& a, const Real& b) const {
    const Weights<Real> reference{Real(w[0]), Real(w[1]), Real(w[2]), Real(w[3])};
    const double inverse = 1 / (x_b - x_a);
    return restrict_cubic(reference, Real((a - Real(x_a)) * Real(inverse)), Real((b - Real(x_a)) * Real(inverse)));
  }
};

/// Motion of one point of a variable-length element, at u, as functions of its coordinates and their rates.
/// Derivatives with respect to the material coordinate at fixed time carry a subscript of x's.
template <class Real, int D>
struct PointMotion {
  std::array<Real, 4> s, s_x, s_xx;  ///< shape functions of (r_A, s_A, r_B, s_B)
  Vec<Real, D> r, r_x, r_xx, r_xxx;
  Vec<Real, D> y_a, y_a_x, y_a_xx;  ///< dr/dx_A at fixed x
  Vec<Real, D> y_b, y_b_x, y_b_xx;  ///< dr/dx_B at fixed x
  Vec<Real, D> v, v_x, v_xx;        ///< velocity of the material point
  Vec<Real, D> remainder;           ///< r_v: acceleration at q'' = 0
};

/// Kinematics of a variable-length element in one configuration, evaluated at any number of points.
template <class Real, int D, MovingEnds Ends = MovingEnds::both>
class MovingKinematics {
 public:
  using Vector = Vec<Real, D>;
  static constexpr bool a_moves = Ends != MovingEnds::b, b_moves = Ends != MovingEnds::a;

  MovingKinematics(const MovingCoordinates<Real, D>& q, const MovingCoordinates<Real, D>& rate,
                   WeightTransport transport, const WeightFunction& weights)
      : q_(q), rate_(rate), transported_(transport == WeightTransport::transported) {
    l_ = q.x_b - q.x_a;
    inverse_ = Real(1) / l_;
    inverse2_ = inverse_ * inverse_;
    l_rate_ = rate.x_b - rate.x_a;
    if (transported_) {
      weights_ = weights.on(q.x_a, q.x_b);
      prepare_transport();
    } else {
      for (std::size_t i = 0; i < 4; ++i) weights_[i] = Real(weights.w[i]);
    }
  }

  const Real& length() const { return l_; }
  const Real& length_rate() const { return l_rate_; }
  const Weights<Real>& weights() const { return weights_; }
  /// Velocity of the reference point u along the beam, c = x_A' (1 - u) + x_B' u.
  template <class Parameter>
  Real mesh_velocity(const Parameter& u) const {
    return rate_.x_a * (1 - u) + rate_.x_b * u;
  }
  const MovingCoordinates<Real, D>& coordinates() const { return q_; }
  const MovingCoordinates<Real, D>& rates() const { return rate_; }

  /// `f` holds the shape functions of `weights()` at u. Nothing is set for an end that does not move.
  /// Tabulated ones are plain numbers, whatever `Real` is.
  template <class Parameter, class Shape>
  [[gnu::always_inline]] PointMotion<Real, D> at(const Parameter& u, const ShapeTable<Shape>& f) const {
    PointMotion<Real, D> point;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i % 2 == 0) {
        point.s[i] = f[i][0];
        point.s_x[i] = inverse_ * f[i][1];
        point.s_xx[i] = inverse2_ * f[i][2];
      } else {
        point.s[i] = l_ * f[i][0];
        point.s_x[i] = f[i][1];
        point.s_xx[i] = inverse_ * f[i][2];
      }
    }
    point.r = combine(point.s, q_.e);
    point.r_x = combine(point.s_x, q_.e);
    point.r_xx = combine(point.s_xx, q_.e);
    point.r_xxx = derivative(f, 3, q_.e) * Real(inverse2_ * inverse_);
    if (transported_) {
      transport_weights(point);
    } else {
      freeze_weights(u, f, point);
    }
    return point;
  }

 private:
  static Vector combine(const std::array<Real, 4>& s, const NodalCubic<Real, D>& e) {
    return e.r_a * s[0] + e.s_a * s[1] + e.r_b * s[2] + e.s_b * s[3];
  }
  template <class Shape>
  Vector derivative(const ShapeTable<Shape>& f, std::size_t n, const NodalCubic<Real, D>& e) const {
    return e.r_a * f[0][n] + e.r_b * f[2][n] + (e.s_a * f[1][n] + e.s_b * f[3][n]) * l_;
  }

  /// Constant weights: u and l change under a fixed material point.
  template <class Parameter, class Shape>
  [[gnu::always_inline]] void freeze_weights(const Parameter& u, const ShapeTable<Shape>& f,
                                             PointMotion<Real, D>& point) const {
    auto slopes = [&](std::size_t n, const NodalCubic<Real, D>& e) -> Vector {
      return e.s_a * f[1][n] + e.s_b * f[3][n];
    };
    const Real ul = inverse_ * u, vl = inverse_ * (1 - u);
    const Vector d1 = derivative(f, 1, q_.e), d2 = derivative(f, 2, q_.e);
    const Vector d3 = derivative(f, 3, q_.e);
    const Vector g0 = slopes(0, q_.e), g1 = slopes(1, q_.e), g2 = slopes(2, q_.e);
    const Vector w1 = derivative(f, 1, rate_.e);
    point.v = combine(point.s, rate_.e);
    point.v_x = w1 * inverse_;
    point.v_xx = combine(point.s_xx, rate_.e);
    if constexpr (a_moves) {
      point.y_a = -d1 * vl - g0;
      point.y_a_x = (d1 * inverse_ - d2 * vl - g1) * inverse_;
      point.y_a_xx = (d2 * Real(Real(2) * inverse_) - d3 * vl - g2) * inverse2_;
      point.v += point.y_a * rate_.x_a;
      point.v_x += point.y_a_x * rate_.x_a;
      point.v_xx += point.y_a_xx * rate_.x_a;
    }
    if constexpr (b_moves) {
      point.y_b = -d1 * ul + g0;
      point.y_b_x = (-d1 * inverse_ - d2 * ul + g1) * inverse_;
      point.y_b_xx = (-d2 * Real(Real(2) * inverse_) - d3 * ul + g2) * inverse2_;
      point.v += point.y_b * rate_.x_b;
      point.v_x += point.y_b_x * rate_.x_b;
      point.v_xx += point.y_b_xx * rate_.x_b;
    }
    const Real u_rate = -mesh_velocity(u) * inverse_;
    const Real u_rate2 = Real(-2) * u_rate * l_rate_ * inverse_;  // second derivative of u at fixed x
    point.remainder = slopes(0, rate_.e) * Real(Real(2) * l_rate_) + (w1 + g1 * l_rate_) * Real(Real(2) * u_rate) +
                      d2 * Real(u_rate * u_rate) + d1 * u_rate2;
  }

  /// Weights that belong to the material points: the ordinary element between moving ends, pulled back to the
  /// nodes by the nodal material velocities V = (r_A' - s_A x_A', s_A' - k_A x_A', ...), k = r_xx at that end.
  void prepare_transport() {
    const auto at_a = rational_shape(weights_, Real(0)), at_b = rational_shape(weights_, Real(1));
    const Real inverse3 = inverse2_ * inverse_;
    k_a_ = derivative(at_a, 2, q_.e) * inverse2_;
    k_b_ = derivative(at_b, 2, q_.e) * inverse2_;
    const Vector j_a = derivative(at_a, 3, q_.e) * inverse3, j_b = derivative(at_b, 3, q_.e) * inverse3;
    material_ = {rate_.e.r_a - q_.e.s_a * rate_.x_a, rate_.e.s_a - k_a_ * rate_.x_a, rate_.e.r_b - q_.e.s_b * rate_.x_b,
                 rate_.e.s_b - k_b_ * rate_.x_b};
    const Vector kv_a = derivative(at_a, 2, material_) * inverse2_, kv_b = derivative(at_b, 2, material_) * inverse2_;
    const Real xa2 = rate_.x_a * rate_.x_a, xb2 = rate_.x_b * rate_.x_b;
    remainder_ = {k_a_ * xa2 - rate_.e.s_a * Real(Real(2) * rate_.x_a), -kv_a * Real(Real(2) * rate_.x_a) - j_a * xa2,
                  k_b_ * xb2 - rate_.e.s_b * Real(Real(2) * rate_.x_b), -kv_b * Real(Real(2) * rate_.x_b) - j_b * xb2};
  }

  void transport_weights(PointMotion<Real, D>& point) const {
    auto moving_end = [&](const std::array<Real, 4>& s, std::size_t i, const Vector& slope, const Vector& k) -> Vector {
      return -(slope * s[i] + k * s[i + 1]);
    };
    if constexpr (a_moves) {
      point.y_a = moving_end(point.s, 0, q_.e.s_a, k_a_);
      point.y_a_x = moving_end(point.s_x, 0, q_.e.s_a, k_a_);
      point.y_a_xx = moving_end(point.s_xx, 0, q_.e.s_a, k_a_);
    }
    if constexpr (b_moves) {
      point.y_b = moving_end(point.s, 2, q_.e.s_b, k_b_);
      point.y_b_x = moving_end(point.s_x, 2, q_.e.s_b, k_b_);
      point.y_b_xx = moving_end(point.s_xx, 2, q_.e.s_b, k_b_);
    }
    point.v = combine(point.s, material_);
    point.v_x = combine(point.s_x, material_);
    point.v_xx = combine(point.s_xx, material_);
    point.remainder = combine(point.s, remainder_);
  }

  MovingCoordinates<Real, D> q_, rate_;
  bool transported_;
  Real l_, inverse_, inverse2_, l_rate_;
  Weights<Real> weights_;
  Vector k_a_, k_b_;
  NodalCubic<Real, D> material_, remainder_;
};

}  // namespace vlbeam
