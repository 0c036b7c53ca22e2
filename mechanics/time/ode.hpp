#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "mechanics/time/second_order.hpp"

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

/// A function of state and time: an event is due where it turns positive.
struct Guard {
  int kind;  ///< what the event is: the system's own numbers
  int part;  ///< of which part of the system
  double value;
  double rounding = 0;  ///< what it is known to
  /// Its rate [1/s], where it is known: it is then watched between both ends of a step, too.
  double rate = std::numeric_limits<double>::quiet_NaN();
  /// How far beyond zero a step may end, by the rate at its start.
  double room = std::numeric_limits<double>::infinity();
  int source = 0;  ///< which of those that the system has
};
/// As many and in the same order until the next event.
using Guards = std::vector<Guard>;

}  // namespace vlbeam
