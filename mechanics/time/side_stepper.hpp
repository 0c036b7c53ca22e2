#pragma once

#include <memory>

#include "mechanics/time/integrate.hpp"

namespace vlbeam {

/// A stepper with the view of the equations that is its own.
struct Method {
  Method(EventedOde& ode, const IntegrationOptions& options, NewtonCounters& counters);

  std::unique_ptr<SecondOrderSystem> system;  ///< null where the method takes the first-order form
  std::unique_ptr<Stepper> stepper;
};

/// A method that met an undefined state may propose no usable step at all.
void shorten(double& dt, double tried, Stepper& stepper);

/// Steps that end inside a step of the main stepper cannot be taken, although that step could.
struct SideStepUnderflow {
  double t, dt;
};

/// Steps that start from the beginning of the current step and leave the main stepper alone.
class SideStepper {
 public:
  SideStepper(EventedOde& ode, const IntegrationOptions& options, NewtonCounters& total)
      : ode_(ode), total_(total), method_(ode, options, own_), stepper_(method_.stepper.get()) {}
  /// Its work counts; what it met on its way, which depends on the output, does not.
  ~SideStepper() {
    total_.iterations += own_.iterations;
    total_.tangents += own_.tangents;
  }
  SideStepper(const SideStepper&) = delete;
  SideStepper& operator=(const SideStepper&) = delete;

  /// The solution at `to`, from (from, start), where the last step of `main` started. Throws SideStepUnderflow.
  const Eigen::VectorXd& at(const Stepper& main, const Eigen::VectorXd& start, double from, double to) {
    stepper_->resume(main);
    return step_to(start, from, to);
  }
  /// The same where the last call of at() was for nearly the same instant.
  const Eigen::VectorXd& nearby(const Stepper& main, const Eigen::VectorXd& start, double from, double to) {
    stepper_->resume_nearby(main);
    return step_to(start, from, to);
  }

  /// Behind the last call of at().
  const Stepper& stepper() const { return *stepper_; }

  /// Of its stepper nothing stays from one call of at() to the next.
  void exchange(Archive& memory) { own_.exchange(memory); }

 private:
  const Eigen::VectorXd& step_to(const Eigen::VectorXd& start, double from, double to);

  EventedOde& ode_;
  NewtonCounters& total_;
  NewtonCounters own_;
  Method method_;
  Stepper* stepper_;
  Eigen::VectorXd y_, before_;
};

}  // namespace vlbeam
