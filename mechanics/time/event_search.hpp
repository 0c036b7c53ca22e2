#pragma once

#include <limits>

#include "mechanics/time/side_stepper.hpp"

namespace vlbeam {

struct LocatedEvent {
  enum class Where { start, inside, end };  ///< of the step

  int index = -1;
  double t = 0;
  Eigen::VectorXd y;  ///< unless it is at the end of the step
  Where where = Where::inside;
};

/// One step of the main stepper, in which events are looked for.
struct WholeStep {
  double t0;
  const Eigen::VectorXd& y0;
  double t1;
  const Eigen::VectorXd& y1;
};

/// Finds what happens in a step.
class EventSearch {
 public:
  EventSearch(EventedOde& ode, const Stepper& main, SideStepper& side, const IntegrationOptions& options)
      : ode_(ode), main_(main), side_(side), options_(options) {}

  /// The first event in the step, at whose end the guards are `at_end`, or index -1. Unless events are to be located
  /// its time is the end of the step. Throws SideStepUnderflow where the step is too long to be looked into.
  /// A guard whose rate is known, and that may have been positive within the step alone, makes it such a one.
  LocatedEvent first(const WholeStep& step, const Guards& at_start, const Guards& at_end);

  /// The solution at `t` within the step. Where steps inside it cannot be taken, that one being too long, an
  /// interpolant has to do: a sample must not change the way of the run. Valid until the next step of either stepper.
  const Eigen::VectorXd& at(const WholeStep& step, double t);

 private:
  EventedOde& ode_;
  const Stepper& main_;
  SideStepper& side_;
  const IntegrationOptions& options_;
  Eigen::VectorXd interpolated_;
};

/// Lets a step end at the event in it, where that can be foreseen: a whole step, which shows that there is one, and the
/// steps of another stepper that locate it need not be taken.
class EventAim {
 public:
  EventAim(EventedOde& ode, Stepper& main, const IntegrationOptions& options)
      : ode_(ode), main_(main), takes_aim_(options.locate_events) {}

  /// Looks at the guards at (t, start), where the next step is to start.
  void stand_at(const Eigen::VectorXd& start, double t);
  const Guards& at_start() const { return now_; }
  /// [s], by which no guard will be farther beyond zero than it has room, by its rate.
  double longest() const;
  /// How long the next step from (t, start) is to be, of at most `dt`: up to the first event that is expected in it, or
  /// dt. `y` is where the step will take place, and equals `start`: it looks ahead there, and leaves it as it was.
  /// Behind stand_at().
  double take(const Eigen::VectorXd& start, double t, double dt, Eigen::VectorXd& y);
  /// Whether the last call of take() has found an event to aim at.
  bool aims() const { return guard_ >= 0; }

  enum class Shot {
    none,    ///< nothing to aim at
    hit,     ///< the step ends at the event
    missed,  ///< (t, y) is where it started: it is to be taken again, whole, and no aim is taken then
  };
  /// Repeats the step from (t0, y0), which ended at (t, y), until it ends at the event that was aimed at, or that it
  /// has just passed. It misses where another one comes before, where that one turns out not to be within `longest` of
  /// the start, and where the step cannot be repeated.
  Shot shoot(const Eigen::VectorXd& y0, double t0, double longest, Eigen::VectorXd& y, double& t);

  /// The event that was hit.
  int guard() const { return guard_; }
  /// Guards at the end of the step, where nothing was aimed at.
  const Guards& at_end() const { return at_end_; }
  /// Guards are others from now on.
  void forget() {
    known_.clear();
    end_t_ = now_t_ = never;
  }

  void exchange(Archive& memory);

 private:
  static constexpr double never = std::numeric_limits<double>::quiet_NaN();

  bool all_stay_behind(const Guards& now, double t, double dt) const;
  /// Or at what the step has all but reached, if a step until `latest` would.
  void aim_at_what_has_passed(const Guards& then, double t, double latest);

  EventedOde& ode_;
  Stepper& main_;
  bool takes_aim_;
  bool repeats_ = false;  ///< the method can, and knows accelerations
  Guards now_;            ///< where the next step starts, which is at
  double now_t_ = never;
  Guards known_;  ///< at the start of the last step
  double known_t_ = 0;
  Guards at_end_;  ///< of the last step, where it ended last:
  double end_t_ = never;
  double missed_from_ = never;  ///< [s]
  int guard_ = -1;
  double slope_ = 0;  ///< [1/s], of that guard where it turns
};

}  // namespace vlbeam
