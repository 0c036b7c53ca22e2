#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "core/dynamics/second_order.hpp"

namespace vlbeam {

/// y' = f(y, t) as the integrators see it. The size may change at an event, never in between.
class Ode {
 public:
  virtual ~Ode() = default;
  virtual Eigen::Index size() const = 0;
  /// What the coordinates q are, of y = (q, q', what is only counted). None where y is nothing of the kind.
  virtual std::vector<FieldRun> fields() const { return {}; }
  /// Writes f(y, t) into `dydt`, already of the right size. Allocates nothing.
  virtual void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) = 0;
  /// Writes df/dy and df/dt, both already of the right size.
  virtual void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) = 0;
  /// The same equations as an implicit method needs them, y = (q, q', ...); null where there are none. Each view has a
  /// factored matrix of its own: a method that keeps one from step to step needs a view that nobody else uses.
  virtual std::unique_ptr<SecondOrderSystem> new_second_order() { return nullptr; }
};

inline constexpr int max_guards = 9;
/// Values of the guard functions; an event is due where one turns positive. Unused ones are negative.
using Guards = std::array<double, max_guards>;

}  // namespace vlbeam
