#include "mechanics/time/generalized_alpha.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/geometry/elementary.hpp"
#include "mechanics/time/alpha_stepper.hpp"

namespace vlbeam {
namespace {

constexpr double first_newton = 1e-8;  // of an increment
// Of the step: below, rounding of constraints and of what supports drive, over h, would go into velocities and forces.
constexpr double shortest_share = 1e-5;
constexpr double safety = 0.9, least_factor = 0.3, largest_factor = 1.5;  // of an adaptive step
constexpr double turn_margin = 1.1, turn_share = 0.85;                    // of the longest step for what it turns
constexpr int calm_steps = 12;       // behind one that was rejected: growing at once, it would be rejected again
constexpr double loss_factor = 0.3;  // to the next shorter step

}  // namespace

GeneralizedAlpha::GeneralizedAlpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options,
                                   NewtonCounters* counters)
    : system_(system),
      options_(options),
      counters_(counters),
      rule_(options.rho_inf),
      tolerance_(options.newton_tolerance > 0 ? options.newton_tolerance : first_newton),
      usual_(options.adaptive && options.first_step > 0 ? options.first_step : options.step) {
  history_.reserve(static_cast<std::size_t>(options.newton_iterations));
  if (counters) counters->longest.reserve(history_.capacity());
}

bool GeneralizedAlpha::try_step(Ode& /*ode*/, Eigen::VectorXd& y, double& t, double& dt) {
  const double h = length(dt);
  begin(y, t, h);
  if (!repeats_start_) std::swap(step_.start, step_.end);
  repeats_start_ = true;
  step_.end.resize(step_.d.size());
  const bool prescribed = system_.multipliers() > 0 || system_.driven();
  if (h < shortest_share * std::min(longest_, usual_) && !stalled_ && prescribed) {
    drift(y, t, h);
    nearby_ = false;
    solved_h_ = 0;
    dt = longest_;
    return true;
  }
  const double given_h = step_.start.h;
  const bool another_h = given_h > 0 && h != given_h;
  if (another_h) {  // `a` of the given length waits in step_.end, for give_up()
    assign(step_.end.a,
           step_.start.true_acceleration + (h / given_h) * (step_.start.a - step_.start.true_acceleration));
    step_.end.a.swap(step_.start.a);
    step_.start.h = h;
  }
  const auto give_up = [&] {
    if (another_h) step_.start.a.swap(step_.end.a);
    step_.start.h = given_h;
    return false;
  };

  double dissipation = 0;
  const bool nearby = nearby_;
  predict(t, h);
  bool solved = solve(t + h, h, options_.newton, nearby, dissipation);
  if (!solved && options_.newton == NewtonKind::modified) {  // before the step is given up: it would be another one
    predict(t, h);
    solved = solve(t + h, h, NewtonKind::full, false, dissipation);
  }
  if (!solved) {
    dt = h / 2;
    tangent_by_a_ = solved_h_ = 0;
    stalled_ = true;
    if (counters_) ++counters_->failures;
    shorter_.failed(dt);
    return give_up();
  }
  // evaluated where it is needed: until the step is accepted step_.end.a may hold what give_up() puts back
  const auto next_a = rule_.carried() * step_.start.a + (1 / (h * h * rule_.beta)) * step_.d;
  Eigen::VectorXd& error = r_;
  assign(error, rule_.error_constant(h) * (next_a - step_.start.a));
  stalled_ = false;
  solved_h_ = h;
  is_smooth_ = acceleration_predicts(h);
  if (options_.newton_tolerance == 0) choose_tolerance();
  if (!nearby) shorter_.taken(h, longest_);
  double next = shorter_.longest(longest_);
  if (options_.adaptive) {
    const double ratio = error_ratio(t, h);
    double factor = std::clamp(safety / portable::cbrt(std::max(ratio, 1e-12)), least_factor, largest_factor);
    if (ratio > 1) {
      dt = usual_ = h * factor;
      calm_ = calm_steps;
      return give_up();
    }
    if (calm_ > 0) {
      --calm_;
      factor = std::min(factor, 1.0);
    }
    if (h > shortest_share * longest_ && !follows_loss(y, t, h, dissipation)) {
      dt = usual_ = loss_factor * h;
      return give_up();
    }
    next = std::min(next, factor > 0.9 && factor < 1.2 ? h : h * factor);  // a kept step keeps the tangent
    if (options_.most_turn > 0) {  // in jumps: a step that is a little shorter each time gains energy
      const double turn = within_turn(t + h);
      if (next > turn) next = h < turn_margin * turn ? std::min(h, next) : turn_share * turn;
    }
    usual_ = next;
  }
  assign(step_.end.a, next_a);
  accept(y, t, h, dissipation);
  dt = next;
  return true;
}

bool GeneralizedAlpha::extrapolate(const Eigen::VectorXd& y, double t, double dt, double tau, Eigen::VectorXd& there) {
  begin(y, t, length(dt));
  const Eigen::Index own = step_.base_q().size(), others = y.size() - 2 * own;
  there.resize(y.size());
  const auto a = here().true_acceleration.head(own);
  assign_both_to(there.head(own), step_.base_q() + tau * (step_.base_v() + (tau / 2) * a),  //
                 there.segment(own, own), step_.base_v() + tau * a);
  there.tail(others) = y.tail(others);
  return true;
}

void GeneralizedAlpha::keep_for_event(const Stepper& other, bool at_start) {
  const auto& to_event = dynamic_cast<const GeneralizedAlpha&>(other);
  const EndAccelerations& last = at_start ? to_event.step_.start : to_event.here();
  EndAccelerations& before = step_.end;
  if (&last != &before) assign(before.true_acceleration, last.true_acceleration);
  // the step to the event may have been a short one: what `a` is ahead of that is taken from the whole one
  assign(before.a, before.true_acceleration + (step_.start.a - step_.start.true_acceleration));
  before.h = step_.start.h;
  crosses_event_ = true;
}

void GeneralizedAlpha::exchange(Archive& memory) {
  if (!memory.reads() && !options_.checkpoints) throw std::logic_error("generalized-alpha without checkpoints");
  system_.exchange(memory);
  memory(started_);
  memory(crosses_event_);
  if (crosses_event_) step_.end.exchange(memory);
  memory(motion_);
  memory(calm_);
  memory(usual_);
  memory(energy_);
  memory(turned_);
  memory(turned_until_);
  shorter_.exchange(memory);
  kept_.exchange(memory);
  memory(is_smooth_);
  memory(tolerance_);
  if (!started_) return;
  if (memory.reads()) repeats_start_ = false;
  here().exchange(memory);
  memory(allowed_);
  memory(from_q_);
  memory(motion_until_event_);
  memory(noise_step_);
  if (memory.reads()) stop_.set_fields(system_.fields());
  stop_.exchange(memory);
  memory(tangent_by_a_);
  if (tangent_by_a_ == 0) return;
  tangent_.exchange(memory);
  if (memory.reads()) system_.linearize(tangent_.q, tangent_.v, tangent_.a, tangent_.t, tangent_.by);
}

void GeneralizedAlpha::resume(const Stepper& other) {
  tangent_by_a_ = 0;
  solved_h_ = 0;
  resume_nearby(other);
}

void GeneralizedAlpha::resume_nearby(const Stepper& other) {
  const auto& main = dynamic_cast<const GeneralizedAlpha&>(other);
  if (&main != this) {
    system_.follow(main.system_);
    stop_.set_fields(main.stop_.fields());
    assign(allowed_, main.allowed_);
    assign(from_q_, main.from_q_);
    motion_ = main.motion_;
    motion_until_event_ = main.motion_until_event_;
    calm_ = main.calm_;
    usual_ = main.usual_;
    energy_ = main.energy_;
    turned_ = main.turned_;
    turned_until_ = main.turned_until_;
    kept_ = {};
    step_.start.take(main.step_.start);
  }
  repeats_start_ = true;
  longest_ = main.longest_;
  shorter_ = main.shorter_;
  tolerance_ = main.tolerance_;
  is_smooth_ = main.is_smooth_;
  started_ = true;
  stalled_ = false;
  nearby_ = solved_h_ > 0;
}

void GeneralizedAlpha::begin(const Eigen::VectorXd& y, double t, double h) {
  const Eigen::Index n = system_.coordinates();
  r_.resize(n);
  step_.begin(y, n, n - system_.multipliers());
  if (!started_) start(y, t, h);
}

void GeneralizedAlpha::start(const Eigen::VectorXd& y, double t, double h) {
  tangent_by_a_ = 0;
  system_.expand(y, step_.q, step_.v);
  Eigen::VectorXd& now = step_.start.true_acceleration;
  now.resize(step_.q.size());
  system_.acceleration(step_.q, step_.v, t, now);
  if (!crosses_event_ || !go_on(t, h)) {
    assign(step_.start.a, now);
    step_.start.h = 0;
    std::swap(step_.start, step_.end);
  }
  crosses_event_ = repeats_start_ = false;
  double dissipation = 0;
  if (system_.balance().dissipated) {
    system_.expand(y, step_.d, other_);
    dissipation = system_.residual(step_.d, other_, step_.end.true_acceleration, t, r_);
  }
  step_.end.power = system_.supplied_power(step_.q, step_.v, step_.end.true_acceleration, t);
  step_.end.power.dissipated = dissipation;
  stop_.set_fields(system_.fields());
  if (options_.adaptive) start_control(step_.q.size());
  started_ = true;
}

bool GeneralizedAlpha::go_on(double t, double h) {
  const Eigen::VectorXd& now = step_.start.true_acceleration;
  Eigen::VectorXd &carried = step_.d, &ahead = step_.start.a;  // neither is needed yet
  assign_both(carried, now, ahead, now);
  if (!system_.carry(step_.end.true_acceleration, t, carried, r_)) return false;
  system_.carry(step_.end.a, t, ahead, r_);
  assign(ahead, ahead - carried);
  system_.residual(step_.q, step_.v, carried, t, r_);
  if (!make_tangent(step_.q, step_.v, carried, t, h)) return false;
  system_.solve(r_);
  if (!all_finite(r_)) return false;
  step_.end.resize(carried.size());  // the event may have changed how many there are
  assign_both(step_.end.true_acceleration, carried - rule_.by_a(h) * r_,  //
              step_.end.a, step_.end.true_acceleration + ahead);
  // with these accelerations forces balance there, those of supports among them
  assign_both(step_.q, step_.q - r_, step_.v, step_.v - rule_.by_v(h) * r_);
  return true;
}

void GeneralizedAlpha::drift(Eigen::VectorXd& y, double& t, double h) {
  const Eigen::Index own = step_.base_q().size();
  y.head(own) += h * step_.base_v();
  y.segment(own, own) += h * step_.start.true_acceleration.head(own);
  system_.balance().add(h * step_.start.power, y);
  t += h;
}

void GeneralizedAlpha::accept(Eigen::VectorXd& y, double& t, double h, double dissipation) {
  EndAccelerations& end = step_.end;
  end.power = system_.supplied_power(step_.q, step_.v, end.true_acceleration, t + h);
  end.power.dissipated = dissipation;
  end.h = h;
  EnergyBalance given = 0.5 * h * (step_.start.power + end.power);
  if (system_.balance().dissipated) {
    system_.expand(y, r_, other_);
    const auto lost =
        system_.power_lost_between(r_, step_.q, step_.start.true_acceleration, end.true_acceleration, h, t);
    if (lost) given.dissipated = h * *lost;
  }
  system_.contract(step_.q, step_.v, y);
  energy_ = std::max(energy_, std::abs(given.dissipated));
  system_.balance().add(given, y);
  repeats_start_ = false;
  if (counters_) {
    const ConstraintResidual residual = system_.constraint_residual(step_.q, step_.v, t + h);
    auto& largest = counters_->constraints;
    largest.position = std::max(largest.position, residual.position);
    largest.velocity = std::max(largest.velocity, residual.velocity);
    const auto multipliers = end.true_acceleration.tail(system_.multipliers());
    counters_->multipliers.assign(multipliers.begin(), multipliers.end());
  }
  t += h;
}

std::unique_ptr<Stepper> make_generalized_alpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options,
                                                NewtonCounters* counters) {
  return std::make_unique<GeneralizedAlpha>(system, options, counters);
}

}  // namespace vlbeam
