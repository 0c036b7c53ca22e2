#include "mechanics/motion/system/accelerations.hpp"

#include <limits>

#include "mechanics/time/assign.hpp"

namespace vlbeam {

template <int D>
void Accelerations<D>::adopt() {
  elements_.reserve(beam_.moving_parts().size());
  motions_.reserve(beam_.places().size());
  link_forces_.setZero(static_cast<Eigen::Index>(links_.all().size()));
}

template <int D>
EnergyBalance Accelerations<D>::add_forces(const double* q, const double* rate, double t, double* force,
                                           JointElements& elements) const {
  const Vector g = beam_.gravity(t), on_beam = beam_.beam_gravity(t);
  EnergyBalance power;
  power.dissipated =
      beam_.left().add_forces(q, rate, on_beam, force) + beam_.right().add_forces(q, rate, on_beam, force);
  for (const SpanBetween<D>& span : beam_.between())
    power.dissipated += span.span().add_forces(q, rate, on_beam, force);
  const Motion<D> now = beam_.motion(q, rate, nullptr, t);
  for (const auto& part : beam_.acting()) power = power + part->add_force(now, force);
  if (beam_.model().loads.present() && beam_.prescribed_mesh() == nullptr) {  // else MeshEquations counts it
    power.loads += beam_.line_power(now.beam, t);
    power.supports += beam_.fed_line_power(now.beam, t);
  }
  if (beam_.moving_parts().empty()) {
    elements.clear();
    return power;
  }
  beam_.fill_elements(q, rate, t, elements);
  double lost = 0;
  for (std::size_t p = 0; p < beam_.moving_parts().size(); ++p) {
    const MovingPart& part = beam_.moving_parts()[p];
    const auto& eq = elements[p];
    const auto at = beam_.vectors_of(force, part.element);
    for (std::size_t i = 0; i < 4; ++i) Eigen::Map<Vector>(at[i]) += eq.force[i];
    if (part.a >= 0) force[beam_.places()[static_cast<std::size_t>(part.a)].mark] += eq.force_a;
    if (part.b >= 0) force[beam_.places()[static_cast<std::size_t>(part.b)].mark] += eq.force_b;
    lost += eq.dissipation;
  }
  power.dissipated += lost;
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    position<D>(force, beam_.places()[i].node) += beam_.joint(i).law.mass * g;
    force[beam_.places()[i].mark] -= beam_.turning_lag(i, q, rate);
  }
  if (const auto* mesh = beam_.prescribed_mesh()) mesh->add_entering(beam_.view(q, rate), force);
  return power;
}

template <int D>
void Accelerations<D>::rates(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) {
  ++evaluations_;
  const bool imposes = beam_.imposes();
  if (imposes) {
    imposed_ = y;
    impose(t);
  }
  const Eigen::Index count = beam_.coordinates();
  const double *const q = imposes ? imposed_.data() : y.data(), *const rate = q + count;
  assign_to(dydt.head(count), Eigen::Map<const Eigen::VectorXd>(rate, count));
  assign_to(dydt.tail(dydt.size() - count), Eigen::VectorXd::Zero(dydt.size() - count));
  const auto power = solve(q, rate, t, dydt.data() + count);
  if (power) {
    beam_.dofs().balance.add(*power, dydt);
  } else {  // outside the domain: the step is repeated, shorter
    dydt.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

template <int D>
void Accelerations<D>::accelerations(const ConstVector& q, const ConstVector& v, double t, Eigen::VectorXd& a) {
  ++evaluations_;
  const Eigen::Index count = beam_.coordinates();
  const double *at = q.data(), *rate = v.data();
  if (beam_.imposes()) {
    imposed_.resize(2 * count);
    assign_both_to(imposed_.head(count), q.head(count), imposed_.tail(count), v.head(count));
    impose(t);
    at = imposed_.data();
    rate = at + count;
  }
  assign_to(a.head(count), Eigen::VectorXd::Zero(count));
  if (!solve(at, rate, t, a.data())) a.setConstant(std::numeric_limits<double>::quiet_NaN());
}

template <int D>
void Accelerations<D>::impose(double t) {
  beam_.impose(imposed_, t);
  beam_.orient(t);
}

template <int D>
std::optional<EnergyBalance> Accelerations<D>::solve(const double* q, const double* rate, double t, double* a) {
  if (!beam_.move_nodes(t)) return std::nullopt;
  EnergyBalance power = add_forces(q, rate, t, a, elements_);
  Unknowns<D>* const unknowns = beam_.unknowns();
  if (unknowns != nullptr && !unknowns->accelerate(q, rate, t, a, power.dissipated)) return std::nullopt;
  std::optional<PrescribedMotion<D>> pull;  // of moving supports
  const bool solved = beam_.prescribed_mesh() != nullptr ? solve_prescribed(q, rate, t, a, pull)
                      : beam_.has_joint()                ? solve_at_joints(q, rate, t, a, pull, power)
                                                         : solve_without_joints(q, rate, t, a, pull, power);
  if (!solved) return std::nullopt;
  if (unknowns != nullptr) unknowns->follow(q, rate, a);
  for (std::size_t i = 0; i < beam_.free_masses().size(); ++i) {
    Eigen::Map<Vector>(a + beam_.free_mass_at(i)) = beam_.gravity(t);
  }
  if (beam_.prescribed_mesh() != nullptr) {
    power.loads = 0;
    power = power + of_mesh_->power(&elements_, q, rate, a, t);
  } else if (unknowns != nullptr && unknowns->supplied()) {
    power = power + unknowns->power(q, rate, a, t, nullptr);
  }
  if (pull && beam_.prescribed_mesh() == nullptr) power.supports += pull->power(a);
  links_.carry(q, rate, t);
  if (!links_.all().empty() || !links_.carried().empty()) {
    if (!press(q, rate, a, power)) return std::nullopt;
  }
  return power;
}

template <int D>
bool Accelerations<D>::solve_prescribed(const double* q, const double* rate, double t, double* a,
                                        std::optional<PrescribedMotion<D>>& pull) {
  pull = mass_.prescribed(elements_, q, rate, a, t);
  if (!beam_.prescribed_mesh()->solve(elements_, a)) return false;
  if (pull) pull->complete(a);
  return true;
}

template <int D>
bool Accelerations<D>::solve_at_joints(const double* q, const double* rate, double t, double* a,
                                       std::optional<PrescribedMotion<D>>& pull, EnergyBalance& power) {
  motions_.clear();
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    motions_.push_back(mass_.joint_motion(i, q, rate, t));
  }
  if (beam_.unknowns() != nullptr && !beam_.unknowns()->load(q, rate, a, motions_)) return false;
  pull = mass_.prescribed(elements_, q, rate, a, t);
  const auto at_joints = mass_.solve_joints(elements_, motions_, a);
  if (!at_joints) return false;
  power.dissipated += at_joints->dissipated;
  power.supports += at_joints->guided;
  if (pull) pull->complete(a);
  return true;
}

template <int D>
bool Accelerations<D>::solve_without_joints(const double* q, const double* rate, double t, double* a,
                                            std::optional<PrescribedMotion<D>>& pull, EnergyBalance& power) {
  pull = mass_.solve_without_joints(q, rate, t, a);
  if (beam_.loose() == nullptr) return true;
  const auto answer = beam_.loose()->accelerate(q, rate, beam_.gravity(t), a);
  if (!answer) return false;
  power.dissipated += answer->dissipation;
  if (pull) pull->add_force(answer->element, answer->force, answer->s);
  return true;
}

template <int D>
bool Accelerations<D>::press(const double* q, const double* rate, double* a, EnergyBalance& power) {
  const Eigen::VectorXd apart = Eigen::Map<const Eigen::VectorXd>(a, beam_.coordinates());
  const auto held = static_cast<Eigen::Index>(links_.all().size());
  pressing_ = links_.all();
  pressing_.insert(pressing_.end(), links_.carried().begin(), links_.carried().end());
  const auto forces = mass_.press(pressing_, elements_, q, links_.bending_in(q, rate, pressing_), a);
  if (!forces) return false;
  link_forces_ = forces->head(held);
  carried_forces_ = forces->tail(forces->size() - held);
  for (Eigen::Index i = 0; i < carried_forces_.size(); ++i) {
    power.loads += carried_forces_[i] * links_.carried()[static_cast<std::size_t>(i)].rate(beam_.view(q, rate));
  }
  if (beam_.model().driven()) {
    const Eigen::VectorXd change = Eigen::Map<const Eigen::VectorXd>(a, beam_.coordinates()) - apart;
    power.supports += mass_.work_of_prescribed(pressing_, *forces, elements_, q, rate, change);
  }
  return true;
}

template <int D>
double Accelerations<D>::contact_force(const Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd exact = y;
  beam_.impose(exact, t);
  beam_.orient(t);
  const double *q = exact.data(), *rate = q + beam_.coordinates();
  Eigen::VectorXd a = Eigen::VectorXd::Zero(beam_.coordinates());
  JointElements none;
  add_forces(q, rate, t, a.data(), none);
  mass_.solve_without_joints(q, rate, t, a.data());
  const auto answer = beam_.loose()->accelerate(q, rate, beam_.gravity(t), a.data());
  return answer ? answer->contact : 0;
}

template <int D>
Eigen::VectorXd Accelerations<D>::forces_of_links(const Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd exact = y;
  beam_.impose(exact, t);
  beam_.orient(t);
  const double *q = exact.data(), *rate = q + beam_.coordinates();
  Eigen::VectorXd a = Eigen::VectorXd::Zero(beam_.coordinates());
  JointElements elements;
  add_forces(q, rate, t, a.data(), elements);
  std::vector<JointMotion<D>> motions;
  for (std::size_t i = 0; i < beam_.places().size(); ++i) motions.push_back(mass_.joint_motion(i, q, rate, t));
  const auto pull = mass_.prescribed(elements, q, rate, a.data(), t);
  std::optional<Eigen::VectorXd> forces;
  if (mass_.solve_joints(elements, motions, a.data())) {
    if (pull) pull->complete(a.data());
    forces = mass_.press(links_.all(), elements, q, links_.bending_in(q, rate, links_.all()), a.data());
  }
  return forces.value_or(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(links_.all().size())));
}

template class Accelerations<2>;
template class Accelerations<3>;

}  // namespace vlbeam
