#include "mechanics/assembly/assembly_equations.hpp"

#include <algorithm>
#include <cmath>

namespace vlbeam {
namespace {

constexpr double redundant_share = 1e-11;  // of the largest pivot: below, a condition follows from others

}  // namespace

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

namespace {

/// A spring at one instant.
template <int D>
struct SpringNow {
  Vec<double, D> along;  ///< from the first point to the second, of length 1
  double length, stretch, rate, tension;
  bool bears;

  SpringNow(const LinkSpring& spring, const LinkVector& h, const LinkVector& v) {
    const Vec<double, D> apart = h.segment<D>(D) - h.segment<D>(0), moving = v.segment<D>(D) - v.segment<D>(0);
    length = apart.norm();
    along = length > 0 ? Vec<double, D>(apart / length) : Vec<double, D>::Unit(0);
    stretch = length - spring.length;
    rate = along.dot(moving);
    tension = spring.stiffness * stretch + spring.damping * rate;
    bears = !spring.tension_only || (stretch > 0 && tension > 0);
    if (!bears) tension = 0;
  }
};

}  // namespace

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
Eigen::MatrixXd AssemblyEquations<D>::gradients(const Eigen::VectorXd& h) const {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(conditions_, h.size());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const LinkVector own = part_of(h, k);
    for (const LinkCondition& condition : system_.links()[k].conditions) {
      rows.row(row++).segment(static_cast<Eigen::Index>(D * system_.first_end(k)), own.size()) =
          condition.slope(own).transpose();
    }
  }
  return rows;
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
void AssemblyEquations<D>::mobility(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& free,
                                    Eigen::MatrixXd& mobility) {
  const auto size = static_cast<Eigen::Index>(D * system_.handles().size());
  free.setZero(size);
  mobility.setZero(size, size);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(size);
  hand_out(unit);
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    view.equations->acceleration(view.q, view.v, t, view.a);
    for (const std::size_t i : view.handles) {
      free.template segment<D>(static_cast<Eigen::Index>(D * i)) = system_.handles()[i].rate(view.a.data());
    }
  }
  for (View& view : views_) {
    for (const std::size_t of : view.handles) {
      for (int c = 0; c < D; ++c) {
        const auto column = static_cast<Eigen::Index>(D * of + static_cast<std::size_t>(c));
        unit[column] = 1;
        hand_out(unit);
        unit[column] = 0;
        view.equations->acceleration(view.q, view.v, t, view.r);
        view.r -= view.a;
        for (const std::size_t i : view.handles) {
          mobility.template block<D, 1>(static_cast<Eigen::Index>(D * i), column) =
              system_.handles()[i].rate(view.r.data());
        }
      }
    }
  }
}

template <int D>
double AssemblyEquations<D>::find_acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                               Eigen::VectorXd& a) {
  refresh();
  a.setZero(all_);
  const Eigen::VectorXd h = touch(q, false), rate = touch(v, true);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(h.size());
  const double lost = spring_forces(h, rate, forces);
  if (conditions_ > 0) {
    Eigen::VectorXd free;
    Eigen::MatrixXd by_force;
    mobility(q, v, t, free, by_force);
    const Eigen::MatrixXd rows = gradients(h);
    Eigen::VectorXd wanted = rows * (free + by_force * forces);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < system_.links().size(); ++k) {
      for (const LinkCondition& condition : system_.links()[k].conditions) {
        wanted[row++] += condition.turning(part_of(rate, k));
      }
    }
    Eigen::FullPivLU<Eigen::MatrixXd> factors(rows * by_force * rows.transpose());
    factors.setThreshold(redundant_share);
    const Eigen::VectorXd pull = factors.solve(wanted);
    forces -= rows.transpose() * pull;
    unit_ =
        static_cast<double>(conditions_) / std::max((rows * by_force * rows.transpose()).trace(), 1e-300);  // a mass
    a.tail(conditions_) = pull / unit_;
    system_.redundant.clear();
    for (Eigen::Index i = factors.rank(); i < conditions_; ++i) {
      Eigen::Index at = factors.permutationQ().indices()[i];
      for (const Link<D>& link : system_.links()) {
        at -= static_cast<Eigen::Index>(link.conditions.size());
        if (at >= 0) continue;
        if (std::ranges::find(system_.redundant, link.name) == system_.redundant.end()) {
          system_.redundant.push_back(link.name);
        }
        break;
      }
    }
  }
  hand_out(forces);
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    view.equations->acceleration(view.q, view.v, t, view.a);
    scatter(view, view.a, a);
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

/// Impulses act on velocities as forces on accelerations.
template <int D>
void AssemblyEquations<D>::push(Eigen::VectorXd& what, const Eigen::MatrixXd& rows, const Eigen::MatrixXd& mobility,
                                const Eigen::VectorXd& off, double t) {
  Eigen::FullPivLU<Eigen::MatrixXd> factors(rows * mobility * rows.transpose());
  factors.setThreshold(redundant_share);
  const Eigen::VectorXd impulses = -rows.transpose() * factors.solve(off);
  hand_out(Eigen::VectorXd::Zero(impulses.size()));
  for (View& view : views_) view.equations->acceleration(view.q, view.v, t, view.a);
  hand_out(impulses);
  for (View& view : views_) {
    view.equations->acceleration(view.q, view.v, t, view.r);
    view.r -= view.a;
    what.segment(view.first, view.own) += view.r.head(view.own);
  }
  hand_out(Eigen::VectorXd::Zero(impulses.size()));
}

template <int D>
void AssemblyEquations<D>::project(const Eigen::VectorXd& q, Eigen::VectorXd& v, double t) {
  refresh();
  if (conditions_ == 0) return;
  Eigen::VectorXd free;
  Eigen::MatrixXd by_force;
  mobility(q, v, t, free, by_force);
  const Eigen::MatrixXd rows = gradients(touch(q, false));
  push(v, rows, by_force, rows * touch(v, true), t);
}

template <int D>
void AssemblyEquations<D>::approach(Eigen::VectorXd& q, Eigen::VectorXd& v, double t) {
  refresh();
  if (conditions_ == 0) return;
  Eigen::VectorXd free;
  Eigen::MatrixXd by_force;
  mobility(q, v, t, free, by_force);
  const Eigen::VectorXd h = touch(q, false);
  Eigen::VectorXd off(conditions_);
  write_conditions(h, off.data());
  push(q, gradients(h), by_force, off, t);
  const Eigen::MatrixXd rows = gradients(touch(q, false));
  push(v, rows, by_force, rows * touch(v, true), t);
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
Tally AssemblyEquations<D>::supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                           double t) {
  refresh();
  link_forces(q, v, a, forces_);
  hand_out(forces_);
  Tally power;
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
  if (!tallies().dissipated) return std::nullopt;
  middle_q_ = 0.5 * (q0 + q1);
  middle_v_ = (q1 - q0) / h;
  middle_a_ = 0.5 * (a0 + a1);
  return residual(middle_q_, middle_v_, middle_a_, t + h / 2, middle_r_);
}

template <int D>
bool AssemblyEquations<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                     double t, const TangentWeights& by) {
  refresh();
  link_forces(q, v, a, forces_);
  hand_out(forces_);
  const Eigen::VectorXd &h = h_, &rate = rate_;
  scale_ = by.a * unit_;
  gradients_ = gradients(h);
  curvature_.setZero(h.size(), h.size());
  Eigen::Index row = all_ - conditions_;
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const Link<D>& link = system_.links()[k];
    const auto at = static_cast<Eigen::Index>(D * system_.first_end(k));
    for (const LinkCondition& condition : link.conditions) {
      const Eigen::Index n = condition.curvature.rows();
      if (n > 0) curvature_.block(at, at, n, n) += by.q * unit_ * a[row] * condition.curvature;
      ++row;
    }
    if (!link.spring) continue;
    const SpringNow<D> now(*link.spring, part_of(h, k), part_of(rate, k));
    if (!now.bears || now.length == 0) continue;
    using Matrix = Eigen::Matrix<double, D, D>;
    const Matrix along = now.along * now.along.transpose(), across = (Matrix::Identity() - along) / now.length;
    const Vec<double, D> moving =
        rate.template segment<D>(at + D) - rate.template segment<D>(at);  // turns what it damps along
    const Matrix own = (by.q * link.spring->stiffness + by.v * link.spring->damping) * along +
                       by.q * (now.tension * across + link.spring->damping * now.along * (across * moving).transpose());
    curvature_.template block<D, D>(at, at) += own;
    curvature_.template block<D, D>(at + D, at + D) += own;
    curvature_.template block<D, D>(at, at + D) -= own;
    curvature_.template block<D, D>(at + D, at) -= own;
  }
  bent_.clear();
  for (Eigen::Index i = 0; i < h.size(); ++i) {
    if (!curvature_.row(i).isZero(0)) bent_.push_back(i);
  }
  Eigen::MatrixXd yielding = Eigen::MatrixXd::Zero(h.size(), h.size());  // F
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    gather(view, a, view.a);
    if (!view.equations->linearize(view.q, view.v, view.a, t, by)) return false;
    const auto count = static_cast<Eigen::Index>(D * view.handles.size());
    view.columns.resize(view.own + view.multipliers, count);
    Eigen::Index column = 0;
    for (const std::size_t of : view.handles) {
      for (int c = 0; c < D; ++c, ++column) {
        view.r.setZero(view.own + view.multipliers);
        system_.handles()[of].add_force(Vec<double, D>::Unit(c), view.r.data());
        view.equations->solve(view.r);
        view.columns.col(column) = view.r;
        for (const std::size_t i : view.handles) {
          yielding.template block<D, 1>(static_cast<Eigen::Index>(D * i),
                                        static_cast<Eigen::Index>(D * of + static_cast<std::size_t>(c))) =
              system_.handles()[i].rate(view.r.data());
        }
      }
    }
  }
  const auto bent = static_cast<Eigen::Index>(bent_.size()), size = bent + conditions_;
  if (size == 0) return true;
  const Eigen::MatrixXd by_force = yielding * gradients_.transpose();  // F G^T
  const Eigen::MatrixXd schur = gradients_ * by_force;
  force_size_ = conditions_ > 0 ? 1 / std::max(schur.diagonal().cwiseAbs().maxCoeff(), 1e-300) : 1;
  Eigen::MatrixXd whole(size, size);
  Eigen::MatrixXd by_bent(h.size(), bent);  // F L, of the t that L acts on
  for (Eigen::Index j = 0; j < bent; ++j)
    by_bent.col(j) = yielding * curvature_.col(bent_[static_cast<std::size_t>(j)]);
  for (Eigen::Index i = 0; i < bent; ++i) {
    const Eigen::Index at = bent_[static_cast<std::size_t>(i)];
    whole.row(i).head(bent) = by_bent.row(at);
    whole(i, i) += 1;
    whole.row(i).tail(conditions_) = force_size_ * by_force.row(at);
  }
  whole.bottomLeftCorner(conditions_, bent) = -gradients_ * by_bent;
  whole.bottomRightCorner(conditions_, conditions_) = -force_size_ * schur;
  dependent_ = !system_.redundant.empty();
  if (dependent_) {
    careful_factors_.compute(whole);
    careful_factors_.setThreshold(redundant_share);
  } else {
    factors_.compute(whole);
  }
  return true;
}

template <int D>
void AssemblyEquations<D>::solve(Eigen::VectorXd& r) const {
  Eigen::VectorXd& touched = touched_;
  touched.setZero(static_cast<Eigen::Index>(D * system_.handles().size()));
  for (const View& view : views_) {
    gather(view, r, view.r);
    view.equations->solve(view.r);
    for (const std::size_t i : view.handles) {
      touched.template segment<D>(static_cast<Eigen::Index>(D * i)) = system_.handles()[i].rate(view.r.data());
    }
  }
  const auto bent = static_cast<Eigen::Index>(bent_.size()), size = bent + conditions_;
  Eigen::VectorXd& pull = pull_;
  pull.setZero(touched.size());
  if (size > 0) {
    Eigen::VectorXd& right = right_;
    right.resize(size);
    for (Eigen::Index i = 0; i < bent; ++i) right[i] = touched[bent_[static_cast<std::size_t>(i)]];
    right.tail(conditions_) = r.tail(conditions_);
    right.tail(conditions_).noalias() -= gradients_ * touched;
    if (dependent_) {
      right = careful_factors_.solve(right).eval();
    } else {
      right = factors_.permutationP() * right;
      factors_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(right);
      factors_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(right);
    }
    const Eigen::VectorXd& answer = right;
    for (Eigen::Index i = 0; i < bent; ++i) pull += answer[i] * curvature_.col(bent_[static_cast<std::size_t>(i)]);
    eta_ = force_size_ * answer.tail(conditions_);
    pull.noalias() += gradients_.transpose() * eta_;
    r.tail(conditions_) = eta_ / scale_;
  }
  for (const View& view : views_) {
    Eigen::Index column = 0;
    for (const std::size_t i : view.handles) {
      view.r.noalias() -=
          view.columns.template middleCols<D>(column) * pull.template segment<D>(static_cast<Eigen::Index>(D * i));
      column += D;
    }
    scatter(view, view.r, r);
  }
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
void AssemblyEquations<D>::exchange(Memory& memory) {
  refresh();
  memory(unit_);
  for (View& view : views_) view.equations->exchange(memory);
}

template class AssemblyEquations<2>;
template class AssemblyEquations<3>;

}  // namespace vlbeam
