#pragma once

#include "mechanics/time/second_order.hpp"

namespace vlbeam {

/// The same equations for a method that differentiates the constraints, and has a linear solver of its own.
class ConstrainedSystem : public SecondOrderSystem {
 public:
  /// Writes dC/dt = C_q v + C_t where the multipliers stand, at the end of `rates`.
  virtual void constraint_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                Eigen::VectorXd& rates) const = 0;
  /// The matrix of linearize(), dense and not factored. Rows of constraints are C_q; columns of multipliers are by the
  /// multipliers, C_q^T multiplier_unit(), whatever `by`. Only with multipliers.
  virtual void tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                       const TangentWeights& by, Eigen::MatrixXd& dense) = 0;
  /// Adds `factor` times the second derivative of constraint i, a linear or quadratic form.
  virtual void add_curvature(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const = 0;
  /// What makes an acceleration of a multiplier.
  virtual double multiplier_unit() const = 0;
};

}  // namespace vlbeam
