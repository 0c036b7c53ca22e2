#include "core/dynamics/integrate.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>

#include "core/error.hpp"

namespace vlbeam {
namespace {

constexpr double guard_tolerance = 1e-12;  // a guard this near zero is at its root
constexpr double event_tolerance = 1e-10;  // a guard must exceed this at the end of a step to be looked into
constexpr int longest_cascade = 8;         // events at one instant

std::unique_ptr<Stepper> make_stepper(EventedOde& ode, const IntegrationOptions& options) {
  if (options.type == IntegratorType::generalized_alpha) {
    return make_generalized_alpha(*ode.second_order(), options.generalized_alpha);
  }
  if (options.type == IntegratorType::energy_momentum) {
    return make_energy_momentum(*ode.second_order(), options.energy_momentum);
  }
  return make_odeint_stepper(options.type, options.tolerances);
}

double first_step(const IntegrationOptions& options) {
  if (!has_fixed_step(options.type)) return options.first_step;
  return options.type == IntegratorType::generalized_alpha ? options.generalized_alpha.step
                                                           : options.energy_momentum.step;
}

/// A method that met an undefined state may propose no usable step at all.
void shorten(double& dt, double tried, Stepper& stepper) {
  if (dt > 0 && dt < tried) return;
  dt = tried / 10;
  stepper.reset();
}

/// Steps that start from the beginning of the current step and leave the main stepper alone.
class SideStepper {
 public:
  SideStepper(EventedOde& ode, const IntegrationOptions& options) : ode_(ode), stepper_(make_stepper(ode, options)) {}

  /// The solution at `to`, from (from, start), where the last step of `main` started.
  const Eigen::VectorXd& at(const Stepper& main, const Eigen::VectorXd& start, double from, double to) {
    y_ = start;
    stepper_->resume(main);
    double t = from, dt = to - from;
    while (t < to) {
      const bool last = dt >= to - t;
      if (last) dt = to - t;
      const double tried = dt;
      if (stepper_->try_step(ode_, y_, t, dt)) {
        if (last) break;
      } else {
        shorten(dt, tried, *stepper_);
      }
    }
    return y_;
  }

 private:
  EventedOde& ode_;
  std::unique_ptr<Stepper> stepper_;
  Eigen::VectorXd y_;
};

struct Located {
  int index = -1;
  double t = 0;
};

/// The first event in the step from (t0, y0) to (t1, y1), or index -1.
Located first_event(const EventedOde& ode, SideStepper& side, const Stepper& main, const Eigen::VectorXd& y0, double t0,
                    const Eigen::VectorXd& y1, double t1) {
  const Guards at_start = ode.guards(y0, t0), at_end = ode.guards(y1, t1);
  Located first;
  for (int i = 0; i < max_guards; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (at_end[k] <= event_tolerance) continue;
    double t = t0;
    if (at_start[k] < -guard_tolerance) {
      auto guard = [&](double tau) {
        const double value = ode.guards(side.at(main, y0, t0, t0 + tau), t0 + tau)[k];
        return std::abs(value) <= guard_tolerance ? 0.0 : value;
      };
      std::uintmax_t evaluations = 60;
      const auto bracket = boost::math::tools::toms748_solve(
          guard, 0.0, t1 - t0, at_start[k], at_end[k], boost::math::tools::eps_tolerance<double>(52), evaluations);
      t = t0 + (bracket.first + bracket.second) / 2;
    }
    if (first.index < 0 || t < first.t) first = {i, t};
  }
  return first;
}

[[noreturn]] void underflow(double t, double dt) {
  std::ostringstream what;
  what << "step underflow: the integrator needs steps below " << dt
       << " s; the scene may be too stiff for an explicit method, an element too short or the curve degenerate";
  throw ComputationFailed(what.str(), t);
}

}  // namespace

bool integrate(EventedOde& ode, Eigen::VectorXd& y, double& t, double t_end, const std::vector<double>& sample_times,
               const IntegrationOptions& options, SolverCounters& counters) {
  auto stepper = make_stepper(ode, options);
  SideStepper side(ode, options);
  const double smallest = 1e-15 * std::max(std::abs(t_end), t_end - t);
  double dt = std::min(first_step(options), t_end - t);
  auto next_sample = std::lower_bound(sample_times.begin(), sample_times.end(), t);
  Eigen::VectorXd before = y;
  double last_event = t - 1;
  int cascade = 0;

  for (; next_sample != sample_times.end() && *next_sample <= t; ++next_sample) ode.sample(y, t);
  while (t < t_end) {
    before = y;
    const double t_before = t;
    const bool last = dt >= t_end - t;
    if (last) dt = t_end - t;
    const double tried = dt;
    if (!stepper->try_step(ode, y, t, dt)) {
      ++counters.rejected;
      shorten(dt, tried, *stepper);
      if (dt < smallest) underflow(t, smallest);
      continue;
    }
    if (!y.allFinite()) {  // a trial state outside the domain of the equations: not an error estimate, so not rejected
      y = before;
      t = t_before;
      dt = tried / 10;
      ++counters.rejected;
      stepper->reset();
      if (dt < smallest) underflow(t, smallest);
      continue;
    }
    if (last) t = t_end;
    ++counters.steps;

    const Located event = first_event(ode, side, *stepper, before, t_before, y, t);
    if (event.index >= 0) {
      t = event.t;
      y = t > t_before ? side.at(*stepper, before, t_before, t) : before;
    } else if (!last) {
      counters.smallest_step = counters.smallest_step == 0 ? tried : std::min(counters.smallest_step, tried);
    }
    for (; next_sample != sample_times.end() && *next_sample <= t; ++next_sample) {
      ode.sample(*next_sample == t ? y : side.at(*stepper, before, t_before, *next_sample), *next_sample);
    }
    if (event.index >= 0) {
      cascade = t - last_event > smallest ? 0 : cascade + 1;
      last_event = t;
      if (cascade > longest_cascade) {
        throw ComputationFailed("a cascade of length-control events without progress in time", t);
      }
      ode.handle_event(event.index, y, t);
      stepper->reset();
      dt = tried;
    }
    if (!ode.proceed(t)) return false;
  }
  return true;
}

}  // namespace vlbeam
