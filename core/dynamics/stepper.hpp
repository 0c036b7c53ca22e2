#pragma once

#include <memory>

#include "core/dynamics/ode.hpp"

namespace vlbeam {

enum class IntegratorType { dopri5, cash_karp, fehlberg78, bulirsch_stoer, generalized_alpha, energy_momentum };

/// Whether a method takes steps of one given length; the others choose it by their tolerances.
constexpr bool has_fixed_step(IntegratorType type) {
  return type == IntegratorType::generalized_alpha || type == IntegratorType::energy_momentum;
}

struct Tolerances {
  double rtol = 1e-9;
  double atol = 1e-9;
};

/// One step of a method with error control.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Tries one step of length `dt` from (t, y). When it meets the tolerances, moves y and t and proposes the next `dt`;
  /// otherwise leaves them, shortens `dt` and returns false.
  virtual bool try_step(Ode& ode, Eigen::VectorXd& y, double& t, double& dt) = 0;
  /// Forgets what it kept of earlier steps: for a state or an equation that is not the last step's.
  virtual void reset() = 0;
  /// Gets ready to repeat the last successful step of `other`, a stepper of the same method.
  virtual void resume(const Stepper& /*other*/) { reset(); }
};

/// A Boost.Odeint method with step size control, ready for its first step.
std::unique_ptr<Stepper> make_odeint_stepper(IntegratorType type, const Tolerances& tolerances);

}  // namespace vlbeam
