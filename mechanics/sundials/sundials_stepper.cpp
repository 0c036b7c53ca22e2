// The only file that includes SUNDIALS.
#include "mechanics/sundials/sundials_stepper.hpp"

#ifdef VLBEAM_HAVE_SUNDIALS
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/time/constrained_system.hpp"
#endif

namespace vlbeam {

#ifdef VLBEAM_HAVE_SUNDIALS

namespace {

constexpr long most_steps = 20000;  // of SUNDIALS in one of ours
constexpr int explicit_order = 5;
// [s] Over a step shorter than this a multiplier's error is none of velocities yet. Newton's test sees multipliers,
// too, and in the short steps of a start their rounding would never pass it. With tolerances by field the unit is the
// time that those of position and velocity make.
constexpr double unfelt = 1e-5;

using State = Eigen::VectorXd;
using Map = Eigen::Map<State>;

Map values(N_Vector v) { return {N_VGetArrayPointer(v), N_VGetLength(v)}; }

void silent(int, const char*, const char*, char*, void*) {}  // a step that fails is repeated, or reported by the driver

/// The handles of one solver, freed in the right order.
struct Handles {
  explicit Handles(void (*free_)(void**)) : free(free_) { SUNContext_Create(nullptr, &context); }
  ~Handles() {
    if (memory != nullptr) free(&memory);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    for (N_Vector vector : {state, rate, id, atol}) {
      if (vector != nullptr) N_VDestroy(vector);
    }
    SUNContext_Free(&context);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  N_Vector vector(Eigen::Index n) const { return N_VNew_Serial(n, context); }
  void dense() {
    const sunindextype n = N_VGetLength(state);
    matrix = SUNDenseMatrix(n, n, context);
    linear = SUNLinSol_Dense(state, matrix, context);
  }

  SUNContext context = nullptr;
  void* memory = nullptr;
  SUNLinearSolver linear = nullptr;
  SUNMatrix matrix = nullptr;
  N_Vector state = nullptr, rate = nullptr, id = nullptr, atol = nullptr;
  void (*free)(void**);
};

class SundialsStepper : public Stepper {
 public:
  explicit SundialsStepper(const Tolerances& tolerances) : tolerances_(tolerances) {}

  bool try_step(Ode& ode, State& y, double& t, double& dt) override {
    if (!handles_) start(ode, y, t);
    const double to = t + dt;
    if (!advance(to)) {
      dt /= 10;
      reset();
      return false;
    }
    store(y);
    t = to;
    dt = proposed();
    return true;
  }

  void reset() override { handles_.reset(); }

  void exchange(Archive& /*memory*/) override { throw std::logic_error("SUNDIALS keeps its history to itself"); }

 protected:
  virtual void start(Ode& ode, const State& y, double t) = 0;
  /// Integrates to `to`; false where it cannot.
  virtual bool advance(double to) = 0;
  virtual void store(State& y) { y = values(handles_->state); }
  virtual double proposed() = 0;

  Tolerances tolerances_;
  std::unique_ptr<Handles> handles_;
};

/// The equations in first order, as SUNDIALS calls them.
class FirstOrder : public SundialsStepper {
 public:
  using SundialsStepper::SundialsStepper;

 protected:
  void begin(Ode& ode, const State& y, void (*free)(void**)) {
    ode_ = &ode;
    at_.resize(y.size());
    dydt_.resize(y.size());
    handles_ = std::make_unique<Handles>(free);
    handles_->state = handles_->vector(y.size());
    values(handles_->state) = y;
  }

  static int rhs(double t, N_Vector y, N_Vector dydt, void* self) {
    auto& me = *static_cast<FirstOrder*>(self);
    me.at_ = values(y);
    me.ode_->rhs(me.at_, me.dydt_, t);
    values(dydt) = me.dydt_;
    return me.dydt_.allFinite() ? 0 : 1;  // 1: try a shorter step
  }

  static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix matrix, void* self, N_Vector, N_Vector, N_Vector) {
    auto& me = *static_cast<FirstOrder*>(self);
    me.at_ = values(y);
    const Eigen::Index n = me.at_.size();
    me.dfdy_.resize(n, n);
    me.ode_->jacobian(me.at_, t, me.dfdy_, me.dydt_);
    Eigen::Map<Eigen::MatrixXd>(SM_DATA_D(matrix), n, n) = me.dfdy_;
    return me.dfdy_.allFinite() ? 0 : 1;
  }

 private:
  Ode* ode_ = nullptr;
  State at_, dydt_;
  Eigen::MatrixXd dfdy_;
};

class Cvode final : public FirstOrder {
 public:
  using FirstOrder::FirstOrder;

 private:
  void start(Ode& ode, const State& y, double t) override {
    begin(ode, y, CVodeFree);
    Handles& h = *handles_;
    h.memory = CVodeCreate(CV_BDF, h.context);
    CVodeSetErrHandlerFn(h.memory, silent, nullptr);
    CVodeInit(h.memory, rhs, t, h.state);
    CVodeSetUserData(h.memory, static_cast<FirstOrder*>(this));
    CVodeSStolerances(h.memory, tolerances_.rtol, tolerances_.atol);
    h.dense();
    CVodeSetLinearSolver(h.memory, h.linear, h.matrix);
    CVodeSetJacFn(h.memory, jacobian);
    CVodeSetMaxNumSteps(h.memory, most_steps);
  }
  bool advance(double to) override {
    double reached = 0;
    CVodeSetStopTime(handles_->memory, to);
    return CVode(handles_->memory, to, handles_->state, &reached, CV_NORMAL) >= 0;
  }
  double proposed() override {
    double step = 0;
    CVodeGetCurrentStep(handles_->memory, &step);
    return step;
  }
};

class Arkode final : public FirstOrder {
 public:
  using FirstOrder::FirstOrder;

 private:
  void start(Ode& ode, const State& y, double t) override {
    begin(ode, y, ERKStepFree);
    Handles& h = *handles_;
    h.memory = ERKStepCreate(rhs, t, h.state, h.context);
    ERKStepSetErrHandlerFn(h.memory, silent, nullptr);
    ERKStepSetUserData(h.memory, static_cast<FirstOrder*>(this));
    ERKStepSStolerances(h.memory, tolerances_.rtol, tolerances_.atol);
    ERKStepSetOrder(h.memory, explicit_order);
    ERKStepSetMaxNumSteps(h.memory, most_steps);
  }
  bool advance(double to) override {
    double reached = 0;
    ERKStepSetStopTime(handles_->memory, to);
    return ERKStepEvolve(handles_->memory, to, handles_->state, &reached, ARK_NORMAL) >= 0;
  }
  double proposed() override {
    double step = 0;
    ERKStepGetCurrentStep(handles_->memory, &step);
    return step;
  }
};

/// Unknowns (q, v, lambda, mu, E): 0 = (q' - v + C_q^T mu, M v' + C_q^T lambda - Q, dC/dt, C, E' - P), E the energies
/// that the state counts.
class Ida final : public SundialsStepper {
 public:
  Ida(const Tolerances& tolerances, ConstrainedSystem& system, NewtonCounters* counters)
      : SundialsStepper(tolerances), system_(system), counters_(counters) {}

 private:
  void start(Ode&, const State& y, double t) override {
    system_.expand(y, q_, v_);
    n_ = system_.coordinates();
    multipliers_ = system_.multipliers();
    own_ = n_ - multipliers_;
    balance_ = system_.balance().count();
    a_.resize(n_);
    r_.resize(n_);
    system_.acceleration(q_, v_, t, a_);
    State powers;
    powers.setZero(balance_);
    add_powers(system_.residual(q_, v_, a_, t, r_), t, powers);

    handles_ = std::make_unique<Handles>(IDAFree);
    Handles& h = *handles_;
    const Eigen::Index size = 2 * (own_ + multipliers_) + balance_;
    h.state = h.vector(size);
    h.rate = h.vector(size);
    h.id = h.vector(size);
    values(h.state) << q_.head(own_), v_.head(own_), a_.tail(multipliers_), State::Zero(multipliers_), y.tail(balance_);
    values(h.rate) << v_.head(own_), a_.head(own_), State::Zero(2 * multipliers_), powers;
    values(h.id) << State::Ones(2 * own_), State::Zero(2 * multipliers_), State::Ones(balance_);
    h.memory = IDACreate(h.context);
    IDASetErrHandlerFn(h.memory, silent, nullptr);
    IDAInit(h.memory, residual, t, h.state, h.rate);
    IDASetUserData(h.memory, this);
    h.atol = h.vector(size);
    set_tolerances(values(h.atol));
    IDASVtolerances(h.memory, tolerances_.rtol, h.atol);
    IDASetId(h.memory, h.id);
    IDASetSuppressAlg(h.memory, SUNTRUE);  // multipliers of a problem of index 2 would defeat the error test
    h.dense();
    IDASetLinearSolver(h.memory, h.linear, h.matrix);
    IDASetJacFn(h.memory, jacobian);
    IDASetMaxNumSteps(h.memory, most_steps);
  }

  void set_tolerances(Map atol) const {
    atol.setConstant(tolerances_.atol);
    atol.segment(2 * own_, 2 * multipliers_).setConstant(tolerances_.atol / unfelt);
    if (!tolerances_.by_field) return;
    const FieldTolerances& by_field = *tolerances_.by_field;
    atol.tail(balance_).setConstant(std::numeric_limits<double>::max());
    for_each_coordinate(system_.fields(), [&](Field field, Eigen::Index i) {
      const auto f = static_cast<std::size_t>(field);
      if (i < own_) {
        atol[i] = by_field.of[f];
        atol[own_ + i] = by_field.of_rate[f];
      } else {
        atol[own_ + i] = by_field.of[f] / unfelt;
        atol[own_ + multipliers_ + i] = by_field.of_rate[f] / (unfelt * system_.multiplier_unit());
      }
    });
  }

  void unpack(N_Vector state, N_Vector rate) {
    const auto y = values(state), dy = values(rate);
    q_.head(own_) = y.head(own_);
    v_.head(own_) = y.segment(own_, own_);
    a_.head(own_) = dy.segment(own_, own_);
    a_.tail(multipliers_) = y.segment(2 * own_, multipliers_);
  }

  /// Adds the rates of the energies that the state counts.
  template <class Powers>
  void add_powers(double dissipated, double t, Powers&& powers) {
    EnergyBalance power = system_.supplied_power(q_, v_, a_, t);
    power.dissipated = dissipated;
    system_.balance().add(power, powers);
  }

  static int residual(double t, N_Vector state, N_Vector rate, N_Vector result, void* self) {
    auto& me = *static_cast<Ida*>(self);
    me.unpack(state, rate);
    const double dissipated = me.system_.residual(me.q_, me.v_, me.a_, t, me.r_);
    auto out = values(result);
    const auto y = values(state), dy = values(rate);
    auto powers = out.tail(me.balance_);
    powers.setZero();
    me.add_powers(dissipated, t, powers);
    powers = dy.tail(me.balance_) - powers;
    const Eigen::Index own = me.own_, m = me.multipliers_;
    out.head(own) = dy.head(own) - me.v_.head(own) - me.r_.head(own);
    out.segment(own, own) = me.r_.head(own);
    out.segment(2 * own + m, m) = me.r_.tail(m);
    me.a_.tail(m) += y.segment(2 * own + m, m);  // the equations are linear in the multipliers
    me.system_.residual(me.q_, me.v_, me.a_, t, me.r_);
    out.head(own) += me.r_.head(own);
    me.system_.constraint_rates(me.q_, me.v_, t, me.r_);
    out.segment(2 * own, m) = me.r_.tail(m);
    return out.allFinite() ? 0 : 1;
  }

  /// Exact but for the rows of the energies, of which nothing else depends.
  static int jacobian(double t, double c_j, N_Vector state, N_Vector rate, N_Vector, SUNMatrix matrix, void* self,
                      N_Vector, N_Vector, N_Vector) {
    auto& me = *static_cast<Ida*>(self);
    me.unpack(state, rate);
    const Eigen::Index own = me.own_, m = me.multipliers_, size = N_VGetLength(state), mu = 2 * own + m;
    me.system_.tangent(me.q_, me.v_, me.a_, t, {1, 0, 0}, me.by_q_);
    me.system_.tangent(me.q_, me.v_, me.a_, t, {0, 1, c_j}, me.by_v_);
    const auto columns = me.by_q_.topRightCorner(own, m), rows = me.by_q_.bottomLeftCorner(m, own);
    Eigen::Map<Eigen::MatrixXd> j(SM_DATA_D(matrix), size, size);
    j.setZero();
    j.block(0, 0, own, own).diagonal().setConstant(c_j);
    j.block(0, own, own, own).diagonal().setConstant(-1);
    j.block(0, mu, own, m) = columns;
    j.block(own, 0, own, own) = me.by_q_.topLeftCorner(own, own);
    j.block(own, own, own, own) = me.by_v_.topLeftCorner(own, own);
    j.block(own, 2 * own, own, m) = columns;
    j.block(2 * own, own, m, own) = rows;
    j.block(mu, 0, m, own) = rows;
    for (Eigen::Index i = 0; i < m; ++i) {
      me.by_v_.setZero();
      me.system_.add_curvature(i, 1, me.by_v_);
      const auto second = me.by_v_.topLeftCorner(own, own);
      j.block(0, 0, own, own) += me.system_.multiplier_unit() * values(state)[mu + i] * second;
      j.block(2 * own + i, 0, 1, own) = (second * me.v_.head(own)).transpose();
    }
    j.diagonal().tail(me.balance_).setConstant(c_j);
    return j.allFinite() ? 0 : 1;
  }

  bool advance(double to) override {
    IDASetStopTime(handles_->memory, to);
    return IDASolve(handles_->memory, to, &reached_, handles_->state, handles_->rate, IDA_NORMAL) >= 0;
  }

  void store(State& y) override {
    unpack(handles_->state, handles_->rate);
    system_.contract(q_, v_, y);
    y.tail(balance_) = values(handles_->state).tail(balance_);
    if (counters_ == nullptr) return;
    const ConstraintResidual now = system_.constraint_residual(q_, v_, reached_);
    auto& largest = counters_->constraints;
    largest.position = std::max(largest.position, now.position);
    largest.velocity = std::max(largest.velocity, now.velocity);
    const auto multipliers = a_.tail(multipliers_);
    counters_->multipliers.assign(multipliers.begin(), multipliers.end());
  }

  double proposed() override {
    double step = 0;
    IDAGetCurrentStep(handles_->memory, &step);
    return step;
  }

  ConstrainedSystem& system_;
  NewtonCounters* counters_;
  Eigen::Index n_ = 0, own_ = 0, multipliers_ = 0, balance_ = 0;
  double reached_ = 0;
  State q_, v_, a_, r_;
  Eigen::MatrixXd by_q_, by_v_;
};

}  // namespace

bool have_sundials() { return true; }

std::unique_ptr<Stepper> make_sundials_stepper(SundialsMethod type, const Tolerances& tolerances,
                                               SecondOrderSystem* system, NewtonCounters* counters) {
  if (type == SundialsMethod::ida) {
    return std::make_unique<Ida>(tolerances, dynamic_cast<ConstrainedSystem&>(*system), counters);
  }
  if (type == SundialsMethod::cvode) return std::make_unique<Cvode>(tolerances);
  return std::make_unique<Arkode>(tolerances);
}

#else

bool have_sundials() { return false; }

std::unique_ptr<Stepper> make_sundials_stepper(SundialsMethod, const Tolerances&, SecondOrderSystem*, NewtonCounters*) {
  return nullptr;
}

#endif

OtherMethod method_of_sundials(SundialsMethod type) {
  return {.second_order = type == SundialsMethod::ida,
          .can_be_restarted = false,
          .make = [type](SecondOrderSystem* system, const Tolerances& tolerances, NewtonCounters& counters) {
            return make_sundials_stepper(type, tolerances, system, &counters);
          }};
}

}  // namespace vlbeam
