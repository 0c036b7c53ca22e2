#include "mechanics/conserving/energy_momentum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mechanics/conserving/conserving_step.hpp"
#include "mechanics/motion/system/implicit_beam.hpp"
#include "mechanics/time/newton_stop.hpp"

namespace vlbeam {
namespace {

constexpr double settled = 1e-11;  // a correction, relative to the coordinates, that rounding may leave

/// ConservingStep of a beam in the plane or in space.
class ConservingResidual {
 public:
  virtual ~ConservingResidual() = default;
  /// That of ConservingStep; throws ModelError where energy comes from elsewhere, or angles have some.
  virtual double residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                          const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) = 0;
};

template <int D>
class ConservingBeam final : public ConservingResidual {
 public:
  explicit ConservingBeam(const ImplicitBeam<D>& of)
      : accelerations_(of.accelerations()), step_(accelerations_.beam()) {}

  double residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                  const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) override {
    check();
    accelerations_.count_evaluation();
    return step_.residual(q0, v0, q1, v1, t, h, r);
  }

 private:
  void check() const {
    const auto refuse = [](const char* why) { throw ModelError("integrator", "\"energy-momentum\"", why); };
    const CurrentBeam<D>& beam = accelerations_.beam();
    const BeamModel<D>& model = beam.model();
    if (beam.unknowns() != nullptr) refuse("it knows neither spin nor frames in space: take any other integrator");
    if (model.driven() || beam.prescribed_mesh() != nullptr || model.loads.present() || model.parts_work()) {
      refuse("it keeps an energy that moving supports and nodes, loads and drag change: take any other integrator");
    }
  }

  Accelerations<D>& accelerations_;
  ConservingStep<D> step_;
};

std::unique_ptr<ConservingResidual> conserving_residual_of(SecondOrderSystem& system) {
  if (const auto* plane = dynamic_cast<ImplicitBeam<2>*>(&system)) return std::make_unique<ConservingBeam<2>>(*plane);
  return std::make_unique<ConservingBeam<3>>(dynamic_cast<ImplicitBeam<3>&>(system));
}

class EnergyMomentum final : public Stepper {
 public:
  EnergyMomentum(SecondOrderSystem& system, const EnergyMomentumOptions& options)
      : system_(system), conserving_(conserving_residual_of(system)), options_(options) {}

  bool try_step(Ode& /*ode*/, Eigen::VectorXd& y, double& t, double& dt) override {
    const Eigen::Index n = system_.coordinates();
    const double h = std::min(dt, options_.step);
    q0_ = y.head(n);
    v0_ = y.segment(n, n);
    r_.resize(n);
    if (acceleration_.size() != n) acceleration_.setZero(n);
    v1_ = v0_ + h * acceleration_;
    if (fields_.empty()) fields_ = system_.fields();

    double previous = 0, dissipation = 0;
    if (h != tangent_step_) tangent_step_ = 0;
    for (int iteration = 0; iteration < options_.newton_iterations; ++iteration) {
      q1_ = q0_ + (h / 2) * (v0_ + v1_);
      dissipation = conserving_->residual(q0_, v0_, q1_, v1_, t, h, r_);
      if (!r_.allFinite()) break;
      if (tangent_step_ == 0 && !linearize(t, h)) break;
      system_.solve(r_);  // twice the correction of q_1
      v1_ -= (4 / h) * r_;
      if (!r_.allFinite()) break;
      const double correction = 2 * relative_to_coordinates(fields_, r_, q1_);
      const bool at_rounding =
          correction <= newton_rounding || (iteration > 0 && correction <= settled && correction > previous / 2);
      if (at_rounding) {
        accept(y, t, h, n, dissipation);
        dt = options_.step;
        return true;
      }
      if (iteration > 0 && correction > slow_contraction * previous) tangent_step_ = 0;
      previous = correction;
    }
    dt = h / 2;
    reset();
    return false;
  }

  void exchange(Archive& memory) override {
    memory(acceleration_);
    if (memory.reads()) fields_.clear();  // anew with the next step
    memory(tangent_step_);
    if (tangent_step_ == 0) return;
    for (Eigen::VectorXd* vector : {&middle_q_, &middle_v_, &middle_a_}) memory(*vector);
    memory(middle_t_);
    if (memory.reads()) factor(tangent_step_);
  }

  void pass_corner() override {}

  void reset() override {
    acceleration_.resize(0);
    tangent_step_ = 0;
    fields_.clear();
  }

 private:
  bool linearize(double t, double h) {
    middle_q_ = (q0_ + q1_) / 2;
    middle_v_ = (v0_ + v1_) / 2;
    middle_a_ = (v1_ - v0_) / h;
    middle_t_ = t + h / 2;
    if (!factor(h)) return false;
    tangent_step_ = h;
    return true;
  }

  bool factor(double h) {
    return system_.linearize(middle_q_, middle_v_, middle_a_, middle_t_, {1, 2 / h, 4 / (h * h)});
  }

  void accept(Eigen::VectorXd& y, double& t, double h, Eigen::Index n, double dissipation) {
    y.head(n) = q0_ + (h / 2) * (v0_ + v1_);
    y.segment(n, n) = v1_;
    if (y.size() > 2 * n) y[2 * n] += h * dissipation;
    acceleration_ = (v1_ - v0_) / h;
    t += h;
  }

  SecondOrderSystem& system_;
  std::unique_ptr<ConservingResidual> conserving_;
  EnergyMomentumOptions options_;
  std::vector<FieldRun> fields_;
  double tangent_step_ = 0;       ///< the step that the factored tangent was made for; 0 for none
  Eigen::VectorXd acceleration_;  ///< mean of the last step, which predicts the next one
  Eigen::VectorXd q0_, v0_, q1_, v1_, r_;
  Eigen::VectorXd middle_q_, middle_v_, middle_a_;  ///< what the factored tangent was made at: it may be steps old
  double middle_t_ = 0;                             ///< [s]
};

}  // namespace

std::unique_ptr<Stepper> make_energy_momentum(SecondOrderSystem& system, const EnergyMomentumOptions& options) {
  return std::make_unique<EnergyMomentum>(system, options);
}

OtherMethod energy_momentum(const EnergyMomentumOptions& options) {
  return {.fixed_step = true, .make = [options](SecondOrderSystem* system, const Tolerances&, NewtonCounters&) {
            return make_energy_momentum(*system, options);
          }};
}

}  // namespace vlbeam
