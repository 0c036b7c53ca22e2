#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/time/checkpoint.hpp"
#include "mechanics/time/generalized_alpha.hpp"
#include "mechanics/time/ode.hpp"
#include "mechanics/time/stepper.hpp"
#include "mechanics/time/timetable.hpp"

namespace vlbeam {

/// An ordinary differential equation whose right-hand side changes at events, with what wants to know of its solution.
class EventedOde : public Ode {
 public:
  /// Guard functions at (t, y), scaled so that 1e-10 is a negligible distance.
  virtual Guards guards(const Eigen::VectorXd& y, double t) const = 0;
  /// Guard `index` has turned positive at (t, y): changes the equations and y.
  virtual void handle_event(int index, Eigen::VectorXd& y, double t) = 0;
  /// The solution at a sample time.
  virtual void sample(const Eigen::VectorXd& y, double t) = 0;
  /// After each step: brings y back onto conditions that the method does not know, as far as steps have left them.
  virtual void correct(Eigen::VectorXd& /*y*/, double /*t*/) {}
  /// After each step, which ended at (t, y); false interrupts.
  virtual bool proceed(const Eigen::VectorXd& y, double t) = 0;
  /// What moves fastest in a state, in words: where a run is stuck.
  virtual std::string fastest(const Eigen::VectorXd& /*y*/) const { return ""; }
  /// Writes or reads what it keeps beside the state since its last event.
  virtual void exchange(Archive& /*memory*/) {}
};

/// A method of integration that comes from elsewhere.
struct OtherMethod {
  bool fixed_step = false;       ///< it takes steps of the length `step` of the options
  bool second_order = true;      ///< it takes the equations as a SecondOrderSystem, else as y' = f(t, y)
  bool can_be_restarted = true;  ///< its memory can be kept in a checkpoint
  /// Its stepper; of equations of first order the system is null.
  std::function<std::unique_ptr<Stepper>(SecondOrderSystem*, const Tolerances&, NewtonCounters&)> make;
};

struct IntegrationOptions {
  IntegrationMethod type = IntegrationMethod::dopri5;
  std::optional<OtherMethod> other = {};  ///< instead of `type`
  Tolerances tolerances;
  double first_step = 1e-6;  ///< [s], of the methods that choose their step
  double step = 1e-3;        ///< [s], of methods with a fixed step but generalized-alpha
  GeneralizedAlphaOptions generalized_alpha;
  Timetable timetable;        ///< corners of the equations, at which steps of all methods end
  bool locate_events = true;  ///< false: an event happens at the end of the step in which it is due
  /// Of a guard at the end of a step: one that is farther beyond zero makes the step too long, and it is halved.
  double largest_overshoot = std::numeric_limits<double>::infinity();

  bool by_generalized_alpha() const { return !other && type == IntegrationMethod::generalized_alpha; }
  /// Whether the method takes steps of one given length; the others choose it by their tolerances.
  bool has_fixed_step() const {
    if (other) return other->fixed_step;
    return type == IntegrationMethod::adams_bashforth_moulton || type == IntegrationMethod::generalized_alpha;
  }
};

/// Integrates from `t` to `t_end`. Samples (increasing times) and events come from steps of the same method that start
/// where the step across them started, so that they have its full order and neither the steps nor the results depend on
/// the output. An event is located where its guard is zero to 1e-12, unless the options let it come late: by up to a
/// step, which leaves any method of first order. Where steps inside one cannot be taken, that one is halved. Returns
/// false if interrupted. Steps end at the corners of the options' timetable. Throws ComputationFailed on step
/// underflow, on a cascade of events without progress in time, and where steps get too short to come to the end
/// (Progress); `y` and `t` are then the last good state.
///
/// With `checkpoints` it may go on from one, with the digits of the run that left it: `ode` must then be as it was at
/// the start of that run, and samples and events up to there happen to it once more. Checkpoints are kept at the first
/// end of a step at or after each multiple of their interval: steps do not depend on them. Throws InvalidInput where a
/// checkpoint does not fit these equations and options, or where the method has a memory that cannot be kept
/// (SUNDIALS).
bool integrate(EventedOde& ode, Eigen::VectorXd& y, double& t, double t_end, const std::vector<double>& sample_times,
               const IntegrationOptions& options, SolverCounters& counters, const Checkpoints* checkpoints = nullptr);

}  // namespace vlbeam
