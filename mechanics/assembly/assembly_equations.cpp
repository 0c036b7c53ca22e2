#include "mechanics/assembly/assembly_equations.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/assembly/spring_now.hpp"

namespace vlbeam {

template <int D>
AssemblyEquations<D>::AssemblyEquations(AssemblySystem<D>& system) : system_(system) {
  for (std::size_t b = 0; b < system.members(); ++b) {
    views_.push_back({system.member(b).ode().new_second_order()});
  }
}

template <int D>
void AssemblyEquations<D>::refresh() const {
  if (revision_ == system_.revision()) return;
  revision_ = system_.revision();
  own_ = 0;
  for (View& view : views_) {
    view.multipliers = view.equations->multipliers();
    view.own = view.equations->coordinates() - view.multipliers;
    view.first = own_;
    own_ += view.own;
    view.handles.clear();
  }
  all_ = own_;
  for (View& view : views_) {
    view.first_multiplier = all_;
    all_ += view.multipliers;
  }
  conditions_ = 0;
  for (const Link<D>& link : system_.links()) conditions_ += static_cast<Eigen::Index>(link.conditions.size());
  all_ += conditions_;
  for (std::size_t i = 0; i < system_.handles().size(); ++i) {
    const std::size_t member = system_.end(i).member;
    if (member != LinkEnd<D>::no_member) views_[member].handles.push_back(i);
  }
}

template <int D>
Eigen::Index AssemblyEquations<D>::coordinates() const {
  refresh();
  return all_;
}

template <int D>
Eigen::Index AssemblyEquations<D>::multipliers() const {
  refresh();
  return all_ - own_;
}

template <int D>
std::vector<FieldRun> AssemblyEquations<D>::fields() const {
  refresh();
  std::vector<FieldRun> runs;
  for (const View& view : views_) {
    for (FieldRun run : view.equations->fields()) {
      run.first += run.first < view.own ? view.first : view.first_multiplier - view.own;
      runs.push_back(run);
    }
  }
  if (conditions_ > 0) runs.push_back({Field::multiplier, all_ - conditions_, 1, 1, conditions_});
  return runs;
}

template <int D>
void AssemblyEquations<D>::expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const {
  refresh();
  q.setZero(all_);
  v.setZero(all_);
  q.head(own_) = y.head(own_);
  v.head(own_) = y.segment(own_, own_);
}

template <int D>
void AssemblyEquations<D>::contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const {
  y.head(own_) = q.head(own_);
  y.segment(own_, own_) = v.head(own_);
}

template <int D>
void AssemblyEquations<D>::gather(const View& view, const Eigen::VectorXd& whole, Eigen::VectorXd& own) const {
  own.resize(view.own + view.multipliers);
  own.head(view.own) = whole.segment(view.first, view.own);
  own.tail(view.multipliers) = whole.segment(view.first_multiplier, view.multipliers);
}

template <int D>
void AssemblyEquations<D>::scatter(const View& view, const Eigen::VectorXd& own, Eigen::VectorXd& whole) const {
  whole.segment(view.first, view.own) = own.head(view.own);
  whole.segment(view.first_multiplier, view.multipliers) = own.tail(view.multipliers);
}

template <int D>
void AssemblyEquations<D>::touch(const Eigen::VectorXd& q, bool rates, Eigen::VectorXd& h) const {
  const auto& handles = system_.handles();
  h.resize(static_cast<Eigen::Index>(D * handles.size()));
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const std::size_t member = system_.end(i).member;
    const double* const at = member == LinkEnd<D>::no_member ? nullptr : q.data() + views_[member].first;
    h.template segment<D>(static_cast<Eigen::Index>(D * i)) = rates ? handles[i].rate(at) : handles[i].value(at);
  }
}

template <int D>
LinkVector AssemblyEquations<D>::part_of(const Eigen::VectorXd& touched, std::size_t link) const {
  return touched.segment(static_cast<Eigen::Index>(D * system_.first_end(link)),
                         static_cast<Eigen::Index>(D * system_.links()[link].ends.size()));
}

template <int D>
double AssemblyEquations<D>::spring_forces(const Eigen::VectorXd& h, const Eigen::VectorXd& rate,
                                           Eigen::VectorXd& force) const {
  double lost = 0;
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const auto& spring = system_.links()[k].spring;
    if (!spring) continue;
    const SpringNow<D> now(*spring, part_of(h, k), part_of(rate, k));
    if (!now.bears) continue;
    const auto at = static_cast<Eigen::Index>(D * system_.first_end(k));
    force.template segment<D>(at) += now.tension * now.along;
    force.template segment<D>(at + D) -= now.tension * now.along;
    lost += (now.tension - spring->stiffness * now.stretch) * now.rate;
  }
  return lost;
}

template <int D>
void AssemblyEquations<D>::hand_out(const Eigen::VectorXd& forces) const {
  for (std::size_t b = 0; b < views_.size(); ++b) {
    auto& all = system_.member(b).link_forces().all;
    all.resize(views_[b].handles.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t handle = views_[b].handles[i];
      all[i].handle = &system_.handles()[handle];
      all[i].force = forces.template segment<D>(static_cast<Eigen::Index>(D * handle));
    }
  }
}

template <int D>
double AssemblyEquations<D>::link_forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                         Eigen::VectorXd& forces) const {
  touch(q, false, h_);
  touch(v, true, rate_);
  forces.setZero(h_.size());
  const double lost = spring_forces(h_, rate_, forces);
  Eigen::Index row = all_ - conditions_;
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const LinkVector own = part_of(h_, k);
    const auto at = static_cast<Eigen::Index>(D * system_.first_end(k));
    for (const LinkCondition& condition : system_.links()[k].conditions) {
      forces.segment(at, own.size()) -= unit_ * a[row++] * condition.slope(own);
    }
  }
  return lost;
}

template <int D>
void AssemblyEquations<D>::write_conditions(const Eigen::VectorXd& h, double* values) const {
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const LinkVector own = part_of(h, k);
    for (const LinkCondition& condition : system_.links()[k].conditions) *values++ = condition.value(own);
  }
}

template <int D>
double AssemblyEquations<D>::residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                      double t, Eigen::VectorXd& r) {
  refresh();
  r.resize(all_);
  double lost = link_forces(q, v, a, forces_);
  hand_out(forces_);
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    gather(view, a, view.a);
    view.r.resize(view.q.size());
    lost += view.equations->residual(view.q, view.v, view.a, t, view.r);
    scatter(view, view.r, r);
  }
  write_conditions(h_, r.data() + all_ - conditions_);
  return lost;
}

template <int D>
bool AssemblyEquations<D>::inertia(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double t, Eigen::VectorXd& r) {
  refresh();
  r.setZero(all_);
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, a, view.a);
    view.r.resize(view.q.size());
    if (!view.equations->inertia(view.q, view.a, t, view.r)) return false;
    scatter(view, view.r, r);
  }
  return true;
}

template <int D>
ConstraintResidual AssemblyEquations<D>::constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                             double t) const {
  refresh();
  ConstraintResidual largest;
  for (const View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    const ConstraintResidual own = view.equations->constraint_residual(view.q, view.v, t);
    largest.position = std::max(largest.position, own.position);
    largest.velocity = std::max(largest.velocity, own.velocity);
  }
  touch(q, false, h_);
  touch(v, true, rate_);
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const LinkVector own = part_of(h_, k), moving = part_of(rate_, k);
    for (const LinkCondition& condition : system_.links()[k].conditions) {
      largest.position = std::max(largest.position, std::abs(condition.value(own)));
      largest.velocity = std::max(largest.velocity, std::abs(condition.slope(own).dot(moving)));
    }
  }
  return largest;
}

template <int D>
bool AssemblyEquations<D>::driven() const {
  return std::ranges::any_of(views_, [](const View& view) { return view.equations->driven(); });
}

template <int D>
bool AssemblyEquations<D>::driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const {
  refresh();
  bool any = false;
  offset.setZero(all_);
  for (const View& view : views_) {
    gather(view, q, view.q);
    if (!view.equations->driven_offset(view.q, t, view.r)) continue;
    scatter(view, view.r, offset);
    any = true;
  }
  return any;
}

template <int D>
double AssemblyEquations<D>::turning(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
  double most = 0;
  for (const View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    most = std::max(most, view.equations->turning(view.q, view.v));
  }
  return most;
}

template <int D>
EnergyBalance AssemblyEquations<D>::supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                   const Eigen::VectorXd& a, double t) {
  refresh();
  link_forces(q, v, a, forces_);
  hand_out(forces_);
  EnergyBalance power;
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    gather(view, a, view.a);
    power = power + view.equations->supplied_power(view.q, view.v, view.a, t);
  }
  return power;
}

template <int D>
std::optional<double> AssemblyEquations<D>::power_lost_between(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                                               const Eigen::VectorXd& a0, const Eigen::VectorXd& a1,
                                                               double h, double t) {
  if (!balance().dissipated) return std::nullopt;
  middle_q_ = 0.5 * (q0 + q1);
  middle_v_ = (q1 - q0) / h;
  middle_a_ = 0.5 * (a0 + a1);
  return residual(middle_q_, middle_v_, middle_a_, t + h / 2, middle_r_);
}

template <int D>
void AssemblyEquations<D>::follow(const SecondOrderSystem& other) {
  const auto& leader = dynamic_cast<const AssemblyEquations&>(other);
  leader.refresh();
  refresh();
  unit_ = leader.unit_;
  for (std::size_t b = 0; b < views_.size(); ++b) views_[b].equations->follow(*leader.views_[b].equations);
}

template <int D>
void AssemblyEquations<D>::exchange(Archive& memory) {
  refresh();
  memory(unit_);
  for (View& view : views_) view.equations->exchange(memory);
}

template class AssemblyEquations<2>;
template class AssemblyEquations<3>;

}  // namespace vlbeam
