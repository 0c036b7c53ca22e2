#include "core/system/flowing_beam.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "core/system/implicit_flow.hpp"

namespace vlbeam {
namespace {

constexpr double shortest = 1e-6;  // of an element's mean length at t = 0: below, the elements tangle

}  // namespace

template <int D>
FlowingBeam<D>::FlowingBeam(const FlowingModel<D>& model)
    : model_(model), nodal_(Eigen::Index{node_size<D>} * nodes()) {
  check_model();
  mesh_.weights = model_.weights;
  mesh_.weights.resize(static_cast<std::size_t>(elements()));
  const auto& rule = gauss_legendre(model_.quadrature_points);
  for (int k = 0; k < elements(); ++k) tables_.emplace_back(rule, weights(k).w);
  elements_.resize(tables_.size());
  rotary_.reserve(tables_.size());
  model_.motion.at(0, nodes_);
  reference_length_ = (nodes_.back().value - nodes_.front().value) / elements();
  adopt_supports();
  if (model_.spin) spin_.emplace(*model_.spin, nodes_, model_.formulation, model_.quadrature_points);
  residual_.resize(coordinates());
  still_.setZero(nodal_);
  scratch_.setZero(coordinates());
  on_marks_.resize(nodes_.size());
  ramp_ = RampWork<D>(model_.gravity, model_.gravity_ramp);
}

template <int D>
FlowingBeam<D>::~FlowingBeam() = default;

template <int D>
void FlowingBeam<D>::check_model() const {
  if (elements() < 1) throw InvalidInput("/flow/nodes", "no motion", "the first and the last node need theirs");
  if (!model_.weights.empty() && static_cast<int>(model_.weights.size()) != elements()) {
    throw InvalidInput("/beam/weights", std::to_string(model_.weights.size()) + " of them",
                       "there must be one an element, or none");
  }
  std::vector<Prescribed> nodes;
  model_.motion.at(0, nodes);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const double length = nodes[k + 1].value - nodes[k].value;
    if (length > 0) continue;
    throw InvalidInput("/flow/nodes", "element " + std::to_string(k) + " of length " + six_digits(length) + " at t = 0",
                       "material coordinates must increase from node to node");
  }

  auto check_nodes = [&](const char* field, const auto& list, bool once) {
    std::vector<bool> taken(nodes.size(), false);
    for (const auto& entry : list) {
      if (entry.node < 0 || entry.node > elements()) {
        throw InvalidInput(
            field, "node " + std::to_string(entry.node),
            "it must be a node of the beam, 0 to " + std::to_string(elements()) + ": beyond its ends there is none");
      }
      const auto k = static_cast<std::size_t>(entry.node);
      if (taken[k] && once)
        throw InvalidInput(field, "node " + std::to_string(entry.node) + " twice", "a node can stand there once");
      taken[k] = true;
    }
    return taken;
  };
  check_nodes("/supports", model_.supports, true);
  const auto check_loads = [&](const auto& loads) {
    auto at_nodes = loads;
    std::erase_if(at_nodes, [](const auto& load) { return static_cast<bool>(load.x); });
    check_nodes("/loads", at_nodes, false);
  };
  check_loads(model_.loads.points);
  if (model_.spin) {
    check_drives(model_.spin->drives, elements());
    check_loads(model_.spin->torques.points);
    for (const Torques::Point& load : model_.spin->torques.points) {
      if (load.x || std::ranges::count(model_.spin->drives, load.node, &DrivenAngle::node) == 0) continue;
      throw InvalidInput("/loads", "a torque at node " + std::to_string(load.node),
                         "the angle there is prescribed already");
    }
  }

  if (model_.rotary.present()) {
    if (!(std::abs(model_.rotary.direction.norm() - 1) < 1e-9)) {
      throw InvalidInput("/beam/rotary_inertia", "without direction", "it needs a unit vector");
    }
    if (model_.formulation == Formulation::virtual_work) {
      throw InvalidInput("/beam/rotary_inertia", "with virtual-work",
                         "it must be \"none\", or the formulation variational");
    }
    const bool unequal = std::ranges::any_of(model_.weights, [](const auto& of) { return of.w != unit_weights; });
    if (model_.transport == WeightTransport::transported && unequal) {
      throw InvalidInput("/beam/rotary_inertia", "with transported weights",
                         "it must be \"none\", or the weights frozen or unit");
    }
  }
}

template <int D>
void FlowingBeam<D>::adopt_supports() {
  free_.assign(static_cast<std::size_t>(nodes()), {Components::Ones(), Components::Ones()});
  bool oriented = model_.rotary.present();
  if (oriented) {
    const Support<D> along = Support<D>::slide(model_.rotary.direction);
    frame_ = along.frame;
    aligned_ = along.aligned;
  }
  for (const auto& [node, support] : model_.supports) {
    free_[static_cast<std::size_t>(node)] = {support.free_position, support.free_slope};
    auto same = [](const Components& c) { return (c == c[0]).all(); };
    if (same(support.free_position) && same(support.free_slope)) continue;  // the same in any frame
    if (oriented && (support.frame - frame_).norm() > 1e-12) {
      throw InvalidInput("/supports", "slides or clamps of two directions",
                         "those of one beam must share one direction, that of rotary inertia, too");
    }
    oriented = true;
    frame_ = support.frame;
    aligned_ = support.aligned;
  }
}

template <int D>
std::vector<FieldRun> FlowingBeam<D>::fields() const {
  auto runs = nodal_fields(D, nodes());
  if (spin_) {
    for (const FieldRun& run : spin_->fields(nodal_)) runs.push_back(run);
  }
  return runs;
}

template <int D>
MovingCoordinates<double, D> FlowingBeam<D>::axis_of(const double* q, int k, double Prescribed::*x) const {
  return {element_nodes<D>(q, k), nodes_[static_cast<std::size_t>(k)].*x, nodes_[static_cast<std::size_t>(k) + 1].*x};
}

template <int D>
MovingLaw<D> FlowingBeam<D>::law(double t) const {
  MovingLaw<D> result{model_.section, model_.formulation, model_.transport,
                      model_.gravity * smooth_ramp(t, model_.gravity_ramp).value};
  if (model_.loads.line_force) result.gravity += model_.loads.line_force(t) / model_.section.rhoA;
  return result;
}

template <int D>
std::optional<RestElement<D>> FlowingBeam<D>::rest_of(int k) const {
  if (!model_.rest) return std::nullopt;
  const double a = nodes_[static_cast<std::size_t>(k)].value, b = nodes_[static_cast<std::size_t>(k) + 1].value;
  return RestElement<D>{{a, model_.rest->derivatives(a)}, {b, model_.rest->derivatives(b)}};
}

template <int D>
bool FlowingBeam<D>::evaluate(const double* q, const double* rate, double t) {
  ++rhs_evaluations_;
  model_.motion.at(t, nodes_);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (!(nodes_[k + 1].value - nodes_[k].value > 0)) return false;
  }
  check_reach(t);
  MovingLaw<D> moving = law(t);
  for (int k = 0; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto rest = rest_of(k);
    moving.rest = rest ? &*rest : nullptr;
    elements_[i] = moving_equations<double, D>(axis_of(q, k, &Prescribed::value), axis_of(rate, k, &Prescribed::rate),
                                               weights(k), tables_[i], moving);
  }
  if (model_.rotary.present()) {
    rotary_.clear();
    for (int k = 0; k < elements(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const RotaryElement& rotary = rotary_.emplace_back(nodes_[i], nodes_[i + 1], tables_[i]);
      const auto residual = rotary.residual(model_.rotary, element_nodes<D>(q, k), element_nodes<D>(rate, k));
      for (std::size_t row = 0; row < 4; ++row) elements_[i].force[row] -= residual[row];
    }
  }
  if (spin_) spin_->move(nodes_);
  return true;
}

template <int D>
void FlowingBeam<D>::add_residual(const double* a, double* r) const {
  for (int k = 0; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    auto axis = nodal_residual(elements_[i], axis_of(a, k, &Prescribed::acceleration));
    if (model_.rotary.present()) {
      const auto inertia = rotary_[i].inertia(model_.rotary, element_nodes<D>(a, k));
      for (std::size_t row = 0; row < 4; ++row) axis[row] += inertia[row];
    }
    position<D>(r, k) += axis[0];
    slope<D>(r, k) += axis[1];
    position<D>(r, k + 1) += axis[2];
    slope<D>(r, k + 1) += axis[3];
  }
}

template <int D>
void FlowingBeam<D>::add_inflow(const double* q, const double* rate, double* f) const {
  if (model_.formulation == Formulation::virtual_work) return;  // its forces are those of the matter that is there
  for (const int k : {0, elements()}) {
    const bool start = k == 0;
    const double x_rate = start ? nodes_.front().rate : nodes_.back().rate;
    const double in = start ? -x_rate : x_rate;  // length that comes in a second
    position<D>(f, k) += (model_.section.rhoA * in) * (position<D>(rate, k) - x_rate * slope<D>(q, k));
    if (model_.rotary.present()) slope<D>(f, k) += in * rotary_momentum(q, rate, k);
  }
}

template <int D>
Vec<double, D> FlowingBeam<D>::rotary_momentum(const double* q, const double* rate, int k) const {
  const int element = k == 0 ? 0 : k - 1;
  const MovingKinematics<double, D> axis(axis_of(q, element, &Prescribed::value),
                                         axis_of(rate, element, &Prescribed::rate), model_.transport, weights(element));
  const double u = k == 0 ? 0 : 1;
  const PointMotion<double, D> at = axis.at(u, rational_shape(axis.weights(), u));
  return model_.rotary.rhoJ * model_.rotary.across(at.v_x) -
         0.5 * model_.rotary.gyroscopic * model_.rotary.turned(at.r_x);
}

template <int D>
void FlowingBeam<D>::check_reach(double t) const {
  const double margin = 1e-9 * reference_length_, first = nodes_.front().value, last = nodes_.back().value;
  const auto check = [&](const auto& loads) {
    for (const auto& load : loads) {
      if (!load.x) continue;
      const double x = load.x(t);
      if (x >= first - margin && x <= last + margin) continue;
      throw ComputationFailed("a load at the material coordinate " + six_digits(x) +
                                  " m is beyond the ends of the beam, " + six_digits(first) + " and " +
                                  six_digits(last) + " m",
                              t);
    }
  };
  check(model_.loads.points);
  if (spin_) check(spin_->model().torques.points);
}

template <int D>
double FlowingBeam<D>::dissipation() const {
  double power = 0;
  for (const auto& element : elements_) power += element.dissipation;
  return power;
}

template <int D>
bool FlowingBeam<D>::solve_mass(double* f) {
  mass_.reset(nodes());
  for (int k = 0; k < elements(); ++k) mass_.add(k, elements_[static_cast<std::size_t>(k)].mass);
  if (model_.rotary.present()) {
    Components across = Components::Ones();
    across[0] = 0;  // of the frame, whose first axis is the direction then
    for (int k = 0; k < elements(); ++k) {
      mass_.add_to(across, k, model_.rotary.rhoJ * rotary_[static_cast<std::size_t>(k)].mass());
    }
  }
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
  return true;
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
  Eigen::Map<Eigen::VectorXd> force(a, nodal_);
  add_residual(still_.data(), a);
  force = -force;
  model_.loads.add_forces(view(q, rate), t, a);
  add_inflow(q, rate, a);
  Tally power;
  power.dissipated = dissipation();
  if (!solve_mass(a) || (spin_ && !spin_->accelerate(q + nodal_, rate + nodal_, t, a + nodal_, power.dissipated))) {
    dydt.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  if (model_.ledger) power = power + supplied(q, rate, a, t);
  tallies().add(power, dydt);
}

template <int D>
Tally FlowingBeam<D>::supplied(const double* q, const double* rate, const double* a, double t) {
  const Eigen::Index n = coordinates();
  residual_.setZero();
  add_residual(a, residual_.data());
  if (spin_) spin_->inner_residual(q + nodal_, rate + nodal_, a + nodal_, residual_.data() + nodal_);
  double power = residual_.dot(Eigen::Map<const Eigen::VectorXd>(rate, n));  // all that comes in
  double loads = 0, mesh = 0;
  auto drive = [&](int k, double force) {  // along the beam at node k
    const double p = force * nodes_[static_cast<std::size_t>(k)].rate;
    power += p;
    if (k > 0 && k < elements()) mesh += p;
  };
  const Vector line = model_.loads.line_force ? model_.loads.line_force(t) : Vector::Zero();
  for (int k = 0; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    auto [force_a, force_b] = guiding_forces(elements_[i], axis_of(a, k, &Prescribed::acceleration));
    if (spin_) {
      const auto spin = spin_->guiding_forces(k, a + nodal_);
      force_a += spin[0];
      force_b += spin[1];
    }
    if (model_.loads.line_force) {
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
    if (model_.rotary.present()) {  // what its nodes' residual does not supply comes in along the beam
      const auto e = element_nodes<D>(q, k), e_rate = element_nodes<D>(rate, k), e_a = element_nodes<D>(a, k);
      power += rotary_power(model_.rotary, nodes_[i], nodes_[i + 1], tables_[i], e, e_rate, e_a);
      const auto r = rotary_[i].residual(model_.rotary, e, e_rate), inertia = rotary_[i].inertia(model_.rotary, e_a);
      const auto rates = RotaryElement::nodal(e_rate);
      for (std::size_t row = 0; row < 4; ++row) power -= (r[row] + inertia[row]).dot(rates[row]);
    }
    drive(k, force_a);
    drive(k + 1, force_b);
  }
  // of concentrated loads and torques, on material points: what is along the beam goes into the motion of the nodes
  std::ranges::fill(on_marks_, 0);
  loads += model_.loads.add_forces(view(q, rate), t, scratch_.data(), on_marks_.data());
  if (spin_) loads += spin_->add_torques(q + nodal_, rate + nodal_, t, scratch_.data() + nodal_, on_marks_.data());
  for (int k = 1; k < elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    mesh -= on_marks_[i] * nodes_[i].rate;
  }

  Tally result;
  result.ends = power - loads - mesh;
  result.loads = loads;
  result.mesh = mesh;
  result.mass = model_.section.rhoA * (nodes_.back().rate - nodes_.front().rate);
  Vector impulse = law(t).gravity * (model_.section.rhoA * (nodes_.back().value - nodes_.front().value));
  for (int k = 0; k < nodes(); ++k) impulse += position<D>(residual_.data(), k);
  result.impulse.template head<D>() = impulse;
  for (int k = 0; spin_ && k < nodes(); ++k) result.spin_impulse += residual_[angle(k)];
  return result;
}

template <int D>
OuterForces<D> FlowingBeam<D>::forces(const Eigen::VectorXd& y, double t) {
  const std::size_t evaluations = rhs_evaluations_;  // those of the integrator
  Eigen::VectorXd dydt(y.size());
  rhs(y, dydt, t);
  rhs_evaluations_ = evaluations;
  // what M a lacks of the forces that are known
  const Eigen::Index n = coordinates();
  Eigen::VectorXd known = Eigen::VectorXd::Zero(n), force = known;
  const double *q = y.data(), *rate = q + n, *a = dydt.data() + n;
  model_.loads.add_forces(view(q, rate), t, known.data());
  add_inflow(q, rate, known.data());
  add_residual(a, force.data());
  force -= known;
  OuterForces<D> result;
  for (const NodeSupport<D>& held : model_.supports) {
    const auto on_node = force.segment<node_size<D>>(Eigen::Index{node_size<D>} * held.node);
    if (held.node > 0 && held.node < elements()) {
      result.guides.push_back(on_node);
    } else {
      result.supports[held.node == 0 ? 0 : 1] = on_node;
    }
  }
  if (spin_) {
    spin_->residual(q + nodal_, rate + nodal_, a + nodal_, t, force.data() + nodal_);
    result.drives = spin_->drive_torques(force.data() + nodal_);
  }
  return result;
}

template <int D>
void FlowingBeam<D>::jacobian(const Eigen::VectorXd& /*y*/, double /*t*/, Eigen::MatrixXd& /*dfdy*/,
                              Eigen::VectorXd& /*dfdt*/) {
  throw InvalidInput("/integrator/type", "\"rosenbrock4\"",
                     "a beam whose nodes are prescribed takes any explicit method or \"generalized-alpha\"");
}

template <int D>
std::unique_ptr<SecondOrderSystem> FlowingBeam<D>::new_second_order() {
  return std::make_unique<ImplicitFlow<D>>(*this);
}

template <int D>
Guards FlowingBeam<D>::guards(const Eigen::VectorXd& /*y*/, double t) const {
  Guards guards{{0, 0, -1}, {1, 0, -1}};
  const std::vector<Prescribed> nodes = nodes_at(t);
  double least = nodes[1].value - nodes[0].value;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) least = std::min(least, nodes[k + 1].value - nodes[k].value);
  guards[0].value = shortest - least / reference_length_;
  if (model_.transport == WeightTransport::transported) {
    for (int k = 0; k < elements(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      guards[1].value = std::max(guards[1].value, lost_weight(weights_at(i, nodes)));
    }
  }
  return guards;
}

template <int D>
void FlowingBeam<D>::handle_event(int index, Eigen::VectorXd& /*y*/, double t) {
  if (index == 1) throw ComputationFailed("a transported weight is about to vanish", t);
  const std::vector<Prescribed> nodes = nodes_at(t);
  std::size_t least = 0;
  auto length = [&](std::size_t k) { return nodes[k + 1].value - nodes[k].value; };
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) least = length(k) < length(least) ? k : least;
  throw ComputationFailed("the prescribed nodes tangle: element " + std::to_string(least) + " is " +
                              six_digits(length(least)) + " m long at t = " + six_digits(t) + " s",
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
  if (const auto tangle = model_.motion.tangle(0, until, shortest * reference_length_)) {
    throw InvalidInput(
        "/flow/nodes",
        "a motion by which element " + std::to_string(tangle->element) +
            " has no length left at t = " + six_digits(tangle->t) + " s",
        "material coordinates must increase from node to node until the end, t = " + six_digits(until) + " s");
  }
  std::vector<Prescribed> nodes;
  check_places<D>(model_.loads.points, until, 1e-9 * reference_length_, [&](double t) {
    model_.motion.at(t, nodes);
    return std::pair{nodes.front().value, nodes.back().value};
  });
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
  for (int k = 0; spin_ && k < this->nodes(); ++k) rate[angle(k)] = spin;
  return y;
}

template <int D>
Observation<D> FlowingBeam<D>::observe(const Eigen::VectorXd& y, double t, int points, bool strains) const {
  Observation<D> seen;
  if (strains) seen.extremes.emplace();
  const double* q = y.data();
  const double* rate = q + coordinates();
  model_.motion.at(t, nodes_);
  const Vector gravity = model_.gravity * smooth_ramp(t, model_.gravity_ramp).value;
  const Observer<D> observer(model_.section, gravity, points, model_.rotary.present() ? &model_.rotary : nullptr);
  for (int k = 0; k < elements(); ++k) {
    const MovingKinematics<double, D> element(axis_of(q, k, &Prescribed::value), axis_of(rate, k, &Prescribed::rate),
                                              model_.transport, weights(k));
    if (const auto rest = rest_of(k)) {
      const NodalCubic<double, D> nodes{rest->a.curve[0], rest->a.curve[1], rest->b.curve[0], rest->b.curve[1]};
      observer.add(element, &nodes, seen);
    } else {
      observer.add(element, nullptr, seen);
    }
  }
  if (spin_) {
    spin_->move(nodes_);
    const Spin::Seen turning = spin_->observe(q + nodal_, rate + nodal_, points);
    seen.energy.kinetic += turning.kinetic;
    seen.energy.torsion += turning.torsion;
    seen.spin_momentum += turning.momentum;
  }
  const Tally counted = tallies().of(y);
  seen.energy.dissipated = counted.dissipated;
  seen.load_work = counted.loads;
  seen.end_work = counted.ends;
  seen.mesh_work = counted.mesh;
  seen.mass_in = counted.mass;
  seen.energy.supplied = ramp_.until(t, {seen.mass_moment, seen.momentum});
  return seen;
}

template <int D>
Vec<double, D> FlowingBeam<D>::position_at(const Eigen::VectorXd& y, double t, double x) const {
  model_.motion.at(t, nodes_);
  const double margin = 1e-9 * reference_length_;
  if (x < nodes_.front().value - margin || x > nodes_.back().value + margin) {
    throw InvalidInput("/x", six_digits(x),
                       "it must be a material coordinate of the beam, " + six_digits(nodes_.front().value) + " to " +
                           six_digits(nodes_.back().value) + " at t = " + six_digits(t));
  }
  int k = 0;
  while (k + 1 < elements() && x > nodes_[static_cast<std::size_t>(k) + 1].value) ++k;
  const MovingCoordinates<double, D> at = axis_of(y.data(), k, &Prescribed::value);
  const double l = at.x_b - at.x_a;
  const Weights<double> w = weights_at(static_cast<std::size_t>(k), nodes_);
  return RationalCubic<double, D>::from_nodal(at.e, l, w).evaluate((x - at.x_a) / l)[0];
}

template <int D>
std::vector<Vec<double, D>> FlowingBeam<D>::load_places(const Eigen::VectorXd& y, double t) const {
  model_.motion.at(t, nodes_);
  return model_.loads.places(view(y.data(), y.data() + coordinates()), t);
}

template <int D>
ChainState<D> FlowingBeam<D>::chain(const Eigen::VectorXd& y, double t) const {
  ChainState<D> result;
  result.mesh = mesh_;
  for (const Prescribed& node : nodes_at(t)) result.mesh.x.push_back(node.value);
  result.q.assign(y.data(), y.data() + nodal_);
  result.rate.assign(y.data() + coordinates(), y.data() + coordinates() + nodal_);
  return result;
}

template <int D>
Weights<double> FlowingBeam<D>::weights_at(std::size_t element, const std::vector<Prescribed>& nodes) const {
  const WeightFunction& of = mesh_.weights[element];
  return model_.transport == WeightTransport::transported ? of.on(nodes[element].value, nodes[element + 1].value)
                                                          : of.w;
}

template class FlowingBeam<2>;
template class FlowingBeam<3>;

}  // namespace vlbeam
