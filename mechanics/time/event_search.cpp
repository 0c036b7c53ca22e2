#include "mechanics/time/event_search.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/pieces.hpp"
#include "mechanics/time/assign.hpp"

namespace vlbeam {
namespace {

constexpr double guard_tolerance = 1e-12;  // a guard this near zero is at its root
constexpr double event_tolerance = 1e-10;  // a guard must exceed this at the end of a step to be looked into
constexpr double clearly_before = -1e-3;   // of a guard at the first root of another one: its own comes later
constexpr int most_refinements = 60;       // steps to locate one event
constexpr int most_repetitions = 6;        // of a step that is aimed at an event
constexpr double shortest_aim = 1e-6;      // of the whole step
constexpr double just_passed = 0.02;       // of the step
constexpr double foreseen_within = 1e-4;   // of the whole step: what is foreseen is not known better

/// Near enough to its root, in the attempt `i`.
bool is_at_root(const Guard& guard, int i) {
  return std::abs(guard.value) <= std::max(i < 4 ? guard_tolerance : event_tolerance, guard.rounding);
}

/// Lets a vector be what another one is, in the end.
struct PutBack {
  Eigen::VectorXd& vector;
  const Eigen::VectorXd& as;

  ~PutBack() { assign(vector, as); }
};

/// The cubic Hermite interpolant of a step's states.
class Interpolant {
 public:
  Interpolant(EventedOde& ode, const WholeStep& step) : step_(step), f0_(step.y0.size()), f1_(f0_.size()) {
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
  const WholeStep& step_;
  Eigen::VectorXd f0_, f1_, y_;
};

bool is_due(const Guard& guard) { return guard.value > std::max(event_tolerance, guard.rounding); }

/// Whether a guard that rises at the start of a step of length h, and falls at its end, is due in between: by the cubic
/// of its values and rates.
bool is_due_within(const Guard& start, const Guard& end, double h) {
  if (!(start.rate > 0 && end.rate < 0) || is_due(start) || is_due(end)) return false;
  const double m0 = h * start.rate, m1 = h * end.rate, rise = end.value - start.value;
  const double c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
  const double u = m0 / (std::sqrt(c2 * c2 - 3 * c3 * m0) - c2);  // where its derivative, m0 + 2 c2 u + 3 c3 u^2, is 0
  return is_due({start.kind, start.part, start.value + u * (m0 + u * (c2 + u * c3)), start.rounding});
}

bool any_is_due_within(const Guards& start, const Guards& end, double h) {
  if (start.size() != end.size()) return false;
  for (std::size_t k = 0; k < end.size(); ++k) {
    if (is_due_within(start[k], end[k], h)) return true;
  }
  return false;
}

/// Root of guard `k` of the interpolant, from the start of the step.
double interpolated_root(EventedOde& ode, Interpolant& interpolant, const WholeStep& step, std::size_t k) {
  auto interpolated = [&](double tau) { return ode.guards(interpolant(tau), step.t0 + tau)[k].value; };
  std::uintmax_t evaluations = 40;
  const auto bracket = boost::math::tools::toms748_solve(
      interpolated, 0.0, step.t1 - step.t0, ode.guards(step.y0, step.t0)[k].value,
      ode.guards(step.y1, step.t1)[k].value, boost::math::tools::eps_tolerance<double>(40), evaluations);
  return (bracket.first + bracket.second) / 2;
}

/// Root of guard `k` by steps of the main stepper's own method. The interpolant gives the first guess `tau` and the
/// slope, so that two or three steps do; the secant is kept in a bracket, and bisects where it leaves it.
LocatedEvent locate(EventedOde& ode, SideStepper& side, const Stepper& main, const WholeStep& step,
                    Interpolant& interpolant, double tau, std::size_t k) {
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
    if (is_at_root(guard, i) || closed || i == most_refinements) {
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

}  // namespace

const Eigen::VectorXd& EventSearch::at(const WholeStep& step, double t) {
  if (t == step.t1) return step.y1;
  try {
    return side_.at(main_, step.y0, step.t0, t);
  } catch (const SideStepUnderflow&) {
    interpolated_ = Interpolant(ode_, step)(t - step.t0);
    return interpolated_;
  }
}

LocatedEvent EventSearch::first(const WholeStep& step, const Guards& before, const Guards& at_end) {
  const bool passes = any_is_due_within(before, at_end, step.t1 - step.t0);
  if (!passes && std::ranges::none_of(at_end, [&](const Guard& guard) {
        return is_due(guard) || guard.value > options_.largest_overshoot;
      })) {
    return {};
  }
  const bool exactly = options_.locate_events;
  const Guards at_start = ode_.guards(step.y0, step.t0);
  for (std::size_t k = 0; k < at_end.size(); ++k) {  // what was due before the step makes no step too long
    if (is_due(at_end[k]) && at_start[k].value >= -std::max(guard_tolerance, at_start[k].rounding)) {
      return {static_cast<int>(k), step.t0, step.y0, LocatedEvent::Where::start};
    }
  }
  if (passes ||
      std::ranges::any_of(at_end, [&](const Guard& guard) { return guard.value > options_.largest_overshoot; })) {
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
  if (!exactly) return {static_cast<int>(candidates.front().guard), step.t1, step.y1, LocatedEvent::Where::end};

  Interpolant interpolant(ode_, step);
  for (Candidate& each : candidates) each.tau = interpolated_root(ode_, interpolant, step, each.guard);
  std::ranges::stable_sort(candidates, {}, &Candidate::tau);
  LocatedEvent first;
  std::size_t last = 0;  // guard that was located
  for (const auto& [tau, k] : candidates) {
    // Beyond the first event the equations may not even have a solution.
    if (first.index >= 0 && ode_.guards(first.y, first.t)[k].value < clearly_before) continue;
    last = k;
    const LocatedEvent found = locate(ode_, side_, main_, step, interpolant, tau, k);
    if (first.index < 0 || found.t < first.t || (found.t == first.t && found.index < first.index)) first = found;
  }
  if (first.index != static_cast<int>(last)) {  // `side` is to end there
    side_.at(main_, step.y0, step.t0, first.t);
  }
  return first;
}

/// By twice the speed of the last step.
bool EventAim::all_stay_behind(const Guards& now, double t, double dt) const {
  if (known_.size() != now.size() || !(t > known_t_)) return false;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double rise = std::max(0.0, now[k].value - known_[k].value) / (t - known_t_);
    if (now[k].value + 2 * rise * dt > 0) return false;
  }
  return true;
}

void EventAim::stand_at(const Eigen::VectorXd& start, double t) {
  if (t == now_t_) return;
  if (t == end_t_) {
    now_ = at_end_;
  } else {
    now_ = ode_.guards(start, t);
  }
  now_t_ = t;
}

double EventAim::longest() const {
  double longest = std::numeric_limits<double>::infinity();
  for (const Guard& guard : now_) {
    if (guard.rate > 0 && guard.value < 0) longest = std::min(longest, (guard.room - guard.value) / guard.rate);
  }
  return longest;
}

double EventAim::take(const Eigen::VectorXd& start, double t, double dt, Eigen::VectorXd& y) {
  guard_ = -1;
  if (!takes_aim_ || t == missed_from_) return dt;
  const Guards& now = now_;
  const bool behind = all_stay_behind(now, t, dt);
  known_ = now;
  known_t_ = t;
  if (behind) return dt;
  repeats_ = main_.extrapolate(start, t, dt, dt, y);
  if (!repeats_) return dt;
  const PutBack at_last{y, start};
  const Guards then = ode_.guards(y, t + dt);
  const auto foreseen = [&](std::size_t k, double tau) {
    main_.extrapolate(start, t, dt, tau, y);
    return ode_.guards(y, t + tau)[k].value;
  };
  double first = dt;
  for (std::size_t k = 0; k < then.size(); ++k) {
    if (!is_due(then[k])) continue;
    if (now[k].value >= -std::max(guard_tolerance, now[k].rounding)) return guard_ = -1, dt;  // due at the start
    std::uintmax_t evaluations = 12;
    const auto [low, high] =
        boost::math::tools::toms748_solve([&](double tau) { return foreseen(k, tau); }, 0.0, dt, now[k].value,
                                          then[k].value, boost::math::tools::eps_tolerance<double>(16), evaluations);
    const double tau = (low + high) / 2;
    if (tau > first - foreseen_within * dt) continue;
    first = tau;
    guard_ = static_cast<int>(k);
  }
  if (guard_ < 0) return dt;
  const double reach = 1e-3 * dt;
  const auto k = static_cast<std::size_t>(guard_);
  slope_ = (foreseen(k, first + reach) - foreseen(k, first - reach)) / (2 * reach);
  if (first > shortest_aim * dt && slope_ > 0) return first;
  guard_ = -1;
  return dt;
}

void EventAim::exchange(Archive& memory) {
  memory(repeats_);
  memory(known_t_);
  Eigen::VectorXd values(static_cast<Eigen::Index>(known_.size()));
  for (std::size_t k = 0; k < known_.size(); ++k) values[static_cast<Eigen::Index>(k)] = known_[k].value;
  memory(values);
  known_.resize(static_cast<std::size_t>(values.size()));
  for (std::size_t k = 0; k < known_.size(); ++k) known_[k].value = values[static_cast<Eigen::Index>(k)];
}

void EventAim::aim_at_what_has_passed(const Guards& then, double t, double latest) {
  if (!repeats_ || known_t_ == missed_from_ || known_.size() != then.size()) return;
  for (std::size_t k = 0; k < then.size(); ++k) {
    const double rise = then[k].value - known_[k].value, slope = rise / (t - known_t_);
    if (is_due(then[k])) {
      if (then[k].value > just_passed * rise) return;
    } else if (known_[k].value > clearly_before || !(rise > 0) || t - then[k].value / slope > latest) {
      continue;
    }
    guard_ = static_cast<int>(k);
    slope_ = slope;
    return;
  }
}

EventAim::Shot EventAim::shoot(const Eigen::VectorXd& y0, double t0, double longest, Eigen::VectorXd& y, double& t) {
  double last_t = 0, last_value = 0;
  for (int i = 0; i < most_repetitions; ++i) {
    at_end_ = ode_.guards(y, t);
    end_t_ = t;
    const Guards& guards = at_end_;
    if (guard_ < 0) aim_at_what_has_passed(guards, t, t0 + longest);
    if (guard_ < 0) return Shot::none;
    const auto k = static_cast<std::size_t>(guard_);
    const Guard& guard = guards[k];
    if (is_at_root(guard, i) || guard.value < 0) {
      bool is_first = true;
      for (std::size_t other = 0; other < guards.size(); ++other) {
        is_first = is_first && (other == k || !is_due(guards[other]));
      }
      if (!is_first) break;
      if (is_at_root(guard, i)) return Shot::hit;
    }
    if (i > 0) slope_ = (guard.value - last_value) / (t - last_t);
    last_t = t;
    last_value = guard.value;
    const double next = t - guard.value / slope_ - t0;
    if (!(next > 0 && next <= longest)) break;
    main_.resume_nearby(main_);
    assign(y, y0);
    t = t0;
    double dt = next;
    if (!main_.try_step(ode_, y, t, dt) || !all_finite(y)) break;
  }
  missed_from_ = t0;
  guard_ = -1;
  main_.resume(main_);
  assign(y, y0);
  t = t0;
  return Shot::missed;
}

}  // namespace vlbeam
