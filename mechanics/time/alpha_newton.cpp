#include <array>
#include <cmath>

#include "mechanics/time/alpha_stepper.hpp"

namespace vlbeam {
namespace {

constexpr double same_step = 0.05;  // relative difference of by_a: the tangent of nearly the same step
constexpr double stagnation = 0.5;  // contraction with tangents of the same step: rounding, or far from a solution

}  // namespace

void GeneralizedAlpha::predict(double t, double h) {
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

bool GeneralizedAlpha::acceleration_predicts(double h) const {
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

bool GeneralizedAlpha::solve(double t, double h, NewtonKind kind, bool nearby, double& dissipation) {
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

bool GeneralizedAlpha::make_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                    double t, double h) {
  const TangentWeights by{1, rule_.by_v(h), rule_.by_a(h)};
  if (options_.checkpoints) tangent_.set(q, v, a, t, by);
  if (!system_.linearize(q, v, a, t, by)) return false;
  if (counters_) ++counters_->tangents;
  tangent_by_a_ = by.a;
  return true;
}

void GeneralizedAlpha::measure_noise(double t, double h) {
  system_.residual(step_.q, step_.v, step_.end.true_acceleration, t, r_);
  for (Eigen::VectorXd* vector : {&step_.q, &step_.v, &step_.end.true_acceleration}) NewtonStop::perturb(*vector);
  Eigen::VectorXd rounded(r_.size());  // not kept: this is seldom asked for, and long beams need no vector more
  system_.residual(step_.q, step_.v, step_.end.true_acceleration, t, rounded);
  step_.complete(rule_, h);  // as they were
  assign(r_, r_ - rounded);
  system_.solve(r_);
  stop_.set_noise(r_, step_.q);
}

void GeneralizedAlpha::count(double error) {
  if (!counters_) return;
  ++counters_->iterations;
  history_.push_back(error);
  if (history_.size() > counters_->longest.size()) counters_->longest = history_;
}

}  // namespace vlbeam
