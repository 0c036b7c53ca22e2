#include "mechanics/time/integrate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "mechanics/time/assign.hpp"
#include "mechanics/time/event_search.hpp"
#include "mechanics/time/progress.hpp"
#include "mechanics/time/step_length.hpp"

namespace vlbeam {
namespace {

constexpr double whole_step = 1e-9;    // no step for what rounding leaves of the run
constexpr double corner_reach = 1e-8;  // of the step to a corner, that it may end short of it
constexpr int longest_cascade = 8;     // events at one instant
constexpr int most_looks_beyond = 10;  // steps beyond the end of the run: there may be nothing behind it

double first_step(const IntegrationOptions& options) {
  if (!options.has_fixed_step()) return options.first_step;
  const double first = options.generalized_alpha.first_step;
  const bool starts_short = options.by_generalized_alpha() && first > 0;
  return starts_short ? std::min(first, longest_step(options)) : longest_step(options);
}

/// Whether a step from `from` that was to end at a corner has: at it, or as near as rounding and methods allow.
bool is_there(double corner, double from, double t) { return std::abs(t - corner) <= corner_reach * (corner - from); }

[[noreturn]] void underflow(double t, double dt, bool implicit) {
  std::ostringstream what;
  what << "step underflow: the integrator needs steps below " << dt << " s; "
       << (implicit ? "Newton's iteration does not converge even then"
                    : "the scene may be too stiff for an explicit method")
       << "; the last shape may show an element that is far shorter than the others, or pressed together to a point";
  throw ComputationFailed(what.str(), t);
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
    Archive memory;
    ode_.exchange(memory);
    return memory.numbers();
  }
  void recall(const std::vector<double>& numbers) {
    Archive memory(numbers);
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
  if (checkpoints != nullptr && options.other && !options.other->can_be_restarted) {
    throw ModelError("integrator", "a method that cannot be restarted, with checkpoints",
                     "it keeps its history to itself: take another method");
  }
  IntegrationOptions of_method = options;
  of_method.generalized_alpha.checkpoints = checkpoints != nullptr && checkpoints->keep;
  const Method method(ode, of_method, counters.newton);
  Stepper* const stepper = method.stepper.get();
  SideStepper side(ode, options, counters.newton);
  EventSearch search(ode, *stepper, side, options);
  EventAim aim(ode, *stepper, options);
  StepLength length(options, counters);
  const double smallest = 1e-15 * std::max(std::abs(t_end), t_end - t);
  double dt = std::min(first_step(options), t_end - t);
  auto next_sample = std::lower_bound(sample_times.begin(), sample_times.end(), t);
  double last_event = t - 1;
  int cascade = 0;
  // A step that adapts is not cut at the end of the run, but looked into: whether its own length would have been
  // rejected must not depend on how long the run is.
  int looks_beyond = options.by_generalized_alpha() && options.generalized_alpha.adaptive ? most_looks_beyond : 0;

  EventLog log(ode, checkpoints);
  const auto exchange = [&](Archive& memory) {
    memory(dt);
    memory(last_event);
    memory(cascade);
    memory(looks_beyond);
    counters.exchange(memory);
    length.exchange(memory);
    stepper->exchange(memory);
    aim.exchange(memory);
    side.exchange(memory);
  };
  if (checkpoints != nullptr && checkpoints->from) {
    const Checkpoint& from = *checkpoints->from;
    try {
      log.repeat(from);
      y = from.y;
      t = from.t;
      Archive memory(from.method);
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
  Progress progress(t, t_end, options.first_step, counters);
  const std::function<std::string()> where = [&] { return ode.fastest(y); };

  while (t < t_end) {
    progress.tries(t, where);
    assign(before, y);
    const double t_before = t;
    const double proposed = dt;
    aim.stand_at(before, t);
    const double clear = aim.longest();
    const bool nears = clear < dt;
    if (nears) dt = clear;
    const Timetable::Step stretch = options.timetable.step(t, dt);
    if (!options.timetable.empty()) {
      dt = stretch.length;
      stepper->limit(stretch.longest);
    }
    const bool last = t_end - t <= dt * (1 + whole_step), beyond = last && looks_beyond > 0;
    if (beyond) --looks_beyond;
    if (last && !beyond) dt = t_end - t;
    const double whole = dt;
    dt = aim.take(before, t, whole, y);
    const double tried = dt;
    const std::size_t failures = counters.newton.failures;
    if (!stepper->try_step(ode, y, t, dt)) {
      length.rejected(counters.newton.failures > failures);
      shorten(dt, tried, *stepper);
      if (dt < smallest) underflow(t, smallest, method.system != nullptr);
      continue;
    }
    if (!all_finite(y)) {  // a trial state outside the domain of the equations: not an error estimate, so not rejected
      y = before;
      t = t_before;
      dt = tried / 10;
      length.rejected(StepLimit::error);
      stepper->reset();
      if (dt < smallest) underflow(t, smallest, method.system != nullptr);
      continue;
    }
    if (last && !beyond && !aim.aims()) t = t_end;
    if (stretch.corner && !aim.aims() && is_there(*stretch.corner, t_before, t)) t = *stretch.corner;

    const double longest = whole * (1 + slightly_longer);
    const EventAim::Shot shot =
        aim.shoot(before, t_before, beyond ? longest : std::min(longest, t_end - t_before), y, t);
    if (shot == EventAim::Shot::missed) {
      dt = proposed;
      if (beyond) ++looks_beyond;
      continue;
    }
    const bool hit = shot == EventAim::Shot::hit;
    LocatedEvent event;
    try {
      if (hit) {
        event = {aim.guard(), t, {}, LocatedEvent::Where::end};
      } else {
        event = search.first({t_before, before, t, y}, aim.at_start(), aim.at_end());
      }
    } catch (const SideStepUnderflow& stuck) {  // a step too long to be looked into
      y = before;
      t = t_before;
      dt = tried / 2;
      length.rejected(StepLimit::events);
      stepper->resume(*stepper);
      if (dt < smallest) underflow(stuck.t, std::max(stuck.dt, smallest), method.system != nullptr);
      continue;
    }
    if (beyond && !(event.index >= 0 && event.t <= t_end)) {
      event = {};
      y = search.at({t_before, before, t, y}, t_end);
      t = t_end;
    }
    if (event.index >= 0) {
      stepper->keep_for_event(event.where == LocatedEvent::Where::inside ? side.stepper() : *stepper,
                              event.where == LocatedEvent::Where::start);
    }
    const bool cut = event.index >= 0 && event.t < t;
    if (cut) {
      t = event.t;
      y = event.y;
    }
    for (; next_sample != sample_times.end() && *next_sample <= t; ++next_sample) {
      log.sample(search.at({t_before, before, t, y}, *next_sample), *next_sample);
    }
    const bool at_corner = stretch.corner == t;
    if (!cut && !hit && !last && !at_corner) {
      counters.smallest_step = counters.smallest_step == 0 ? tried : std::min(counters.smallest_step, tried);
    }
    length.accepted(tried, event.index >= 0 || nears, whole < proposed || (last && !beyond));
    if (at_corner || nears) dt = std::max(dt, proposed);
    if (at_corner) stepper->pass_corner();
    if (event.index >= 0) {
      cascade = t - last_event > smallest ? 0 : cascade + 1;
      last_event = t;
      if (cascade > longest_cascade) {
        throw ComputationFailed("a cascade of length-control events without progress in time", t);
      }
      log.event(event.index, y, t);
      stepper->reset();
      aim.forget();
      dt = proposed;
    }
    ode.correct(y, t);
    const bool goes_on = ode.proceed(y, t);
    if (log.due(t, goes_on)) {
      Archive memory;
      exchange(memory);
      log.keep(y, t, memory.numbers());
    }
    if (!goes_on) return false;
  }
  return true;
}

}  // namespace vlbeam
