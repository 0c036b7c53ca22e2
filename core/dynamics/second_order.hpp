#pragma once

#include <Eigen/Core>

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
  /// Assembles and factors dr/dq + by_v dr/dv + by_a dr/da. Returns false where it is singular.
  virtual bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                         double by_v, double by_a) = 0;
  /// Solves with the last factored matrix, in place.
  virtual void solve(Eigen::VectorXd& r) const = 0;
  /// Jacobian of the same equations in first order, y = (q, q', ...): Ode::jacobian().
  virtual void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) = 0;
};

}  // namespace vlbeam
