#include "mechanics/motion/system/implicit_beam.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/geometry/dense.hpp"

namespace vlbeam {

template <int D>
ImplicitBeam<D>::ImplicitBeam(Accelerations<D>& of)
    : accelerations_(of),
      beam_(of.beam()),
      equations_(of.beam()),
      supports_(beam_, !with_multipliers()),
      kinks_(beam_, !with_multipliers()),
      links_(of.links()),
      of_unknowns_(beam_.unknowns() != nullptr ? beam_.unknowns()->new_tangent() : nullptr) {}

template <int D>
void ImplicitBeam<D>::rebuild() const {
  revision_ = beam_.revision();
  dofs_ = beam_.dofs();
  reference_mass_ = beam_.model().section.rhoA * beam_.mesh().length() / beam_.mesh().elements();
  for (ConstraintSet<D>* set : constraints()) {
    set->adopt();
    dofs_.multipliers += set->count();
  }
  values_.resize(dofs_.multipliers);
}

template <int D>
std::vector<FieldRun> ImplicitBeam<D>::fields() const {
  std::vector<FieldRun> runs = dofs().fields(beam_.unknowns());
  at_constraints([&](const ConstraintSet<D>& set, Eigen::Index first) { set.add_fields(first, runs); });
  return runs;
}

template <int D>
void ImplicitBeam<D>::expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const {
  const Eigen::Index n = coordinates(), own = beam_.coordinates();
  q.resize(n);
  v.resize(n);
  assign_both_to(q.head(own), y.head(own), v.head(own), y.segment(own, own));
  q.tail(n - own).setZero();  // multipliers
  v.tail(n - own).setZero();
}

template <int D>
void ImplicitBeam<D>::find_acceleration(const ConstVector& q, const ConstVector& v, double t, Eigen::VectorXd& a) {
  const Eigen::Index own = beam_.coordinates();
  a.resize(q.size());
  accelerations_.accelerations(q, v, t, a);
  a.tail(q.size() - own).setZero();
  if (multipliers() == 0) return;
  a.tail(links_.count()) = -accelerations_.link_forces() / reference_mass_;
  // what the equations of motion lack is what the other constraints give
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  supports().at(t);
  double* const multipliers = a.data() + dofs().multiplier();
  supports_.balance(free_.data(), reference_mass_, multipliers);
  supports().project(free_.data());
  kinks_.choose(q.data());
  kinks_.balance(q.data(), free_.data(), reference_mass_, multipliers + supports_.count());
}

/// What is held or given in time is as it is now.
template <int D>
bool ImplicitBeam<D>::carry(const Eigen::VectorXd& before, double t, Eigen::VectorXd& a,
                            Eigen::VectorXd& memory) const {
  Eigen::VectorXd& carried = memory;
  assign(carried, a);
  if (tied() || !accelerations_.last_event().carry(beam_, before, carried)) return false;
  assign(carried, carried - a);
  supports().at(t);
  supports().project(carried.data());
  at_guides([&](std::size_t i) { carried[places()[i].mark] = 0; });
  assign(a, a + carried);
  return true;
}

/// With what links do, and without what holds.
template <int D>
double ImplicitBeam<D>::free_residual(const ConstVector& q, const ConstVector& v, const ConstVector& a, double t,
                                      Eigen::VectorXd& r, typename Equations<D>::Extent extent) const {
  const double lost = equations_.residual(q, v, a, t, r, extent);
  links_.add_forces(q.data(), a.data() + first_link_multiplier(), reference_mass_, r.data());
  return lost;
}

template <int D>
double ImplicitBeam<D>::residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                 Eigen::VectorXd& r) {
  accelerations_.count_evaluation();
  refresh();
  supports().at(t);
  if (!beam_.move_nodes(t)) {
    r.setConstant(std::numeric_limits<double>::quiet_NaN());
    return 0;
  }
  const double dissipation = free_residual(q, v, a, t, r);
  at_constraints([&](ConstraintSet<D>& set, Eigen::Index first) {
    set.choose(q.data());
    if (&set != &links_) set.add_forces(q.data(), a.data() + first, reference_mass_, r.data());
    set.write_values(q.data(), r.data() + first);
  });
  if (!with_multipliers()) supports().project(r.data());
  at_guides([&](std::size_t i) { r[places()[i].mark] = 0; });
  if (of_unknowns_) of_unknowns_->constrain(q.data(), v.data(), a.data(), t, r.data());
  return dissipation;
}

template <int D>
bool ImplicitBeam<D>::inertia(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double t, Eigen::VectorXd& r) {
  if (tied() || (beam_.unknowns() != nullptr && !of_unknowns_)) return false;
  refresh();
  if (const auto* of_mesh = equations_.of_mesh()) {
    r.setZero();
    of_mesh->add_inertia(a.data(), r.data());
  } else {
    beam_.fill_masses(q.data(), t, elements_);
    accelerations_.mass().multiply(elements_, q.data(), a.data(), r.data());
    r.tail(r.size() - beam_.coordinates()).setZero();
  }
  if (of_unknowns_) beam_.unknowns()->inertia(a.data(), r.data());
  for (std::size_t i = 0; i < beam_.free_masses().size(); ++i) {
    const Eigen::Index at = beam_.free_mass_at(i);
    r.segment<D>(at) =
        beam_.model().joints[static_cast<std::size_t>(beam_.free_masses()[i])].law.mass * a.segment<D>(at);
  }
  supports().at(t);
  if (!with_multipliers()) supports().project(r.data());
  at_guides([&](std::size_t i) { r[places()[i].mark] = 0; });
  return true;
}

template <int D>
ConstraintResidual ImplicitBeam<D>::constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                        double t) const {
  ConstraintResidual largest;
  supports().at(t);
  refresh();
  auto of = [this](const ConstraintSet<D>& set) { return values_.head(set.count()).cwiseAbs().maxCoeff(); };
  at_constraints([&](const ConstraintSet<D>& set, Eigen::Index /*first*/) {
    set.write_values(q.data(), values_.data());
    largest.position = std::max(largest.position, of(set));
    set.write_rates(q.data(), v.data(), values_.data());
    largest.velocity = std::max(largest.velocity, of(set));
  });
  return largest;
}

template <int D>
void ImplicitBeam<D>::constraint_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                       Eigen::VectorXd& rates) const {
  supports().at(t);
  at_constraints([&](const ConstraintSet<D>& set, Eigen::Index first) {
    set.write_rates(q.data(), v.data(), rates.data() + first);
  });
}

template <int D>
void ImplicitBeam<D>::add_curvature(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const {
  at_constraints([&](const ConstraintSet<D>& set, Eigen::Index first) {
    const Eigen::Index own = dofs().multiplier() + i - first;
    if (own >= 0 && own < set.count()) set.add_second_derivative(own, factor, dense);
  });
}

template <int D>
bool ImplicitBeam<D>::driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const {
  const bool guides = beam_.model().guides();
  if (!beam_.model().driven() || (with_multipliers() && !guides)) return false;
  offset.setZero(q.size());
  at_guides([&](std::size_t i) { offset[places()[i].mark] = q[places()[i].mark] - beam_.guided(i, t)->value; });
  if (!with_multipliers()) supports().add_offset(t, q.data(), offset.data());
  return true;
}

template <int D>
EnergyBalance ImplicitBeam<D>::supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                              const Eigen::VectorXd& a, double t) {
  if (auto* of_mesh = equations_.of_mesh()) return of_mesh->power(nullptr, q.data(), v.data(), a.data(), t);
  EnergyBalance power;
  if (beam_.model().balance().loads) {
    free_.setZero(q.size());
    const Motion<D> now = beam_.motion(q.data(), v.data(), a.data(), t);
    for (const auto& part : beam_.acting()) power.loads += part->load_power(now, free_.data());
    power.loads += beam_.line_power(now.beam, t);
    power.supports += beam_.fed_line_power(now.beam, t);
  }
  if (auto* unknowns = beam_.unknowns(); unknowns != nullptr && unknowns->supplied()) {
    if (tied()) {
      free_.resize(q.size());
      free_residual(q, v, a, t, free_);
    }
    power = power + unknowns->power(q.data(), v.data(), a.data(), t, tied() ? free_.data() : nullptr);
  }
  if (!beam_.model().driven()) return power;
  free_.resize(q.size());
  free_residual(q, v, a, t, free_, Equations<D>::Extent::ends);
  at_guides([&](std::size_t i) { power.supports += free_[places()[i].mark] * v[places()[i].mark]; });
  supports().at(t);
  power.supports += supports().power(free_.data(), v.data());
  return power;
}

template <int D>
std::optional<double> ImplicitBeam<D>::power_lost_between(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                                          const Eigen::VectorXd& a0, const Eigen::VectorXd& a1,
                                                          double h, double t) {
  const auto& parts = beam_.model().parts;
  const bool damped = beam_.model().section.damped() ||
                      std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part->takes_evenly(); });
  if (!damped || !beam_.move_nodes(t + h / 2)) return std::nullopt;
  assign_both(middle_q_, 0.5 * (q0 + q1), middle_v_, (q1 - q0) / h);
  assign(a_, 0.5 * (a0 + a1));
  free_.resize(q0.size());
  const double lost = equations_.residual(middle_q_, middle_v_, a_, t + h / 2, free_);
  beam_.move_nodes(t + h);
  return lost;
}

template <int D>
void ImplicitBeam<D>::tangents_apart(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                     double t, const TangentWeights& by, Eigen::MatrixXd& axis,
                                     Eigen::MatrixXd& angles) {
  refresh();
  equations_.assemble(q, v, a, t, by, tangent_);
  axis.setZero(after_nodes(), after_nodes());
  tangent_.expand(axis);
  angles.resize(0, 0);
  if (of_unknowns_) of_unknowns_->expand(by, angles);
}

template <int D>
bool ImplicitBeam<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                const TangentWeights& by) {
  equations_.assemble(q, v, a, t, by, tangent_);
  constraint_scale_ = reference_mass_ * by.a;  // as the rest of the tangent: by a mass and by.a
  add_constraints(q, a, t, constraint_scale_);
  if (!with_multipliers()) supports().project(tangent_);
  at_guides([&](std::size_t i) { tangent_.fix(static_cast<int>(i), reference_mass_ * by.a); });
  if (of_unknowns_ && !of_unknowns_->prepare(by, reference_mass_ * by.a, tangent_)) return false;
  if (!tangent_.factor()) return false;
  if (tied()) {
    free_.resize(q.size());
    free_residual(q, v, a, t, free_);
    of_unknowns_->complete(q.data(), v.data(), free_.data(), tangent_);
  }
  return true;
}

/// Rows and columns of constraints, times `scale`, and what their forces add to the tangent.
template <int D>
void ImplicitBeam<D>::add_constraints(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double t, double scale) {
  supports().at(t);
  at_constraints([&](ConstraintSet<D>& set, Eigen::Index first) {
    set.choose(q.data());
    set.add_tangent(q.data(), a.data() + first, reference_mass_, scale, tangent_);
  });
}

template <int D>
void ImplicitBeam<D>::tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                              const TangentWeights& by, Eigen::MatrixXd& dense) {
  equations_.assemble(q, v, a, t, by, tangent_);
  add_constraints(q, a, t, reference_mass_);
  dense.setZero(coordinates(), coordinates());
  tangent_.expand(dense);
  dense.bottomRows(multipliers()) /= reference_mass_;
}

template <int D>
void ImplicitBeam<D>::follow(const SecondOrderSystem& other) {
  const auto& leader = dynamic_cast<const ImplicitBeam&>(other);
  leader.refresh();
  refresh();
  for (std::size_t i = 0; i < constraints().size(); ++i) constraints()[i]->follow(*leader.constraints()[i]);
}

template <int D>
void ImplicitBeam<D>::exchange(Archive& memory) {
  refresh();
  for (ConstraintSet<D>* set : constraints()) set->exchange(memory);
}

template <int D>
void ImplicitBeam<D>::solve(Eigen::VectorXd& r) const {
  r.tail(multipliers()) *= constraint_scale_;
  at_guides([&](std::size_t i) { r[places()[i].mark] = 0; });
  if (of_unknowns_) of_unknowns_->solve_before(r.data());
  // what has a tangent of its own stands between the others and multipliers
  const auto swap_multipliers = [&](Eigen::Index ahead) {
    std::rotate(r.begin() + angles(), r.end() - ahead, r.end());
  };
  const Eigen::Index turning = dofs().turning;
  if (turning > 0) swap_multipliers(multipliers());
  tangent_.solve(r.data());
  if (turning > 0) swap_multipliers(turning);
  if (of_unknowns_) of_unknowns_->solve_after(r.data());
  if (beam_.model().turns() && !with_multipliers()) {  // the tangent may be an older one
    supports().project(r.data());
  }
}

template <int D>
OuterForces<D> ImplicitBeam<D>::forces_at_rest(const Eigen::VectorXd& y, double t, const Eigen::VectorXd& of_links) {
  Eigen::VectorXd q, v, a;
  expand(y, q, v);
  free_.resize(q.size());
  a.setZero(q.size());
  a.tail(of_links.size()) = -of_links / reference_mass_;
  free_residual(q, v, a, t, free_);
  OuterForces<D> forces;
  forces.links.assign(of_links.begin(), of_links.end());
  forces.supports = {free_.head<B>(), free_.segment<B>(after_nodes() - B)};
  forces.on_masses.assign(beam_.model().joints.size(), Vec<double, D>::Zero());
  for (std::size_t i = 0; i < places().size(); ++i) {
    auto& on_mass = forces.on_masses[static_cast<std::size_t>(beam_.joint_index(i))];
    on_mass = -position<D>(free_.data(), places()[i].node) - beam_.joint(i).law.mass * beam_.gravity(t);
    for (const auto& part : beam_.acting()) on_mass -= part->force_on_joint(places()[i].node);
  }
  return forces;
}

template <int D>
OuterForces<D> ImplicitBeam<D>::forces(const Eigen::VectorXd& y, double t) {
  Eigen::VectorXd own_q, own_v, a;
  const bool of_state = multipliers() == 0;  // else there are more coordinates than those of the state
  if (!of_state) expand(y, own_q, own_v);
  const Eigen::Index n = coordinates();
  const ConstVector q = of_state ? ConstVector(y.head(n)) : ConstVector(own_q),
                    v = of_state ? ConstVector(y.segment(n, n)) : ConstVector(own_v);
  find_acceleration(q, v, t, a);
  free_.resize(q.size());
  free_residual(q, v, a, t, free_);
  OuterForces<D> forces;
  forces.supports = {free_.head<B>(), free_.segment<B>(after_nodes() - B)};
  for (const auto& [node, support] : beam_.model().held_nodes) {
    forces.guides.push_back(free_.segment<B>(Eigen::Index{B} * node));
  }
  const auto& joints = beam_.model().joints;
  forces.on_masses.assign(joints.size(), Vec<double, D>::Zero());
  forces.guiding.assign(joints.size(), 0);
  for (const JointPlace& place : places()) forces.mark_accelerations.push_back(a[place.mark]);
  at_guides(
      [&](std::size_t i) { forces.guiding[static_cast<std::size_t>(beam_.joint_index(i))] = free_[places()[i].mark]; });
  if (beam_.unknowns() != nullptr) beam_.unknowns()->observe_forces(q.data(), v.data(), free_.data(), forces);
  if (const auto* loose = beam_.loose()) {
    const Vec<double, D> acceleration = loose->acceleration(q.data(), v.data(), a.data());
    forces.on_masses.front() = joints.front().law.mass * (acceleration - beam_.gravity(t));
  }
  for (std::size_t i = 0; i < places().size(); ++i) {
    const Vec<double, D> acceleration = position<D>(a.data(), places()[i].node);  // it moves with the mass
    auto& on_mass = forces.on_masses[static_cast<std::size_t>(beam_.joint_index(i))];
    on_mass = beam_.joint(i).law.mass * (acceleration - beam_.gravity(t));
    if (beam_.held(i) != nullptr)
      on_mass -= position<D>(free_.data(), places()[i].node);  // what holds it does the rest
    for (const auto& part : beam_.acting()) on_mass -= part->force_on_joint(places()[i].node);
  }
  const auto& links = accelerations_.links().all();
  forces.links.assign(accelerations_.link_forces().begin(), accelerations_.link_forces().end());
  forces.carried.assign(accelerations_.carried_forces().begin(), accelerations_.carried_forces().end());
  for (std::size_t c = 0; c < links.size(); ++c) {  // and so does what it is linked to
    const auto& link = links[c];
    if (link.place) continue;  // held by the ground, beside what slides
    const Vec<double, D> push = accelerations_.link_forces()[static_cast<Eigen::Index>(c)] * link.line(y.data());
    for (std::size_t i = 0; i < places().size(); ++i) {
      auto& on_mass = forces.on_masses[static_cast<std::size_t>(beam_.joint_index(i))];
      if (places()[i].node == link.ahead) on_mass -= push;
      if (places()[i].node == link.behind) on_mass += push;
    }
  }
  return forces;
}

template class ImplicitBeam<2>;
template class ImplicitBeam<3>;

}  // namespace vlbeam
