#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/tangent_weights.hpp"
#include "mechanics/time/archive.hpp"
#include "mechanics/time/assign.hpp"
#include "mechanics/time/energy_balance.hpp"

namespace vlbeam {

/// Coefficients of the generalized-alpha method (Arnold & Bruels 2007).
struct AlphaRule {
  /// By the spectral radius at infinity.
  explicit AlphaRule(double rho_inf)
      : alpha_m((2 * rho_inf - 1) / (rho_inf + 1)),
        alpha_f(rho_inf / (rho_inf + 1)),
        gamma(0.5 + alpha_f - alpha_m),
        beta(0.25 * (gamma + 0.5) * (gamma + 0.5)) {}

  double alpha_m, alpha_f, gamma, beta;

  /// What accelerations and velocities at the end of a step of length h change by, for a change of the positions.
  double by_a(double h) const { return (1 - alpha_m) / (h * h * beta * (1 - alpha_f)); }
  double by_v(double h) const { return gamma / (h * beta); }
  /// The method's own acceleration at the end of a step, from that at its start, is this times that one, and the
  /// increment over h^2 beta.
  double carried() const { return (-1 / beta) * (0.5 - beta); }
  /// The error of a step's positions over the change of the method's own acceleration.
  double error_constant(double h) const { return h * h * std::abs(beta + 0.5 * (alpha_m - alpha_f) - 1.0 / 6); }
};

/// Accelerations, arrays of coordinates, at an end of a step.
struct EndAccelerations {
  Eigen::VectorXd true_acceleration;  ///< q'' that satisfies the equations of motion
  Eigen::VectorXd a;                  ///< the method's own acceleration
  double h = 0;                       ///< [s], length of the step that `a` belongs to
  EnergyBalance power;                ///< [W]

  void resize(Eigen::Index coordinates) {
    true_acceleration.resize(coordinates);
    a.resize(coordinates);
  }
  void take(const EndAccelerations& other) {
    assign_both(true_acceleration, other.true_acceleration, a, other.a);
    h = other.h;
    power = other.power;
  }
  void exchange(Archive& memory) {
    memory(true_acceleration);
    memory(a);
    memory(h);
    power.exchange(memory);
  }
};

/// Start and end of a step, arrays of coordinates.
struct AlphaStep {
  using State = Eigen::Map<const Eigen::VectorXd>;

  EndAccelerations start, end;
  Eigen::VectorXd d;     ///< what the positions at its end are off those of the velocity going on
  Eigen::VectorXd q, v;  ///< at its end

  /// It starts from the state y, which must stay there and as it is until the step is done. Coordinates that are no
  /// part of the state, the last ones, start from 0.
  void begin(const Eigen::VectorXd& y, Eigen::Index coordinates, Eigen::Index of_state) {
    for (Eigen::VectorXd* vector : {&d, &q, &v}) vector->resize(coordinates);
    state_ = y.data();
    of_state_ = of_state;
  }
  /// Coordinates and velocities in that state.
  State base_q() const { return {state_, of_state_}; }
  State base_v() const { return {state_ + of_state_, of_state_}; }

  /// Takes a correction off the increment. The increment is kept by itself: next to the coordinates it would lose its
  /// digits in short steps, and with them the accelerations theirs.
  void correct(const AlphaRule& rule, const Eigen::VectorXd& correction, double h) {
    complete(rule, h, correction.data());
  }
  /// The end of the step, from the increment.
  void complete(const AlphaRule& rule, double h) { complete(rule, h, nullptr); }

 private:
  void complete(const AlphaRule& rule, double h, const double* correction);

  const double* state_ = nullptr;
  Eigen::Index of_state_ = 0;
  Eigen::VectorXd zero_;  ///< where other coordinates start
};

/// What the factored tangent was made at: it may be steps old.
struct TangentPoint {
  Eigen::VectorXd q, v, a;
  double t = 0;
  TangentWeights by{1, 0, 0};

  /// Allocates nothing once the sizes are known.
  void set(const Eigen::VectorXd& q_, const Eigen::VectorXd& v_, const Eigen::VectorXd& a_, double t_,
           const TangentWeights& by_) {
    assign(q, q_);
    assign(v, v_);
    assign(a, a_);
    t = t_;
    by = by_;
  }
  void exchange(Archive& memory) {
    for (Eigen::VectorXd* vector : {&q, &v, &a}) memory(*vector);
    for (double* number : {&t, &by.v, &by.a}) memory(*number);
  }
};

}  // namespace vlbeam
