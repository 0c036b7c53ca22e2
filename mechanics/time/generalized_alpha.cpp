#include "mechanics/time/generalized_alpha.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/geometry/elementary.hpp"
#include "mechanics/time/alpha_step.hpp"
#include "mechanics/time/assign.hpp"
#include "mechanics/time/kept_tangent.hpp"
#include "mechanics/time/newton_stop.hpp"
#include "mechanics/time/shorter_steps.hpp"

namespace vlbeam {
namespace {

constexpr double newton_share = 3e-4;  // of a step's own error, that Newton's iteration may leave
constexpr double first_newton = 1e-8, least_newton = 1e-10, most_newton = 1e-5;  // of an increment
constexpr double same_step = 0.05;  // relative difference of by_a: the tangent of nearly the same step
constexpr double stagnation = 0.5;  // contraction with tangents of the same step: rounding, or far from a solution
// Of the step: below, rounding of constraints and of what supports drive, over h, would go into velocities and forces.
constexpr double shortest_share = 1e-5;
constexpr double safety = 0.9, least_factor = 0.3, largest_factor = 1.5;  // of an adaptive step
constexpr double turn_margin = 1.1, turn_share = 0.85;                    // of the longest step for what it turns
constexpr int calm_steps = 12;          // behind one that was rejected: growing at once, it would be rejected again
constexpr double least_motion = 1e-5;   // of Tolerances::motion
constexpr double foreseen_share = 0.1;  // of the longest step that follows the motion: so far it is foreseen
constexpr double sets_in = 10;          // of a damper: power at the end of a step over that at its start
constexpr double loss_share = 1e-3;     // of the largest kinetic energy so far, lost where a damper sets in
constexpr double loss_factor = 0.3;     // to the next shorter step
constexpr double torn_share = 0.3;      // of it: no step is off so far, in modes that it does not follow either

class GeneralizedAlpha final : public Stepper {
 public:
  GeneralizedAlpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options, NewtonCounters* counters)
      : system_(system),
        options_(options),
        counters_(counters),
        rule_(options.rho_inf),
        tolerance_(options.newton_tolerance > 0 ? options.newton_tolerance : first_newton),
        usual_(options.adaptive && options.first_step > 0 ? options.first_step : options.step) {
    history_.reserve(static_cast<std::size_t>(options.newton_iterations));
    if (counters) counters->longest.reserve(history_.capacity());
  }

  bool try_step(Ode& /*ode*/, Eigen::VectorXd& y, double& t, double& dt) override {
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

  bool extrapolate(const Eigen::VectorXd& y, double t, double dt, double tau, Eigen::VectorXd& there) override {
    begin(y, t, length(dt));
    const Eigen::Index own = step_.base_q().size(), others = y.size() - 2 * own;
    there.resize(y.size());
    const auto a = here().true_acceleration.head(own);
    assign_both_to(there.head(own), step_.base_q() + tau * (step_.base_v() + (tau / 2) * a),  //
                   there.segment(own, own), step_.base_v() + tau * a);
    there.tail(others) = y.tail(others);
    return true;
  }

  void reset() override {
    started_ = nearby_ = false;
    solved_h_ = 0;
    tangent_by_a_ = 0;
  }

  void pass_corner() override {}  // its accelerations go on: the step that they are off is one, and short

  void limit(double longest) override { longest_ = std::min(options_.step, longest); }

  void keep_for_event(const Stepper& other, bool at_start) override {
    const auto& to_event = dynamic_cast<const GeneralizedAlpha&>(other);
    const EndAccelerations& last = at_start ? to_event.step_.start : to_event.here();
    EndAccelerations& before = step_.end;
    if (&last != &before) assign(before.true_acceleration, last.true_acceleration);
    // the step to the event may have been a short one: what `a` is ahead of that is taken from the whole one
    assign(before.a, before.true_acceleration + (step_.start.a - step_.start.true_acceleration));
    before.h = step_.start.h;
    crosses_event_ = true;
  }

  void exchange(Memory& memory) override {
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

  void resume(const Stepper& other) override {
    tangent_by_a_ = 0;
    solved_h_ = 0;
    resume_nearby(other);
  }

  void resume_nearby(const Stepper& other) override {
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

 private:
  double length(double dt) const { return dt <= longest_ * (1 + 2 * slightly_longer) ? dt : longest_; }

  /// A step from (t, y), of length h.
  void begin(const Eigen::VectorXd& y, double t, double h) {
    const Eigen::Index n = system_.coordinates();
    r_.resize(n);
    step_.begin(y, n, n - system_.multipliers());
    if (!started_) start(y, t, h);
  }

  void start(const Eigen::VectorXd& y, double t, double h) {
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
    if (system_.tallies().dissipated) {
      system_.expand(y, step_.d, other_);
      dissipation = system_.residual(step_.d, other_, step_.end.true_acceleration, t, r_);
    }
    step_.end.power = system_.supplied_power(step_.q, step_.v, step_.end.true_acceleration, t);
    step_.end.power.dissipated = dissipation;
    stop_.set_fields(system_.fields());
    if (options_.adaptive) start_control(step_.q.size());
    started_ = true;
  }

  void start_control(Eigen::Index n) {
    assign(allowed_, Eigen::VectorXd::Constant(n, options_.tolerances.atol));
    if (const auto& by_field = options_.tolerances.by_field) {
      for_each_coordinate(stop_.fields(), [&](Field field, Eigen::Index i) {
        allowed_[i] = by_field->of[static_cast<std::size_t>(field)];
      });
    }
    from_q_.setZero(n);
    from_q_.head(step_.base_q().size()) = step_.base_q();
    motion_until_event_ = motion_;
  }

  /// Lets the method go on through an event with its accelerations of before. Those of the equations of motion tell, in
  /// all modes, what the event has changed of the forces: a merged element that is 1e-9 m off its shape would throw a
  /// mode faster than the step a million times as far as it will swing, and a method that starts anew in each step,
  /// where events are as frequent, gives such modes energy. Of that change the method takes what its step can follow,
  /// by its own tangent S = K + by_v C + by_a M: in slow modes all but a share of (frequency x step)^2. The
  /// accelerations of before are in step_.end, where those with which it goes on take their place, and those of now in
  /// step_.start. Returns false where it starts anew.
  bool go_on(double t, double h) {
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

  /// The velocity goes on, and the acceleration, too, where that is smooth: else it would throw stiff modes, whose
  /// period is shorter than the step, far off, and Newton would start from a torn mesh.
  void predict(double t, double h) {
    if (nearby_) {
      const double ratio = h / solved_h_;
      assign(step_.d, (ratio * ratio) * step_.d);
    } else if (is_smooth_) {
      assign(step_.d, (0.5 * h * h) * step_.start.a);
    } else {
      assign(step_.d, Eigen::VectorXd::Zero(step_.d.size()));
    }
    nearby_ = false;
    step_.complete(rule_, h);
    if (system_.driven_offset(step_.q, t + h, r_)) {  // what is driven has no equation that Newton would solve
      step_.correct(rule_, r_, h);
    }
  }

  /// Whether the end of this step was nearer to the acceleration going on than to the velocity alone. Slopes tell:
  /// stiff modes turn them more than they move nodes.
  bool acceleration_predicts(double h) const {
    Eigen::Array2d off{0, 0};  // squares, of the one and of the other
    for (const FieldRun& run : stop_.fields()) {
      if (run.field != Field::slope) continue;
      off += sum_in_pieces<Eigen::Array2d>(run.count, run.stride, [&](Eigen::Index first, Eigen::Index count) {
        Eigen::Array2d sum{0, 0};
        for_each_coordinate(std::array{run.part(first, count)}, [&](Field /*field*/, Eigen::Index i) {
          const double by_acceleration = step_.d[i] - 0.5 * h * h * step_.start.a[i], by_velocity = step_.d[i];
          sum += Eigen::Array2d(by_acceleration * by_acceleration, by_velocity * by_velocity);
        });
        return sum;
      });
    }
    return off[0] < off[1];
  }

  /// Newton's iteration for the end of the step, from the predictor. Returns false where it stalls. `nearby`: its
  /// tangent is that of nearly this step.
  bool solve(double t, double h, NewtonKind kind, bool nearby, double& dissipation) {
    const bool renew = kept_.is_old() && !nearby;
    if (renew || std::abs(rule_.by_a(h) - tangent_by_a_) > (nearby ? same_step * rule_.by_a(h) : 0)) tangent_by_a_ = 0;
    const bool starts_fresh = tangent_by_a_ == 0;
    if (h != noise_step_) stop_.forget_noise();
    noise_step_ = h;
    bool fresh = false;         // the tangent is of this step
    int with_this_tangent = 0;  // iterations of this step
    history_.clear();
    stop_.begin_step(nearby && !starts_fresh ? stop_.slowest() + std::abs(rule_.by_a(h) / tangent_by_a_ - 1) : 0);
    for (int iteration = 0; iteration < options_.newton_iterations; ++iteration) {
      dissipation = system_.residual(step_.q, step_.v, step_.end.true_acceleration, t, r_);
      if (tangent_by_a_ == 0 || kind == NewtonKind::full) {
        if (!make_tangent(step_.q, step_.v, step_.end.true_acceleration, t, h)) return false;
        stop_.new_tangent();
        fresh = true;
        with_this_tangent = 0;
      }
      system_.solve(r_);
      if (!all_finite(r_)) return false;
      step_.correct(rule_, r_, h);
      const NewtonStop::Verdict verdict = stop_.judge(r_, step_.d, tolerance_, slow_contraction);
      count(stop_.error());
      if (verdict == NewtonStop::Verdict::done) {
        if (starts_fresh) {
          kept_.made(stop_.slowest());
        } else if (!nearby) {
          kept_.kept(iteration + 1, fresh);
        }
        return true;
      }
      if (verdict == NewtonStop::Verdict::stagnates && stop_.negligible(step_.q)) {
        measure_noise(t, h);
        if (stop_.settle()) return true;
      }
      if (++with_this_tangent > 1 || kind == NewtonKind::full) {
        if (fresh && stop_.negligible(step_.q) && !stop_.falls()) return true;
        // far from a solution full Newton may find another one than that of a shorter step
        const double limit = kind == NewtonKind::full ? stagnation : 1;
        const bool late = kind == NewtonKind::modified || iteration > 1;  // the first may overshoot
        if (fresh && late && stop_.contraction() > limit && stop_.grows(limit, step_.q)) return false;
        if (stop_.error_after(tangent_work + 1) > tolerance_) tangent_by_a_ = 0;
      }
    }
    return false;
  }

  /// Of a step of length h.
  bool make_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t, double h) {
    const TangentWeights by{1, rule_.by_v(h), rule_.by_a(h)};
    if (options_.checkpoints) tangent_.set(q, v, a, t, by);
    if (!system_.linearize(q, v, a, t, by)) return false;
    if (counters_) ++counters_->tangents;
    tangent_by_a_ = by.a;
    return true;
  }

  /// What rounding of all that the residual depends on does to the solution.
  void measure_noise(double t, double h) {
    system_.residual(step_.q, step_.v, step_.end.true_acceleration, t, r_);
    for (Eigen::VectorXd* vector : {&step_.q, &step_.v, &step_.end.true_acceleration}) NewtonStop::perturb(*vector);
    Eigen::VectorXd rounded(r_.size());  // not kept: this is seldom asked for, and long beams need no vector more
    system_.residual(step_.q, step_.v, step_.end.true_acceleration, t, rounded);
    step_.complete(rule_, h);  // as they were
    assign(r_, r_ - rounded);
    system_.solve(r_);
    stop_.set_noise(r_, step_.q);
  }

  void count(double error) {
    if (!counters_) return;
    ++counters_->iterations;
    history_.push_back(error);
    if (history_.size() > counters_->longest.size()) counters_->longest = history_;
  }

  /// Estimated error of the positions over what the tolerances allow, the largest of all coordinates.
  double error_ratio(double t, double h) {
    const Eigen::Index count = step_.q.size() - system_.multipliers();
    if (is_torn()) return std::numeric_limits<double>::infinity();
    if (options_.error_estimate == ErrorEstimate::filtered) filter_error(t + h, h, count);
    const double scale = share_of_motion();
    std::atomic<double> largest = 0;
    in_pieces(count, 1, [&](Eigen::Index first, Eigen::Index n) {
      raise(largest,
            step_kernels().error_ratio(n, r_.data() + first, allowed_.data() + first, step_.base_q().data() + first,
                                       step_.q.data() + first, scale, options_.tolerances.rtol));
    });
    return largest;
  }

  /// How long the next step may be for what it turns [s]. The error of a turn adds to those before it: that of a step
  /// goes with the square of its angle, and the sum of all so with the logarithm of what has turned, not in proportion.
  double within_turn(double t) {
    const double rate = system_.turning(step_.q, step_.v);
    if (t > turned_until_) {  // a step that is repeated does not count again
      turned_ += rate * (t - turned_until_);
      turned_until_ = t;
    }
    return options_.most_turn / (std::sqrt(1 + turned_) * std::max(rate, std::numeric_limits<double>::min()));
  }

  /// Whether the step is short enough to tell what it loses. A damper that sets in within it, as where a mass lands,
  /// may stop the mass within a small part of it: positions are right to the tolerance then, but the power at the end
  /// of the step says nothing of what it loses, nor does that of the next step's middle. Such a step is to lose no
  /// more, by its end, than a small share of the largest kinetic energy so far.
  bool follows_loss(const Eigen::VectorXd& y, double t, double h, double dissipation) {
    const double before = step_.start.power.dissipated;
    if (!(dissipation > sets_in * before)) return true;
    system_.expand(y, r_, other_);
    for (const Eigen::VectorXd* velocities : {&other_, &step_.v}) {
      if (!system_.inertia(step_.q, *velocities, t + h, r_)) return true;
      energy_ = std::max(energy_, 0.5 * std::abs(velocities->dot(r_)));
    }
    return 0.5 * h * dissipation <= loss_share * energy_;
  }

  /// What Newton's iteration may leave in the next step, of its increment: a share of the error that the method itself
  /// makes, as it was in this step.
  void choose_tolerance() {
    const auto [errors, increments] = field_norms<2>(stop_.fields(), {&r_, &step_.d});
    double least = std::numeric_limits<double>::infinity();
    for (const Field field : {Field::position, Field::slope, Field::mark, Field::mass, Field::angle}) {
      const auto f = static_cast<std::size_t>(field);
      if (errors[f] > 0 && increments[f] > 0) least = std::min(least, errors[f] / increments[f]);
    }
    tolerance_ = std::clamp(newton_share * least, least_newton, most_newton);
  }

  /// Whether the unfiltered error is no error of a step any more. Newton's iteration may find another solution than the
  /// one that goes on from the start, a rod turned round for one; it is as if stiff modes had thrown the beam there,
  /// and filter_error() would leave nothing of that.
  bool is_torn() const {
    if (options_.tolerances.motion == 0) return false;
    const FieldNorms errors = field_norms(stop_.fields(), r_);
    return errors[static_cast<std::size_t>(Field::position)] > torn_share * options_.tolerances.motion;
  }

  /// By the tangent: of fast modes, which the step does not follow, it counts next to nothing. The residual is linear
  /// in the accelerations, and next to 0 at the end of the step: with more acceleration it is the inertia of this.
  void filter_error(double t, double h, Eigen::Index count) {
    other_.resize(step_.q.size());
    assign_to(other_.head(count), rule_.by_a(h) * r_.head(count));
    other_.tail(system_.multipliers()).setZero();
    if (!system_.inertia(step_.q, other_, t, r_)) {
      assign(other_, step_.end.true_acceleration + other_);
      system_.residual(step_.q, step_.v, other_, t, r_);
    }
    system_.solve(r_);
  }

  /// The longest step that is thought to follow the motion, whatever the duration of the run: what tolerances make of
  /// positions and their rates [s].
  double longest_followed() const {
    const auto position = static_cast<std::size_t>(Field::position);
    const auto& by_field = options_.tolerances.by_field;
    return by_field && by_field->of_rate[position] > 0 ? by_field->of[position] / by_field->of_rate[position] : 0;
  }

  /// Of the tolerances, by the largest displacement so far, or that of a part of the longest step at the largest speed:
  /// what starts with a jolt will move farther than it has, and vibrations that turn back before do not count in full.
  /// At an event nodes become others: what they move from then on is added to the largest before.
  double share_of_motion() {
    const double whole = options_.tolerances.motion;
    if (whole == 0) return 1;
    assign(other_, step_.q - from_q_);
    const FieldNorms moved = field_norms(stop_.fields(), other_), speeds = field_norms(stop_.fields(), step_.v);
    double motion = 0;
    for (const Field field : {Field::position, Field::mark, Field::mass}) {
      const auto f = static_cast<std::size_t>(field);
      motion_ = std::max(motion_, motion_until_event_ + moved[f]);
      motion = std::max(motion, foreseen_share * longest_followed() * speeds[f]);
    }
    return std::clamp(std::max(motion_, motion) / whole, least_motion, 1.0);
  }

  /// A step of next to no length, up to an event or a sample: the last accelerations go on.
  void drift(Eigen::VectorXd& y, double& t, double h) {
    const Eigen::Index own = step_.base_q().size();
    y.head(own) += h * step_.base_v();
    y.segment(own, own) += h * step_.start.true_acceleration.head(own);
    system_.tallies().add(h * step_.start.power, y);
    t += h;
  }

  void accept(Eigen::VectorXd& y, double& t, double h, double dissipation) {
    EndAccelerations& end = step_.end;
    end.power = system_.supplied_power(step_.q, step_.v, end.true_acceleration, t + h);
    end.power.dissipated = dissipation;
    end.h = h;
    Tally given = 0.5 * h * (step_.start.power + end.power);
    if (system_.tallies().dissipated) {
      system_.expand(y, r_, other_);
      const auto lost =
          system_.power_lost_between(r_, step_.q, step_.start.true_acceleration, end.true_acceleration, h, t);
      if (lost) given.dissipated = h * *lost;
    }
    system_.contract(step_.q, step_.v, y);
    energy_ = std::max(energy_, std::abs(given.dissipated));
    system_.tallies().add(given, y);
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

  /// Accelerations where the next step starts.
  EndAccelerations& here() { return repeats_start_ ? step_.start : step_.end; }
  const EndAccelerations& here() const { return repeats_start_ ? step_.start : step_.end; }

  SecondOrderSystem& system_;
  GeneralizedAlphaOptions options_;
  NewtonCounters* counters_;
  AlphaRule rule_;
  double longest_ = options_.step;  ///< [s], of the next steps
  bool started_ = false;
  bool stalled_ = false;  ///< Newton's iteration has asked for the shorter step
  ShorterSteps shorter_;  ///< since Newton's iteration failed
  KeptTangent kept_;
  bool is_smooth_ = false;   ///< the motion, so that its acceleration is worth carrying on
  bool nearby_ = false;      ///< step_.d and the tangent are of nearly the same step, `solved_h_` long
  double solved_h_ = 0;      ///< [s]; 0 for none
  double tolerance_;         ///< of Newton's iteration, of the increment
  int calm_ = 0;             ///< steps that may not be longer than the one before
  double usual_;             ///< [s], length that the error last allowed: next to it a step has next to no length
  double turned_ = 0;        ///< [rad], so far
  double turned_until_ = 0;  ///< [s]
  double tangent_by_a_ = 0;  ///< what the factored tangent was made for; 0 for none
  TangentPoint tangent_;     ///< where checkpoints are kept
  AlphaStep step_;
  double energy_ = 0;           ///< [J], the largest kinetic one so far that follows_loss() has seen, or lost in a step
  bool repeats_start_ = false;  ///< the next step starts where the last one did
  Eigen::VectorXd r_;           ///< residual and correction, then the estimated error of the positions
  Eigen::VectorXd other_;       ///< working memory of one function at a time
  NewtonStop stop_;
  Eigen::VectorXd allowed_;                     ///< absolute tolerances of the coordinates
  bool crosses_event_ = false;                  ///< the next start is behind an event: step_.end goes on through it
  Eigen::VectorXd from_q_;                      ///< where the coordinates started, or were at the last event
  double motion_ = 0, motion_until_event_ = 0;  ///< [m], largest displacement so far
  double noise_step_ = 0;                       ///< [s], that its noise belongs to
  std::vector<double> history_;                 ///< corrections of the current step, relative to its increment
};

}  // namespace

std::unique_ptr<Stepper> make_generalized_alpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options,
                                                NewtonCounters* counters) {
  return std::make_unique<GeneralizedAlpha>(system, options, counters);
}

}  // namespace vlbeam
