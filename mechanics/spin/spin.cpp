#include "mechanics/spin/spin.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "core/element/quadrature.hpp"
#include "core/error.hpp"

namespace vlbeam {
namespace {

std::vector<int> nodes_of(const std::vector<DrivenAngle>& drives) {
  std::vector<int> nodes;
  for (const DrivenAngle& drive : drives) nodes.push_back(drive.node);
  return nodes;
}

}  // namespace

void check_drives(const std::vector<DrivenAngle>& drives, int last_node) {
  std::vector<bool> driven(static_cast<std::size_t>(last_node) + 1, false);
  for (const DrivenAngle& drive : drives) {
    const std::string node = "node " + std::to_string(drive.node);
    if (drive.node < 0 || drive.node > last_node) {
      throw ModelError(
          "drives", node,
          "it must be a node of the beam, 0 to " + std::to_string(last_node) + ": beyond its ends there is none");
    }
    const auto k = static_cast<std::size_t>(drive.node);
    if (driven[k]) throw ModelError("drives", node + " twice", "a node can stand there once");
    driven[k] = true;
    const double rate = drive.theta(0).rate, first = drives.front().theta(0).rate;
    if (rate == first) continue;
    std::ostringstream spins;
    spins << "spins of " << first << " and " << rate << " rad/s";
    throw ModelError("drives", spins.str(),
                     "it must be one: a shaft driven at two places at different rates winds up without bound");
  }
}

Spin::Spin(const SpinModel& model, std::vector<Prescribed> marks, Formulation formulation, int quadrature_points)
    : model_(model),
      marks_(std::move(marks)),
      formulation_(formulation),
      chain_(model.section, model.field, formulation, static_cast<int>(marks_.size()) - 1, quadrature_points,
             nodes_of(model.drives)) {
  prescribed_.setZero(coordinates());
  forces_.resize(coordinates());
  residual_.resize(coordinates());
}

std::vector<FieldRun> Spin::fields(Eigen::Index first) const {
  const Eigen::Index per_node = chain_.per_node(), nodes = chain_.nodes();
  std::vector<FieldRun> runs{{Field::angle, first, 1, per_node, nodes}};
  if (per_node == 2) runs.push_back({Field::twist, first + 1, 1, per_node, nodes});
  return runs;
}

void Spin::start(double* q, double* rate) const {
  for (int k = 0; k < chain_.nodes(); ++k) rate[angle(k)] = model_.rate;
  for (const DrivenAngle& drive : model_.drives) {
    const Prescribed now = drive.theta(0);
    q[angle(drive.node)] = now.value;
    rate[angle(drive.node)] = now.rate;
  }
}

double Spin::add_torques(const double* q, const double* rate, double t, double* f, double* on_marks) const {
  double power = 0;
  const auto add = [&](int k, const SpinChain::Coordinates& at, const SpinChain::Coordinates& rates, double u,
                       double torque) {
    const SpinChain::Point point = chain_.at(at, rates, u);
    chain_.scatter(k, {point.s[0] * torque, point.s[1] * torque, point.s[2] * torque, point.s[3] * torque}, f);
    power += torque * point.spin;
    if (on_marks == nullptr) return;
    on_marks[k] += torque * point.by_a;
    on_marks[k + 1] += torque * point.by_b;
  };
  const auto element = [&](int k, const auto& visit) {
    visit(chain_.local(q, marks_, &Prescribed::value, k), chain_.local(rate, marks_, &Prescribed::rate, k));
  };
  for (const Torques::Point& load : model_.torques.points) {
    const double x = load.x ? load.x(t) : marks_[static_cast<std::size_t>(load.node)].value, torque = load.torque(t);
    const int k = element_at(marks_, x);
    element(k, [&](const auto& at, const auto& rates) {
      const double u = (x - at.x_a) / (at.x_b - at.x_a);
      const bool jumps =
          !load.x && load.node > 0 && load.node + 1 < chain_.nodes();  // the twist: the mean of both sides
      add(k, at, rates, u, jumps ? torque / 2 : torque);
      if (!jumps) return;
      element(k - 1,
              [&](const auto& before, const auto& before_rates) { add(k - 1, before, before_rates, 1, torque / 2); });
    });
  }
  if (!model_.torques.line) return power;
  const double torque = model_.torques.line(t);
  for (int k = 0; k + 1 < chain_.nodes(); ++k) {
    element(k, [&](const auto& at, const auto& rates) {
      for (const auto& [u, w, feels] : chain_.rule()) add(k, at, rates, u, w * torque * (at.x_b - at.x_a));
    });
  }
  return power;
}

std::array<Spin::Inlet, 2> Spin::inlets() const {
  const int last = chain_.nodes() - 1;
  const double first_rate = marks_.front().rate, last_rate = marks_.back().rate;
  // the virtual work's forces are those of the matter that is there
  const double in = formulation_ == Formulation::variational ? 1 : 0;
  return {Inlet{0, 0, first_rate, -in * first_rate}, Inlet{last, last - 1, last_rate, in * last_rate}};
}

void Spin::add_inflow(const double* q, const double* rate, double* f) const {
  for (const Inlet& inlet : inlets()) {
    if (inlet.in == 0) continue;
    const SpinChain::Point end =
        chain_.at(chain_.local(q, marks_, &Prescribed::value, inlet.element),
                  chain_.local(rate, marks_, &Prescribed::rate, inlet.element), inlet.node == 0 ? 0 : 1);
    f[angle(inlet.node)] += model_.section.rhoIp * inlet.in * end.spin;
  }
}

double Spin::inner_residual(const double* q, const double* rate, const double* a, double* r) {
  Eigen::Map<Eigen::VectorXd>(r, coordinates()).setZero();
  return chain_.residual(q, rate, a, marks_, r);
}

double Spin::residual(const double* q, const double* rate, const double* a, double t, double* r) {
  const double dissipated = inner_residual(q, rate, a, r);
  take_forces(q, rate, t, r);
  return dissipated;
}

void Spin::take_forces(const double* q, const double* rate, double t, double* r) {
  forces_.setZero();
  if (model_.torques.present()) add_torques(q, rate, t, forces_.data());
  add_inflow(q, rate, forces_.data());
  Eigen::Map<Eigen::VectorXd>(r, coordinates()) -= forces_;
}

bool Spin::accelerate(const double* q, const double* rate, double t, double* a, double& dissipated) {
  for (const DrivenAngle& drive : model_.drives) prescribed_[angle(drive.node)] = drive.theta(t).acceleration;
  chain_.evaluate(q, rate, marks_);
  dissipated += chain_.dissipation();
  Eigen::Map<Eigen::VectorXd> f(a, coordinates());
  f.setZero();
  chain_.add_residual(prescribed_.data(), marks_, a);
  take_forces(q, rate, t, a);
  f = -f;
  if (!chain_.solve(a)) return false;
  for (const DrivenAngle& drive : model_.drives) a[angle(drive.node)] = prescribed_[angle(drive.node)];
  return true;
}

void Spin::inertia(const double* a, double* r) const {
  Eigen::Map<Eigen::VectorXd>(r, coordinates()).setZero();
  chain_.add_inertia(a, marks_, r);
  for (const DrivenAngle& drive : model_.drives) r[angle(drive.node)] = a[angle(drive.node)];
}

void Spin::drive(const double* a, double t, double* r) const {
  for (const DrivenAngle& drive : model_.drives) {
    r[angle(drive.node)] = a[angle(drive.node)] - drive.theta(t).acceleration;
  }
}

Spin::Section Spin::section(const double* q, const double* rate, double x) const {
  const int k = element_at(marks_, x);
  const SpinChain::Coordinates at = chain_.local(q, marks_, &Prescribed::value, k);
  return {k, chain_.at(at, chain_.local(rate, marks_, &Prescribed::rate, k), (x - at.x_a) / (at.x_b - at.x_a))};
}

void Spin::scatter(const Section& at, double torque, double couple, double* f) const {
  std::array<double, 4> entries;
  for (std::size_t i = 0; i < 4; ++i) entries[i] = at.at.s[i] * torque + at.at.s_x[i] * couple;
  chain_.scatter(at.element, entries, f);
}

EnergyBalance Spin::power(const double* q, const double* rate, const double* a, double t, const Eigen::VectorXd* more) {
  EnergyBalance power;
  residual(q, rate, a, t, residual_.data());
  if (more != nullptr) residual_ -= *more;
  for (const DrivenAngle& drive : model_.drives) power.ends += residual_[angle(drive.node)] * rate[angle(drive.node)];
  if (model_.torques.present()) power.loads = add_torques(q, rate, t, forces_.data());
  return power;
}

std::vector<double> Spin::drive_torques(const double* residual) const {
  std::vector<double> torques;
  for (const DrivenAngle& drive : model_.drives) torques.push_back(residual[angle(drive.node)]);
  return torques;
}

void Spin::assemble(const TangentWeights& by, SpinTangent& tangent) const {
  tangent.assemble(chain_, marks_, by);
  for (const Inlet& inlet : inlets()) {
    if (inlet.in == 0) continue;
    // the spin of the matter at the end is the rate of its angle less x' times the twist there
    const double inertia = model_.section.rhoIp * inlet.in, twist = by.q * inertia * inlet.rate;
    const auto i = static_cast<std::size_t>(inlet.node);
    tangent.band.diagonal[i](0, 0) -= inertia * by.v;
    if (chain_.per_node() == 2) {
      tangent.band.diagonal[i](0, 1) += twist;
      continue;
    }
    const std::size_t other = inlet.node == 0 ? 1 : i - 1;
    const double share = twist / (marks_[i].value - marks_[other].value);  // negative at the start
    tangent.band.diagonal[i](0, 0) += share;
    (inlet.node == 0 ? tangent.band.upper[0] : tangent.band.lower[i])(0, 0) -= share;
  }
}

Spin::Seen Spin::observe(const double* q, const double* rate, int points) const {
  Seen seen;
  for (int k = 0; k + 1 < chain_.nodes(); ++k) {
    const SpinChain::Coordinates at = chain_.local(q, marks_, &Prescribed::value, k),
                                 rates = chain_.local(rate, marks_, &Prescribed::rate, k);
    for (const auto& [u, w] : gauss_legendre(points)) {
      const SpinChain::Point point = chain_.at(at, rates, u);
      const double length = w * (at.x_b - at.x_a);
      seen.kinetic += 0.5 * length * model_.section.rhoIp * point.spin * point.spin;
      seen.torsion += 0.5 * length * model_.section.GIp * point.twist * point.twist;
      seen.momentum += length * model_.section.rhoIp * point.spin;
    }
  }
  return seen;
}

}  // namespace vlbeam
