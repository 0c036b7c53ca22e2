#include "core/dynamics/generalized_alpha.hpp"

#include <algorithm>
#include <cmath>

namespace vlbeam {
namespace {

constexpr double slow_contraction = 0.1;  // a modified Newton step that gains less asks for a new tangent

class GeneralizedAlpha final : public Stepper {
 public:
  GeneralizedAlpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options)
      : system_(system),
        options_(options),
        alpha_m_((2 * options.rho_inf - 1) / (options.rho_inf + 1)),
        alpha_f_(options.rho_inf / (options.rho_inf + 1)),
        gamma_(0.5 + alpha_f_ - alpha_m_),
        beta_(0.25 * (gamma_ + 0.5) * (gamma_ + 0.5)) {}

  bool try_step(Ode& /*ode*/, Eigen::VectorXd& y, double& t, double& dt) override {
    const Eigen::Index n = system_.coordinates();
    r_.resize(n);
    if (!started_) start(y, t, n);
    start_ = end_;
    const double h = std::min(dt, options_.step);
    const double by_a = (1 - alpha_m_) / (h * h * beta_ * (1 - alpha_f_)), by_v = gamma_ / (h * beta_);

    // predictor: unchanged acceleration a_dot, and what follows from it
    q_ = y.head(n);
    v_ = y.segment(n, n);
    acceleration_ = start_.true_acceleration;
    next_a_ =
        ((1 - alpha_f_) * acceleration_ + alpha_f_ * start_.true_acceleration - alpha_m_ * start_.a) / (1 - alpha_m_);
    q_ += h * v_ + h * h * ((0.5 - beta_) * start_.a + beta_ * next_a_);
    v_ += h * ((1 - gamma_) * start_.a + gamma_ * next_a_);

    double previous = 0, dissipation = 0;
    bool fresh = false;
    if (by_a != tangent_by_a_ || system_.factorizations() != factorization_) tangent_by_a_ = 0;
    for (int iteration = 0; iteration < options_.newton_iterations; ++iteration) {
      dissipation = system_.residual(q_, v_, acceleration_, t + h, r_);
      if (!r_.allFinite()) return stalled(dt, h);
      if (tangent_by_a_ == 0) {
        if (!system_.linearize(q_, v_, acceleration_, t + h, by_v, by_a)) return stalled(dt, h);
        tangent_by_a_ = by_a;
        factorization_ = system_.factorizations();
        fresh = true;
      }
      system_.solve(r_);
      q_ -= r_;
      v_ -= by_v * r_;
      acceleration_ -= by_a * r_;
      next_a_ -= by_a * (1 - alpha_f_) / (1 - alpha_m_) * r_;
      const double correction = r_.lpNorm<Eigen::Infinity>() / std::max(1.0, q_.lpNorm<Eigen::Infinity>());
      if (!std::isfinite(correction)) return stalled(dt, h);
      if (correction <= options_.newton_tolerance) {
        accept(y, t, h, n, dissipation);
        dt = options_.step;
        return true;
      }
      if (iteration > 0 && correction > slow_contraction * previous) {
        if (fresh && correction > previous) return stalled(dt, h);
        tangent_by_a_ = 0;
        fresh = false;
      }
      previous = correction;
    }
    return stalled(dt, h);
  }

  void reset() override {
    started_ = false;
    tangent_by_a_ = 0;
  }

  void resume(const Stepper& other) override {
    const auto& main = dynamic_cast<const GeneralizedAlpha&>(other);
    end_ = main.start_;
    started_ = true;
    tangent_by_a_ = 0;
  }

 private:
  struct Memory {
    Eigen::VectorXd true_acceleration;  ///< q'' that satisfies the equations of motion
    Eigen::VectorXd a;                  ///< the method's own acceleration
    double dissipation = 0;             ///< [W]
  };

  void start(const Eigen::VectorXd& y, double t, Eigen::Index n) {
    end_.true_acceleration.resize(n);
    system_.acceleration(y.head(n), y.segment(n, n), t, end_.true_acceleration);
    end_.a = end_.true_acceleration;
    end_.dissipation = system_.residual(y.head(n), y.segment(n, n), end_.true_acceleration, t, r_);
    started_ = true;
    tangent_by_a_ = 0;
  }

  bool stalled(double& dt, double h) {
    dt = h / 2;
    tangent_by_a_ = 0;
    return false;
  }

  void accept(Eigen::VectorXd& y, double& t, double h, Eigen::Index n, double dissipation) {
    y.head(n) = q_;
    y.segment(n, n) = v_;
    if (y.size() > 2 * n) y[2 * n] += 0.5 * h * (start_.dissipation + dissipation);
    end_.true_acceleration = acceleration_;
    end_.a = next_a_;
    end_.dissipation = dissipation;
    t += h;
  }

  SecondOrderSystem& system_;
  GeneralizedAlphaOptions options_;
  double alpha_m_, alpha_f_, gamma_, beta_;
  bool started_ = false;
  std::size_t factorization_ = 0;
  double tangent_by_a_ = 0;  ///< what the factored tangent was made for; 0 for none
  Memory start_, end_;       ///< at the start and at the end of the last step
  Eigen::VectorXd q_, v_, acceleration_, next_a_, r_;
};

}  // namespace

std::unique_ptr<Stepper> make_generalized_alpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options) {
  return std::make_unique<GeneralizedAlpha>(system, options);
}

}  // namespace vlbeam
