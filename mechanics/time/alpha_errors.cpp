#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "mechanics/time/alpha_stepper.hpp"

namespace vlbeam {
namespace {

constexpr double newton_share = 3e-4;                       // of a step's own error, that Newton's iteration may leave
constexpr double least_newton = 1e-10, most_newton = 1e-5;  // of an increment
constexpr double least_motion = 1e-5;                       // of Tolerances::motion
constexpr double foreseen_share = 0.1;  // of the longest step that follows the motion: so far it is foreseen
constexpr double sets_in = 10;          // of a damper: power at the end of a step over that at its start
constexpr double loss_share = 1e-3;     // of the largest kinetic energy so far, lost where a damper sets in
constexpr double torn_share = 0.3;      // of it: no step is off so far, in modes that it does not follow either

}  // namespace

void GeneralizedAlpha::start_control(Eigen::Index n) {
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

double GeneralizedAlpha::error_ratio(double t, double h) {
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

double GeneralizedAlpha::within_turn(double t) {
  const double rate = system_.turning(step_.q, step_.v);
  if (t > turned_until_) {  // a step that is repeated does not count again
    turned_ += rate * (t - turned_until_);
    turned_until_ = t;
  }
  return options_.most_turn / (std::sqrt(1 + turned_) * std::max(rate, std::numeric_limits<double>::min()));
}

bool GeneralizedAlpha::follows_loss(const Eigen::VectorXd& y, double t, double h, double dissipation) {
  const double before = step_.start.power.dissipated;
  if (!(dissipation > sets_in * before)) return true;
  system_.expand(y, r_, other_);
  for (const Eigen::VectorXd* velocities : {&other_, &step_.v}) {
    if (!system_.inertia(step_.q, *velocities, t + h, r_)) return true;
    energy_ = std::max(energy_, 0.5 * std::abs(velocities->dot(r_)));
  }
  return 0.5 * h * dissipation <= loss_share * energy_;
}

void GeneralizedAlpha::choose_tolerance() {
  const auto [errors, increments] = field_norms<2>(stop_.fields(), {&r_, &step_.d});
  double least = std::numeric_limits<double>::infinity();
  for (const Field field : {Field::position, Field::slope, Field::mark, Field::mass, Field::angle}) {
    const auto f = static_cast<std::size_t>(field);
    if (errors[f] > 0 && increments[f] > 0) least = std::min(least, errors[f] / increments[f]);
  }
  tolerance_ = std::clamp(newton_share * least, least_newton, most_newton);
}

bool GeneralizedAlpha::is_torn() const {
  if (options_.tolerances.motion == 0) return false;
  const FieldNorms errors = field_norms(stop_.fields(), r_);
  return errors[static_cast<std::size_t>(Field::position)] > torn_share * options_.tolerances.motion;
}

void GeneralizedAlpha::filter_error(double t, double h, Eigen::Index count) {
  other_.resize(step_.q.size());
  assign_to(other_.head(count), rule_.by_a(h) * r_.head(count));
  other_.tail(system_.multipliers()).setZero();
  if (!system_.inertia(step_.q, other_, t, r_)) {
    assign(other_, step_.end.true_acceleration + other_);
    system_.residual(step_.q, step_.v, other_, t, r_);
  }
  system_.solve(r_);
}

double GeneralizedAlpha::longest_followed() const {
  const auto position = static_cast<std::size_t>(Field::position);
  const auto& by_field = options_.tolerances.by_field;
  return by_field && by_field->of_rate[position] > 0 ? by_field->of[position] / by_field->of_rate[position] : 0;
}

double GeneralizedAlpha::share_of_motion() {
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

}  // namespace vlbeam
