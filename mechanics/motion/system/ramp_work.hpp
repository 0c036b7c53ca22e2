#pragma once

#include "core/geometry/prescribed.hpp"
#include "core/geometry/vec.hpp"
#include "mechanics/time/archive.hpp"

namespace vlbeam {

/// Work done by gravity as it grows, -integral of S'(t) g.M(t) dt, where M is the first moment of mass: the potential
/// energy -S g.M changes by it although nothing moves. Integrated beside the equations of motion, so that their steps
/// do not depend on it, by the trapezoidal rule with end corrections (order 4), from t = 0, where S' = S'' = 0.
template <int D>
class RampWork {
 public:
  /// What is looked at, at one instant: the first moment of mass [kg m] and its rate, the momentum [kg m/s].
  struct Moment {
    Vec<double, D> mass, momentum;
  };

  RampWork() = default;
  RampWork(const Vec<double, D>& gravity, double duration)
      : gravity_(gravity), duration_(gravity.isZero(0) ? 0 : duration) {}

  void exchange(Archive& memory) {
    for (double* number : {&last_, &done_, &power_.value, &power_.rate}) memory(*number);
  }

  /// Whether gravity grew since the last instant, and long enough to be worth a look.
  bool due(double t) const {
    constexpr double looks = 500;  // while gravity grows
    return last_ < duration_ && (t - last_ >= duration_ / looks || t >= duration_);
  }
  /// The state has changed at the last instant, in an event.
  void restart(double t, const Moment& moment) {
    last_ = t;
    power_ = power(t, moment);
  }
  void advance(double t, const Moment& moment) {
    done_ = until(t, moment);
    restart(t, moment);
  }
  /// Work from the start until `t` [J]; `t` must not be before the last instant.
  double until(double t, const Moment& moment) const {
    if (last_ >= duration_) return done_;
    const Power now = power(t, moment);
    const double h = t - last_;
    return done_ + h / 2 * (power_.value + now.value) + h * h / 12 * (power_.rate - now.rate);
  }

 private:
  struct Power {
    double value, rate;
  };

  Power power(double t, const Moment& moment) const {
    const Prescribed share = smooth_ramp(t, duration_);
    const double mass = gravity_.dot(moment.mass), momentum = gravity_.dot(moment.momentum);
    return {-share.rate * mass, -share.acceleration * mass - share.rate * momentum};
  }

  Vec<double, D> gravity_ = Vec<double, D>::Zero();
  double duration_ = 0, last_ = 0, done_ = 0;
  Power power_{0, 0};
};

}  // namespace vlbeam
