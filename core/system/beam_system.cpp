#include "core/system/beam_system.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/length_control/chain_motion.hpp"
#include "core/system/implicit_beam.hpp"
#include "core/system/prescribed_motion.hpp"

namespace vlbeam {
template <int D>
BeamSystem<D>::BeamSystem(const BeamModel<D>& model, const ChainState<D>& chain) : model_(model) {
  if (model.travels()) moving_.emplace(model_, chain.mesh.weights);
  if (model.spin) {
    check_drives(model.spin->drives, chain.mesh.last());
    std::vector<Prescribed> marks;
    if (moving_) marks = moving_->marks();
    for (std::size_t k = marks.size(); k < chain.mesh.x.size(); ++k) marks.push_back({chain.mesh.x[k], 0, 0});
    spin_.emplace(model.spin.value(), std::move(marks), model.formulation, model.quadrature_points);
  }
  if (model.driven() && !model.joints.empty() && model.length_control.velocities == VelocityTransfer::conservative) {
    throw ModelError("velocities at events", "\"conservative\"",
                     "moving supports need \"nodal\" or \"projected\": they give energy and momentum away");
  }
  std::ranges::sort(model_.masses.points, {}, &PointMass::x);
  if (model_.loads.present()) acting_.push_back(std::make_shared<ActingLoads<D>>(model_.loads));
  if (model_.drag.present()) acting_.push_back(std::make_shared<ActingDrag<D>>(model_.drag));
  if (model_.masses.present()) acting_.push_back(std::make_shared<ActingPointMasses<D>>(model_.masses));
  acting_.insert(acting_.end(), model_.parts.begin(), model_.parts.end());
  adopt(chain);
  initial_ = state_of(chain, {});
  if (spin_) spin_->start(initial_.data() + angles(), initial_.data() + coordinates() + angles());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (joint(i).pitch == 0) continue;
    const double x = initial_[places_[i].mark];
    nut_.emplace(joint(i).pitch, x,
                 spin_->section(initial_.data() + angles(), initial_.data() + coordinates() + angles(), x).at.angle);
  }
  held_.anchor(initial_.data());
  tie_blocks(initial_.data());
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
  if (model_.frames) take_frames(chain);
  departed_.clear();
  for (const auto& mass : chain.departed) departed_.push_back(mass.index);
  passed_.resize(model_.joints.size(), -1);
  for (const auto& joint : chain.joints) {  // later on it is passages that count
    int& passed = passed_[static_cast<std::size_t>(joint.index)];
    if (passed >= 0) continue;
    const double x = mesh_.x[static_cast<std::size_t>(joint.node)];
    passed = static_cast<int>(std::ranges::count_if(model_.masses.points, [x](auto& point) { return point.x < x; }));
  }
  if (chain.rider) passed_.front() = -1;
  layout_ = {.nodes = static_cast<int>(mesh_.x.size()),
             .marks = chain.rider ? 1 : static_cast<int>(chain.joints.size()),
             .departed = static_cast<int>(departed_.size()),
             .turning = spin_     ? spin_->coordinates()
                        : frames_ ? frames_->coordinates()
                                  : 0,
             .tallies = model_.tallies()};
  places_.clear();
  index_.clear();
  touches_.clear();
  for (const auto& joint : chain.joints) {
    places_.push_back({.node = joint.node,
                       .mark = layout_.mark(static_cast<int>(places_.size())),
                       .passed = passed_[static_cast<std::size_t>(joint.index)]});
    index_.push_back(joint.index);
    touches_.push_back(joint.touches);
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!joint(i).law.kinked()) continue;
    places_[i].behind = layout_.kink(layout_.kinks++);
  }
  held_.adopt(model_, mesh_.last(), places_, index_, frames_ ? layout_.angle() : -1);
  if (frames_) {
    if constexpr (D == 3) frames_->let_slide(places_, layout_.angle(), model_.rest.get(), rest_triads_);
    std::vector<bool> held(mesh_.x.size(), false);
    for (const HeldNode<D>& node : held_.nodes()) held[static_cast<std::size_t>(node.node)] = node.holds_angle();
    frames_->hold(held);
  }
  const BeamSection section = model_.axis_section();
  const BeamRule rule = beam_rule(model_.quadrature_points, model_.axial_strain);
  const int middle = mesh_.elements() / 2;
  const int left_open = moving_ ? 0 : has_joint() ? std::max(0, places_.front().node - 1) : middle;
  const int right_open = moving_       ? mesh_.last()
                         : has_joint() ? std::min(mesh_.last(), places_.back().node + 1)
                                       : middle;
  const double* rest = rest_.empty() ? nullptr : rest_.data();
  left_.emplace(mesh_, 0, left_open, model_.start, section, rule, rest, model_.masses.points);
  right_.emplace(mesh_, mesh_.last(), right_open, model_.end, section, rule, rest, model_.masses.points);
  between_.clear();
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    const int low = places_[i].node + 1, high = places_[i + 1].node - 1;
    if (low <= high) between_.emplace_back(mesh_, low, high, section, rule, rest, model_.masses.points);
  }
  if (model_.driven()) {
    for (const std::size_t end : {0, 1}) {
      const std::size_t k = end == 0 ? 0 : static_cast<std::size_t>(mesh_.elements()) - 1;
      end_inertia_[end] = fixed_inertia(mesh_.x[k + 1] - mesh_.x[k], mesh_.weights[k].w, rule);
    }
  }
  parts_.clear();
  const auto joint_at = [&](int node) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].node == node) return static_cast<int>(i);
    }
    return -1;
  };
  for (int k = 0; (has_joint() || moving_) && k < mesh_.elements(); ++k) {
    const int a = joint_at(k), b = joint_at(k + 1);
    if (a < 0 && b < 0 && !moving_) continue;
    const MovingEnds ends = moving_ || (a >= 0 && b >= 0) ? MovingEnds::both : a < 0 ? MovingEnds::b : MovingEnds::a;
    parts_.push_back({k, ends, a, b, ShapeTabulation(rule, mesh_.weights[static_cast<std::size_t>(k)].w)});
  }
  elements_.reserve(parts_.size());
  motions_.reserve(places_.size());
  if (chained()) {
    std::vector<typename JointChain<D>::Joint> joints;
    for (std::size_t i = 0; i < places_.size(); ++i) joints.push_back({&joint(i).law, held(i), places_[i]});
    joint_chain_.layout(*left_, *right_, between_, parts_, std::move(joints));
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
  find_resting();
}

template <int D>
void BeamSystem<D>::set_end_limits() {
  const auto& control = model_.length_control;
  end_limit_ = {0, 0};
  cut_limit_ = std::numeric_limits<double>::infinity();
  if (!control.enabled || control.end_merge == 0) return;
  if (rider_) cut_limit_ = control.end_cut() * std::min(control.standard_length, rider_->curve.length);
  if (!has_joint()) return;
  const int node = places_.front().node;
  const auto j = static_cast<std::size_t>(node);
  const double unit = std::min(control.standard_length, (mesh_.x[j + 1] - mesh_.x[j - 1]) / 2);
  const auto limit = [&](double length) {  // an element that is shorter from the start has to halve first
    const double due = control.end_merge * unit;
    return length > due ? due : length / 2;
  };
  if (node + 1 == mesh_.last()) end_limit_[0] = limit(mesh_.x[j + 1] - mesh_.x[j]);
  if (node == 1) end_limit_[1] = limit(mesh_.x[j] - mesh_.x[j - 1]);
}

template <int D>
JointMotion<D> BeamSystem<D>::joint_motion(std::size_t which, const double* q, const double* rate, double t) const {
  const auto guide = guided(which, t);
  return {joint_slopes(which, q), joint_slopes(which, rate), rate[places_[which].mark], gravity(t),
          guide ? std::optional(guide->acceleration) : std::nullopt};
}

template <int D>
ConstraintResidual BeamSystem<D>::slope_residual(const Eigen::VectorXd& y) const {
  ConstraintResidual largest;
  for (std::size_t j = 0; j < places_.size(); ++j) {
    if (places_[j].behind < 0) continue;
    const auto slopes = joint_slopes(j, y.data()), rates = joint_slopes(j, y.data() + coordinates());
    const SlopeConditions<D> conditions(joint(j).law.slopes, longest_axis<D>(slopes.template head<D>()));
    for (int i = 0; i < conditions.count(); ++i) {
      largest.position = std::max(largest.position, std::abs(conditions.value(i, slopes)));
      largest.velocity = std::max(largest.velocity, std::abs(conditions.rate(i, slopes, rates)));
    }
  }
  return largest;
}

template <int D>
std::optional<RestElement<D>> BeamSystem<D>::rest_of(const MovingPart& part, const double* q) const {
  if (!model_.rest) return std::nullopt;
  const auto end = [&](int node, int joint) -> RestEnd<D> {
    if (moving_) {
      const double x = moving_->marks()[static_cast<std::size_t>(node)].value;
      return {x, model_.rest->derivatives(x)};
    }
    if (joint >= 0) {
      const double x = q[places_[static_cast<std::size_t>(joint)].mark];
      return {x, model_.rest->derivatives(x)};
    }
    return {mesh_.x[static_cast<std::size_t>(node)],
            {position<D>(rest_.data(), node), slope<D>(rest_.data(), node), Vector::Zero(), Vector::Zero()}};
  };
  return RestElement<D>{end(part.element, part.a), end(part.element + 1, part.b)};
}

template <int D>
void BeamSystem<D>::fill_elements(const double* q, const double* rate, double t, JointElements& elements) const {
  elements.clear();
  const ChainView<D> beam = view(q, rate);
  MovingLaw<D> law = moving_law(t);
  for (const MovingPart& part : parts_) {
    const int k = part.element;
    const auto rest = rest_of(part, q);
    law.rest = rest ? &*rest : nullptr;
    const auto at = beam.coordinates(k), rates = beam.rates(k);
    const WeightFunction& weights = beam.weights(k);
    switch (part.ends) {
      case MovingEnds::a:
        elements.push_back(moving_equations<double, D, MovingEnds::a>(at, rates, weights, part.table, law));
        break;
      case MovingEnds::b:
        elements.push_back(moving_equations<double, D, MovingEnds::b>(at, rates, weights, part.table, law));
        break;
      case MovingEnds::both:
        elements.push_back(moving_equations<double, D, MovingEnds::both>(at, rates, weights, part.table, law));
        break;
    }
    if (model_.masses.present()) model_.masses.add_to(beam, k, gravity(t), elements.back());
  }
  if (moving_) moving_->take_inertia(beam, parts_, elements);
}

template <int D>
std::optional<JointPower> BeamSystem<D>::solve_joints(const JointElements& elements,
                                                      const std::vector<JointMotion<D>>& motions, double* force) const {
  if (chained()) return joint_chain_.solve(elements, motions, force);
  const auto lost = solve_with_joint(*left_, *right_, elements[0], elements[1], joint(0).law, motions[0], held(0),
                                     force, force + places_[0].mark);
  return lost ? std::optional(JointPower{.dissipated = *lost}) : std::nullopt;
}

template <int D>
void BeamSystem<D>::impose(Eigen::VectorXd& y, double t) const {
  if (const auto which = nut_place()) {
    const Eigen::Index mark = places_[*which].mark;
    const Nut::Place place = nut_->place(*spin_, y.data() + angles(), y.data() + coordinates() + angles(), y[mark]);
    y[mark] = place.x;
    y[coordinates() + mark] = place.rate;
  }
  if (!model_.driven()) return;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto guide = guided(i, t);
    if (!guide) continue;
    y[places_[i].mark] = guide->value;
    y[coordinates() + places_[i].mark] = guide->rate;
  }
  held_.impose(t, y.data(), y.data() + coordinates());
}

template <int D>
void BeamSystem<D>::orient(double t) const {
  if (!model_.turns()) return;
  const auto& held = held_.at(t);
  left_->stand_by(held[0].support);
  right_->stand_by(held[1].support);
  if (rider_) rider_->mass.update(*left_, *right_);
}

template <int D>
void BeamSystem<D>::sample(const Eigen::VectorXd& y, double t) {
  if (!on_sample) return;
  if (!imposes()) return on_sample(y, t);
  Eigen::VectorXd exact = y;
  impose(exact, t);
  on_sample(exact, t);
}

template <int D>
std::array<double*, 4> BeamSystem<D>::vectors_of(double* q, int k) const {
  double* first = q + Eigen::Index{node_size<D>} * k;
  const JointPlace* const joint = view(q, q).joint_at(k);
  return {first, joint != nullptr && joint->behind >= 0 ? q + joint->behind : first + D, first + 2 * D, first + 3 * D};
}

template <int D>
std::optional<typename BeamSystem<D>::PrescribedMotion> BeamSystem<D>::solve_apart(const double* q, const double* rate,
                                                                                   double t, double* force) const {
  std::optional<PrescribedMotion> pull;
  if (model_.driven()) pull.emplace(*this, JointElements{}, q, rate, force, t);
  solve_without_joint(*left_, *right_, force);
  if (pull) pull->complete(force);
  return pull;
}

template <int D>
Tally BeamSystem<D>::add_forces(const double* q, const double* rate, double t, double* force,
                                JointElements& elements) const {
  const Vector g = gravity(t), on_beam = beam_gravity(t);
  Tally power;
  power.dissipated = left_->add_forces(q, rate, on_beam, force) + right_->add_forces(q, rate, on_beam, force);
  for (const SpanBetween<D>& span : between_) power.dissipated += span.span().add_forces(q, rate, on_beam, force);
  const Motion<D> now = motion(q, rate, nullptr, t);
  for (const auto& part : acting_) power = power + part->add_force(now, force);
  if (model_.loads.present() && !moving_) {  // else flow_power() counts it
    power.loads += line_power(now.beam, t);
    power.supports += fed_line_power(now.beam, t);
  }
  if (parts_.empty()) return power;
  fill_elements(q, rate, t, elements);
  double lost = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const MovingPart& part = parts_[p];
    const auto& eq = elements[p];
    const auto at = vectors_of(force, part.element);
    for (std::size_t i = 0; i < 4; ++i) Eigen::Map<Vector>(at[i]) += eq.force[i];
    if (part.a >= 0) force[places_[static_cast<std::size_t>(part.a)].mark] += eq.force_a;
    if (part.b >= 0) force[places_[static_cast<std::size_t>(part.b)].mark] += eq.force_b;
    lost += eq.dissipation;
  }
  power.dissipated += lost;
  for (std::size_t i = 0; i < places_.size(); ++i) position<D>(force, places_[i].node) += joint(i).law.mass * g;
  if (moving_) moving_->add_inflow(view(q, rate), force);
  return power;
}

template <int D>
double BeamSystem<D>::contact_force(const Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd exact = y;
  impose(exact, t);
  orient(t);
  const double *q = exact.data(), *rate = q + coordinates();
  Eigen::VectorXd a = Eigen::VectorXd::Zero(coordinates());
  JointElements none;
  add_forces(q, rate, t, a.data(), none);
  solve_apart(q, rate, t, a.data());
  const auto solved = solve_rider(rider_motion(q, rate), gravity(t), a.data());
  return solved ? solved->contact : 0;
}

template <int D>
void BeamSystem<D>::rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) {
  ++rhs_evaluations_;
  const bool driven = model_.driven();
  if (imposes()) {
    imposed_ = y;
    impose(imposed_, t);
    orient(t);
  }
  const double* q = imposes() ? imposed_.data() : y.data();
  const double* rate = q + coordinates();
  dydt.head(coordinates()) = Eigen::Map<const Eigen::VectorXd>(rate, coordinates());
  dydt.tail(dydt.size() - coordinates()).setZero();
  double* force = dydt.data() + coordinates();
  const auto invalid = [&dydt] {  // outside the domain: the step is repeated, shorter
    dydt.setConstant(std::numeric_limits<double>::quiet_NaN());
  };
  if (!travel(t)) return invalid();
  Tally power = add_forces(q, rate, t, force, elements_);
  if (frames_) frames_->solve_spins(q, rate, force);
  std::optional<PrescribedMotion> pull;  // of moving supports
  const Eigen::Index angles = this->angles();
  if (spin_ && !spin_->accelerate(q + angles, rate + angles, t, force + angles, power.dissipated)) return invalid();

  const auto nut = nut_place();
  if (moving_) {
    if (driven) pull.emplace(*this, elements_, q, rate, force, t);
    if (!moving_->solve(elements_, force)) return invalid();
    if (driven) pull->complete(force);
  } else if (has_joint()) {
    motions_.clear();
    for (std::size_t i = 0; i < places_.size(); ++i) {
      motions_.push_back(joint_motion(i, q, rate, t));
      if (frames_) motions_[i].x_inertia = frames_->mark_inertia(i, i);
    }
    if (nut) {
      const Eigen::Index mark = places_[*nut].mark;
      if (!nut_->couple(*spin_, q + angles, rate + angles, force + angles, q[mark], rate[mark])) return invalid();
      motions_[*nut].x_inertia = nut_->load().inertia;
      force[mark] += nut_->load().force;
    }
    if (driven) pull.emplace(*this, elements_, q, rate, force, t);
    const auto at_joints =
        frames_ && places_.size() > 1 ? solve_with_frames(force) : solve_joints(elements_, motions_, force);
    if (!at_joints) return invalid();
    power.dissipated += at_joints->dissipated;
    power.supports += at_joints->guided;
    if (driven) pull->complete(force);
  } else {
    pull = solve_apart(q, rate, t, force);
    if (rider_) {
      const auto at = rider_motion(q, rate);
      const auto solved = solve_rider(at, gravity(t), force);
      if (!solved) return invalid();
      force[layout_.mark()] = solved->x;
      power.dissipated += solved->dissipation;
      if (driven) pull->add_rider(solved->force, at.s);
    }
  }
  if (frames_) frames_->complete(q, rate, force);
  for (std::size_t i = 0; i < departed_.size(); ++i) dydt.segment<D>(coordinates() + departed_at(i)) = gravity(t);
  const Eigen::VectorXd* by_nut = nullptr;
  if (nut) by_nut = &nut_->torque(nut_->turn(force[places_[*nut].mark], force + angles));
  if (moving_) {
    power.loads = 0;
    if (model_.books_flow) power = power + flow_power(q, rate, force, t);
  } else if (spin_ && model_.spin->supplied()) {
    power = power + spin_->power(q + angles, rate + angles, force + angles, t, by_nut);
  }
  if (driven && !moving_) power.supports += pull->power(force);
  if (!links_.empty()) {
    const Eigen::VectorXd apart = Eigen::Map<const Eigen::VectorXd>(force, coordinates());
    const auto forces = press(links_, elements_, q, bending_in(rate), force);
    if (!forces) return invalid();
    link_forces_ = *forces;
    if (driven) {
      const Eigen::VectorXd change = Eigen::Map<const Eigen::VectorXd>(force, coordinates()) - apart;
      power.supports += work_of_prescribed(links_, *forces, elements_, q, rate, change);
    }
  }
  layout_.tallies.add(power, dydt);
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
void BeamSystem<D>::exchange(Memory& memory) {
  memory(rhs_evaluations_);
  ramp_.exchange(memory);
  if (frames_) frames_->exchange(memory);
  bool viewed = implicit_ != nullptr;
  memory(viewed);
  if (viewed) second_order()->exchange(memory);
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

template class BeamSystem<2>;
template class BeamSystem<3>;

}  // namespace vlbeam
