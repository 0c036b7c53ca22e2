#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/tangent_weights.hpp"
#include "mechanics/time/archive.hpp"
#include "mechanics/time/energy_balance.hpp"
#include "mechanics/time/fields.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

/// Equations of motion M(q) q'' = Q(q, q', t) as an implicit method sees them: a residual in (q, v, a) and its tangent.
/// Supports and the like are either eliminated, and fixed coordinates then have zero residual and never move, or
/// constraints C(q) = 0 with multipliers, M q'' + C_q^T lambda = Q: the last coordinates then stand for the
/// multipliers, which enter as their "accelerations". Newton's tangent so scales them with the square of the step, and
/// its condition does not depend on the step.
class SecondOrderSystem {
 public:
  virtual ~SecondOrderSystem() = default;

  virtual Eigen::Index coordinates() const = 0;
  /// How many of the coordinates, the last ones, stand for multipliers.
  virtual Eigen::Index multipliers() const { return 0; }
  /// What each of the coordinates is.
  virtual std::vector<FieldRun> fields() const = 0;
  /// Coordinates and velocities from a state y = (q, q', ...) of the minimal ones, all but those that stand for
  /// multipliers, and back.
  virtual void expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const {
    q = y.head(coordinates());
    v = y.segment(coordinates(), coordinates());
  }
  virtual void contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const {
    y.head(q.size()) = q;
    y.segment(q.size(), q.size()) = v;
  }
  /// Acceleration (and multipliers) consistent with (q, v) at time t.
  virtual void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) = 0;
  /// Puts the accelerations (and multipliers) `before` the last event, an array of coordinates of then, in the place of
  /// those in `a`, which are consistent with the state after it. Returns false where they do not go on through it.
  /// `memory` is overwritten.
  virtual bool carry(const Eigen::VectorXd& /*before*/, double /*t*/, Eigen::VectorXd& /*a*/,
                     Eigen::VectorXd& /*memory*/) const {
    return false;
  }
  /// r = M(q) a - Q(q, v, t); returns the power lost to damping [W].
  virtual double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                          Eigen::VectorXd& r) = 0;
  /// Writes M a at (q, t), with zeros where something is held or constrained, if that costs less than a residual;
  /// false where it does not.
  virtual bool inertia(const Eigen::VectorXd& /*q*/, const Eigen::VectorXd& /*a*/, double /*t*/,
                       Eigen::VectorXd& /*r*/) {
    return false;
  }
  virtual ConstraintResidual constraint_residual(const Eigen::VectorXd& /*q*/, const Eigen::VectorXd& /*v*/,
                                                 double /*t*/) const {
    return {};
  }
  /// Whether some coordinates have no equation of motion: they follow from time or from others.
  virtual bool driven() const { return false; }
  /// Writes how far eliminated coordinates that are driven are from where they are at time t; false where none are.
  virtual bool driven_offset(const Eigen::VectorXd& /*q*/, double /*t*/, Eigen::VectorXd& /*offset*/) const {
    return false;
  }
  /// How fast what moves turns as a whole, or its path does [rad/s]; vibrations hardly count.
  virtual double turning(const Eigen::VectorXd& /*q*/, const Eigen::VectorXd& /*v*/) const { return 0; }
  /// Which energies the state counts.
  virtual BalanceEntries balance() const { return {}; }
  /// Powers with which supports and loads do work at (q, v, a, t) [W].
  virtual EnergyBalance supplied_power(const Eigen::VectorXd& /*q*/, const Eigen::VectorXd& /*v*/,
                                       const Eigen::VectorXd& /*a*/, double /*t*/) {
    return {};
  }
  /// Power lost to damping half-way between two states, by the velocity of the way from the one to the other in a time
  /// h, and the mean of their accelerations [W]; nothing where the powers at both ends serve. Stiff damping ends within
  /// a step what a state starts with, and leaves velocities that alternate from step to step: their powers say nothing
  /// of what is lost in between.
  virtual std::optional<double> power_lost_between(const Eigen::VectorXd& /*q0*/, const Eigen::VectorXd& /*q1*/,
                                                   const Eigen::VectorXd& /*a0*/, const Eigen::VectorXd& /*a1*/,
                                                   double /*h*/, double /*t*/) {
    return std::nullopt;
  }
  /// Assembles and factors the tangent of the residual, in place of what was factored before. Returns false where it is
  /// singular.
  virtual bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                         const TangentWeights& by) = 0;
  /// Solves with the last factored matrix, in place.
  virtual void solve(Eigen::VectorXd& r) const = 0;
  /// Takes over what another view of the same equations has chosen on its way, so that both go on with equal digits.
  virtual void follow(const SecondOrderSystem& /*other*/) {}
  /// Writes or reads what it has chosen on its way.
  virtual void exchange(Archive& /*memory*/) {}
};

}  // namespace vlbeam
