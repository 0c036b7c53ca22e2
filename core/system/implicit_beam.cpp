#include "core/system/implicit_beam.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/element/active.hpp"
#include "core/element/moving_tangent.hpp"
#include "core/error.hpp"
#include "core/geometry/dense.hpp"

namespace vlbeam {
template <int D>
double ImplicitBeam<D>::Constraint::value(const double* q, const DrivenPoints& driven) const {
  const Eigen::Map<const NodeVector> here(q + Eigen::Index{B} * node), next(q + Eigen::Index{B} * (node + 1));
  if (tied) return direction.dot(here - next);
  const double off = direction.dot(here - anchor);
  return end < 0 ? off : off - direction.template head<D>().dot(driven[static_cast<std::size_t>(end)].value);
}

template <int D>
double ImplicitBeam<D>::Constraint::rate(const double* q, const double* v, const DrivenPoints& driven) const {
  const Eigen::Map<const NodeVector> here(v + Eigen::Index{B} * node), next(v + Eigen::Index{B} * (node + 1));
  if (tied) return direction.dot(here - next);
  const double off = direction.dot(here);
  if (end < 0) return off;
  const DrivenPoint<D>& by = driven[static_cast<std::size_t>(end)];
  if (slope >= 0) return off - direction.template tail<D>().dot(by.slope_rate(vlbeam::slope<D>(q, node)));
  return off - direction.template head<D>().dot(by.rate);
}

template <int D>
void ImplicitBeam<D>::update_supports(double t) const {
  refresh();
  if (!system_.model().turns()) return;
  const auto driven = system_.driven_points(t);
  standing_ = system_.supports(driven);
  for (Constraint& constraint : constraints_) {
    if (constraint.end < 0 || constraint.end > 1 || constraint.slope < 0) continue;
    const auto end = static_cast<std::size_t>(constraint.end);
    constraint.direction.template tail<D>() = standing_[end].frame.col(constraint.slope);
    constraint.anchor.template tail<D>() = driven[end].turned(system_.anchors()[end].template tail<D>());
  }
}

template <int D>
const typename ImplicitBeam<D>::DrivenPoints& ImplicitBeam<D>::driven_points(double t) const {
  const auto ends = system_.driven_points(t);
  driven_points_.assign(ends.begin(), ends.end());
  for (std::size_t i = 0; i < places().size(); ++i) {
    driven_points_.push_back(system_.driven_joint(i, t).value_or(DrivenPoint<D>{}));
  }
  return driven_points_;
}

template <int D>
void ImplicitBeam<D>::rebuild() const {
  revision_ = system_.revision();
  constraints_.clear();
  const auto old_conditions = std::move(slope_conditions_);
  slope_conditions_.clear();
  places_ = system_.places();
  layout_ = system_.layout();
  layout_.kinks = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    places_[i].behind = -1;
    places_[i].cut = (with_multipliers() && !system_.feeds(i)) || system_.kinked(i);
    layout_.nodes += places_[i].cut ? 1 : 0;
  }
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].mark = layout_.mark(static_cast<int>(i));
  reference_mass_ = system_.model().section.rhoA * system_.mesh().length() / system_.mesh().elements();
  contacts_ = system_.resting();
  if (with_multipliers()) constrain(old_conditions);
  layout_.multipliers = static_cast<Eigen::Index>(constraints_.size() + contacts_.size()) + condition_count();
}

template <int D>
void ImplicitBeam<D>::constrain(const std::vector<Conditions>& old_conditions) const {
  at_held_nodes([&](int node, const Support<D>& support, int joint) {
    const bool at_inner_node = joint < 0 && node != 0 && node != nodes() - 1;  // of a beam whose nodes travel
    const int end = joint >= 0 ? 2 + joint : at_inner_node ? -1 : node == 0 ? 0 : 1;
    const bool twice = joint >= 0;
    const NodeVector anchor = joint >= 0 ? system_.joint_anchor(static_cast<std::size_t>(joint))
                              : at_inner_node
                                  ? NodeVector(system_.initial_state().template segment<B>(Eigen::Index{B} * node))
                                  : system_.anchors()[static_cast<std::size_t>(end)];
    for (int c = 0; c < D; ++c) {
      NodeVector direction = NodeVector::Zero();
      direction.template head<D>() = support.frame.col(c);
      if (support.free_position[c] == 0) constraints_.push_back({node, direction, anchor, end, false, twice});
      direction.template head<D>().setZero();
      direction.template tail<D>() = support.frame.col(c);
      if (support.free_slope[c] == 0) constraints_.push_back({node, direction, anchor, end, false, twice, c});
    }
  });
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!places_[i].cut) continue;
    for (int c = 0; c < (system_.kinked(i) ? D : B); ++c) {
      constraints_.push_back({first_copy(i), NodeVector::Unit(c), NodeVector::Zero(), -1, true});
    }
    if (!system_.kinked(i)) continue;
    Conditions& conditions = slope_conditions_.emplace_back(Conditions{i});
    if (slope_conditions_.size() <= old_conditions.size()) {
      conditions.omitted_axis = old_conditions[slope_conditions_.size() - 1].omitted_axis;
    }
    conditions.of = {system_.joint(i).law.slopes, conditions.omitted_axis};
  }
}

template <int D>
typename ImplicitBeam<D>::Slopes ImplicitBeam<D>::joint_slopes(std::size_t which, const double* q) const {
  const int node = first_copy(which);
  Slopes slopes;
  slopes << slope<D>(q, node), slope<D>(q, node + (places()[which].cut ? 1 : 0));
  return slopes;
}

/// In space the components of the cross product change over only where the slope has turned far away: they change the
/// multipliers' meaning.
template <int D>
auto ImplicitBeam<D>::slope_conditions(const double* q) const -> const std::vector<Conditions>& {
  for (Conditions& conditions : slope_conditions_) {
    if (D == 2 || conditions.of.count() == 0) continue;
    const Vec<double, D> before = slope<D>(q, first_copy(conditions.joint));
    if (std::abs(before[conditions.omitted_axis]) >= 0.4 * before.norm()) continue;
    conditions.omitted_axis = longest_axis<D>(before);
    conditions.of = {system_.joint(conditions.joint).law.slopes, conditions.omitted_axis};
  }
  return slope_conditions_;
}

template <int D>
std::vector<FieldRun> ImplicitBeam<D>::fields() const {
  std::vector<FieldRun> runs = layout().fields(system_.spin());
  Eigen::Index at = layout().multiplier();
  for (const auto& constraint : constraints_) {
    const bool place = !constraint.direction.template head<D>().isZero(0);
    runs.push_back({place ? Field::multiplier : Field::slope_multiplier, at++});
  }
  if (condition_count() > 0) runs.push_back({Field::slope_multiplier, at, condition_count()});
  at_contacts([&](const auto&, int, Eigen::Index multiplier) { runs.push_back({Field::multiplier, multiplier}); });
  return runs;
}

template <int D>
template <class Run, class Second>
void ImplicitBeam<D>::for_each_run(const Run& run, const Second& second) const {
  Eigen::Index own = 0, here = 0;
  const auto pass = [&](Eigen::Index count) {
    run(own, here, count);
    own += count;
    here += count;
  };
  for (std::size_t i = 0; i < places().size(); ++i) {
    const JointPlace& place = places()[i];
    if (!place.cut) continue;
    pass(Eigen::Index{B} * (place.node + 1) - own);
    second(own - B, here, system_.places()[i].behind);
    here += B;
  }
  pass(Eigen::Index{B} * (system_.mesh().last() + 1) - own + static_cast<Eigen::Index>(places().size()));
  own += Eigen::Index{D} * system_.layout().kinks;
  pass(system_.coordinates() - own);
}

template <int D>
void ImplicitBeam<D>::expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const {
  const Eigen::Index n = coordinates(), own = system_.coordinates();
  q.setZero(n);
  v.setZero(n);
  const auto copy = [&](Eigen::Index from, Eigen::Index to, Eigen::Index count) {
    q.segment(to, count) = y.segment(from, count);
    v.segment(to, count) = y.segment(own + from, count);
  };
  for_each_run(copy, [&](Eigen::Index node, Eigen::Index to, Eigen::Index behind) {
    copy(node, to, B);
    if (behind >= 0) copy(behind, to + D, D);
  });
}

template <int D>
void ImplicitBeam<D>::contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const {
  const Eigen::Index own = system_.coordinates();
  const auto copy = [&](Eigen::Index to, Eigen::Index from, Eigen::Index count) {
    y.segment(to, count) = q.segment(from, count);
    y.segment(own + to, count) = v.segment(from, count);
  };
  for_each_run(copy, [&](Eigen::Index /*node*/, Eigen::Index from, Eigen::Index behind) {
    if (behind >= 0) copy(behind, from + D, D);
  });
}

template <int D>
void ImplicitBeam<D>::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) {
  const Eigen::Index own = system_.coordinates();
  y_.setZero(system_.size());
  dydt_.resize(system_.size());
  contract(q, v, y_);
  system_.rhs(y_, dydt_, t);
  y_.head(own) = dydt_.segment(own, own);
  Eigen::VectorXd unused;
  expand(y_, a, unused);
  if (multipliers() == 0) return;
  a.tail(system_.resting_forces().size()) = -system_.resting_forces() / reference_mass_;
  update_supports(t);
  // what the equations of motion lack is what the constraints give: their directions are orthonormal, node by node
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const auto& constraint = constraints_[i];
    // what holds a joint holds both of its nodes; what ties them shows at the second
    const bool second = constraint.twice || constraint.tied;
    const auto lacks = [&](int node) {
      return constraint.direction.dot(Eigen::Map<const NodeVector>(free_.data() + Eigen::Index{B} * node));
    };
    const double lacking = (constraint.tied ? 0 : lacks(constraint.node)) + (second ? lacks(constraint.node + 1) : 0);
    a[a.size() - multipliers() + static_cast<Eigen::Index>(i)] = (constraint.tied ? 1 : -1) * lacking / reference_mass_;
  }
  Eigen::Index at = first_slope_multiplier();
  for (const Conditions& conditions : slope_conditions(q.data())) {
    const int count = conditions.of.count();
    const Slopes slopes = joint_slopes(conditions.joint, q.data());
    Eigen::MatrixXd gradients(2 * D, count);
    for (int i = 0; i < count; ++i) gradients.col(i) = conditions.of.gradient(i, slopes);
    a.segment(at, count) = -solve_symmetric(gradients.transpose() * gradients,
                                            gradients.transpose() * joint_slopes(conditions.joint, free_.data())) /
                           reference_mass_;
    at += count;
  }
}

template <int D>
template <class Function>
void ImplicitBeam<D>::at_end_nodes(const Function& function) const {
  function(0, standing_[0], -1);
  function(nodes() - 1, standing_[1], -1);
}

template <int D>
template <class Function>
void ImplicitBeam<D>::at_held_nodes(const Function& function) const {
  at_end_nodes(function);
  for (const auto& [node, support] : system_.model().held_nodes) function(node, support, -1);
  for (std::size_t i = 0; i < places().size(); ++i) {
    if (const Support<D>* held = system_.held(i)) function(first_copy(i), *held, static_cast<int>(i));
  }
}

template <int D>
void ImplicitBeam<D>::project(double* nodes) const {
  at_held_nodes([&](int k, const Support<D>& support, int /*joint*/) {
    auto keep = [&](auto part, const typename Support<D>::Components& free) {
      part = support.out_of_frame((support.into_frame(part).array() * free).matrix());
    };
    keep(position<D>(nodes, k), support.free_position);
    keep(slope<D>(nodes, k), support.free_slope);
  });
}

template <int D>
double ImplicitBeam<D>::free_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                      double t, Eigen::VectorXd& r) const {
  const auto& model = system_.model();
  const Vec<double, D> gravity = system_.gravity(t), on_beam = system_.beam_gravity(t);
  r.setZero();
  double dissipation = 0;
  at_spans([&](const Span<D>& span, int copies) {
    const Eigen::Index shift = Eigen::Index{B} * copies;
    dissipation += span.add_forces(q.data() + shift, v.data() + shift, on_beam, r.data() + shift);
  });
  model.loads.add_forces(view(q, v), t, r.data());
  if (model.drag.present()) dissipation += model.drag.add_forces(view(q, v), r.data());
  const bool bears_masses = model.masses.present();
  if (bears_masses) model.masses.add_weight(view(q, v), gravity, r.data());
  r = -r;
  if (bears_masses) model.masses.add_residual(view(q, v), a.data(), gravity, r.data());
  at_spans([&](const Span<D>& span, int copies) {
    const Eigen::Index shift = Eigen::Index{B} * copies;
    span.add_inertia(a.data() + shift, r.data() + shift);
  });
  const Eigen::Index extra = after_nodes();
  if (system_.moving_mesh() != nullptr) {
    dissipation += system_.add_travelling_residual(q.data(), v.data(), a.data(), t, r.data());
  } else if (system_.has_joint()) {
    const ChainView<D> beam = view(q, v), accelerations = view(q, a);
    auto law = system_.moving_law(t);
    for (const MovingPart& part : system_.moving_parts()) {
      const auto rest = system_.rest_of(part, q.data(), places());
      law.rest = rest ? &*rest : nullptr;
      auto add = [&]<MovingEnds Ends>() {
        const int k = part.element, node = beam.first_node(k);
        const auto of = moving_residual<Ends, double, D>(beam.coordinates(k), beam.rates(k), accelerations.rates(k),
                                                         beam.weights(k), part.table, law, &dissipation);
        position<D>(r.data(), node) += of.nodes[0];
        slope<D>(r.data(), node) += of.nodes[1];
        position<D>(r.data(), node + 1) += of.nodes[2];
        slope<D>(r.data(), node + 1) += of.nodes[3];
        for (int e = 0; e < moving_ends<Ends>; ++e) {
          r[extra + (is_end_a<Ends>(e) ? part.a : part.b)] += of.ends[static_cast<std::size_t>(e)];
        }
      };
      with_ends(part.ends, add);
    }
    for (std::size_t i = 0; i < places().size(); ++i) {
      const SlidingJoint& joint = system_.joint(i).law;
      const int node = first_copy(i);
      const Vec<double, D> inertia = joint.mass * (position<D>(a.data(), node) - gravity);
      const Vec<double, D> pull = system_.held(i) == nullptr ? inertia : Vec<double, D>(-on_joint_node(i, r));
      position<D>(r.data(), node) += inertia;
      if (!joint.friction) continue;
      const Slopes slopes = joint_slopes(i, q.data());
      const Contact<double, D> contact(slopes.template head<D>(), slopes.template tail<D>(), joint.turns());
      const auto friction = friction_force<double, D>(*joint.friction, pull, contact, v[places()[i].mark]);
      r[places()[i].mark] -= friction.force;
      dissipation += friction.dissipation;
    }
  } else if (const auto& rider = system_.rider()) {
    const auto part =
        rider_residual<double, D>(system_.rider_motion(q.data(), v.data()), element_nodes<D>(a.data(), rider->element),
                                  a[extra], model.joints.front().law, gravity, rider->held);
    position<D>(r.data(), rider->element) += part.nodes[0];
    slope<D>(r.data(), rider->element) += part.nodes[1];
    position<D>(r.data(), rider->element + 1) += part.nodes[2];
    slope<D>(r.data(), rider->element + 1) += part.nodes[3];
    r[extra] = part.x;
    dissipation += part.dissipation;
  }
  at_contacts([&](const auto& contact, int node, Eigen::Index multiplier) {
    const Vec<double, D> pull = reference_mass_ * a[multiplier] / contact.distance * apart(node, q.data());
    position<D>(r.data(), node) -= pull;
    position<D>(r.data(), node + 1) += pull;
  });
  for (std::size_t i = 0; i < system_.departed().size(); ++i) {
    const Eigen::Index at = layout().departed_mass(static_cast<int>(i));
    const double mass = model.joints[static_cast<std::size_t>(system_.departed()[i])].law.mass;
    r.segment<D>(at) = mass * (a.segment<D>(at) - gravity);
  }
  if (Spin* spin = system_.spin()) {
    const Eigen::Index at = angles();
    dissipation += spin->residual(q.data() + at, v.data() + at, a.data() + at, t, r.data() + at);
  }
  return dissipation;
}

template <int D>
double ImplicitBeam<D>::residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                 Eigen::VectorXd& r) {
  system_.count_evaluation();
  update_supports(t);
  if (!system_.travel(t)) {
    r.setConstant(std::numeric_limits<double>::quiet_NaN());
    return 0;
  }
  const Eigen::Index first = layout().multiplier();
  const double dissipation = free_residual(q, v, a, t, r);
  if (!with_multipliers()) project(r.data());
  at_guides([&](std::size_t i) { r[places()[i].mark] = 0; });
  if (const auto nut = system_.nut_place()) {
    const Eigen::Index mark = places()[*nut].mark, at = angles();
    r.segment(at, system_.spin()->coordinates()) -= nut_torque(*nut, q, v, r[mark]);
    r[mark] = system_.nut().off(*system_.spin(), q.data() + at, v.data() + at, q[mark]);
  }
  if (const Spin* spin = system_.spin()) spin->drive(a.data() + angles(), t, r.data() + angles());
  const DrivenPoints& driven = driven_points(t);
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const auto& constraint = constraints_[i];
    const Eigen::Index at = first + static_cast<Eigen::Index>(i);
    const double multiplier = reference_mass_ * a[at];
    Eigen::Map<NodeVector> here(r.data() + Eigen::Index{B} * constraint.node),
        next(r.data() + Eigen::Index{B} * (constraint.node + 1));
    here += multiplier * constraint.direction;
    if (constraint.tied) next -= multiplier * constraint.direction;
    r[at] = constraint.value(q.data(), driven);
  }
  Eigen::Index at = first_slope_multiplier();
  for (const Conditions& conditions : slope_conditions(q.data())) {
    const Slopes slopes = joint_slopes(conditions.joint, q.data());
    const int node = first_copy(conditions.joint);
    for (int i = 0; i < conditions.of.count(); ++i, ++at) {
      const Slopes force = reference_mass_ * a[at] * conditions.of.gradient(i, slopes);
      slope<D>(r.data(), node) += force.template head<D>();
      slope<D>(r.data(), node + 1) += force.template tail<D>();
      r[at] = conditions.of.value(i, slopes);
    }
  }
  at_contacts([&](const auto& contact, int node, Eigen::Index multiplier) {
    r[multiplier] = contact.value(apart(node, q.data()));
  });
  return dissipation;
}

template <int D>
ConstraintResidual ImplicitBeam<D>::constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                        double t) const {
  update_supports(t);
  const DrivenPoints& driven = driven_points(t);
  ConstraintResidual largest;
  for (const auto& constraint : constraints_) {
    largest.position = std::max(largest.position, std::abs(constraint.value(q.data(), driven)));
    largest.velocity = std::max(largest.velocity, std::abs(constraint.rate(q.data(), v.data(), driven)));
  }
  for (const Conditions& conditions : slope_conditions_) {
    const Slopes slopes = joint_slopes(conditions.joint, q.data()), rates = joint_slopes(conditions.joint, v.data());
    for (int i = 0; i < conditions.of.count(); ++i) {
      largest.position = std::max(largest.position, std::abs(conditions.of.value(i, slopes)));
      largest.velocity = std::max(largest.velocity, std::abs(conditions.of.rate(i, slopes, rates)));
    }
  }
  at_contacts([&](const auto& contact, int node, Eigen::Index /*multiplier*/) {
    const Vec<double, D> line = apart(node, q.data());
    largest.position = std::max(largest.position, std::abs(contact.value(line)));
    largest.velocity = std::max(largest.velocity, std::abs(line.dot(apart(node, v.data())) / contact.distance));
  });
  return largest;
}

template <int D>
void ImplicitBeam<D>::constraint_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                       Eigen::VectorXd& rates) const {
  update_supports(t);
  const DrivenPoints& driven = driven_points(t);
  Eigen::Index at = rates.size() - multipliers();
  for (const auto& constraint : constraints_) rates[at++] = constraint.rate(q.data(), v.data(), driven);
  for (const Conditions& conditions : slope_conditions_) {
    const Slopes slopes = joint_slopes(conditions.joint, q.data()), change = joint_slopes(conditions.joint, v.data());
    for (int i = 0; i < conditions.of.count(); ++i) rates[at++] = conditions.of.rate(i, slopes, change);
  }
}

template <int D>
bool ImplicitBeam<D>::driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const {
  const bool guides = system_.model().guides();
  if (!system_.model().driven() || (with_multipliers() && !guides)) return false;
  offset.setZero(q.size());
  at_guides([&](std::size_t i) { offset[places()[i].mark] = q[places()[i].mark] - system_.guided(i, t)->value; });
  if (with_multipliers()) return true;
  update_supports(t);
  const auto points = system_.driven_points(t);
  at_end_nodes([&](int node, const Support<D>& support, int /*joint*/) {
    const std::size_t end = node == 0 ? 0 : 1;
    const Vec<double, D> off =
        position<D>(q.data(), node) - system_.anchors()[end].template head<D>() - points[end].value;
    position<D>(offset.data(), node) =
        support.out_of_frame((support.into_frame(off).array() * (1 - support.free_position)).matrix());
    if (!(end == 0 ? system_.model().start_motion : system_.model().end_motion).turns()) return;
    const Vec<double, D> turned = points[end].turned(system_.anchors()[end].template tail<D>());
    slope<D>(offset.data(), node) = DrivenPoint<D>::held(support, slope<D>(q.data(), node) - turned);
  });
  for (std::size_t i = 0; i < places().size(); ++i) {
    const auto point = system_.driven_joint(i, t);
    if (!point) continue;
    position<D>(offset.data(), first_copy(i)) =
        position<D>(q.data(), first_copy(i)) - system_.joint_anchor(i).template head<D>() - point->value;
  }
  return true;
}

template <int D>
Tally ImplicitBeam<D>::supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                      double t) {
  if (system_.moving_mesh() != nullptr) {
    // by the elements of the last residual, which Newton's last correction is next to nothing away from
    return system_.model().books_flow ? system_.flow_power(q.data(), v.data(), a.data(), t) : Tally{};
  }
  Tally power;
  const Loads<D>& loads = system_.model().loads;
  if (loads.present()) {
    free_.setZero(q.size());
    power.loads = loads.add_forces(view(q, v), t, free_.data()) + system_.line_power(view(q, v), t);
    power.supports += system_.fed_line_power(view(q, v), t);
  }
  if (Spin* spin = system_.spin(); spin != nullptr && spin->model().supplied()) {
    const Eigen::Index at = angles();
    Eigen::VectorXd by_nut;
    if (const auto nut = system_.nut_place()) {
      free_.resize(q.size());
      free_residual(q, v, a, t, free_);
      by_nut = nut_torque(*nut, q, v, free_[places()[*nut].mark]);
    }
    power = power + spin->power(q.data() + at, v.data() + at, a.data() + at, t, by_nut.size() > 0 ? &by_nut : nullptr);
  }
  if (!system_.model().driven()) return power;
  system_.count_evaluation();
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  at_guides([&](std::size_t i) { power.supports += free_[places()[i].mark] * v[places()[i].mark]; });
  update_supports(t);
  at_end_nodes([&](int node, const Support<D>& support, int /*joint*/) {
    const SupportMotion<D>& motion = node == 0 ? system_.model().start_motion : system_.model().end_motion;
    if (!motion) return;
    const auto add = [&](const auto& on, const auto& rate, const typename Support<D>::Components& free) {
      const Vec<double, D> force = support.into_frame(on), velocity = support.into_frame(rate);
      power.supports += (force.array() * velocity.array() * (1 - free)).sum();
    };
    add(position<D>(free_.data(), node), position<D>(v.data(), node), support.free_position);
    if (motion.turns()) add(slope<D>(free_.data(), node), slope<D>(v.data(), node), support.free_slope);
  });
  for (std::size_t i = 0; i < places().size(); ++i) {
    const auto point = system_.driven_joint(i, t);
    if (!point) continue;
    power.supports += on_joint_node(i, free_).dot(point->rate);
  }
  return power;
}

template <int D>
double ImplicitBeam<D>::conserving_residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0,
                                            const Eigen::VectorXd& q1, const Eigen::VectorXd& v1, double t, double h,
                                            Eigen::VectorXd& r) {
  if (system_.model().spin) {
    throw ModelError("integrator", "\"energy-momentum\"", "it knows no spin: take any other integrator");
  }
  if (driven() || system_.moving_mesh() != nullptr || system_.model().loads.present() ||
      system_.model().drag.present()) {
    throw ModelError(
        "integrator", "\"energy-momentum\"",
        "it keeps an energy that moving supports and nodes, loads and drag change: take any other integrator");
  }
  system_.count_evaluation();
  return conserving_step_.residual(q0, v0, q1, v1, t, h, r);
}

/// Adds the tangent of the element behind node `node`. Its row and column 4 D + e belong to unknown marks[e] of the
/// border, if to any.
template <int D>
template <class Matrix>
void ImplicitBeam<D>::add_element(int node, const Matrix& matrix, const std::array<int, 2>& marks) {
  constexpr int X = 4 * D;
  const auto k = static_cast<std::size_t>(node);
  tangent_.diagonal[k] += matrix.template block<B, B>(0, 0);
  tangent_.upper[k] += matrix.template block<B, B>(0, B);
  tangent_.lower[k + 1] += matrix.template block<B, B>(B, 0);
  tangent_.diagonal[k + 1] += matrix.template block<B, B>(B, B);
  for (int e = 0; e < 2; ++e) {
    const int mark = marks[static_cast<std::size_t>(e)];
    if (mark < 0) continue;
    auto& border = tangent_.border[static_cast<std::size_t>(mark)];
    const auto reach = static_cast<std::size_t>(node - border.first);
    for (int end = 0; end < 2; ++end) {
      border.column[reach + static_cast<std::size_t>(end)] += matrix.template block<B, 1>(end * B, X + e);
      border.row[reach + static_cast<std::size_t>(end)] += matrix.template block<1, B>(X + e, end * B).transpose();
    }
    for (int f = 0; f < 2; ++f) {
      const int other = marks[static_cast<std::size_t>(f)];
      if (other >= 0) tangent_.corner(mark, other) += matrix(X + e, X + f);
    }
  }
}

template <int D>
void ImplicitBeam<D>::assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                               const TangentWeights& by) {
  update_supports(t);
  const auto& model = system_.model();
  tangent_.reset(nodes());
  const bool travels = system_.moving_mesh() != nullptr;
  if (travels) {
    add_travelling_elements(q, v, a, t, by);
  } else {
    add_elements(q, v, a, t, by);
  }
  const ChainView<D> beam = view(q, v);
  const auto add_point = [&](int k, const PointMatrix<D>& matrix) {
    const auto mark = [&](int node) {
      const JointPlace* const joint = beam.joint_at(node);
      return joint == nullptr ? -1 : static_cast<int>(joint - places().data());
    };
    add_element(beam.first_node(k), matrix, {mark(k), mark(k + 1)});
  };
  model.loads.add_tangent(beam, t, by, add_point);
  model.drag.add_tangent(beam, by, add_point);
  model.masses.add_tangent(beam, a.data(), system_.gravity(t), by, add_point);
  if (model.rubs()) add_frictions(q, v, a, t, by);
}

/// Elements, those at joints among them, and the masses of joints.
template <int D>
void ImplicitBeam<D>::add_elements(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                   double t, const TangentWeights& by) {
  const auto& model = system_.model();
  auto *diagonal = tangent_.diagonal.data(), *upper = tangent_.upper.data(), *lower = tangent_.lower.data();
  at_spans([&](const Span<D>& span, int copies) {
    const Eigen::Index shift = Eigen::Index{B} * copies;
    span.add_tangent(q.data() + shift, v.data() + shift, by, diagonal + copies, upper + copies, lower + copies);
  });
  const ChainView<D> beam = view(q, v), accelerations = view(q, a);
  for (std::size_t i = 0; i < places().size(); ++i) tangent_.add_border(std::max(0, first_copy(i) - 1));
  auto law = system_.moving_law(t);
  for (const MovingPart& part : system_.moving_parts()) {
    const auto rest = system_.rest_of(part, q.data(), places());
    law.rest = rest ? &*rest : nullptr;
    const int k = part.element;
    const auto add = [&]<MovingEnds Ends>() {
      const std::array<int, 2> marks = Ends == MovingEnds::a   ? std::array{part.a, -1}
                                       : Ends == MovingEnds::b ? std::array{part.b, -1}
                                                               : std::array{part.a, part.b};
      add_element(beam.first_node(k),
                  moving_tangent<Ends, D>(beam.coordinates(k), beam.rates(k), accelerations.rates(k), by,
                                          beam.weights(k), part.table, law),
                  marks);
    };
    with_ends(part.ends, add);
  }
  for (std::size_t i = 0; i < places().size(); ++i) {
    const SlidingJoint& joint = system_.joint(i).law;
    tangent_.diagonal[static_cast<std::size_t>(first_copy(i))].template topLeftCorner<D, D>().diagonal().array() +=
        by.a * joint.mass;
  }
  if (const auto& rider = system_.rider()) {
    tangent_.add_border(rider->element);
    add_element(rider->element,
                rider_tangent<D>(system_.rider_motion(q.data(), v.data()), element_nodes<D>(a.data(), rider->element),
                                 a[after_nodes()], model.joints.front().law, system_.gravity(t), rider->held, by),
                {0, -1});
  }
  for (const int index : system_.departed()) {
    for (int c = 0; c < D; ++c) {
      tangent_.add_border(0);
      const int last = tangent_.borders() - 1;
      tangent_.corner(last, last) = by.a * model.joints[static_cast<std::size_t>(index)].law.mass;
    }
  }
}

/// Elements whose nodes all travel as prescribed, and what flows in.
template <int D>
void ImplicitBeam<D>::add_travelling_elements(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                              const Eigen::VectorXd& a, double t, const TangentWeights& by) {
  system_.travel(t);
  const auto& model = system_.model();
  const MovingMesh<D>& mesh = *system_.moving_mesh();
  const ChainView<D> beam = view(q, v);
  auto law = system_.moving_law(t);
  for (const MovingPart& part : system_.moving_parts()) {
    const auto rest = system_.rest_of(part, q.data(), places());
    law.rest = rest ? &*rest : nullptr;
    const int k = part.element;
    add_element(
        k, moving_tangent<MovingEnds::both, D, 0>(beam.coordinates(k), beam.rates(k), mesh.accelerations(a.data(), k),
                                                  by, beam.weights(k), part.table, law));
    if (!model.rotary.present()) continue;
    const auto i = static_cast<std::size_t>(k);
    add_element(k, RotaryElement(mesh.marks()[i], mesh.marks()[i + 1], part.table).tangent(model.rotary, by));
  }
  mesh.add_inflow_tangent(beam, by, [&](int row, int column, const Block& block) {
    auto& band = column == row ? tangent_.diagonal : column > row ? tangent_.upper : tangent_.lower;
    band[static_cast<std::size_t>(row)] += block;
  });
}

template <int D>
void ImplicitBeam<D>::add_frictions(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                    double t, const TangentWeights& by) {
  bool held = false;
  for (std::size_t i = 0; i < places().size(); ++i) held = held || system_.held(i) != nullptr;
  if (held) {
    free_.resize(q.size());
    free_residual(q, v, a, t, free_);
  }
  for (std::size_t i = 0; i < places().size(); ++i) {
    const SlidingJoint& joint = system_.joint(i).law;
    if (!joint.friction) continue;
    Vec<double, D> pull = joint.mass * (position<D>(a.data(), first_copy(i)) - system_.gravity(t));
    if (system_.held(i) != nullptr) pull -= on_joint_node(i, free_);
    add_friction_tangent(i, pull, q, v, by);
  }
}

template <int D>
void ImplicitBeam<D>::travelling_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                         double t, const TangentWeights& by, Eigen::MatrixXd& axis,
                                         Eigen::MatrixXd& angles) {
  refresh();
  assemble(q, v, a, t, by);
  axis.setZero(after_nodes(), after_nodes());
  tangent_.expand(axis);
  angles.resize(0, 0);
  const Spin* spin = system_.spin();
  if (spin == nullptr) return;
  spin->assemble(by, spin_tangent_);
  const Eigen::Index size = 2 * Eigen::Index{nodes()};  // an angle and a twist a node
  angles.setZero(size, size);
  spin_tangent_.band.expand(angles);
}

template <int D>
bool ImplicitBeam<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                const TangentWeights& by) {
  assemble(q, v, a, t, by);
  constraint_scale_ = reference_mass_ * by.a;  // as the rest of the tangent: by a mass and by.a
  if (with_multipliers()) add_constraints(q, a, constraint_scale_);
  add_contacts(q, a, constraint_scale_);
  if (!with_multipliers()) constrain_tangent();
  at_guides([&](std::size_t i) { tangent_.fix(static_cast<int>(i), reference_mass_ * by.a); });
  const auto nut = system_.nut_place();
  if (nut) take_nut(*nut, reference_mass_ * by.a);
  if (const Spin* spin = system_.spin()) {
    spin->assemble(by, spin_tangent_);
    if (!spin->factor(by.a, spin_tangent_)) return false;
  }
  if (!tangent_.factor()) return false;
  if (nut) factor_nut(*nut, q, v, a, t);
  return true;
}

template <int D>
Eigen::VectorXd ImplicitBeam<D>::nut_torque(std::size_t which, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                            double push) const {
  return system_.nut().torque(*system_.spin(), q.data() + angles(), v.data() + angles(), q[places()[which].mark], push);
}

template <int D>
void ImplicitBeam<D>::take_nut(std::size_t which, double size) {
  const auto& border = tangent_.border[which];
  nut_.row.setZero(angles());
  nut_.column.setZero(angles());
  for (int i = 0; i < BorderedBlockTridiagonal<B>::reach && border.first + i < nodes(); ++i) {
    nut_.row.template segment<B>(Eigen::Index{B} * (border.first + i)) = border.row[static_cast<std::size_t>(i)];
    nut_.column.template segment<B>(Eigen::Index{B} * (border.first + i)) = border.column[static_cast<std::size_t>(i)];
  }
  const auto x = static_cast<Eigen::Index>(which), others = Eigen::Index{tangent_.borders()};
  nut_.row.segment(after_nodes(), others) = tangent_.corner.row(x).head(others);
  nut_.column.segment(after_nodes(), others) = tangent_.corner.col(x).head(others);
  nut_.own = tangent_.corner(x, x);
  nut_.row[after_nodes() + x] = nut_.column[after_nodes() + x] = 0;
  tangent_.fix(static_cast<int>(which), size);
}

template <int D>
void ImplicitBeam<D>::factor_nut(std::size_t which, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                 const Eigen::VectorXd& a, double t) {
  const Spin& spin = *system_.spin();
  const Eigen::Index mark = places()[which].mark;
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  const double push = free_[mark];
  tangent_.solve(nut_.column.data());
  nut_.thread = system_.nut().thread(spin, q.data() + angles(), v.data() + angles(), q[mark]);
  const auto where_free = [&](Eigen::VectorXd torque) {
    for (const DrivenAngle& drive : spin.model().drives) torque[spin.angle(drive.node)] = 0;
    return torque;
  };
  nut_.torque = where_free(nut_.thread.by_angles);
  nut_.by_x = where_free((nut_.own - nut_.row.dot(nut_.column)) * nut_.thread.by_angles + push * nut_.thread.slope);
  nut_.answer.resize(spin.coordinates(), 2);
  nut_.answer.col(0) = nut_.by_x;
  nut_.answer.col(1) = where_free(push * nut_.thread.share);
  for (int i = 0; i < 2; ++i) spin_tangent_.solve(nut_.answer.col(i).data());
  Eigen::Matrix2d small = Eigen::Matrix2d::Identity();
  small.row(0) += nut_.thread.by_angles.transpose() * nut_.answer;
  small.row(1) += nut_.thread.twist.transpose() * nut_.answer;
  nut_.inverse = small.inverse();
}

/// Friction acts on the joint's material coordinate alone. Where its node is held, the beam pulls at it by what the
/// node's own equations lack, whose rows stand in the tangent.
template <int D>
void ImplicitBeam<D>::add_friction_tangent(std::size_t which, const Vec<double, D>& pull, const Eigen::VectorXd& q,
                                           const Eigen::VectorXd& v, const TangentWeights& by) {
  constexpr int N = 3 * D + 1;  // by the pull, the slopes and x'
  using Real = Active<N>;
  const SlidingJoint& joint = system_.joint(which).law;
  const JointPlace& place = places()[which];
  const int j = first_copy(which), far = j + (place.cut ? 1 : 0);
  const bool held = system_.held(which) != nullptr;
  const Slopes slopes = joint_slopes(which, q.data());
  Vec<Real, D> active_pull, before, behind;
  for (int c = 0; c < D; ++c) {
    active_pull[c] = Real(pull[c], c);
    before[c] = Real(slopes[c], D + c);
    behind[c] = Real(slopes[D + c], 2 * D + c);
  }
  const Real force =
      friction_force<Real, D>(*joint.friction, active_pull, Contact<Real, D>(before, behind, joint.turns()),
                              Real(v[place.mark], 3 * D))
          .force;
  if (force.derivatives().size() == 0 || force.value() == 0) return;
  const Eigen::Matrix<double, N, 1>& change = force.derivatives();
  const Vec<double, D> by_pull = change.template head<D>();
  auto& border = tangent_.border[which];
  const auto reached = [&](int node) { return static_cast<std::size_t>(node - border.first); };
  const auto at = static_cast<Eigen::Index>(which);
  border.row[reached(j)].template tail<D>() -= by.q * change.template segment<D>(D);
  border.row[reached(far)].template tail<D>() -= by.q * change.template segment<D>(2 * D);
  tangent_.corner(at, at) -= by.v * change[3 * D];
  border.row[reached(j)].template head<D>() -= by.a * joint.mass * by_pull;
  if (!held) return;
  for (int node = j; node <= far; ++node) {
    const auto k = static_cast<std::size_t>(node);
    const auto add = [&](int to, const Block& block) {
      border.row[reached(to)] += block.template topRows<D>().transpose() * by_pull;
    };
    add(node - 1, tangent_.lower[k]);
    add(node, tangent_.diagonal[k]);
    add(node + 1, tangent_.upper[k]);
    for (int other = 0; other < tangent_.borders(); ++other) {
      const auto& column = tangent_.border[static_cast<std::size_t>(other)];
      const int i = node - column.first;
      if (i < 0 || i >= BorderedBlockTridiagonal<B>::reach) continue;
      tangent_.corner(at, other) += by_pull.dot(column.column[static_cast<std::size_t>(i)].template head<D>());
    }
  }
}

template <int D>
void ImplicitBeam<D>::constrain_tangent() {
  const std::size_t last = tangent_.diagonal.size() - 1;
  at_held_nodes([&](int node, const Support<D>& support, int /*joint*/) {
    if ((support.free_position > 0).all() && (support.free_slope > 0).all()) return;
    Block keep = Block::Zero();
    keep.template topLeftCorner<D, D>() =
        support.frame * support.free_position.matrix().asDiagonal() * support.frame.transpose();
    keep.template bottomRightCorner<D, D>() =
        support.frame * support.free_slope.matrix().asDiagonal() * support.frame.transpose();
    const auto k = static_cast<std::size_t>(node);
    NodeVector size;  // of what is fixed: slopes have another unit
    size.template head<D>().setConstant(tangent_.diagonal[k].diagonal().template head<D>().cwiseAbs().maxCoeff());
    size.template tail<D>().setConstant(tangent_.diagonal[k].diagonal().template tail<D>().cwiseAbs().maxCoeff());
    tangent_.diagonal[k] = keep * tangent_.diagonal[k] * keep + size.asDiagonal() * (Block::Identity() - keep);
    if (k < last) {
      tangent_.upper[k] = keep * tangent_.upper[k];
      tangent_.lower[k + 1] = tangent_.lower[k + 1] * keep;
    }
    if (k > 0) {
      tangent_.lower[k] = keep * tangent_.lower[k];
      tangent_.upper[k - 1] = tangent_.upper[k - 1] * keep;
    }
    for (auto& border : tangent_.border) {
      const int reached = node - border.first;
      if (reached < 0 || reached >= BorderedBlockTridiagonal<B>::reach) continue;
      auto& column = border.column[static_cast<std::size_t>(reached)];
      auto& row = border.row[static_cast<std::size_t>(reached)];
      column = keep * column;
      row = keep * row;
    }
  });
}

template <int D>
void ImplicitBeam<D>::add_constraints(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double scale) {
  for (const auto& constraint : constraints_) {
    auto& border = tangent_.add_border(constraint.node);
    border.column[0] = border.row[0] = scale * constraint.direction;
    if (constraint.tied) border.column[1] = border.row[1] = -scale * constraint.direction;
  }
  Eigen::Index multiplier = first_slope_multiplier();
  for (const Conditions& conditions : slope_conditions(q.data())) {
    const Slopes slopes = joint_slopes(conditions.joint, q.data());
    const int node = first_copy(conditions.joint);
    const auto j = static_cast<std::size_t>(node);
    for (int i = 0; i < conditions.of.count(); ++i, ++multiplier) {
      const Slopes gradient = scale * conditions.of.gradient(i, slopes);
      auto& border = tangent_.add_border(node);
      border.column[0].template tail<D>() = border.row[0].template tail<D>() = gradient.template head<D>();
      border.column[1].template tail<D>() = border.row[1].template tail<D>() = gradient.template tail<D>();
      const typename JointSlopeConditions::Form curvature = reference_mass_ * a[multiplier] * conditions.of.form(i);
      tangent_.diagonal[j].template bottomRightCorner<D, D>() += curvature.template topLeftCorner<D, D>();
      tangent_.upper[j].template bottomRightCorner<D, D>() += curvature.template topRightCorner<D, D>();
      tangent_.lower[j + 1].template bottomRightCorner<D, D>() += curvature.template bottomLeftCorner<D, D>();
      tangent_.diagonal[j + 1].template bottomRightCorner<D, D>() += curvature.template bottomRightCorner<D, D>();
    }
  }
}

template <int D>
void ImplicitBeam<D>::add_contacts(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double scale) {
  at_contacts([&](const auto& contact, int node, Eigen::Index multiplier) {
    auto& border = tangent_.add_border(node);
    const Vec<double, D> line = scale / contact.distance * apart(node, q.data());
    const auto first = static_cast<std::size_t>(node - border.first);
    border.column[first].template head<D>() = border.row[first].template head<D>() = -line;
    border.column[first + 1].template head<D>() = border.row[first + 1].template head<D>() = line;
    const auto k = static_cast<std::size_t>(node);
    const double turns = reference_mass_ * a[multiplier] / contact.distance;
    const auto diagonal = [](Block& block) { return block.template topLeftCorner<D, D>().diagonal().array(); };
    diagonal(tangent_.diagonal[k]) += turns;
    diagonal(tangent_.diagonal[k + 1]) += turns;
    diagonal(tangent_.upper[k]) -= turns;
    diagonal(tangent_.lower[k + 1]) -= turns;
  });
}

template <int D>
void ImplicitBeam<D>::tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                              const TangentWeights& by, Eigen::MatrixXd& dense) {
  assemble(q, v, a, t, by);
  add_constraints(q, a, reference_mass_);
  dense.setZero(coordinates(), coordinates());
  tangent_.expand(dense);
  dense.bottomRows(multipliers()) /= reference_mass_;
}

template <int D>
void ImplicitBeam<D>::add_curvature(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const {
  for (const Conditions& conditions : slope_conditions_) {
    if (i >= conditions.of.count()) {
      i -= conditions.of.count();
      continue;
    }
    const Eigen::Index before = Eigen::Index{B} * first_copy(conditions.joint) + D, behind = before + B;
    const typename JointSlopeConditions::Form form = factor * conditions.of.form(static_cast<int>(i));
    dense.block<D, D>(before, before) += form.template topLeftCorner<D, D>();
    dense.block<D, D>(before, behind) += form.template topRightCorner<D, D>();
    dense.block<D, D>(behind, before) += form.template bottomLeftCorner<D, D>();
    dense.block<D, D>(behind, behind) += form.template bottomRightCorner<D, D>();
    return;
  }
}

template <int D>
void ImplicitBeam<D>::follow(const SecondOrderSystem& other) {
  const auto& leader = dynamic_cast<const ImplicitBeam&>(other);
  leader.refresh();
  refresh();
  slope_conditions_ = leader.slope_conditions_;
}

template <int D>
void ImplicitBeam<D>::exchange(Memory& memory) {
  refresh();
  for (Conditions& conditions : slope_conditions_) {
    memory(conditions.omitted_axis);
    conditions.of = {system_.joint(conditions.joint).law.slopes, conditions.omitted_axis};
  }
}

template <int D>
void ImplicitBeam<D>::solve(Eigen::VectorXd& r) const {
  r.tail(multipliers()) *= constraint_scale_;
  at_guides([&](std::size_t i) { r[places()[i].mark] = 0; });
  const auto nut = system_.nut_place();
  const Eigen::Index x = nut ? places()[*nut].mark : 0;
  const double off = nut ? std::exchange(r[x], 0) : 0;
  // what has a tangent of its own stands between the others and multipliers
  const auto swap_multipliers = [&](Eigen::Index ahead) {
    std::rotate(r.begin() + angles(), r.end() - ahead, r.end());
  };
  if (system_.spin()) swap_multipliers(multipliers());
  tangent_.solve(r.data());
  if (system_.spin()) swap_multipliers(system_.spin()->coordinates());
  if (const Spin* spin = system_.spin()) {
    auto turn = r.segment(angles(), spin->coordinates());
    if (nut) turn -= nut_.row.dot(r.head(angles())) * nut_.torque + off * nut_.by_x;
    spin_tangent_.solve(turn.data());
    if (nut) {
      const Eigen::Vector2d seen(nut_.thread.by_angles.dot(turn), nut_.thread.twist.dot(turn));
      turn -= nut_.answer * (nut_.inverse * seen);
      const double moves = off + nut_.thread.by_angles.dot(turn);
      r.head(angles()) -= moves * nut_.column;
      r[x] = moves;
    }
  }
  if (system_.model().turns() && !with_multipliers()) {  // the tangent may be an older one
    project(r.data());
  }
}

template <int D>
OuterForces<D> ImplicitBeam<D>::forces_at_rest(const Eigen::VectorXd& y, double t) {
  Eigen::VectorXd q, v;
  expand(y, q, v);
  free_.resize(q.size());
  free_residual(q, v, Eigen::VectorXd::Zero(q.size()), t, free_);
  OuterForces<D> forces;
  forces.supports = {free_.head<B>(), free_.segment<B>(after_nodes() - B)};
  forces.on_masses.assign(system_.model().joints.size(), Vec<double, D>::Zero());
  for (std::size_t i = 0; i < places().size(); ++i) {
    auto& on_mass = forces.on_masses[static_cast<std::size_t>(system_.joint_index(i))];
    on_mass = -on_joint_node(i, free_) - system_.joint(i).law.mass * system_.gravity(t);
  }
  return forces;
}

template <int D>
OuterForces<D> ImplicitBeam<D>::forces(const Eigen::VectorXd& y, double t) {
  Eigen::VectorXd q, v, a;
  expand(y, q, v);
  acceleration(q, v, t, a);
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  OuterForces<D> forces;
  forces.supports = {free_.head<B>(), free_.segment<B>(after_nodes() - B)};
  if (const Spin* spin = system_.spin()) {
    Eigen::VectorXd torques = free_.segment(angles(), spin->coordinates());
    if (const auto nut = system_.nut_place()) {
      torques -= nut_torque(*nut, q, v, free_[places()[*nut].mark]);
    }
    forces.drives = spin->drive_torques(torques.data());
  }
  for (const auto& [node, support] : system_.model().held_nodes) {
    forces.guides.push_back(free_.segment<B>(Eigen::Index{B} * node));
  }
  const auto& joints = system_.model().joints;
  forces.on_masses.assign(joints.size(), Vec<double, D>::Zero());
  forces.guiding.assign(joints.size(), 0);
  at_guides([&](std::size_t i) {
    forces.guiding[static_cast<std::size_t>(system_.joint_index(i))] = free_[places()[i].mark];
  });
  if (const auto nut = system_.nut_place()) {
    forces.guiding[static_cast<std::size_t>(system_.joint_index(*nut))] = free_[places()[*nut].mark];
  }
  if (const auto& rider = system_.rider()) {
    const auto at = system_.rider_motion(q.data(), v.data());
    const Vec<double, D> acceleration = combine_nodes<double, D>(at.s, element_nodes<D>(a.data(), rider->element)) +
                                        at.r_x * a[after_nodes()] + at.remainder;
    forces.on_masses.front() = joints.front().law.mass * (acceleration - system_.gravity(t));
  }
  for (std::size_t i = 0; i < places().size(); ++i) {
    const Vec<double, D> acceleration = position<D>(a.data(), first_copy(i));  // it moves with the mass
    auto& on_mass = forces.on_masses[static_cast<std::size_t>(system_.joint_index(i))];
    on_mass = system_.joint(i).law.mass * (acceleration - system_.gravity(t));
    if (system_.held(i) != nullptr) on_mass -= on_joint_node(i, free_);  // what holds it does the rest
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {  // and so does what it rests against
    const auto& contact = contacts_[c];
    const Vec<double, D> push = system_.resting_forces()[static_cast<Eigen::Index>(c)] * contact.line(y.data());
    for (std::size_t i = 0; i < places().size(); ++i) {
      auto& on_mass = forces.on_masses[static_cast<std::size_t>(system_.joint_index(i))];
      if (places()[i].node == contact.ahead) on_mass -= push;
      if (places()[i].node == contact.behind) on_mass += push;
    }
  }
  return forces;
}

template class ImplicitBeam<2>;
template class ImplicitBeam<3>;

}  // namespace vlbeam
