#include "core/system/resting_spin.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include "core/error.hpp"

namespace vlbeam {
namespace {

std::vector<int> nodes_of(const std::vector<DrivenAngle>& drives) {
  std::vector<int> nodes;
  for (const DrivenAngle& drive : drives) nodes.push_back(drive.node);
  return nodes;
}

SpinChain::Nodes at_rest(const std::vector<double>& x) {
  SpinChain::Nodes nodes;
  for (const double at : x) nodes.push_back({at, 0, 0});
  return nodes;
}

}  // namespace

void check_drives(const std::vector<DrivenAngle>& drives, int last_node) {
  std::vector<bool> driven(static_cast<std::size_t>(last_node) + 1, false);
  for (const DrivenAngle& drive : drives) {
    const std::string node = "node " + std::to_string(drive.node);
    if (drive.node < 0 || drive.node > last_node) {
      throw InvalidInput(
          "/spin/drives", node,
          "it must be a node of the beam, 0 to " + std::to_string(last_node) + ": beyond its ends there is none");
    }
    const auto k = static_cast<std::size_t>(drive.node);
    if (driven[k]) throw InvalidInput("/spin/drives", node + " twice", "a node can stand there once");
    driven[k] = true;
    const double rate = drive.theta(0).rate, first = drives.front().theta(0).rate;
    if (rate == first) continue;
    std::ostringstream spins;
    spins << "spins of " << first << " and " << rate << " rad/s";
    throw InvalidInput("/spin/drives", spins.str(),
                       "it must be one: a shaft driven at two places at different rates winds up without bound");
  }
}

RestingSpin::RestingSpin(const SpinModel& model, const std::vector<double>& x, Formulation formulation,
                         int quadrature_points)
    : model_(model),
      nodes_(at_rest(x)),
      chain_(model.section, model.field, formulation, static_cast<int>(x.size()) - 1, quadrature_points,
             nodes_of(model.drives)) {
  prescribed_.setZero(coordinates());
  residual_.resize(coordinates());
}

std::vector<FieldRun> RestingSpin::fields(Eigen::Index first) const {
  const Eigen::Index per_node = chain_.per_node(), nodes = chain_.nodes();
  std::vector<FieldRun> runs{{Field::angle, first, 1, per_node, nodes}};
  if (per_node == 2) runs.push_back({Field::twist, first + 1, 1, per_node, nodes});
  return runs;
}

void RestingSpin::start(double* q, double* rate) const {
  for (int k = 0; k < chain_.nodes(); ++k) rate[angle(k)] = model_.rate;
  for (const DrivenAngle& drive : model_.drives) {
    const Prescribed now = drive.theta(0);
    q[angle(drive.node)] = now.value;
    rate[angle(drive.node)] = now.rate;
  }
}

double RestingSpin::add_torques(const double* q, const double* rate, double t, double* f) const {
  double power = 0;
  const auto add = [&](int k, const SpinChain::Coordinates& rates, const std::array<double, 4>& entries) {
    if (f != nullptr) chain_.scatter(k, entries, f);
    const auto& e = rates.e;
    power += entries[0] * e.r_a[0] + entries[1] * e.s_a[0] + entries[2] * e.r_b[0] + entries[3] * e.s_b[0];
  };
  for (const Torques::Point& load : model_.torques.points) {
    const double x = load.x(t), torque = load.torque(t);
    const auto next = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, x,
                                       [](double at, const Prescribed& node) { return at < node.value; });
    const int k = static_cast<int>(next - nodes_.begin()) - 1;
    const SpinChain::Coordinates at = chain_.local(q, nodes_, &Prescribed::value, k),
                                 rates = chain_.local(rate, nodes_, &Prescribed::rate, k);
    const auto s = chain_.at(at, rates, (x - at.x_a) / (at.x_b - at.x_a)).s;
    add(k, rates, {s[0] * torque, s[1] * torque, s[2] * torque, s[3] * torque});
  }
  if (!model_.torques.line) return power;
  const double torque = model_.torques.line(t);
  for (int k = 0; k + 1 < chain_.nodes(); ++k) {
    // of the angles' shape functions, the twists' part is odd
    const auto i = static_cast<std::size_t>(k);
    const double l = nodes_[i + 1].value - nodes_[i].value;
    add(k, chain_.local(rate, nodes_, &Prescribed::rate, k),
        {torque * l / 2, torque * l * l / 12, torque * l / 2, -torque * l * l / 12});
  }
  return power;
}

double RestingSpin::residual(const double* q, const double* rate, const double* a, double t, double* r) {
  chain_.evaluate(q, rate, nodes_);
  Eigen::Map<Eigen::VectorXd> out(r, coordinates());
  out.setZero();
  if (model_.torques.present()) {
    add_torques(q, rate, t, r);
    out = -out;
  }
  chain_.add_residual(a, nodes_, r);
  return chain_.dissipation();
}

bool RestingSpin::accelerate(const double* q, const double* rate, double t, double* a, Tally& power) {
  for (const DrivenAngle& drive : model_.drives) prescribed_[angle(drive.node)] = drive.theta(t).acceleration;
  power.dissipated += residual(q, rate, prescribed_.data(), t, a);
  Eigen::Map<Eigen::VectorXd> f(a, coordinates());
  f = -f;
  if (!chain_.solve(a)) return false;
  for (const DrivenAngle& drive : model_.drives) a[angle(drive.node)] = prescribed_[angle(drive.node)];
  if (!model_.torques.present() && model_.drives.empty()) return true;
  residual(q, rate, a, t, residual_.data());
  const Tally supplied = this->power(q, rate, residual_.data(), t);
  power.loads += supplied.loads;
  power.drives += supplied.drives;
  return true;
}

void RestingSpin::drive(const double* a, double t, double* r) const {
  for (const DrivenAngle& drive : model_.drives) {
    r[angle(drive.node)] = a[angle(drive.node)] - drive.theta(t).acceleration;
  }
}

Tally RestingSpin::power(const double* q, const double* rate, const double* residual, double t) const {
  Tally power;
  for (const DrivenAngle& drive : model_.drives) power.drives += residual[angle(drive.node)] * rate[angle(drive.node)];
  if (model_.torques.present()) power.loads = add_torques(q, rate, t, nullptr);
  return power;
}

std::vector<double> RestingSpin::drive_torques(const double* residual) const {
  std::vector<double> torques;
  for (const DrivenAngle& drive : model_.drives) torques.push_back(residual[angle(drive.node)]);
  return torques;
}

bool RestingSpin::linearize(double by_v, double by_a, SpinTangent& tangent) const {
  tangent.assemble(chain_, nodes_, {1, by_v, by_a});
  return tangent.factor(chain_, by_a);
}

RestingSpin::Seen RestingSpin::observe(const double* q, const double* rate, int points) const {
  Seen seen;
  for (int k = 0; k + 1 < chain_.nodes(); ++k) {
    const SpinChain::Coordinates at = chain_.local(q, nodes_, &Prescribed::value, k),
                                 rates = chain_.local(rate, nodes_, &Prescribed::rate, k);
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
