// The only file of core that includes Boost.Odeint. Its step control calls pow and log10, whose digits depend on the
// processor: declared before all else by these names, the calls reach the functions at the end of this file.
extern "C" {
double pow(double, double) noexcept __asm__("vlbeam_pow");
double log10(double) noexcept __asm__("vlbeam_log10");
}

#define BOOST_UBLAS_NDEBUG  // uBLAS would check each factorization by multiplying it out

#include <boost/numeric/odeint/stepper/adams_bashforth_moulton.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/extrapolation_stepper.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

// specialises templates that the headers above declare
#include <boost/numeric/odeint/external/eigen/eigen.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/geometry/elementary.hpp"
#include "mechanics/time/stepper.hpp"

namespace vlbeam {
namespace {

namespace odeint = boost::numeric::odeint;
namespace ublas = boost::numeric::ublas;
using State = Eigen::VectorXd;

/// Opens what Odeint's methods keep from step to step and let nobody see: an explicit instantiation may name any
/// member.
template <class Key, typename Key::Member member>
struct Opened {
  friend typename Key::Member at(Key /*key*/) { return member; }
};
using BulirschStoer = odeint::bulirsch_stoer<State>;
struct BulirschStoerFirst {
  using Member = bool BulirschStoer::*;
  friend Member at(BulirschStoerFirst key);
};
struct BulirschStoerOrder {
  using Member = std::size_t BulirschStoer::*;
  friend Member at(BulirschStoerOrder key);
};
struct BulirschStoerStep {
  using Member = double BulirschStoer::*;
  friend Member at(BulirschStoerStep key);
};
template struct Opened<BulirschStoerFirst, &BulirschStoer::m_first>;
template struct Opened<BulirschStoerOrder, &BulirschStoer::m_current_k_opt>;
template struct Opened<BulirschStoerStep, &BulirschStoer::m_dt_last>;

/// A method that keeps nothing, or the derivative at the end of its last step, or the order that it has come to.
template <class Controlled>
class OdeintStepper final : public Stepper {
 public:
  explicit OdeintStepper(const Controlled& controlled) : controlled_(controlled) {}

  bool try_step(Ode& ode, State& y, double& t, double& dt) override {
    auto system = [&ode](const State& at, State& dydt, double time) { ode.rhs(at, dydt, time); };
    size_ = y.size();
    if constexpr (ends_where_it_starts) {
      if (derivative_.size() == 0) {
        derivative_.resize(y.size());
        ode.rhs(y, derivative_, t);
      }
      return controlled_.try_step(system, y, derivative_, t, dt) == odeint::success;
    } else {
      return controlled_.try_step(system, y, t, dt) == odeint::success;
    }
  }

  void reset() override {
    controlled_ = fresh_;
    derivative_.resize(0);
  }

  void exchange(Archive& memory) override {
    memory(derivative_);
    if constexpr (std::is_same_v<Controlled, BulirschStoer>) {
      memory(size_);
      if (memory.reads()) controlled_.adjust_size(State(size_));  // later it would forget the rest
      memory(controlled_.*at(BulirschStoerFirst()));
      memory(controlled_.*at(BulirschStoerOrder()));
      memory(controlled_.*at(BulirschStoerStep()));
    }
  }

 private:
  static constexpr bool ends_where_it_starts =
      std::is_same_v<typename Controlled::stepper_category, odeint::explicit_controlled_stepper_fsal_tag>;

  Controlled controlled_;
  const Controlled fresh_ = controlled_;  // its work vectors have no size yet: an event may change that of the state
  Eigen::Index size_ = 0;                 // of the state
  State derivative_;                      // at the end of the last step, where the next one needs it; else empty
};

template <class Controlled>
std::unique_ptr<Stepper> wrap(const Controlled& controlled) {
  return std::make_unique<OdeintStepper<Controlled>>(controlled);
}

class AdamsBashforthMoulton final : public Stepper {
 public:
  explicit AdamsBashforthMoulton(double step) : step_(step) {}

  bool try_step(Ode& ode, State& y, double& t, double& dt) override {
    bool first = true;
    auto system = [&](const State& at, State& dydt, double time) {
      ode.rhs(at, dydt, time);
      if (first) now_ = dydt;
      first = false;
    };
    next_.resize(y.size());
    if (dt < step_) {
      reset();  // the history is one of equal steps
      single_->do_step(system, y, t, next_, dt);
      t += dt;
    } else {
      // neither in place, which its first steps do not stand, nor of a size it finds out by itself
      if (!sized_) multistep_->adjust_size(y);
      sized_ = true;
      multistep_->do_step(system, y, t, next_, step_);
      t += step_;
      if (history_.size() == needed) history_.erase(history_.begin());
      history_.push_back(now_);
    }
    y.swap(next_);
    dt = step_;
    return true;
  }

  void reset() override {
    multistep_.emplace();
    single_.emplace();
    sized_ = false;
    history_.clear();
  }

  void exchange(Archive& memory) override {
    std::size_t count = history_.size();
    memory(count);
    if (memory.reads()) {
      reset();
      history_.resize(std::min(count, needed));
    }
    for (State& derivative : history_) memory(derivative);
    if (!memory.reads()) return;
    for (State& derivative : history_) {  // the method's own first steps fill its history: with derivatives
      if (!sized_) multistep_->adjust_size(derivative);
      sized_ = true;
      next_.resize(derivative.size());
      const auto known = [&](const State& /*at*/, State& dydt, double /*time*/) { dydt = derivative; };
      multistep_->do_step(known, derivative, 0, next_, step_);
    }
  }

 private:
  static constexpr std::size_t needed = 4;  // derivatives before that of the step
  using Starter = odeint::extrapolation_stepper<6, State>;
  using Multistep = odeint::adams_bashforth_moulton<5, State, double, State, double, odeint::vector_space_algebra,
                                                    odeint::default_operations, odeint::initially_resizer, Starter>;

  double step_;
  std::optional<Multistep> multistep_{std::in_place};
  std::optional<Starter> single_{std::in_place};
  bool sized_ = false;
  State next_, now_;
  std::vector<State> history_;  // the derivatives at the starts of the last steps
};

/// Hairer & Wanner's RODAS (1996), with the sign of d4 as it is there. Odeint has the other one, which makes the method
/// one of first order where the equations depend on time.
struct Rodas : odeint::default_rosenbrock_coefficients<double> {
  const double d4 = -0.3620000000000023e-01;
};

using RosenbrockController = odeint::rosenbrock4_controller<odeint::rosenbrock4<double, Rodas>>;
struct RosenbrockFirst {
  using Member = bool RosenbrockController::*;
  friend Member at(RosenbrockFirst key);
};
struct RosenbrockError {
  using Member = double RosenbrockController::*;
  friend Member at(RosenbrockError key);
};
struct RosenbrockStep {
  using Member = double RosenbrockController::*;
  friend Member at(RosenbrockStep key);
};
template struct Opened<RosenbrockFirst, &RosenbrockController::m_first_step>;
template struct Opened<RosenbrockError, &RosenbrockController::m_err_old>;
template struct Opened<RosenbrockStep, &RosenbrockController::m_dt_old>;

/// Odeint has this method for uBLAS only.
class Rosenbrock4 final : public Stepper {
 public:
  explicit Rosenbrock4(const Tolerances& tolerances) : tolerances_(tolerances) { reset(); }

  bool try_step(Ode& ode, State& y, double& t, double& dt) override {
    const Eigen::Index n = y.size();
    y_.resize(static_cast<std::size_t>(n), false);
    std::copy(y.begin(), y.end(), y_.begin());
    at_.resize(n);
    dydt_.resize(n);
    auto derivative = [&](const Vector& at, Vector& dydt, double time) {
      std::copy(at.begin(), at.end(), at_.begin());
      ode.rhs(at_, dydt_, time);
      std::copy(dydt_.begin(), dydt_.end(), dydt.begin());
    };
    auto jacobian = [&](const Vector& at, ublas::matrix<double>& dfdy, double time, Vector& dfdt) {
      dfdy_.resize(n, n);
      std::copy(at.begin(), at.end(), at_.begin());
      ode.jacobian(at_, time, dfdy_, dydt_);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(&dfdy(0, 0), n, n) = dfdy_;
      std::copy(dydt_.begin(), dydt_.end(), dfdt.begin());
    };
    const auto outcome = controlled_->try_step(std::pair(derivative, jacobian), y_, t, dt);
    if (outcome == odeint::success) std::copy(y_.begin(), y_.end(), y.begin());
    return outcome == odeint::success;
  }

  void reset() override { controlled_.emplace(tolerances_.atol, tolerances_.rtol); }

  void exchange(Archive& memory) override {
    if (memory.reads()) reset();
    memory((*controlled_).*at(RosenbrockFirst()));
    memory((*controlled_).*at(RosenbrockError()));
    memory((*controlled_).*at(RosenbrockStep()));
  }

 private:
  using Vector = ublas::vector<double>;

  Tolerances tolerances_;
  std::optional<RosenbrockController> controlled_;
  Vector y_;
  State at_, dydt_;
  Eigen::MatrixXd dfdy_;
};

}  // namespace

std::unique_ptr<Stepper> make_odeint_stepper(IntegrationMethod type, const Tolerances& tolerances, double step) {
  const double atol = tolerances.atol, rtol = tolerances.rtol;
  switch (type) {
    case IntegrationMethod::cash_karp:
      return wrap(odeint::make_controlled<odeint::runge_kutta_cash_karp54<State>>(atol, rtol));
    case IntegrationMethod::fehlberg78:
      return wrap(odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(atol, rtol));
    case IntegrationMethod::bulirsch_stoer:
      return wrap(odeint::bulirsch_stoer<State>(atol, rtol));
    case IntegrationMethod::adams_bashforth_moulton:
      return std::make_unique<AdamsBashforthMoulton>(step);
    case IntegrationMethod::rosenbrock4:
      return std::make_unique<Rosenbrock4>(tolerances);
    case IntegrationMethod::dopri5:
      break;
    default:
      throw std::invalid_argument("a method that Odeint does not have");
  }
  return wrap(odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(atol, rtol));
}

}  // namespace vlbeam

extern "C" {
double vlbeam_pow(double x, double power) { return vlbeam::portable::pow(x, power); }
double vlbeam_log10(double x) { return vlbeam::portable::log10(x); }
}
