#include "mechanics/time/side_stepper.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/time/assign.hpp"
#include "mechanics/time/in_tolerances.hpp"

namespace vlbeam {
namespace {

constexpr int most_side_steps = 60;  // tries to get inside a step: else the step itself is too long

}  // namespace

Method::Method(EventedOde& ode, const IntegrationOptions& options, NewtonCounters& counters) {
  if (options.by_generalized_alpha()) {
    system = ode.new_second_order();
    stepper = make_generalized_alpha(*system, options.generalized_alpha, &counters);
    return;
  }
  if (options.other && options.other->second_order) {
    system = ode.new_second_order();
    stepper = options.other->make(system.get(), options.tolerances, counters);
    return;
  }
  const auto& by_field = options.tolerances.by_field;
  const bool in_units = by_field && !options.has_fixed_step();
  const Tolerances tolerances = in_units ? Tolerances{options.tolerances.rtol, 1} : options.tolerances;
  stepper = options.other ? options.other->make(nullptr, tolerances, counters)
                          : make_odeint_stepper(options.type, tolerances, options.step);
  if (in_units) stepper = in_tolerances(std::move(stepper), *by_field);
}

void shorten(double& dt, double tried, Stepper& stepper) {
  if (dt > 0 && dt < tried) return;
  dt = tried / 10;
  stepper.reset();
}

const Eigen::VectorXd& SideStepper::step_to(const Eigen::VectorXd& start, double from, double to) {
  assign(y_, start);
  double t = from, dt = to - from;
  for (int tries = 0; t < to; ++tries) {
    if (tries == most_side_steps) throw SideStepUnderflow{t, dt};
    const bool last = dt >= to - t;
    if (last) dt = to - t;
    const double tried = dt, t_before = t;
    assign(before_, y_);
    if (!stepper_->try_step(ode_, y_, t, dt)) {
      shorten(dt, tried, *stepper_);
    } else if (!all_finite(y_)) {
      y_ = before_;
      t = t_before;
      dt = tried / 10;
      stepper_->reset();
    } else {
      if (last) break;
      continue;
    }
    const double smallest = std::max(1e-12 * (to - from), 1e-15 * std::abs(to));
    if (dt < smallest) throw SideStepUnderflow{t, smallest};  // below, t itself would stand still
  }
  return y_;
}

}  // namespace vlbeam
