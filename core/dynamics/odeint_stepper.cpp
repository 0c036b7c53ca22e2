// The only file that includes Boost.Odeint.
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

// specialises templates that the headers above declare
#include <boost/numeric/odeint/external/eigen/eigen.hpp>

#include "core/dynamics/stepper.hpp"

namespace vlbeam {
namespace {

namespace odeint = boost::numeric::odeint;
using State = Eigen::VectorXd;

template <class Controlled>
class OdeintStepper final : public Stepper {
 public:
  explicit OdeintStepper(const Controlled& controlled) : controlled_(controlled) {}

  bool try_step(Ode& ode, State& y, double& t, double& dt) override {
    auto system = [&ode](const State& at, State& dydt, double time) { ode.rhs(at, dydt, time); };
    return controlled_.try_step(system, y, t, dt) == odeint::success;
  }

  void reset() override { controlled_ = fresh_; }

 private:
  Controlled controlled_;
  const Controlled fresh_ = controlled_;  // its work vectors have no size yet: an event may change that of the state
};

template <class Controlled>
std::unique_ptr<Stepper> wrap(const Controlled& controlled) {
  return std::make_unique<OdeintStepper<Controlled>>(controlled);
}

}  // namespace

std::unique_ptr<Stepper> make_odeint_stepper(IntegratorType type, const Tolerances& tolerances) {
  const double atol = tolerances.atol, rtol = tolerances.rtol;
  switch (type) {
    case IntegratorType::cash_karp:
      return wrap(odeint::make_controlled<odeint::runge_kutta_cash_karp54<State>>(atol, rtol));
    case IntegratorType::fehlberg78:
      return wrap(odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(atol, rtol));
    case IntegratorType::bulirsch_stoer:
      return wrap(odeint::bulirsch_stoer<State>(atol, rtol));
    case IntegratorType::dopri5:
    case IntegratorType::generalized_alpha:  // not one of Odeint's
    case IntegratorType::energy_momentum:
      break;
  }
  return wrap(odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(atol, rtol));
}

}  // namespace vlbeam
