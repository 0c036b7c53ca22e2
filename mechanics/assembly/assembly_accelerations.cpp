// Accelerations and impulses that links allow: explicit methods, starts, events.
#include <algorithm>

#include "mechanics/assembly/assembly_equations.hpp"

namespace vlbeam {

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

template void AssemblyEquations<2>::mobility(const Eigen::VectorXd&, const Eigen::VectorXd&, double, Eigen::VectorXd&,
                                             Eigen::MatrixXd&);
template Eigen::MatrixXd AssemblyEquations<2>::gradients(const Eigen::VectorXd&) const;
template double AssemblyEquations<2>::find_acceleration(const Eigen::VectorXd&, const Eigen::VectorXd&, double,
                                                        Eigen::VectorXd&);
template void AssemblyEquations<2>::push(Eigen::VectorXd&, const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                         const Eigen::VectorXd&, double);
template void AssemblyEquations<2>::project(const Eigen::VectorXd&, Eigen::VectorXd&, double);
template void AssemblyEquations<2>::approach(Eigen::VectorXd&, Eigen::VectorXd&, double);
template void AssemblyEquations<3>::mobility(const Eigen::VectorXd&, const Eigen::VectorXd&, double, Eigen::VectorXd&,
                                             Eigen::MatrixXd&);
template Eigen::MatrixXd AssemblyEquations<3>::gradients(const Eigen::VectorXd&) const;
template double AssemblyEquations<3>::find_acceleration(const Eigen::VectorXd&, const Eigen::VectorXd&, double,
                                                        Eigen::VectorXd&);
template void AssemblyEquations<3>::push(Eigen::VectorXd&, const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                         const Eigen::VectorXd&, double);
template void AssemblyEquations<3>::project(const Eigen::VectorXd&, Eigen::VectorXd&, double);
template void AssemblyEquations<3>::approach(Eigen::VectorXd&, Eigen::VectorXd&, double);

}  // namespace vlbeam
