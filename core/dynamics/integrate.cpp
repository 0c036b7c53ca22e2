#include "core/dynamics/integrate.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/dynamics/in_tolerances.hpp"
#include "core/dynamics/sundials_stepper.hpp"
#include "core/error.hpp"
#include "core/pieces.hpp"

namespace vlbeam {
namespace {

constexpr double guard_tolerance = 1e-12;  // a guard this near zero is at its root
constexpr double whole_step = 1e-9;        // no step for what rounding leaves of the run
constexpr double event_tolerance = 1e-10;  // a guard must exceed this at the end of a step to be looked into
constexpr double clearly_before = -1e-3;   // of a guard at the first root of another one: its own comes later
constexpr int most_refinements = 60;       // steps to locate one event
constexpr int most_side_steps = 60;        // tries to get inside a step: else the step itself is too long
constexpr int longest_cascade = 8;         // events at one instant
constexpr int most_looks_beyond = 10;      // steps beyond the end of the run: there may be nothing behind it

/// A stepper with the view of the equations that is its own.
struct Method {
  Method(EventedOde& ode, const IntegrationOptions& options, NewtonCounters& counters) {
    if (options.type == IntegratorType::generalized_alpha) {
      system = ode.new_second_order();
      stepper = make_generalized_alpha(*system, options.generalized_alpha, &counters);
    } else if (options.type == IntegratorType::energy_momentum) {
      system = ode.new_second_order();
      stepper = make_energy_momentum(*system, options.energy_momentum);
    } else if (options.type == IntegratorType::ida) {
      system = ode.new_second_order();
      stepper = make_sundials_stepper(options.type, options.tolerances, system.get(), &counters);
    } else {
      const auto& by_field = options.tolerances.by_field;
      const bool in_units = by_field && !has_fixed_step(options.type);
      const Tolerances tolerances = in_units ? Tolerances{options.tolerances.rtol, 1} : options.tolerances;
      stepper = of_sundials(options.type) ? make_sundials_stepper(options.type, tolerances, nullptr, nullptr)
                                          : make_odeint_stepper(options.type, tolerances, options.step);
      if (in_units) stepper = in_tolerances(std::move(stepper), *by_field);
    }
  }

  std::unique_ptr<SecondOrderSystem> system;  ///< null where the method takes the first-order form
  std::unique_ptr<Stepper> stepper;
};

double first_step(const IntegrationOptions& options) {
  if (!has_fixed_step(options.type)) return options.first_step;
  if (options.type == IntegratorType::generalized_alpha) {
    const GeneralizedAlphaOptions& method = options.generalized_alpha;
    return method.first_step > 0 ? std::min(method.first_step, method.step) : method.step;
  }
  return options.type == IntegratorType::energy_momentum ? options.energy_momentum.step : options.step;
}

/// A method that met an undefined state may propose no usable step at all.
void shorten(double& dt, double tried, Stepper& stepper) {
  if (dt > 0 && dt < tried) return;
  dt = tried / 10;
  stepper.reset();
}

/// Steps that end inside a step of the main stepper cannot be taken, although that step could.
struct SideStepUnderflow {
  double t, dt;
};

[[noreturn]] void underflow(double t, double dt, bool implicit) {
  std::ostringstream what;
  what << "step underflow: the integrator needs steps below " << dt << " s; "
       << (implicit ? "Newton's iteration does not converge even then: "
                    : "the scene may be too stiff for an explicit method, ")
       << "an element " << (implicit ? "may be too short, the motion too violent for the step, " : "too short ")
       << "or the curve degenerate";
  throw ComputationFailed(what.str(), t);
}

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
  void exchange(Memory& memory) { own_.exchange(memory); }

 private:
  const Eigen::VectorXd& step_to(const Eigen::VectorXd& start, double from, double to) {
    y_ = start;
    double t = from, dt = to - from;
    for (int tries = 0; t < to; ++tries) {
      if (tries == most_side_steps) throw SideStepUnderflow{t, dt};
      const bool last = dt >= to - t;
      if (last) dt = to - t;
      const double tried = dt, t_before = t;
      before_ = y_;
      if (!stepper_->try_step(ode_, y_, t, dt)) {
        shorten(dt, tried, *stepper_);
      } else if (!y_.allFinite()) {
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

  EventedOde& ode_;
  NewtonCounters& total_;
  NewtonCounters own_;
  Method method_;
  Stepper* stepper_;
  Eigen::VectorXd y_, before_;
};

struct Located {
  enum class Where { start, inside, end };  ///< of the step

  int index = -1;
  double t = 0;
  Eigen::VectorXd y;
  Where where = Where::inside;
};

/// One step of the main stepper, in which events are looked for.
struct Step {
  double t0;
  const Eigen::VectorXd& y0;
  double t1;
  const Eigen::VectorXd& y1;
};

/// The cubic Hermite interpolant of a step's states.
class Interpolant {
 public:
  Interpolant(EventedOde& ode, const Step& step) : step_(step), f0_(step.y0.size()), f1_(f0_.size()) {
    ode.rhs(step.y0, f0_, step.t0);
    ode.rhs(step.y1, f1_, step.t1);
  }

  const Eigen::VectorXd& operator()(double tau) {
    const double h = step_.t1 - step_.t0, u = tau / h, v = 1 - u;
    y_.resize(f0_.size());
    in_pieces(y_.size(), 1, [&](Eigen::Index first, Eigen::Index count) {
      const auto of = [=](const Eigen::VectorXd& all) { return all.segment(first, count); };
      y_.segment(first, count) = v * v * (1 + 2 * u) * of(step_.y0) + u * u * (3 - 2 * u) * of(step_.y1) +
                                 (h * u * v) * (v * of(f0_) - u * of(f1_));
    });
    return y_;
  }

 private:
  const Step& step_;
  Eigen::VectorXd f0_, f1_, y_;
};

bool is_due(const Guard& guard) { return guard.value > std::max(event_tolerance, guard.rounding); }

/// Root of guard `k` of the interpolant, from the start of the step.
double interpolated_root(EventedOde& ode, Interpolant& interpolant, const Step& step, std::size_t k) {
  auto interpolated = [&](double tau) { return ode.guards(interpolant(tau), step.t0 + tau)[k].value; };
  std::uintmax_t evaluations = 40;
  const auto bracket = boost::math::tools::toms748_solve(
      interpolated, 0.0, step.t1 - step.t0, ode.guards(step.y0, step.t0)[k].value,
      ode.guards(step.y1, step.t1)[k].value, boost::math::tools::eps_tolerance<double>(40), evaluations);
  return (bracket.first + bracket.second) / 2;
}

/// Root of guard `k` by steps of the main stepper's own method. The interpolant gives the first guess `tau` and the
/// slope, so that two or three steps do; the secant is kept in a bracket, and bisects where it leaves it.
Located locate(EventedOde& ode, SideStepper& side, const Stepper& main, const Step& step, Interpolant& interpolant,
               double tau, std::size_t k) {
  auto interpolated = [&](double at) { return ode.guards(interpolant(at), step.t0 + at)[k].value; };
  const double h = step.t1 - step.t0;
  double low = 0, high = h;
  const double reach = 1e-4 * h;
  double slope = (interpolated(tau + reach) - interpolated(tau - reach)) / (2 * reach);
  double last_tau = 0, last_value = 0;
  for (int i = 0;; ++i) {
    const Eigen::VectorXd& y =
        i == 0 ? side.at(main, step.y0, step.t0, step.t0 + tau) : side.nearby(main, step.y0, step.t0, step.t0 + tau);
    const Guard guard = ode.guards(y, step.t0 + tau)[k];
    const double value = guard.value;
    const bool closed = high - low <= 1e-15 * h || tau == last_tau;
    if (std::abs(value) <= std::max(i < 4 ? guard_tolerance : event_tolerance, guard.rounding) || closed ||
        i == most_refinements) {
      return {static_cast<int>(k), step.t0 + tau, y};
    }
    (value > 0 ? high : low) = tau;
    if (i > 0) slope = (value - last_value) / (tau - last_tau);
    last_tau = tau;
    last_value = value;
    tau -= value / slope;
    if (!(tau > low && tau < high)) tau = (low + high) / 2;
  }
}

/// The solution at `t` within the step. Where steps inside it cannot be taken, that one being too long, the interpolant
/// has to do: a sample must not change the way of the run.
Eigen::VectorXd state_at(EventedOde& ode, SideStepper& side, const Stepper& main, const Step& step, double t) {
  if (t == step.t1) return step.y1;
  try {
    return side.at(main, step.y0, step.t0, t);
  } catch (const SideStepUnderflow&) {
    return Interpolant(ode, step)(t - step.t0);
  }
}

/// The first event in the step, or index -1. Without `locate_events` its time is the end of the step.
Located first_event(EventedOde& ode, SideStepper& side, const Stepper& main, const Step& step,
                    const IntegrationOptions& options) {
  const bool exactly = options.locate_events;
  const Guards at_start = ode.guards(step.y0, step.t0), at_end = ode.guards(step.y1, step.t1);
  for (std::size_t k = 0; k < at_end.size(); ++k) {  // what was due before the step makes no step too long
    if (is_due(at_end[k]) && at_start[k].value >= -std::max(guard_tolerance, at_start[k].rounding)) {
      return {static_cast<int>(k), step.t0, step.y0, Located::Where::start};
    }
  }
  if (std::ranges::any_of(at_end, [&](const Guard& guard) { return guard.value > options.largest_overshoot; })) {
    throw SideStepUnderflow{step.t0, 0};
  }
  struct Candidate {
    double tau;
    std::size_t guard;
  };
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < at_end.size(); ++k) {
    if (is_due(at_end[k])) candidates.push_back({step.t1 - step.t0, k});
  }
  if (candidates.empty()) return {};
  if (!exactly) return {static_cast<int>(candidates.front().guard), step.t1, step.y1, Located::Where::end};

  Interpolant interpolant(ode, step);
  for (Candidate& each : candidates) each.tau = interpolated_root(ode, interpolant, step, each.guard);
  std::ranges::stable_sort(candidates, {}, &Candidate::tau);
  Located first;
  std::size_t last = 0;  // guard that was located
  for (const auto& [tau, k] : candidates) {
    // Beyond the first event the equations may not even have a solution.
    if (first.index >= 0 && ode.guards(first.y, first.t)[k].value < clearly_before) continue;
    last = k;
    const Located found = locate(ode, side, main, step, interpolant, tau, k);
    if (first.index < 0 || found.t < first.t || (found.t == first.t && found.index < first.index)) first = found;
  }
  if (first.index != static_cast<int>(last)) {  // `side` is to end there
    side.at(main, step.y0, step.t0, first.t);
  }
  return first;
}

/// Tells the equations what happens to them, and remembers it where checkpoints are to be kept.
class EventLog {
 public:
  EventLog(EventedOde& ode, const Checkpoints* checkpoints)
      : ode_(ode), checkpoints_(checkpoints && checkpoints->keep ? checkpoints : nullptr) {}

  void sample(const Eigen::VectorXd& y, double t) {
    remember(-1, y, t);
    ode_.sample(y, t);
  }
  void event(int guard, Eigen::VectorXd& y, double t) {
    remember(guard, y, t);
    ode_.handle_event(guard, y, t);
  }

  /// Tells all that happened before a checkpoint once more.
  void repeat(const Checkpoint& from) {
    for (const LoggedEvent& entry : from.past) {
      if (entry.y.size() != ode_.size()) throw std::out_of_range("a state of another size");
      recall(entry.system);
      if (entry.guard < 0) {
        sample(entry.y, entry.t);
        continue;
      }
      Eigen::VectorXd y = entry.y;
      if (ode_.guards(y, entry.t).size() <= static_cast<std::size_t>(entry.guard)) {
        throw std::out_of_range("an event of other equations");
      }
      event(entry.guard, y, entry.t);
    }
    if (from.y.size() != ode_.size()) throw std::out_of_range("a state of another size");
    recall(from.system);
    earlier_ = from.seconds;
    set_next(from.t);
  }

  /// Whether one is to be kept at the end of a step, after which the integration goes on or is interrupted.
  bool due(double t, bool goes_on) const { return checkpoints_ != nullptr && (t >= next_ || !goes_on); }
  void keep(const Eigen::VectorXd& y, double t, std::vector<double> method) {
    kept_.t = t;
    kept_.y = y;
    kept_.system = memory();
    kept_.method = std::move(method);
    kept_.seconds = earlier_ + std::chrono::duration<double>(Clock::now() - started_).count();
    checkpoints_->keep(kept_);
    set_next(t);
  }
  void set_next(double t) {
    if (checkpoints_ != nullptr) next_ = checkpoints_->every * (std::floor(t / checkpoints_->every) + 1);
  }

 private:
  std::vector<double> memory() {
    Memory memory;
    ode_.exchange(memory);
    return memory.numbers();
  }
  void recall(const std::vector<double>& numbers) {
    Memory memory(numbers);
    ode_.exchange(memory);
    if (!memory.at_end()) throw std::out_of_range("a memory of other equations");
  }
  void remember(int guard, const Eigen::VectorXd& y, double t) {
    if (checkpoints_ != nullptr) kept_.past.push_back({guard, t, y, memory()});
  }

  using Clock = std::chrono::steady_clock;

  EventedOde& ode_;
  const Checkpoints* checkpoints_;
  Checkpoint kept_;
  Clock::time_point started_ = Clock::now();
  double earlier_ = 0;  ///< [s], before that
  double next_ = 0;     ///< [s]
};

}  // namespace

bool integrate(EventedOde& ode, Eigen::VectorXd& y, double& t, double t_end, const std::vector<double>& sample_times,
               const IntegrationOptions& options, SolverCounters& counters, const Checkpoints* checkpoints) {
  if (checkpoints != nullptr && of_sundials(options.type)) {
    throw ModelError("integrator", "a method of SUNDIALS, with checkpoints",
                     "it keeps its history to itself: take another method");
  }
  const Method method(ode, options, counters.newton);
  Stepper* const stepper = method.stepper.get();
  SideStepper side(ode, options, counters.newton);
  const double smallest = 1e-15 * std::max(std::abs(t_end), t_end - t);
  double dt = std::min(first_step(options), t_end - t);
  auto next_sample = std::lower_bound(sample_times.begin(), sample_times.end(), t);
  double last_event = t - 1;
  int cascade = 0;
  // A step that adapts is not cut at the end of the run, but looked into: whether its own length would have been
  // rejected must not depend on how long the run is.
  int looks_beyond =
      options.type == IntegratorType::generalized_alpha && options.generalized_alpha.adaptive ? most_looks_beyond : 0;

  EventLog log(ode, checkpoints);
  const auto exchange = [&](Memory& memory) {
    memory(dt);
    memory(last_event);
    memory(cascade);
    memory(looks_beyond);
    counters.exchange(memory);
    stepper->exchange(memory);
    side.exchange(memory);
  };
  if (checkpoints != nullptr && checkpoints->from) {
    const Checkpoint& from = *checkpoints->from;
    try {
      log.repeat(from);
      y = from.y;
      t = from.t;
      Memory memory(from.method);
      exchange(memory);
      if (!memory.at_end()) throw std::out_of_range("a memory of another method");
    } catch (const std::out_of_range& unfit) {
      refuse("checkpoint", unfit.what(), "it must be of this scene and this program");
    }
    next_sample = std::upper_bound(sample_times.begin(), sample_times.end(), t);
  } else {
    for (; next_sample != sample_times.end() && *next_sample <= t; ++next_sample) log.sample(y, t);
    log.set_next(t);
  }
  Eigen::VectorXd before = y;

  while (t < t_end) {
    before = y;
    const double t_before = t;
    const bool last = t_end - t <= dt * (1 + whole_step), beyond = last && looks_beyond > 0;
    if (beyond) --looks_beyond;
    if (last && !beyond) dt = t_end - t;
    const double tried = dt;
    if (!stepper->try_step(ode, y, t, dt)) {
      ++counters.rejected;
      shorten(dt, tried, *stepper);
      if (dt < smallest) underflow(t, smallest, method.system != nullptr);
      continue;
    }
    if (!y.allFinite()) {  // a trial state outside the domain of the equations: not an error estimate, so not rejected
      y = before;
      t = t_before;
      dt = tried / 10;
      ++counters.rejected;
      stepper->reset();
      if (dt < smallest) underflow(t, smallest, method.system != nullptr);
      continue;
    }
    if (last && !beyond) t = t_end;

    Located event;
    try {
      event = first_event(ode, side, *stepper, {t_before, before, t, y}, options);
    } catch (const SideStepUnderflow& stuck) {  // a step too long to be looked into
      y = before;
      t = t_before;
      dt = tried / 2;
      ++counters.rejected;
      stepper->resume(*stepper);
      if (dt < smallest) underflow(stuck.t, std::max(stuck.dt, smallest), method.system != nullptr);
      continue;
    }
    if (beyond && !(event.index >= 0 && event.t <= t_end)) {
      event = {};
      y = Eigen::VectorXd(state_at(ode, side, *stepper, {t_before, before, t, y}, t_end));
      t = t_end;
    }
    if (event.index >= 0) {
      stepper->keep_for_event(event.where == Located::Where::inside ? side.stepper() : *stepper,
                              event.where == Located::Where::start);
    }
    const bool cut = event.index >= 0 && event.t < t;
    if (cut) {
      t = event.t;
      y = event.y;
    }
    for (; next_sample != sample_times.end() && *next_sample <= t; ++next_sample) {
      log.sample(state_at(ode, side, *stepper, {t_before, before, t, y}, *next_sample), *next_sample);
    }
    if (!cut && !last) {
      counters.smallest_step = counters.smallest_step == 0 ? tried : std::min(counters.smallest_step, tried);
    }
    ++counters.steps;
    if (event.index >= 0) {
      cascade = t - last_event > smallest ? 0 : cascade + 1;
      last_event = t;
      if (cascade > longest_cascade) {
        throw ComputationFailed("a cascade of length-control events without progress in time", t);
      }
      log.event(event.index, y, t);
      stepper->reset();
      dt = tried;
    }
    const bool goes_on = ode.proceed(y, t);
    if (log.due(t, goes_on)) {
      Memory memory;
      exchange(memory);
      log.keep(y, t, memory.numbers());
    }
    if (!goes_on) return false;
  }
  return true;
}

}  // namespace vlbeam
