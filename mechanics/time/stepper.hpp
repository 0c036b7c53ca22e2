#pragma once

#include <memory>
#include <optional>

#include "mechanics/time/archive.hpp"
#include "mechanics/time/integration_method.hpp"
#include "mechanics/time/ode.hpp"

namespace vlbeam {

/// Absolute tolerances of coordinates and of their rates, kind by kind. What a state only counts, energies and the
/// like, is not controlled. Those of multipliers are accelerations and velocities, or, on slopes, these times a length.
struct FieldTolerances {
  FieldNorms of{}, of_rate{};
};

struct Tolerances {
  double rtol = 1e-9;
  double atol = 1e-9;                            ///< of every entry of the state in its own unit
  std::optional<FieldTolerances> by_field = {};  ///< in place of it
  /// [m] of displacement, from which those of `by_field` hold in full; until something has moved as far they are
  /// smaller in proportion, down to 1e-5 of them. 0: they always hold. Of generalized-alpha alone.
  double motion = 0;
};

inline constexpr double slightly_longer = 1e-6;  // share of a fixed step, that it may be longer to end at an event

/// One step of a method.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Tries one step of length `dt`, or of its fixed length if that is shorter, from (t, y). When it meets the
  /// tolerances, moves y and t and proposes the next `dt`; otherwise leaves them, shortens `dt` and returns false.
  virtual bool try_step(Ode& ode, Eigen::VectorXd& y, double& t, double& dt) = 0;
  /// Forgets what it kept of earlier steps: for a state or an equation that is not the last step's.
  virtual void reset() = 0;
  /// The last step ended at a corner of the equations: state and time are as it left them, derivatives may have jumped.
  virtual void pass_corner() { reset(); }
  /// From now on no step is to be longer than this [s], and a short one is short against it.
  virtual void limit(double /*longest*/) {}
  /// Keeps what is to go on through an event, after which it is reset(): from the end of the last step of `other`, a
  /// stepper of the same method, or, `at_start`, from where that step started.
  virtual void keep_for_event(const Stepper& /*other*/, bool /*at_start*/) {}
  /// Gets ready to repeat the last successful step of `other`, a stepper of the same method.
  virtual void resume(const Stepper& /*other*/) { reset(); }
  /// The same, where this stepper's last step was from the same start, and nearly as long as the next one will be.
  virtual void resume_nearby(const Stepper& other) { resume(other); }
  /// Writes where the solution goes from (t, y) in a time `tau` of a next step of `dt`, as far as accelerations tell.
  /// Returns false where the method does not know them. `y` and `there` are two vectors.
  virtual bool extrapolate(const Eigen::VectorXd& /*y*/, double /*t*/, double /*dt*/, double /*tau*/,
                           Eigen::VectorXd& /*there*/) {
    return false;
  }
  /// Writes or reads what it keeps from one step to the next. Not between a failed step and its repetition.
  virtual void exchange(Archive& memory) = 0;
};

/// A Boost.Odeint method, ready for its first step. Those that choose their step look at `tolerances`.
/// Rosenbrock4 solves dense systems of the size of the state at each step: for stiff equations of at most some hundred
/// unknowns, about 20 planar elements.
///
/// The Adams-Bashforth-Moulton method has five steps of length `step` [s] and order five, at two evaluations a step.
/// Its step is fixed: what makes a multistep method cheap is its history at equal distances, and every event breaks
/// that history anyway. Steps without it, the first four and shortened ones, are extrapolated and of sixth order.
std::unique_ptr<Stepper> make_odeint_stepper(IntegrationMethod type, const Tolerances& tolerances, double step);

}  // namespace vlbeam
