#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace vlbeam {

/// Equations of motion M(q) q'' = Q(q, q', t) as an implicit method sees them: a residual in (q, v, a) and its tangent.
/// Coordinates that a support fixes have zero residual and never move.
class SecondOrderSystem {
 public:
  virtual ~SecondOrderSystem() = default;

  virtual Eigen::Index coordinates() const = 0;
  /// Acceleration consistent with (q, v) at time t.
  virtual void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) = 0;
  /// r = M(q) a - Q(q, v, t); returns the power lost to damping [W].
  virtual double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                          Eigen::VectorXd& r) = 0;
  /// Assembles and factors dr/dq + by_v dr/dv + by_a dr/da, in place of what was factored before, for whichever stepper.
  /// Returns false where it is singular.
  virtual bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                         double by_v, double by_a) = 0;
  /// Solves with the last factored matrix, in place.
  virtual void solve(Eigen::VectorXd& r) const = 0;
  /// Residual of a step of length h from (q0, v0) at time t to (q1, v1), q1 = q0 + h (v0 + v1)/2, that keeps energy:
  /// the change of momentum over h minus a mean force, near M a - Q in the middle of the step. Returns the mean power
  /// lost to damping [W].
  virtual double conserving_residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                                     const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) = 0;
  /// Counts the calls of linearize(): tells who keeps a factored matrix whether it still is his.
  std::size_t factorizations() const { return factorizations_; }

 protected:
  std::size_t factorizations_ = 0;
};

}  // namespace vlbeam
