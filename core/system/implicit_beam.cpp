#include "core/system/implicit_beam.hpp"

#include "core/element/moving_tangent.hpp"
#include "core/error.hpp"

namespace vlbeam {
namespace {

/// Coordinates of one of the two elements at the joint, from the nodal array and the joint's entry.
template <MovingEnds Ends, int D>
MovingCoordinates<double, D> element_of(const double* nodes, int k, double joint, double other) {
  return Ends == MovingEnds::a ? MovingCoordinates<double, D>{element_nodes<D>(nodes, k), joint, other}
                               : MovingCoordinates<double, D>{element_nodes<D>(nodes, k), other, joint};
}

}  // namespace

template <int D>
double ImplicitBeam<D>::Constraint::value(const double* q, const std::array<DrivenPoint<D>, 2>& driven) const {
  const Eigen::Map<const NodeVector> here(q + Eigen::Index{B} * node), next(q + Eigen::Index{B} * (node + 1));
  if (tied) return direction.dot(here - next);
  const double off = direction.dot(here - anchor);
  return end < 0 ? off : off - direction.template head<D>().dot(driven[static_cast<std::size_t>(end)].value);
}

template <int D>
double ImplicitBeam<D>::Constraint::rate(const double* v, const std::array<DrivenPoint<D>, 2>& driven) const {
  const Eigen::Map<const NodeVector> here(v + Eigen::Index{B} * node), next(v + Eigen::Index{B} * (node + 1));
  if (tied) return direction.dot(here - next);
  const double off = direction.dot(here);
  return end < 0 ? off : off - direction.template head<D>().dot(driven[static_cast<std::size_t>(end)].rate);
}

template <int D>
void ImplicitBeam<D>::refresh() const {
  if (revision_ == system_.revision()) return;
  revision_ = system_.revision();
  constraints_.clear();
  slope_conditions_ = {};
  reference_mass_ = system_.model().section.rhoA * system_.mesh().length() / system_.mesh().elements();
  if (!with_multipliers()) return;
  at_held_nodes([&](int node, const Support<D>& support) {
    const int end = node == 0 ? 0 : node == nodes() - 1 ? 1 : -1;
    const NodeVector& anchor = end < 0 ? system_.joint_anchor() : system_.anchors()[static_cast<std::size_t>(end)];
    for (int c = 0; c < D; ++c) {
      NodeVector direction = NodeVector::Zero();
      direction.template head<D>() = support.frame.col(c);
      if (support.free_position[c] == 0) constraints_.push_back({node, direction, anchor, end});
      direction.template head<D>().setZero();
      direction.template tail<D>() = support.frame.col(c);
      if (support.free_slope[c] == 0) constraints_.push_back({node, direction, anchor, end});
    }
  });
  if (!system_.has_joint()) return;
  for (int c = 0; c < (system_.kinked() ? D : B); ++c) {
    constraints_.push_back({system_.joint(), NodeVector::Unit(c), NodeVector::Zero(), -1, true});
  }
  slope_conditions_ = {system_.model().joint->slopes, omitted_axis_};
}

template <int D>
typename ImplicitBeam<D>::Slopes ImplicitBeam<D>::joint_slopes(const double* q) const {
  Slopes slopes;
  slopes << slope<D>(q, system_.joint()), slope<D>(q, system_.joint() + cut());
  return slopes;
}

/// In space the components of the cross product change over only where the slope has turned far away: they change the
/// multipliers' meaning.
template <int D>
const SlopeConditions<D>& ImplicitBeam<D>::slope_conditions(const double* q) const {
  if (D == 3 && slope_conditions_.count() > 0) {
    const Vec<double, D> before = slope<D>(q, system_.joint());
    if (std::abs(before[omitted_axis_]) < 0.4 * before.norm()) {
      omitted_axis_ = longest_axis<D>(before);
      slope_conditions_ = {system_.model().joint->slopes, omitted_axis_};
    }
  }
  return slope_conditions_;
}

template <int D>
Eigen::Index ImplicitBeam<D>::multipliers() const {
  refresh();
  return static_cast<Eigen::Index>(constraints_.size()) + slope_conditions_.count();
}

template <int D>
Eigen::Index ImplicitBeam<D>::coordinates() const {
  return system_.coordinates() + B * cut() - (system_.kinked() ? D : 0) + multipliers();
}

template <int D>
std::vector<FieldRun> ImplicitBeam<D>::fields() const {
  refresh();
  auto runs = nodal_fields(D, nodes());
  if (system_.has_joint() || system_.rider()) {
    runs.push_back({Field::mark, after_nodes()});
  } else if (system_.has_free_mass()) {
    runs.push_back({Field::mass, after_nodes(), D});
  }
  if (const Spin* spin = system_.spin()) {
    for (const FieldRun& run : spin->fields(after_nodes())) runs.push_back(run);
  }
  Eigen::Index at = coordinates() - multipliers();
  for (const auto& constraint : constraints_) {
    const bool place = !constraint.direction.template head<D>().isZero(0);
    runs.push_back({place ? Field::multiplier : Field::slope_multiplier, at++});
  }
  if (slope_conditions_.count() > 0) runs.push_back({Field::slope_multiplier, at, slope_conditions_.count()});
  return runs;
}

template <int D>
void ImplicitBeam<D>::expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const {
  const Eigen::Index n = coordinates(), own = system_.coordinates();
  if (n == own) {
    q = y.head(own);
    v = y.segment(own, own);
    return;
  }
  const Eigen::Index before = cut() == 0 ? own : Eigen::Index{B} * (system_.joint() + 1);
  const Eigen::Index kink = system_.kinked() ? D : 0, behind = own - before - kink;
  auto spread = [&](const auto& from, Eigen::VectorXd& to) {
    to.setZero(n);
    to.head(before) = from.head(before);
    if (cut() == 0) return;
    to.segment(before, B) = from.segment(before - B, B);
    to.segment(before + D, kink) = from.tail(kink);
    to.segment(before + B, behind) = from.segment(before, behind);
  };
  spread(y.head(own), q);
  spread(y.segment(own, own), v);
}

template <int D>
void ImplicitBeam<D>::contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const {
  const Eigen::Index own = system_.coordinates();
  const Eigen::Index before = cut() == 0 ? own : Eigen::Index{B} * (system_.joint() + 1);
  const Eigen::Index kink = system_.kinked() ? D : 0, behind = own - before - kink;
  auto gather = [&](const Eigen::VectorXd& from, auto to) {
    to.head(before) = from.head(before);
    to.segment(before, behind) = from.segment(before + B * cut(), behind);
    if (kink > 0) to.tail(kink) = from.segment(before + D, kink);
  };
  gather(q, y.head(own));
  gather(v, y.segment(own, own));
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
  // what the equations of motion lack is what the constraints give: their directions are orthonormal, node by node
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const auto& constraint = constraints_[i];
    const auto lacks = [&](int node) {
      return constraint.direction.dot(Eigen::Map<const NodeVector>(free_.data() + Eigen::Index{B} * node));
    };
    const bool second = constraint.node == system_.joint() && cut() > 0;  // what holds a joint holds both of its nodes
    const double lacking = (constraint.tied ? 0 : lacks(constraint.node)) + (second ? lacks(constraint.node + 1) : 0);
    a[a.size() - multipliers() + static_cast<Eigen::Index>(i)] = (constraint.tied ? 1 : -1) * lacking / reference_mass_;
  }
  if (slope_conditions_.count() == 0) return;
  const auto& conditions = slope_conditions(q.data());
  Eigen::MatrixXd gradients(2 * D, conditions.count());
  for (int i = 0; i < conditions.count(); ++i) gradients.col(i) = conditions.gradient(i, joint_slopes(q.data()));
  a.tail(conditions.count()) =
      -(gradients.transpose() * gradients).ldlt().solve(gradients.transpose() * joint_slopes(free_.data())) /
      reference_mass_;
}

template <int D>
template <class Function>
void ImplicitBeam<D>::at_end_nodes(const Function& function) const {
  function(0, system_.model().start);
  function(nodes() - 1, system_.model().end);
}

template <int D>
template <class Function>
void ImplicitBeam<D>::at_held_nodes(const Function& function) const {
  at_end_nodes(function);
  if (const Support<D>* held = system_.held_joint()) function(system_.joint(), *held);
}

template <int D>
void ImplicitBeam<D>::project(double* nodes) const {
  at_held_nodes([&](int k, const Support<D>& support) {
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
  const int shift = B * cut();  // of the nodes behind the joint
  r.setZero();
  double dissipation = system_.left().add_forces(q.data(), v.data(), on_beam, r.data()) +
                       system_.right().add_forces(q.data() + shift, v.data() + shift, on_beam, r.data() + shift);
  model.loads.add_forces(view(q, v), t, r.data());
  const bool bears_masses = model.masses.present();
  if (bears_masses) model.masses.add_weight(view(q, v), gravity, r.data());
  r = -r;
  if (bears_masses) model.masses.add_residual(view(q, v), a.data(), gravity, r.data());
  system_.left().add_inertia(a.data(), r.data());
  system_.right().add_inertia(a.data() + shift, r.data() + shift);
  const Eigen::Index extra = after_nodes();
  if (system_.has_joint()) {
    const int j = system_.joint();
    const auto ju = static_cast<std::size_t>(j);
    const auto& mesh = system_.mesh();
    auto law = system_.moving_law(t);
    const auto rest = system_.joint_rest(q[extra]);
    auto add = [&]<MovingEnds Ends>(int node, const WeightFunction& weights, double far_end,
                                    const ShapeTabulation& table) {
      if (rest) law.rest = Ends == MovingEnds::b ? &rest->left : &rest->right;
      const auto part = moving_residual<Ends, double, D>(
          element_of<Ends, D>(q.data(), node, q[extra], far_end), element_of<Ends, D>(v.data(), node, v[extra], 0),
          element_of<Ends, D>(a.data(), node, a[extra], 0), weights, table, law, &dissipation);
      position<D>(r.data(), node) += part.nodes[0];
      slope<D>(r.data(), node) += part.nodes[1];
      position<D>(r.data(), node + 1) += part.nodes[2];
      slope<D>(r.data(), node + 1) += part.nodes[3];
      r[extra] += part.end;
    };
    add.template operator()<MovingEnds::b>(j - 1, mesh.weights[ju - 1], mesh.x[ju - 1], system_.left_table());
    add.template operator()<MovingEnds::a>(j + cut(), mesh.weights[ju], mesh.x[ju + 1], system_.right_table());
    const Vec<double, D> pull = position<D>(a.data(), j) - gravity;
    position<D>(r.data(), j) += model.joint->mass * pull;
    if (model.joint->friction) {
      const Vec<double, D> mean = (slope<D>(q.data(), j) + slope<D>(q.data(), j + cut())) / 2;
      const auto friction = friction_force<double, D>(*model.joint->friction, model.joint->mass, pull, mean, v[extra]);
      r[extra] -= friction.force;
      dissipation += friction.dissipation;
    }
  } else if (const auto& rider = system_.rider()) {
    const auto part =
        rider_residual<double, D>(system_.rider_motion(q.data(), v.data()), element_nodes<D>(a.data(), rider->element),
                                  a[extra], *model.joint, gravity, rider->held);
    position<D>(r.data(), rider->element) += part.nodes[0];
    slope<D>(r.data(), rider->element) += part.nodes[1];
    position<D>(r.data(), rider->element + 1) += part.nodes[2];
    slope<D>(r.data(), rider->element + 1) += part.nodes[3];
    r[extra] = part.x;
    dissipation += part.dissipation;
  } else if (system_.has_free_mass()) {
    r.segment<D>(extra) = model.joint->mass * (a.segment<D>(extra) - gravity);
  }
  if (Spin* spin = system_.spin()) {
    dissipation += spin->residual(q.data() + extra, v.data() + extra, a.data() + extra, t, r.data() + extra);
  }
  return dissipation;
}

template <int D>
double ImplicitBeam<D>::residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                 Eigen::VectorXd& r) {
  system_.count_evaluation();
  const Eigen::Index first = coordinates() - multipliers();
  const double dissipation = free_residual(q, v, a, t, r);
  if (!with_multipliers()) project(r.data());
  if (const Spin* spin = system_.spin()) spin->drive(a.data() + after_nodes(), t, r.data() + after_nodes());
  const auto driven = system_.driven_points(t);
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
  if (slope_conditions_.count() > 0) {
    const auto& conditions = slope_conditions(q.data());
    const Slopes slopes = joint_slopes(q.data());
    for (int i = 0; i < conditions.count(); ++i) {
      const Eigen::Index at = first_slope_multiplier() + i;
      const Slopes force = reference_mass_ * a[at] * conditions.gradient(i, slopes);
      slope<D>(r.data(), system_.joint()) += force.template head<D>();
      slope<D>(r.data(), system_.joint() + 1) += force.template tail<D>();
      r[at] = conditions.value(i, slopes);
    }
  }
  return dissipation;
}

template <int D>
ConstraintResidual ImplicitBeam<D>::constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                        double t) const {
  refresh();
  const auto driven = system_.driven_points(t);
  ConstraintResidual largest;
  for (const auto& constraint : constraints_) {
    largest.position = std::max(largest.position, std::abs(constraint.value(q.data(), driven)));
    largest.velocity = std::max(largest.velocity, std::abs(constraint.rate(v.data(), driven)));
  }
  for (int i = 0; i < slope_conditions_.count(); ++i) {
    const Slopes slopes = joint_slopes(q.data());
    largest.position = std::max(largest.position, std::abs(slope_conditions_.value(i, slopes)));
    largest.velocity = std::max(largest.velocity, std::abs(slope_conditions_.rate(i, slopes, joint_slopes(v.data()))));
  }
  return largest;
}

template <int D>
void ImplicitBeam<D>::constraint_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                       Eigen::VectorXd& rates) const {
  const auto driven = system_.driven_points(t);
  Eigen::Index at = rates.size() - multipliers();
  for (const auto& constraint : constraints_) rates[at++] = constraint.rate(v.data(), driven);
  for (int i = 0; i < slope_conditions_.count(); ++i) {
    rates[at++] = slope_conditions_.rate(i, joint_slopes(q.data()), joint_slopes(v.data()));
  }
}

template <int D>
bool ImplicitBeam<D>::driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const {
  if (!driven() || with_multipliers()) return false;
  offset.setZero(q.size());
  const auto points = system_.driven_points(t);
  at_end_nodes([&](int node, const Support<D>& support) {
    const std::size_t end = node == 0 ? 0 : 1;
    const Vec<double, D> off =
        position<D>(q.data(), node) - system_.anchors()[end].template head<D>() - points[end].value;
    position<D>(offset.data(), node) =
        support.out_of_frame((support.into_frame(off).array() * (1 - support.free_position)).matrix());
  });
  return true;
}

template <int D>
Tally ImplicitBeam<D>::supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                      double t) {
  Tally power;
  const Loads<D>& loads = system_.model().loads;
  if (loads.present()) {
    free_.setZero(q.size());
    power.loads = loads.add_forces(view(q, v), t, free_.data()) + system_.line_power(view(q, v), t);
  }
  if (Spin* spin = system_.spin(); spin != nullptr && spin->model().supplied()) {
    const Eigen::Index at = after_nodes();
    power = power + spin->power(q.data() + at, v.data() + at, a.data() + at, t);
  }
  if (!driven()) return power;
  system_.count_evaluation();
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  at_end_nodes([&](int node, const Support<D>& support) {
    if (!(node == 0 ? system_.model().start_motion : system_.model().end_motion)) return;
    const Vec<double, D> force = support.into_frame(position<D>(free_.data(), node)),
                         velocity = support.into_frame(position<D>(v.data(), node));
    power.supports += (force.array() * velocity.array() * (1 - support.free_position)).sum();
  });
  return power;
}

template <int D>
double ImplicitBeam<D>::conserving_residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0,
                                            const Eigen::VectorXd& q1, const Eigen::VectorXd& v1, double t, double h,
                                            Eigen::VectorXd& r) {
  if (system_.model().spin) {
    throw InvalidInput("/integrator/type", "\"energy-momentum\"", "it knows no spin: take any other integrator");
  }
  if (driven() || system_.model().loads.present()) {
    throw InvalidInput("/integrator/type", "\"energy-momentum\"",
                       "it keeps an energy that moving supports and loads change: take any other integrator");
  }
  system_.count_evaluation();
  return conserving_step_.residual(q0, v0, q1, v1, t, h, r);
}

template <int D>
void ImplicitBeam<D>::assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                               double by_v, double by_a) {
  refresh();
  const auto& model = system_.model();
  const auto& mesh = system_.mesh();
  tangent_.reset(nodes());
  const int shift = cut();  // of the nodes behind the joint
  auto *diagonal = tangent_.diagonal.data(), *upper = tangent_.upper.data(), *lower = tangent_.lower.data();
  system_.left().add_tangent(q.data(), v.data(), by_v, by_a, diagonal, upper, lower);
  system_.right().add_tangent(q.data() + Eigen::Index{B} * shift, v.data() + Eigen::Index{B} * shift, by_v, by_a,
                              diagonal + shift, upper + shift, lower + shift);
  const Eigen::Index extra = after_nodes();
  constexpr int N = 4 * D + 1;
  // adds the tangent of an element at `node` to blocks and to the border of x
  auto add_blocks = [&](int node, const Eigen::Matrix<double, N, N>& matrix) {
    const auto k = static_cast<std::size_t>(node);
    tangent_.diagonal[k] += matrix.template block<B, B>(0, 0);
    tangent_.upper[k] += matrix.template block<B, B>(0, B);
    tangent_.lower[k + 1] += matrix.template block<B, B>(B, 0);
    tangent_.diagonal[k + 1] += matrix.template block<B, B>(B, B);
  };
  auto add_element = [&](auto& border, int node, const Eigen::Matrix<double, N, N>& matrix) {
    const auto reach = static_cast<std::size_t>(node - border.first);
    add_blocks(node, matrix);
    for (int end = 0; end < 2; ++end) {
      border.column[reach + static_cast<std::size_t>(end)] += matrix.template block<B, 1>(end * B, N - 1);
      border.row[reach + static_cast<std::size_t>(end)] += matrix.template block<1, B>(N - 1, end * B).transpose();
    }
    tangent_.corner(0, 0) += matrix(N - 1, N - 1);
  };
  if (system_.has_joint()) {
    const int j = system_.joint();
    const auto ju = static_cast<std::size_t>(j);
    auto law = system_.moving_law(t);
    const auto rest = system_.joint_rest(q[extra]);
    auto& border = tangent_.add_border(j - 1);
    auto add = [&]<MovingEnds Ends>(int node, const WeightFunction& weights, double far_end,
                                    const ShapeTabulation& table) {
      if (rest) law.rest = Ends == MovingEnds::b ? &rest->left : &rest->right;
      add_element(
          border, node,
          moving_tangent<Ends, D>(element_of<Ends, D>(q.data(), node, q[extra], far_end),
                                  element_of<Ends, D>(v.data(), node, v[extra], 0),
                                  element_of<Ends, D>(a.data(), node, a[extra], 0), by_v, by_a, weights, table, law));
    };
    add.template operator()<MovingEnds::b>(j - 1, mesh.weights[ju - 1], mesh.x[ju - 1], system_.left_table());
    add.template operator()<MovingEnds::a>(j + shift, mesh.weights[ju], mesh.x[ju + 1], system_.right_table());
    tangent_.diagonal[ju].template topLeftCorner<D, D>().diagonal().array() += by_a * model.joint->mass;
    if (model.joint->friction) add_friction_tangent(q, v, a, t, by_v, by_a);
  } else if (const auto& rider = system_.rider()) {
    add_element(tangent_.add_border(rider->element), rider->element,
                rider_tangent<D>(system_.rider_motion(q.data(), v.data()), element_nodes<D>(a.data(), rider->element),
                                 a[extra], *model.joint, system_.gravity(t), rider->held, by_v, by_a));
  } else if (system_.has_free_mass()) {
    for (int c = 0; c < D; ++c) tangent_.add_border(0);
    tangent_.corner.diagonal().setConstant(by_a * model.joint->mass);
  }
  const ChainView<D> beam = view(q, v);
  const auto add_point = [&](int k, const PointMatrix<D>& matrix) {
    if (beam.at_joint(k)) {
      add_element(tangent_.border.front(), beam.first_node(k), matrix);
    } else {
      add_blocks(beam.first_node(k), matrix);
    }
  };
  model.loads.add_tangent(beam, t, add_point);
  model.masses.add_tangent(beam, a.data(), system_.gravity(t), by_v, by_a, add_point);
}

template <int D>
bool ImplicitBeam<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                double by_v, double by_a) {
  assemble(q, v, a, t, by_v, by_a);
  if (with_multipliers()) {
    constraint_scale_ = reference_mass_ * by_a;  // as the rest of the tangent: by a mass and by_a
    add_constraints(q, a, constraint_scale_);
  } else {
    constrain_tangent();
  }
  if (const Spin* spin = system_.spin()) {
    spin->assemble({1, by_v, by_a}, spin_tangent_);
    if (!spin->factor(by_a, spin_tangent_)) return false;
  }
  return tangent_.factor();
}

/// Friction acts on the joint's material coordinate, the first unknown of the border, alone.
template <int D>
void ImplicitBeam<D>::add_friction_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                           double t, double by_v, double by_a) {
  constexpr int N = 2 * D + 1;  // by the mass's acceleration, the mean slope and x'
  using Real = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;
  const auto& joint = *system_.model().joint;
  const int j = system_.joint(), far = j + cut();
  const Vec<double, D> pull = position<D>(a.data(), j) - system_.gravity(t);
  const Vec<double, D> mean = (slope<D>(q.data(), j) + slope<D>(q.data(), far)) / 2;
  Vec<Real, D> active_pull, active_slope;
  for (int c = 0; c < D; ++c) {
    active_pull[c] = Real(pull[c], N, c);
    active_slope[c] = Real(mean[c], N, D + c);
  }
  const Real x_rate(v[after_nodes()], N, 2 * D);
  const Real force = friction_force<Real, D>(*joint.friction, joint.mass, active_pull, active_slope, x_rate).force;
  if (force.derivatives().size() == 0 || force.value() == 0) return;
  const Eigen::Matrix<double, N, 1>& by = force.derivatives();
  auto& row = tangent_.border.front().row;  // from node j - 1 on
  row[1].template head<D>() -= by_a * by.template head<D>();
  row[1].template tail<D>() -= by.template segment<D>(D) / 2;
  row[static_cast<std::size_t>(far - j) + 1].template tail<D>() -= by.template segment<D>(D) / 2;
  tangent_.corner(0, 0) -= by_v * by[2 * D];
}

template <int D>
void ImplicitBeam<D>::constrain_tangent() {
  const std::size_t last = tangent_.diagonal.size() - 1;
  at_held_nodes([&](int node, const Support<D>& support) {
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
  if (slope_conditions_.count() == 0) return;
  const auto& conditions = slope_conditions(q.data());
  const Slopes slopes = joint_slopes(q.data());
  const auto j = static_cast<std::size_t>(system_.joint());
  for (int i = 0; i < conditions.count(); ++i) {
    const Slopes gradient = scale * conditions.gradient(i, slopes);
    auto& border = tangent_.add_border(system_.joint());
    border.column[0].template tail<D>() = border.row[0].template tail<D>() = gradient.template head<D>();
    border.column[1].template tail<D>() = border.row[1].template tail<D>() = gradient.template tail<D>();
    const typename JointSlopeConditions::Form curvature =
        reference_mass_ * a[first_slope_multiplier() + i] * conditions.form(i);
    tangent_.diagonal[j].template bottomRightCorner<D, D>() += curvature.template topLeftCorner<D, D>();
    tangent_.upper[j].template bottomRightCorner<D, D>() += curvature.template topRightCorner<D, D>();
    tangent_.lower[j + 1].template bottomRightCorner<D, D>() += curvature.template bottomLeftCorner<D, D>();
    tangent_.diagonal[j + 1].template bottomRightCorner<D, D>() += curvature.template bottomRightCorner<D, D>();
  }
}

template <int D>
void ImplicitBeam<D>::tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                              double by_v, double by_a, Eigen::MatrixXd& dense) {
  assemble(q, v, a, t, by_v, by_a);
  add_constraints(q, a, reference_mass_);
  dense.setZero(coordinates(), coordinates());
  tangent_.expand(dense);
  dense.bottomRows(multipliers()) /= reference_mass_;
}

template <int D>
void ImplicitBeam<D>::add_curvature(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const {
  const Eigen::Index before = Eigen::Index{B} * system_.joint() + D, behind = before + B;
  const typename JointSlopeConditions::Form form = factor * slope_conditions_.form(static_cast<int>(i));
  dense.block<D, D>(before, before) += form.template topLeftCorner<D, D>();
  dense.block<D, D>(before, behind) += form.template topRightCorner<D, D>();
  dense.block<D, D>(behind, before) += form.template bottomLeftCorner<D, D>();
  dense.block<D, D>(behind, behind) += form.template bottomRightCorner<D, D>();
}

template <int D>
void ImplicitBeam<D>::follow(const SecondOrderSystem& other) {
  const auto& leader = dynamic_cast<const ImplicitBeam&>(other);
  leader.refresh();
  refresh();
  omitted_axis_ = leader.omitted_axis_;
  slope_conditions_ = leader.slope_conditions_;
}

template <int D>
void ImplicitBeam<D>::solve(Eigen::VectorXd& r) const {
  r.tail(multipliers()) *= constraint_scale_;
  tangent_.solve(r.data());
  if (system_.spin() != nullptr) spin_tangent_.solve(r.data() + after_nodes());
}

template <int D>
OuterForces<D> ImplicitBeam<D>::forces_at_rest(const Eigen::VectorXd& y, double t) {
  Eigen::VectorXd q, v;
  expand(y, q, v);
  free_.resize(q.size());
  free_residual(q, v, Eigen::VectorXd::Zero(q.size()), t, free_);
  OuterForces<D> forces;
  forces.supports = {free_.head<B>(), free_.segment<B>(after_nodes() - B)};
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
  if (const Spin* spin = system_.spin()) forces.drives = spin->drive_torques(free_.data() + after_nodes());
  if (!system_.mass_on_beam()) return forces;
  Vec<double, D> acceleration;
  if (const auto& rider = system_.rider()) {
    const auto at = system_.rider_motion(q.data(), v.data());
    acceleration = combine_nodes<double, D>(at.s, element_nodes<D>(a.data(), rider->element)) +
                   at.r_x * a[after_nodes()] + at.remainder;
  } else {
    acceleration = position<D>(a.data(), system_.joint());  // its node moves with the mass
  }
  forces.on_mass = system_.model().joint->mass * (acceleration - system_.gravity(t));
  if (system_.held_joint() != nullptr) {  // what holds it does the rest
    const int j = system_.joint();
    forces.on_mass -= position<D>(free_.data(), j);
    if (cut() > 0) forces.on_mass -= position<D>(free_.data(), j + 1);
  }
  return forces;
}

template class ImplicitBeam<2>;
template class ImplicitBeam<3>;

}  // namespace vlbeam
