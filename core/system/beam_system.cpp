#include "core/system/beam_system.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/length_control/chain_motion.hpp"
#include "core/system/implicit_beam.hpp"

namespace vlbeam {
template <int D>
BeamSystem<D>::BeamSystem(const BeamModel<D>& model, const ChainState<D>& chain) : model_(model) {
  if (model.spin && model.joint) {
    throw InvalidInput("/sliding_mass", "this key", "it does not go together with /spin");
  }
  if (model.spin) check_drives(model.spin->drives, chain.mesh.last());
  if (model.driven() && model.joint && model.length_control.velocities == VelocityTransfer::conservative) {
    throw InvalidInput("/length_control/velocities", "\"conservative\"",
                       "moving supports need \"nodal\" or \"projected\": they give energy and momentum away");
  }
  adopt(chain);
  initial_ = state_of(chain, {});
  if (spin_) spin_->start(initial_.data() + nodal_, initial_.data() + coordinates_ + nodal_);
  anchors_ = {initial_.head<node_size<D>>(), initial_.segment<node_size<D>>(nodal_ - node_size<D>)};
  if (has_joint()) joint_anchor_ = initial_.segment<node_size<D>>(Eigen::Index{node_size<D>} * joint_);
  impose(initial_, 0);
  ramp_ = RampWork<D>(model.gravity, model.gravity_ramp);
}

template <int D>
BeamSystem<D>::~BeamSystem() = default;

template <int D>
void BeamSystem<D>::adopt(const ChainState<D>& chain) {
  ++revision_;
  mesh_ = chain.mesh;
  rest_ = chain.rest;
  joint_ = chain.joint;
  free_mass_ = model_.joint && !model_.joint_support && joint_ == no_joint && !chain.rider;
  nodal_ = node_size<D> * static_cast<Eigen::Index>(mesh_.x.size());
  spin_.reset();
  if (model_.spin) {
    std::vector<Prescribed> marks;
    for (const double x : mesh_.x) marks.push_back({x, 0, 0});
    spin_.emplace(*model_.spin, std::move(marks), model_.formulation, model_.quadrature_points);
  }
  coordinates_ = nodal_ + (spin_ ? spin_->coordinates() : 0) + (has_joint() || chain.rider ? 1 : 0) +
                 (kinked() || free_mass_ ? D : 0);
  behind_ = kinked() ? nodal_ + 1 : Eigen::Index{node_size<D>} * joint_ + D;
  const auto& rule = gauss_legendre(model_.quadrature_points);
  const int middle = mesh_.elements() / 2;
  const int left_open = has_joint() ? joint_ - 1 : middle, right_open = has_joint() ? joint_ + 1 : middle;
  const double* rest = rest_.empty() ? nullptr : rest_.data();
  left_.emplace(mesh_, 0, left_open, model_.start, model_.section, rule, rest, model_.masses.points);
  right_.emplace(mesh_, mesh_.last(), right_open, model_.end, model_.section, rule, rest, model_.masses.points);
  if (model_.driven()) {
    for (const std::size_t end : {0, 1}) {
      const std::size_t k = end == 0 ? 0 : static_cast<std::size_t>(mesh_.elements()) - 1;
      end_inertia_[end] = fixed_inertia(mesh_.x[k + 1] - mesh_.x[k], mesh_.weights[k].w, rule);
    }
  }
  if (has_joint()) {
    const auto j = static_cast<std::size_t>(joint_);
    left_table_ = ShapeTabulation(rule, mesh_.weights[j - 1].w);
    right_table_ = ShapeTabulation(rule, mesh_.weights[j].w);
  }
  rider_.reset();
  if (chain.rider) {
    const auto k = static_cast<std::size_t>(chain.rider->element);
    rider_.emplace(Riding{chain.rider->element,
                          chain.rider->held,
                          k > 0 ? mesh_.x.back() : mesh_.x.front(),
                          {mesh_.x[k], mesh_.x[k + 1] - mesh_.x[k], mesh_.weights[k].w},
                          RiderMass<D>(*left_, *right_, mesh_.last() + 1, chain.rider->element)});
  }
  set_end_limits();
}

template <int D>
void BeamSystem<D>::set_end_limits() {
  const auto& control = model_.length_control;
  end_limit_ = {0, 0};
  cut_limit_ = std::numeric_limits<double>::infinity();
  if (!control.enabled || control.end_merge == 0) return;
  if (rider_) cut_limit_ = control.end_cut() * std::min(control.standard_length, rider_->curve.length);
  if (!has_joint()) return;
  const auto j = static_cast<std::size_t>(joint_);
  const double unit = std::min(control.standard_length, (mesh_.x[j + 1] - mesh_.x[j - 1]) / 2);
  const auto limit = [&](double length) {  // an element that is shorter from the start has to halve first
    const double due = control.end_merge * unit;
    return length > due ? due : length / 2;
  };
  if (joint_ + 1 == mesh_.last()) end_limit_[0] = limit(mesh_.x[j + 1] - mesh_.x[j]);
  if (joint_ == 1) end_limit_[1] = limit(mesh_.x[j] - mesh_.x[j - 1]);
}

template <int D>
std::vector<FieldRun> BeamSystem<D>::fields() const {
  auto runs = nodal_fields(D, nodal_ / node_size<D>);
  if (has_joint() || rider_) runs.push_back({Field::mark, nodal_});
  if (kinked()) runs.push_back({Field::slope, behind_, D});
  if (free_mass_) runs.push_back({Field::mass, nodal_, D});
  if (spin_) {
    for (const FieldRun& run : spin_->fields(nodal_)) runs.push_back(run);
  }
  return runs;
}

template <int D>
Eigen::VectorXd BeamSystem<D>::state_of(const ChainState<D>& chain, const Eigen::VectorXd& old) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  y.head(nodal_) = Eigen::Map<const Eigen::VectorXd>(chain.q.data(), nodal_);
  y.segment(coordinates_, nodal_) = Eigen::Map<const Eigen::VectorXd>(chain.rate.data(), nodal_);
  if (has_joint()) {
    y[nodal_] = chain.mesh.x[static_cast<std::size_t>(chain.joint)];
    y[coordinates_ + nodal_] = chain.joint_rate;
  }
  if (rider_) {
    y[nodal_] = chain.rider->x;
    y[coordinates_ + nodal_] = chain.rider->rate;
  }
  if (kinked()) {
    y.segment<D>(behind_) = chain.kink->slope;
    y.segment<D>(coordinates_ + behind_) = chain.kink->rate;
  }
  const Eigen::Index tallies = model_.tallies().count();
  if (old.size() > 0) y.tail(tallies) = old.tail(tallies);
  return y;
}

template <int D>
ChainState<D> BeamSystem<D>::chain(const Eigen::VectorXd& y) const {
  ChainState<D> result;
  result.mesh = mesh_;
  result.q.assign(y.data(), y.data() + nodal_);
  result.rate.assign(y.data() + coordinates_, y.data() + coordinates_ + nodal_);
  result.joint = joint_;
  if (has_joint()) {
    result.mesh.x[static_cast<std::size_t>(joint_)] = y[nodal_];
    result.joint_rate = y[coordinates_ + nodal_];
  }
  result.rest = rest_;
  if (has_joint() && result.curved_at_rest()) {
    const auto at_joint = model_.rest->derivatives(y[nodal_]);
    position<D>(result.rest.data(), joint_) = at_joint[0];
    slope<D>(result.rest.data(), joint_) = at_joint[1];
  }
  if (rider_) result.rider = {rider_->element, y[nodal_], y[coordinates_ + nodal_], rider_->held};
  if (kinked()) result.kink = {y.segment<D>(behind_), y.segment<D>(coordinates_ + behind_)};
  return result;
}

template <int D>
std::optional<typename BeamSystem<D>::MassMotion> BeamSystem<D>::mass_motion(const Eigen::VectorXd& y) const {
  if (!model_.joint || !(mass_on_beam() || free_mass_)) return std::nullopt;
  if (rider_) {
    const auto at = rider_motion(y.data(), y.data() + coordinates_);
    return MassMotion{at.r, at.v};
  }
  const Eigen::Index at = has_joint() ? Eigen::Index{node_size<D> * joint_} : nodal_;
  return MassMotion{y.segment<D>(at), y.segment<D>(coordinates_ + at)};
}

template <int D>
NodalCubic<double, D> BeamSystem<D>::element_of(const double* q, int k) const {
  auto nodes = element_nodes<D>(q, k);
  if (k == joint_) nodes.s_a = Eigen::Map<const Vector>(q + behind_);
  return nodes;
}

template <int D>
JointMotion<D> BeamSystem<D>::joint_motion(const double* q, const double* rate, double t) const {
  return {joint_slopes(q), joint_slopes(rate), rate[nodal_], gravity(t)};
}

template <int D>
ConstraintResidual BeamSystem<D>::slope_residual(const Eigen::VectorXd& y) const {
  ConstraintResidual largest;
  if (!kinked()) return largest;
  const auto slopes = joint_slopes(y.data()), rates = joint_slopes(y.data() + coordinates_);
  const SlopeConditions<D> conditions(model_.joint->slopes, longest_axis<D>(slopes.template head<D>()));
  for (int i = 0; i < conditions.count(); ++i) {
    largest.position = std::max(largest.position, std::abs(conditions.value(i, slopes)));
    largest.velocity = std::max(largest.velocity, std::abs(conditions.rate(i, slopes, rates)));
  }
  return largest;
}

template <int D>
std::optional<typename BeamSystem<D>::JointRest> BeamSystem<D>::joint_rest(double x) const {
  if (!model_.rest) return std::nullopt;
  const RestEnd<D> moving{x, model_.rest->derivatives(x)};
  const auto fixed = [&](int node) -> RestEnd<D> {
    return {mesh_.x[static_cast<std::size_t>(node)],
            {position<D>(rest_.data(), node), slope<D>(rest_.data(), node), Vector::Zero(), Vector::Zero()}};
  };
  return JointRest{{fixed(joint_ - 1), moving}, {moving, fixed(joint_ + 1)}};
}

template <int D>
typename BeamSystem<D>::JointElements BeamSystem<D>::joint_elements(const double* q, const double* rate,
                                                                    double t) const {
  const auto j = static_cast<std::size_t>(joint_);
  const double x = q[nodal_], x_rate = rate[nodal_];
  MovingLaw<D> left = moving_law(t), right = left;
  const auto rest = joint_rest(x);
  if (rest) {
    left.rest = &rest->left;
    right.rest = &rest->right;
  }
  JointElements at_joint{moving_equations<double, D, MovingEnds::b>({element_of(q, joint_ - 1), mesh_.x[j - 1], x},
                                                                    {element_of(rate, joint_ - 1), 0, x_rate},
                                                                    mesh_.weights[j - 1], left_table_, left),
                         moving_equations<double, D, MovingEnds::a>({element_of(q, joint_), x, mesh_.x[j + 1]},
                                                                    {element_of(rate, joint_), x_rate, 0},
                                                                    mesh_.weights[j], right_table_, right)};
  if (model_.masses.present()) {
    const ChainView<D> beam = view(q, rate);
    model_.masses.add_to(beam, joint_ - 1, gravity(t), at_joint.left);
    model_.masses.add_to(beam, joint_, gravity(t), at_joint.right);
  }
  return at_joint;
}

template <int D>
void BeamSystem<D>::impose(Eigen::VectorXd& y, double t) const {
  if (!model_.driven()) return;
  const auto points = driven_points(t);
  for (const std::size_t end : {0, 1}) {
    if (!(end == 0 ? model_.start_motion : model_.end_motion)) continue;
    const Support<D>& support = end == 0 ? model_.start : model_.end;
    const int node = end == 0 ? 0 : mesh_.last();
    auto set = [&](auto part, const Vector& value) {
      const auto& free = support.free_position;
      part = support.out_of_frame(
          (support.into_frame(part).array() * free + support.into_frame(value).array() * (1 - free)).matrix());
    };
    set(position<D>(y.data(), node), anchors_[end].template head<D>() + points[end].value);
    set(position<D>(y.data() + coordinates_, node), points[end].rate);
  }
}

template <int D>
void BeamSystem<D>::sample(const Eigen::VectorXd& y, double t) {
  if (!on_sample) return;
  if (!model_.driven()) return on_sample(y, t);
  Eigen::VectorXd exact = y;
  impose(exact, t);
  on_sample(exact, t);
}

template <int D>
std::array<double*, 4> BeamSystem<D>::vectors_of(double* q, int k) const {
  double* first = q + Eigen::Index{node_size<D>} * k;
  return {first, k == joint_ ? q + behind_ : first + D, first + 2 * D, first + 3 * D};
}

/// M a = F with some accelerations a_s given: the others follow from M a = F - M a_s, and what holds a_s is M a - F.
/// Only the element at a support couples a_s to anything.
template <int D>
class BeamSystem<D>::Pull {
 public:
  /// Takes the inertia of the given accelerations from the forces. `at_joint` is null without a joint.
  Pull(const BeamSystem& system, const JointElements* at_joint, double* force, double t)
      : system_(&system), points_(system.driven_points(t)) {
    for (const int end : {0, 1}) ends_[static_cast<std::size_t>(end)] = end_element(end, at_joint);
    for (End& end : ends_) end.force = Eigen::Map<const Vector>(system_->vectors_of(force, end.element)[end.held]);
    for (std::size_t e = 0; e < 2; ++e) {
      const End& end = ends_[e];
      const auto parts = system_->vectors_of(force, end.element);
      for (std::size_t i = 0; i < 4; ++i) {
        Eigen::Map<Vector>(parts[i]) -= end.mass[i][end.held] * points_[e].acceleration;
      }
      if (at_joint != nullptr) force[system_->nodal_] -= end.by_joint[end.held].dot(points_[e].acceleration);
    }
  }

  /// Completes the accelerations `a`.
  void complete(double* a) const {
    for (std::size_t e = 0; e < 2; ++e) {
      Eigen::Map<Vector>(system_->vectors_of(a, ends_[e].element)[ends_[e].held]) += points_[e].acceleration;
    }
  }

  /// `on_rider` acts on the rider, whose shape functions are `s`, and its opposite on the beam.
  void add_rider(const Vector& on_rider, const std::array<double, 4>& s) {
    for (End& end : ends_) {
      if (end.element == system_->rider_->element) end.force -= s[end.held] * on_rider;
    }
  }

  /// Power of the supports at the accelerations `a` [W].
  double power(double* a) const {
    double sum = 0;
    for (std::size_t e = 0; e < 2; ++e) {
      const End& end = ends_[e];
      const auto parts = system_->vectors_of(a, end.element);
      Vector reaction = -end.force;
      if (system_->has_joint()) reaction += end.by_joint[end.held] * a[system_->nodal_];
      for (std::size_t i = 0; i < 4; ++i) reaction += end.mass[end.held][i] * Eigen::Map<const Vector>(parts[i]);
      sum += reaction.dot(points_[e].rate);
    }
    return sum;
  }

 private:
  /// The element at a support, by its mass matrix (order r_A, s_A, r_B, s_B) and its coupling to x_i.
  struct End {
    int element = 0;
    std::size_t held = 0;                         ///< row of the support's point
    std::array<std::array<double, 4>, 4> mass{};  ///< [kg m^k]
    std::array<Vector, 4> by_joint;               ///< zero away from the joint
    Vector force;                                 ///< on the support's point
  };

  End end_element(int end, const JointElements* at_joint) const {
    End result;
    result.element = end == 0 ? 0 : system_->mesh_.elements() - 1;
    result.held = end == 0 ? 0 : 2;
    result.by_joint.fill(Vector::Zero());
    if (system_->has_joint() && result.element + 1 == system_->joint_) {
      result.mass = at_joint->left.mass;
      result.by_joint = at_joint->left.mass_b;
    } else if (system_->has_joint() && result.element == system_->joint_) {
      result.mass = at_joint->right.mass;
      result.by_joint = at_joint->right.mass_a;
    } else {
      result.mass = system_->end_inertia_[static_cast<std::size_t>(end)].mass;
      for (auto& row : result.mass) {
        for (double& entry : row) entry *= system_->model_.section.rhoA;
      }
      add_point_masses(system_->model_.masses.points, system_->mesh_, result.element, result.mass);
    }
    return result;
  }

  const BeamSystem* system_;
  std::array<DrivenPoint<D>, 2> points_;
  std::array<End, 2> ends_;
};

template <int D>
std::optional<typename BeamSystem<D>::Pull> BeamSystem<D>::solve_apart(double t, double* force) const {
  std::optional<Pull> pull;
  if (model_.driven()) pull.emplace(*this, nullptr, force, t);
  solve_without_joint(*left_, *right_, force);
  if (pull) pull->complete(force);
  return pull;
}

template <int D>
double BeamSystem<D>::contact_force(const Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd exact = y;
  impose(exact, t);
  const double *q = exact.data(), *rate = q + coordinates_;
  const Vector on_beam = beam_gravity(t);
  Eigen::VectorXd a = Eigen::VectorXd::Zero(coordinates_);
  left_->add_forces(q, rate, on_beam, a.data());
  right_->add_forces(q, rate, on_beam, a.data());
  model_.loads.add_forces(view(q, rate), t, a.data());
  model_.masses.add_weight(view(q, rate), gravity(t), a.data());
  solve_apart(t, a.data());
  const auto solved = solve_rider(rider_motion(q, rate), gravity(t), a.data());
  return solved ? solved->contact : 0;
}

template <int D>
void BeamSystem<D>::rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) {
  ++rhs_evaluations_;
  const bool driven = model_.driven();
  if (driven) {
    imposed_ = y;
    impose(imposed_, t);
  }
  const double* q = driven ? imposed_.data() : y.data();
  const double* rate = q + coordinates_;
  dydt.head(coordinates_) = Eigen::Map<const Eigen::VectorXd>(rate, coordinates_);
  dydt.tail(dydt.size() - coordinates_).setZero();
  double* force = dydt.data() + coordinates_;
  const Vector g = gravity(t), on_beam = beam_gravity(t);
  Tally power;
  power.dissipated = left_->add_forces(q, rate, on_beam, force) + right_->add_forces(q, rate, on_beam, force);
  if (model_.loads.present()) {
    const ChainView<D> beam = view(q, rate);
    power.loads = model_.loads.add_forces(beam, t, force) + line_power(beam, t);
  }
  if (model_.masses.present()) model_.masses.add_weight(view(q, rate), g, force);
  std::optional<Pull> pull;  // of moving supports

  if (has_joint()) {
    const JointElements at_joint = joint_elements(q, rate, t);
    const auto &before = at_joint.left, &behind = at_joint.right;
    position<D>(force, joint_ - 1) += before.force[0];
    slope<D>(force, joint_ - 1) += before.force[1];
    position<D>(force, joint_) += before.force[2] + behind.force[0] + model_.joint->mass * g;
    if (kinked()) {
      slope<D>(force, joint_) += before.force[3];
      Eigen::Map<Vector>(force + behind_) += behind.force[1];
    } else {
      slope<D>(force, joint_) += before.force[3] + behind.force[1];
    }
    position<D>(force, joint_ + 1) += behind.force[2];
    slope<D>(force, joint_ + 1) += behind.force[3];
    force[nodal_] += before.force_b + behind.force_a;
    power.dissipated += before.dissipation + behind.dissipation;
    if (driven) pull.emplace(*this, &at_joint, force, t);
    const auto friction = solve_with_joint(*left_, *right_, before, behind, *model_.joint, joint_motion(q, rate, t),
                                           held_joint(), force, force + nodal_);
    if (!friction) {
      dydt.setConstant(std::numeric_limits<double>::quiet_NaN());  // outside the domain: the step is repeated, shorter
      return;
    }
    power.dissipated += *friction;
    if (driven) pull->complete(force);
  } else {
    pull = solve_apart(t, force);
    if (rider_) {
      const auto at = rider_motion(q, rate);
      const auto solved = solve_rider(at, g, force);
      if (!solved) {
        dydt.setConstant(std::numeric_limits<double>::quiet_NaN());
        return;
      }
      force[nodal_] = solved->x;
      power.dissipated += solved->dissipation;
      if (driven) pull->add_rider(solved->force, at.s);
    }
    if (free_mass_) dydt.segment<D>(coordinates_ + nodal_) = g;
  }
  if (spin_) {
    if (!spin_->accelerate(q + nodal_, rate + nodal_, t, force + nodal_, power.dissipated)) {
      dydt.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    if (model_.spin->supplied()) power = power + spin_->power(q + nodal_, rate + nodal_, force + nodal_, t);
  }
  if (driven) power.supports = pull->power(force);
  model_.tallies().add(power, dydt);
}

template <int D>
SecondOrderSystem* BeamSystem<D>::second_order() {
  if (!implicit_) implicit_ = std::make_unique<ImplicitBeam<D>>(*this);
  return implicit_.get();
}

template <int D>
std::unique_ptr<SecondOrderSystem> BeamSystem<D>::new_second_order() {
  return std::make_unique<ImplicitBeam<D>>(*this);
}

template <int D>
OuterForces<D> BeamSystem<D>::forces(const Eigen::VectorXd& y, double t) {
  second_order();
  const std::size_t evaluations = rhs_evaluations_;  // those of the integrator
  const OuterForces<D> forces = implicit_->forces(y, t);
  rhs_evaluations_ = evaluations;
  return forces;
}

template <int D>
OuterForces<D> BeamSystem<D>::forces_at_rest(const Eigen::VectorXd& y, double t) {
  second_order();
  return implicit_->forces_at_rest(y, t);
}

template <int D>
void BeamSystem<D>::observe_elements(const ChainState<D>& chain, int first, int last, double t, int points,
                                     Observation<D>& seen) const {
  const Observer<D> observer(model_.section, gravity(t), points);
  for (int k = first; k < last; ++k) {
    const bool at_joint = chain.joint != no_joint && (k == chain.joint || k + 1 == chain.joint);
    const MovingKinematics<double, D> element(chain.coordinates(k), chain.rates(k),
                                              at_joint ? model_.transport : WeightTransport::frozen,
                                              chain.mesh.weights[static_cast<std::size_t>(k)]);
    if (chain.curved_at_rest()) {
      const NodalCubic<double, D> rest = chain.rest_nodes(k);
      observer.add(element, &rest, seen);
    } else {
      observer.add(element, nullptr, seen);
    }
  }
  for (const PointMass& point : model_.masses.points) {
    const int k = chain.mesh.element_at(point.x);
    if (k < first || k >= last) continue;
    const auto at = motion_at(chain, k, point.x, model_.transport);
    seen.add_mass(point.mass, at.r, at.v, gravity(t));
  }
}

template <int D>
double BeamSystem<D>::line_power(const ChainView<D>& beam, double t) const {
  if (!model_.loads.line_force) return 0;
  const Eigen::Index shift = beam.cut ? node_size<D> : 0;
  const double rhoA = model_.section.rhoA;
  Vector sum = (left_->first_moment(beam.rate) + right_->first_moment(beam.rate + shift)) / rhoA;
  if (has_joint()) {
    for (const int k : {joint_ - 1, joint_}) {
      const bool reshaped = model_.transport == WeightTransport::transported && beam.weights(k).w != unit_weights;
      sum += swept(beam.kinematics(k), k < joint_ ? left_table_ : right_table_, reshaped, model_.formulation);
    }
  }
  return model_.loads.line_force(t).dot(sum);
}

template <int D>
Observation<D> BeamSystem<D>::observe(const Eigen::VectorXd& y, double t, int points, bool strains) const {
  Observation<D> seen;
  if (strains) seen.extremes.emplace();
  observe_elements(chain(y), 0, mesh_.elements(), t, points, seen);
  if (const auto mass = mass_motion(y)) {
    seen.add_mass(model_.joint->mass, mass->r, mass->v, gravity(t));
  }
  if (spin_) {
    const Spin::Seen turning = spin_->observe(y.data() + nodal_, y.data() + coordinates_ + nodal_, points);
    seen.energy.kinetic += turning.kinetic;
    seen.energy.torsion += turning.torsion;
    seen.spin_momentum += turning.momentum;
  }
  const Tally counted = model_.tallies().of(y);
  seen.energy.dissipated = counted.dissipated;
  seen.load_work = counted.loads;
  seen.end_work = counted.ends;
  seen.energy.supplied = counted.supports;
  seen.energy.supplied += ramp_.until(t, {seen.mass_moment, seen.momentum});
  return seen;
}

template class BeamSystem<2>;
template class BeamSystem<3>;

}  // namespace vlbeam
