#include "core/system/flowing_beam.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/system/implicit_flow.hpp"

namespace vlbeam {
namespace {

constexpr double shortest = 1e-6;         // of an element's mean length at t = 0: below, the elements tangle
constexpr double smallest_weight = 1e-3;  // of the largest of the same element

/// Where the entries of the ledger stand in the state, behind the rates; the impulse takes D of them, and the
/// dissipated energy is the last.
enum LedgerEntry : std::uint8_t { mass_entry, ends_entry, loads_entry, mesh_entry, impulse_entry };
template <int D>
constexpr int ledger_size = impulse_entry + D + 2;

std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

template <int D>
MovingEquations<double, D> axis_equations(StrainLaw strain_law, const MovingCoordinates<double, D>& q,
                                          const MovingCoordinates<double, D>& rate, const WeightFunction& weights,
                                          const ShapeTabulation& table, const MovingLaw<D>& law) {
  auto measured = [&]<StrainLaw Law>() {
    return law.section.bends() ? moving_equations<Law, true, double, D>(q, rate, weights, table, law)
                               : moving_equations<Law, false, double, D>(q, rate, weights, table, law);
  };
  return strain_law == StrainLaw::green ? measured.template operator()<StrainLaw::green>()
                                        : measured.template operator()<StrainLaw::engineering>();
}

}  // namespace

template <int D>
FlowingBeam<D>::FlowingBeam(const FlowingModel<D>& model)
    : model_(model), nodal_(Eigen::Index{node_size<D>} * nodes()) {
  check_model();
  if (model_.weights.empty()) model_.weights.resize(static_cast<std::size_t>(elements()));
  const auto& rule = gauss_legendre(model_.quadrature_points);
  for (int k = 0; k < elements(); ++k) tables_.emplace_back(rule, weights(k).w);
  elements_.resize(tables_.size());
  model_.motion.at(0, nodes_);
  reference_length_ = (nodes_.back().value - nodes_.front().value) / elements();
  adopt_supports();
  spin_inverse_.resize(static_cast<std::size_t>(nodes()));
  residual_.resize(coordinates());
  still_.setZero(coordinates());
}

template <int D>
FlowingBeam<D>::~FlowingBeam() = default;

template <int D>
void FlowingBeam<D>::check_model() const {
  if (elements() < 1) throw InvalidInput("/beam/nodes", "no motion", "the first and the last node need theirs");
  if (!model_.weights.empty() && static_cast<int>(model_.weights.size()) != elements()) {
    throw InvalidInput("/beam/weights", std::to_string(model_.weights.size()) + " of them", "one an element, or none");
  }
  std::vector<Prescribed> nodes;
  model_.motion.at(0, nodes);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const double length = nodes[k + 1].value - nodes[k].value;
    if (length > 0) continue;
    throw InvalidInput("/beam/nodes", "element " + std::to_string(k) + " of length " + text(length) + " at t = 0",
                       "material coordinates increase from node to node");
  }

  auto check_nodes = [&](const char* field, const auto& list) {
    std::vector<bool> taken(nodes.size(), false);
    for (const auto& entry : list) {
      if (entry.node < 0 || entry.node > elements()) {
        throw InvalidInput(
            field, "node " + std::to_string(entry.node),
            "a node of the beam, 0 to " + std::to_string(elements()) + ": beyond its ends there is none");
      }
      const auto k = static_cast<std::size_t>(entry.node);
      if (taken[k]) throw InvalidInput(field, "node " + std::to_string(entry.node) + " twice", "once a node");
      taken[k] = true;
    }
    return taken;
  };
  check_nodes("/supports", model_.supports);
  check_nodes("/loads", model_.loads);
  const std::vector<bool> driven = check_nodes("/angles", model_.angles);

  if (!model_.spin && (!model_.angles.empty() || model_.line_torque)) {
    throw InvalidInput("/beam/spin", "none", "a section that spins: angles or torques are given");
  }
  for (const auto& load : model_.loads) {
    if (!load.torque) continue;
    if (!model_.spin) throw InvalidInput("/beam/spin", "none", "a section that spins: a torque is given");
    if (driven[static_cast<std::size_t>(load.node)]) {
      throw InvalidInput("/loads", "a torque at node " + std::to_string(load.node),
                         "a torque where the angle is not prescribed already");
    }
  }
  for (const DrivenAngle& angle : model_.angles) {
    const double rate = angle.theta(0).rate, first = model_.angles.front().theta(0).rate;
    if (rate == first) continue;
    throw InvalidInput("/angles", "spins of " + text(first) + " and " + text(rate) + " rad/s",
                       "one spin: a shaft driven at two places at different rates winds up without bound");
  }
}

template <int D>
void FlowingBeam<D>::adopt_supports() {
  free_.assign(static_cast<std::size_t>(nodes()), {Components::Ones(), Components::Ones()});
  bool oriented = false;
  for (const auto& [node, support] : model_.supports) {
    free_[static_cast<std::size_t>(node)] = {support.free_position, support.free_slope};
    auto same = [](const Components& c) { return (c == c[0]).all(); };
    if (same(support.free_position) && same(support.free_slope)) continue;  // the same in any frame
    if (oriented && (support.frame - frame_).norm() > 1e-12) {
      throw InvalidInput("/supports", "slides or clamps of two directions", "those of one beam to share one direction");
    }
    oriented = true;
    frame_ = support.frame;
    aligned_ = support.aligned;
  }
}

template <int D>
Eigen::Index FlowingBeam<D>::size() const {
  return 2 * coordinates() + (model_.ledger ? ledger_size<D> : damped() ? 1 : 0);
}

template <int D>
MovingCoordinates<double, D> FlowingBeam<D>::axis_of(const double* q, int k, double Prescribed::*x) const {
  return {element_nodes<D>(q, k), nodes_[static_cast<std::size_t>(k)].*x, nodes_[static_cast<std::size_t>(k) + 1].*x};
}

template <int D>
SpinCoordinates<double> FlowingBeam<D>::spin_of(const double* q, int k, double Prescribed::*x) const {
  const double* theta = q + nodal_;
  return {theta[k], theta[k + 1], nodes_[static_cast<std::size_t>(k)].*x, nodes_[static_cast<std::size_t>(k) + 1].*x};
}

template <int D>
MovingLaw<D> FlowingBeam<D>::law(double t) const {
  MovingLaw<D> result{model_.section, model_.formulation, model_.transport, model_.gravity};
  if (model_.line_force) result.gravity += model_.line_force(t) / model_.section.rhoA;
  return result;
}

template <int D>
bool FlowingBeam<D>::evaluate(const double* q, const double* rate, double t) {
  ++rhs_evaluations_;
  model_.motion.at(t, nodes_);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (!(nodes_[k + 1].value - nodes_[k].value > 0)) return false;
  }
  const MovingLaw<D> moving = law(t);
  for (int k = 0; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    elements_[i].axis = axis_equations<D>(model_.strain_law, axis_of(q, k, &Prescribed::value),
                                          axis_of(rate, k, &Prescribed::rate), weights(k), tables_[i], moving);
    if (model_.spin) {
      elements_[i].spin = spin_equations(spin_of(q, k, &Prescribed::value), spin_of(rate, k, &Prescribed::rate),
                                         model_.formulation, *model_.spin);
    }
  }
  return true;
}

template <int D>
void FlowingBeam<D>::add_residual(const double* a, double* r) const {
  for (int k = 0; k < elements(); ++k) {
    const Element& element = elements_[static_cast<std::size_t>(k)];
    const auto axis = nodal_residual(element.axis, axis_of(a, k, &Prescribed::acceleration));
    position<D>(r, k) += axis[0];
    slope<D>(r, k) += axis[1];
    position<D>(r, k + 1) += axis[2];
    slope<D>(r, k + 1) += axis[3];
    if (model_.spin) {
      const auto spin = element.spin.residual(spin_of(a, k, &Prescribed::acceleration));
      r[nodal_ + k] += spin[0];
      r[nodal_ + k + 1] += spin[1];
    }
  }
}

template <int D>
void FlowingBeam<D>::add_inflow(const double* q, const double* rate, double* f) const {
  if (model_.formulation == Formulation::virtual_work) return;  // its forces are those of the matter that is there
  for (const int k : {0, elements()}) {
    const double in = k == 0 ? -nodes_.front().rate : nodes_.back().rate;  // length that comes in a second
    const double x_rate = k == 0 ? nodes_.front().rate : nodes_.back().rate;
    position<D>(f, k) += (model_.section.rhoA * in) * (position<D>(rate, k) - x_rate * slope<D>(q, k));
    if (model_.spin) {
      const int element = k == 0 ? 0 : k - 1;
      const SpinMotion<double> spin(spin_of(q, element, &Prescribed::value), spin_of(rate, element, &Prescribed::rate));
      f[nodal_ + k] += model_.spin->rhoIp * in * (k == 0 ? spin.omega_a : spin.omega_b);
    }
  }
}

template <int D>
void FlowingBeam<D>::add_loads(const double* q, double t, double* f) const {
  for (const NodeLoad<D>& load : model_.loads) {
    position<D>(f, load.node) += force_of(load, q, t);
    if (load.torque) f[nodal_ + load.node] += load.torque(t);
  }
  if (model_.line_torque) {
    const double torque = model_.line_torque(t);
    for (int k = 0; k < elements(); ++k) {
      const double half = torque * elements_[static_cast<std::size_t>(k)].spin.l / 2;
      f[nodal_ + k] += half;
      f[nodal_ + k + 1] += half;
    }
  }
}

template <int D>
Vec<double, D> FlowingBeam<D>::force_of(const NodeLoad<D>& load, const double* q, double t) {
  Vector force = Vector::Zero();
  if (load.force) force += load.force(t);
  if (load.follower) force += load.follower(t) * slope<D>(q, load.node).normalized();
  return force;
}

template <int D>
double FlowingBeam<D>::dissipation() const {
  double power = 0;
  for (const Element& element : elements_)
    power += element.axis.dissipation + (model_.spin ? element.spin.dissipation : 0);
  return power;
}

template <int D>
bool FlowingBeam<D>::solve_mass(double t, double* f) {
  mass_.reset(nodes());
  for (int k = 0; k < elements(); ++k) mass_.add(k, elements_[static_cast<std::size_t>(k)].axis.mass);
  if (!mass_.factor(free_)) return false;
  auto turn = [&](const Eigen::Matrix<double, D, D>& into) {
    for (int k = 0; k < 2 * nodes(); ++k) {
      Eigen::Map<Vector> part(f + Eigen::Index{D} * k);
      part = (into * part).eval();
    }
  };
  if (!aligned_) turn(frame_.transpose());
  mass_.solve(f);
  if (!aligned_) turn(frame_);
  if (model_.spin) solve_spin(t, f + nodal_);
  return true;
}

template <int D>
void FlowingBeam<D>::solve_spin(double t, double* f) {
  // a driven angle is a pivot of infinite inertia with its acceleration for the solution
  spin_inverse_.assign(spin_inverse_.size(), 1);
  for (const DrivenAngle& angle : model_.angles) {
    spin_inverse_[static_cast<std::size_t>(angle.node)] = 0;
    f[angle.node] = angle.theta(t).acceleration;
  }
  double pivot = 0;
  for (int k = 0; k <= elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double before = k > 0 ? elements_[i - 1].spin.mass_coupling() : 0;
    pivot = (k > 0 ? elements_[i - 1].spin.mass_diagonal() - before * before * spin_inverse_[i - 1] : 0) +
            (k < elements() ? elements_[i].spin.mass_diagonal() : 0);
    if (spin_inverse_[i] == 0) continue;
    spin_inverse_[i] = 1 / pivot;
    f[k] = (f[k] - (k > 0 ? before * f[k - 1] : 0)) * spin_inverse_[i];
  }
  for (int k = elements() - 1; k >= 0; --k) {
    const auto i = static_cast<std::size_t>(k);
    f[k] -= spin_inverse_[i] * elements_[i].spin.mass_coupling() * f[k + 1];
  }
}

template <int D>
void FlowingBeam<D>::rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) {
  const Eigen::Index n = coordinates();
  const double* q = y.data();
  const double* rate = q + n;
  double* a = dydt.data() + n;
  dydt.head(n) = y.segment(n, n);
  dydt.tail(dydt.size() - n).setZero();
  if (!evaluate(q, rate, t)) {
    dydt.setConstant(std::numeric_limits<double>::quiet_NaN());  // outside the domain: the step is repeated, shorter
    return;
  }
  Eigen::Map<Eigen::VectorXd> force(a, n);
  add_residual(still_.data(), a);
  force = -force;
  add_loads(q, t, a);
  add_inflow(q, rate, a);
  if (!solve_mass(t, a)) {
    dydt.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  if (model_.ledger) {
    book(q, rate, a, t, dydt.data() + 2 * n);
  } else if (damped()) {
    dydt[dydt.size() - 1] = dissipation();
  }
}

template <int D>
void FlowingBeam<D>::book(const double* q, const double* rate, const double* a, double t, double* entry) {
  const Eigen::Index n = coordinates();
  residual_.setZero();
  add_residual(a, residual_.data());
  double power = residual_.dot(Eigen::Map<const Eigen::VectorXd>(rate, n));  // all that comes in
  double loads = 0, mesh = 0;
  auto drive = [&](int k, double force) {  // along the beam at node k
    const double p = force * nodes_[static_cast<std::size_t>(k)].rate;
    power += p;
    if (k > 0 && k < elements()) mesh += p;
  };
  const Vector line = model_.line_force ? model_.line_force(t) : Vector::Zero();
  const double line_torque = model_.line_torque ? model_.line_torque(t) : 0;
  for (int k = 0; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto& eq = elements_[i].axis;
    const MovingCoordinates<double, D> at = axis_of(a, k, &Prescribed::acceleration);
    const std::array<Vector, 4> nodal{at.e.r_a, at.e.s_a, at.e.r_b, at.e.s_b};
    double force_a = eq.mass_aa * at.x_a + eq.mass_ab * at.x_b - eq.force_a;
    double force_b = eq.mass_ab * at.x_a + eq.mass_bb * at.x_b - eq.force_b;
    for (std::size_t j = 0; j < 4; ++j) {
      force_a += eq.mass_a[j].dot(nodal[j]);
      force_b += eq.mass_b[j].dot(nodal[j]);
    }
    if (model_.spin) {
      const auto spin = elements_[i].spin.residual(spin_of(a, k, &Prescribed::acceleration));
      force_a += spin[2];
      force_b += spin[3];
    }
    if (model_.line_force) {
      // moving_equations took the line force for a potential, of which the moving ends carry a part; it is none
      const MovingKinematics<double, D> kinematics(axis_of(q, k, &Prescribed::value),
                                                   axis_of(rate, k, &Prescribed::rate), model_.transport, weights(k));
      for (const auto& [u, w] : tables_[i].rule) {
        const PointMotion<double, D> point = kinematics.at(u, rational_shape(kinematics.weights(), u));
        const double along = line.dot(point.r_x) * kinematics.length();
        force_a += w * ((1 - u) * along - line.dot(point.r));
        force_b += w * (u * along + line.dot(point.r));
        const double work = w * kinematics.length() * line.dot(point.v);
        loads += work;
        power += work;
      }
    }
    if (model_.line_torque) {
      const SpinMotion<double> spin(spin_of(q, k, &Prescribed::value), spin_of(rate, k, &Prescribed::rate));
      const double half = line_torque * spin.l / 2;
      loads += half * (spin.omega_a + spin.omega_b);
      force_a += half * spin.tau;
      force_b += half * spin.tau;
      power -= half * spin.tau * (nodes_[i].rate + nodes_[i + 1].rate);  // the residual holds it already
    }
    drive(k, force_a);
    drive(k + 1, force_b);
  }
  for (const NodeLoad<D>& load : model_.loads) {
    // on the material point: what is along the beam goes into the motion of the node, not into the matter
    const double x_rate = nodes_[static_cast<std::size_t>(load.node)].rate;
    double along = force_of(load, q, t).dot(slope<D>(q, load.node)) * x_rate;
    double work = force_of(load, q, t).dot(position<D>(rate, load.node));
    if (load.torque) {
      const double torque = load.torque(t);
      along += torque * twist_at(q, load.node) * x_rate;
      work += torque * rate[nodal_ + load.node];
    }
    loads += work - along;
    if (load.node > 0 && load.node < elements()) mesh += along;
  }

  entry[mass_entry] = model_.section.rhoA * (nodes_.back().rate - nodes_.front().rate);
  entry[ends_entry] = power - loads - mesh;
  entry[loads_entry] = loads;
  entry[mesh_entry] = mesh;
  Eigen::Map<Vector> impulse(entry + impulse_entry);
  impulse = law(t).gravity * (model_.section.rhoA * (nodes_.back().value - nodes_.front().value));
  for (int k = 0; k < nodes(); ++k) impulse += position<D>(residual_.data(), k);
  entry[impulse_entry + D] = model_.spin ? residual_.tail(nodes()).sum() : 0;
  entry[impulse_entry + D + 1] = dissipation();
}

template <int D>
double FlowingBeam<D>::twist_at(const double* q, int node) const {
  auto twist = [&](int k) {
    const SpinCoordinates<double> at = spin_of(q, k, &Prescribed::value);
    return (at.theta_b - at.theta_a) / (at.x_b - at.x_a);
  };
  if (node == 0) return twist(0);
  return node == elements() ? twist(node - 1) : (twist(node - 1) + twist(node)) / 2;
}

template <int D>
FlowLedger<D> FlowingBeam<D>::ledger(const Eigen::VectorXd& y) const {
  if (!model_.ledger) throw InvalidInput("/ledger", "false", "true: the state holds no ledger otherwise");
  const double* entry = y.data() + 2 * coordinates();
  return {.mass = entry[mass_entry],
          .ends = entry[ends_entry],
          .loads = entry[loads_entry],
          .mesh = entry[mesh_entry],
          .dissipated = entry[impulse_entry + D + 1],
          .impulse = Eigen::Map<const Vector>(entry + impulse_entry),
          .spin_impulse = entry[impulse_entry + D]};
}

template <int D>
void FlowingBeam<D>::jacobian(const Eigen::VectorXd& /*y*/, double /*t*/, Eigen::MatrixXd& /*dfdy*/,
                              Eigen::VectorXd& /*dfdt*/) {
  throw InvalidInput("/integrator/type", "\"rosenbrock4\"",
                     "a beam whose nodes are prescribed takes any explicit method or \"generalized-alpha\"");
}

template <int D>
std::unique_ptr<SecondOrderSystem> FlowingBeam<D>::new_second_order() {
  if (model_.ledger) {
    throw InvalidInput("/ledger", "true", "false with an implicit method: it integrates the motion alone");
  }
  return std::make_unique<ImplicitFlow<D>>(*this);
}

template <int D>
Guards FlowingBeam<D>::guards(const Eigen::VectorXd& /*y*/, double t) const {
  Guards value;
  value.fill(-1);
  const std::vector<Prescribed> nodes = nodes_at(t);
  double least = nodes[1].value - nodes[0].value;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) least = std::min(least, nodes[k + 1].value - nodes[k].value);
  value[0] = shortest - least / reference_length_;
  if (model_.transport == WeightTransport::transported) {
    for (int k = 0; k < elements(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Weights<double> w = weights(k).on(nodes[i].value, nodes[i + 1].value);
      const double ratio = *std::min_element(w.begin(), w.end()) / *std::max_element(w.begin(), w.end());
      value[1] = std::max(value[1], smallest_weight - ratio);
    }
  }
  return value;
}

template <int D>
void FlowingBeam<D>::handle_event(int index, Eigen::VectorXd& /*y*/, double t) {
  if (index == 1) throw ComputationFailed("a transported weight is about to vanish", t);
  const std::vector<Prescribed> nodes = nodes_at(t);
  std::size_t least = 0;
  auto length = [&](std::size_t k) { return nodes[k + 1].value - nodes[k].value; };
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) least = length(k) < length(least) ? k : least;
  throw ComputationFailed("the prescribed nodes tangle: element " + std::to_string(least) + " is " +
                              text(length(least)) + " m long at t = " + text(t) + " s",
                          t);
}

template <int D>
std::vector<Prescribed> FlowingBeam<D>::nodes_at(double t) const {
  std::vector<Prescribed> nodes;
  model_.motion.at(t, nodes);
  return nodes;
}

template <int D>
void FlowingBeam<D>::check_motion(double until) const {
  const auto tangle = model_.motion.tangle(0, until, shortest * reference_length_);
  if (!tangle) return;
  throw InvalidInput("/beam/nodes",
                     "a motion by which element " + std::to_string(tangle->element) +
                         " has no length left at t = " + text(tangle->t) + " s",
                     "material coordinates increase from node to node until the end, t = " + text(until) + " s");
}

template <int D>
Eigen::VectorXd FlowingBeam<D>::straight_state(const Vector& start, const Vector& along, double stretch,
                                               double velocity, double spin, double t) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  const std::vector<Prescribed> nodes = nodes_at(t);
  double* rate = y.data() + coordinates();
  for (int k = 0; k < this->nodes(); ++k) {
    const Prescribed& x = nodes[static_cast<std::size_t>(k)];
    position<D>(y.data(), k) = start + along * (stretch * (x.value - nodes.front().value));
    slope<D>(y.data(), k) = stretch * along;
    position<D>(rate, k) = along * (velocity + stretch * x.rate);
  }
  if (model_.spin) y.segment(coordinates() + nodal_, this->nodes()).setConstant(spin);
  return y;
}

template <int D>
FlowObservation<D> FlowingBeam<D>::observe(const Eigen::VectorXd& y, double t) const {
  FlowObservation<D> seen;
  const double* q = y.data();
  const double* rate = q + coordinates();
  model_.motion.at(t, nodes_);
  auto elastic = [&](const PointMotion<double, D>& at) {
    auto energies = [](const auto& stress) { return std::array<double, 2>{stress.axial, stress.bending}; };
    const Stiffness& k = model_.section.stiffness;
    return model_.strain_law == StrainLaw::green
               ? energies(ElasticStress<StrainLaw::green, true, double, D>(at.r_x, at.r_xx, k))
               : energies(ElasticStress<StrainLaw::engineering, true, double, D>(at.r_x, at.r_xx, k));
  };
  for (int k = 0; k < elements(); ++k) {
    const MovingKinematics<double, D> kinematics(axis_of(q, k, &Prescribed::value), axis_of(rate, k, &Prescribed::rate),
                                                 model_.transport, weights(k));
    for (const auto& [u, w] : tables_[static_cast<std::size_t>(k)].rule) {
      const PointMotion<double, D> at = kinematics.at(u, rational_shape(kinematics.weights(), u));
      const double length = w * kinematics.length(), mass = length * model_.section.rhoA;
      const auto [axial, bending] = elastic(at);
      seen.energy.kinetic += 0.5 * mass * at.v.squaredNorm();
      seen.energy.axial += length * axial;
      seen.energy.bending += length * bending;
      seen.energy.gravity -= mass * model_.gravity.dot(at.r);
      seen.mass += mass;
      seen.momentum += mass * at.v;
      seen.beam_length += length * at.r_x.norm();
    }
    if (model_.spin) {
      const SpinMotion<double> spin(spin_of(q, k, &Prescribed::value), spin_of(rate, k, &Prescribed::rate));
      seen.energy.kinetic += spin.kinetic_energy(*model_.spin);
      seen.energy.torsion += spin.torsion_energy(*model_.spin);
      seen.spin_momentum += spin.momentum(*model_.spin);
    }
  }
  if (y.size() > 2 * coordinates()) seen.energy.dissipated = y[y.size() - 1];
  return seen;
}

template <int D>
Vec<double, D> FlowingBeam<D>::position_at(const Eigen::VectorXd& y, double t, double x) const {
  model_.motion.at(t, nodes_);
  const double slack = 1e-9 * reference_length_;
  if (x < nodes_.front().value - slack || x > nodes_.back().value + slack) {
    throw InvalidInput("/x", text(x),
                       "a material coordinate of the beam, " + text(nodes_.front().value) + " to " +
                           text(nodes_.back().value) + " at t = " + text(t));
  }
  int k = 0;
  while (k + 1 < elements() && x > nodes_[static_cast<std::size_t>(k) + 1].value) ++k;
  const MovingCoordinates<double, D> at = axis_of(y.data(), k, &Prescribed::value);
  const double l = at.x_b - at.x_a;
  const Weights<double> w =
      model_.transport == WeightTransport::transported ? weights(k).on(at.x_a, at.x_b) : weights(k).w;
  return RationalCubic<double, D>::from_nodal(at.e, l, w).evaluate((x - at.x_a) / l)[0];
}

template class FlowingBeam<2>;
template class FlowingBeam<3>;

}  // namespace vlbeam
