#include "mechanics/motion/system/beam_mass.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/dense.hpp"

namespace vlbeam {

template <int D>
void BeamMass<D>::adopt() {
  const BeamModel<D>& model = beam_.model();
  const Mesh& mesh = beam_.mesh();
  if (model.driven()) {
    for (const std::size_t end : {0, 1}) {
      const std::size_t k = end == 0 ? 0 : static_cast<std::size_t>(mesh.elements()) - 1;
      const Weights<double>& w = mesh.weights[k].w;
      end_inertia_[end] = fixed_inertia(mesh.x[k], mesh.x[k + 1], w, beam_.rules().of(w), model.pieces);
    }
  }
  if (!chained()) return;
  std::vector<typename JointChain<D>::Joint> joints;
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    joints.push_back({&beam_.joint(i).law, beam_.held(i), beam_.places()[i]});
  }
  joint_chain_.layout(beam_.left(), beam_.right(), beam_.between(), beam_.moving_parts(), std::move(joints));
}

template <int D>
bool BeamMass<D>::chained() const {
  if (beam_.places().size() > 1) return true;
  return beam_.has_joint() && (beam_.guides(0) || beam_.feeds(0) || beam_.ties(0) || couples());
}

template <int D>
JointMotion<D> BeamMass<D>::joint_motion(std::size_t which, const double* q, const double* rate, double t) const {
  const auto guide = beam_.guided(which, t);
  return {beam_.joint_slopes(which, q),
          beam_.joint_slopes(which, rate),
          rate[beam_.places()[which].mark],
          beam_.gravity(t),
          guide ? std::optional(guide->acceleration) : std::nullopt,
          beam_.turning_inertia(which, q)};
}

template <int D>
std::optional<JointPower> BeamMass<D>::solve_chain(const JointElements& elements,
                                                   const std::vector<JointMotion<D>>& motions, double* force,
                                                   const BeamPart& part) {
  if (chained()) return joint_chain_.solve(elements, motions, force, part);
  const auto lost = solve_with_joint(beam_.left(), beam_.right(), elements[0], elements[1], beam_.joint(0).law,
                                     motions[0], beam_.held(0), force, force + beam_.places()[0].mark, part);
  return lost ? std::optional(JointPower{.dissipated = *lost}) : std::nullopt;
}

/// Unknowns may tie each joint's x'' to those of all others, but little: by rounds.
template <int D>
std::optional<JointPower> BeamMass<D>::solve_joints(const JointElements& elements,
                                                    const std::vector<JointMotion<D>>& motions, double* force) {
  const std::size_t count = beam_.places().size();
  if (!couples() || count < 2) return solve_chain(elements, motions, force);
  constexpr int most_rounds = 50;
  constexpr double settled = 1e-14;
  round_forces_ = Eigen::Map<const Eigen::VectorXd>(force, beam_.coordinates());
  std::vector<double>& x = round_marks_;
  x.assign(count, 0);

  for (int round = 0; round < most_rounds; ++round) {
    Eigen::Map<Eigen::VectorXd>(force, beam_.coordinates()) = round_forces_;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        if (j != i) force[beam_.places()[i].mark] -= beam_.unknowns()->coupling(i, j) * x[j];
      }
    }
    const auto power = solve_chain(elements, motions, force);
    if (!power) return power;
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      change = std::max(change, std::abs(force[beam_.places()[i].mark] - x[i]));
      largest = std::max(largest, std::abs(force[beam_.places()[i].mark]));
      x[i] = force[beam_.places()[i].mark];
    }
    if (!(change > settled * largest)) return power;
  }
  return std::nullopt;
}

template <int D>
std::optional<PrescribedMotion<D>> BeamMass<D>::solve_without_joints(const double* q, const double* rate, double t,
                                                                     double* force) const {
  auto pull = prescribed({}, q, rate, force, t);
  solve_without_joint(beam_.left(), beam_.right(), force);
  if (pull) pull->complete(force);
  return pull;
}

template <int D>
bool BeamMass<D>::solve(const JointElements& elements, const double* q, double* p, const BeamPart& part) {
  if (!solve_apart(elements, q, p, part)) return false;
  const auto count = static_cast<Eigen::Index>(links_.all().size());
  return count == 0 || press(links_.all(), elements, q, Eigen::VectorXd::Zero(count), p);
}

template <int D>
bool BeamMass<D>::solve_apart(const JointElements& elements, const double* q, double* p, const BeamPart& part) {
  if (elements.empty()) {
    solve_without_joint(beam_.left(), beam_.right(), p);
    return beam_.loose() == nullptr || beam_.loose()->solve(q, p);
  }
  std::vector<JointMotion<D>> at_rest;
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    const auto kept = beam_.guides(i) || beam_.ties(i) ? std::optional(0.0) : std::nullopt;
    at_rest.push_back({beam_.joint_slopes(i, q), Eigen::Matrix<double, 2 * D, 1>::Zero(), 0, Vector::Zero(), kept,
                       beam_.turning_inertia(i, q)});
  }
  return solve_chain(elements, at_rest, p, part).has_value();
}

template <int D>
std::optional<Eigen::VectorXd> BeamMass<D>::press(const std::vector<BeamLink<D>>& links, const JointElements& elements,
                                                  const double* q, const Eigen::VectorXd& wanted, double* a) {
  const auto count = static_cast<Eigen::Index>(links.size());
  Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(beam_.coordinates(), count), by(count, count);  // M^-1 L, L^T M^-1 L
  Eigen::VectorXd lacking = wanted;
  const ChainView<D> beam = beam_.view(q, q);
  for (Eigen::Index i = 0; i < count; ++i) {
    const BeamLink<D>& link = links[static_cast<std::size_t>(i)];
    link.add_force(beam, 1, answers.col(i).data());
    if (!solve_apart(elements, q, answers.col(i).data())) return std::nullopt;
    lacking[i] -= link.dot(beam, a);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const BeamLink<D>& link = links[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < count; ++k) by(i, k) = link.dot(beam, answers.col(k).data());
    by(i, i) += link.mobility;
  }
  const Eigen::VectorXd forces = solve_pivoting(by, lacking);
  Eigen::Map<Eigen::VectorXd>(a, beam_.coordinates()) += answers * forces;
  return forces;
}

template <int D>
double BeamMass<D>::work_of_prescribed(const std::vector<BeamLink<D>>& links, const Eigen::VectorXd& forces,
                                       const JointElements& elements, const double* q, const double* rate,
                                       const Eigen::VectorXd& change) const {
  Eigen::VectorXd all(beam_.coordinates());
  multiply(elements, q, change.data(), all.data());
  double work = all.dot(Eigen::Map<const Eigen::VectorXd>(rate, beam_.coordinates()));
  for (std::size_t i = 0; i < links.size(); ++i) {
    work -= forces[static_cast<Eigen::Index>(i)] * links[i].dot(beam_.view(q, rate), rate);
  }
  return work;
}

template <int D>
void BeamMass<D>::multiply(const JointElements& elements, const double* q, const double* rate, double* out,
                           const BeamPart& part) const {
  beam_.clear(out, part);
  beam_.left().add_inertia(rate, out, part.before);
  beam_.right().add_inertia(rate, out, part.behind);
  for (const SpanBetween<D>& span : beam_.between()) span.span().add_inertia(rate, out);
  if (const auto* loose = beam_.loose()) loose->add_momentum(q, rate, loose->place(q, rate).v, out);
  for (std::size_t p = 0; p < beam_.moving_parts().size(); ++p) {
    const MovingPart& moving = beam_.moving_parts()[p];
    const auto& eq = elements[p];
    const auto e = beam_.view(rate, rate).coordinates(moving.element).e;
    const std::array<Vector, 4> nodal{e.r_a, e.s_a, e.r_b, e.s_b};
    const Eigen::Index a = moving.a < 0 ? -1 : beam_.places()[static_cast<std::size_t>(moving.a)].mark,
                       b = moving.b < 0 ? -1 : beam_.places()[static_cast<std::size_t>(moving.b)].mark;
    const double x_a = a < 0 ? 0 : rate[a], x_b = b < 0 ? 0 : rate[b];
    const auto to = beam_.vectors_of(out, moving.element);
    double on_a = eq.mass_aa * x_a + eq.mass_ab * x_b, on_b = eq.mass_ab * x_a + eq.mass_bb * x_b;
    for (std::size_t i = 0; i < 4; ++i) {
      Vector sum = eq.mass_a[i] * x_a + eq.mass_b[i] * x_b;
      for (std::size_t j = 0; j < 4; ++j) sum += eq.mass[i][j] * nodal[j];
      Eigen::Map<Vector>(to[i]) += sum;
      on_a += eq.mass_a[i].dot(nodal[i]);
      on_b += eq.mass_b[i].dot(nodal[i]);
    }
    if (a >= 0) out[a] += on_a;
    if (b >= 0) out[b] += on_b;
  }
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    position<D>(out, beam_.places()[i].node) += beam_.joint(i).law.mass * position<D>(rate, beam_.places()[i].node);
    out[beam_.places()[i].mark] += beam_.turning_inertia(i, q) * rate[beam_.places()[i].mark];
  }
}

template class BeamMass<2>;
template class BeamMass<3>;

}  // namespace vlbeam
