#include "mechanics/statics/static_equations.hpp"

#include "core/geometry/dense.hpp"

namespace vlbeam {

template <int D>
void StaticEquations<D>::refresh() const {
  if (revision_ == system_.revision()) return;
  revision_ = system_.revision();
  kinks_.adopt(system_, true);
  links_.adopt();
}

template <int D>
Kinks<D>& StaticEquations<D>::kinks() const {
  refresh();
  for (auto& kink : kinks_.all()) kink.suspended = suspended(kink.joint);
  return kinks_;
}

template <int D>
void StaticEquations<D>::choose_conditions(Eigen::VectorXd& u) {
  const Eigen::Index first = system_.coordinates();
  kinks().choose(u.data(), [&](Eigen::Index at, int count) { u.segment(first + at, count).setZero(); });
}

template <int D>
void StaticEquations<D>::reactions(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const {
  prepare();
  r.resize(size());
  equations_.residual(u, zero_, zero_, factor, r);
  const Eigen::Index at = system_.coordinates();
  const Kinks<D>& conditions = kinks();
  conditions.add_forces(u.data(), u.data() + at, 1, r.data());
  conditions.write_values(u.data(), u.data() + at, r.data() + at);
  const Eigen::Index first = at + conditions.count();
  links_.add_forces(u.data(), u.data() + first, 1 / length_, r.data());
  links_.write_values(u.data(), r.data() + first);
  r.tail(links_.count()) /= length_;
}

template <int D>
void StaticEquations<D>::residual(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const {
  reactions(u, factor, r);
  system_.supports().project(r.data());
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (holds(which)) r[mark(which)] = 0;
  }
}

template <int D>
void StaticEquations<D>::assemble(const Eigen::VectorXd& u, double factor, double by_a) {
  prepare();
  equations_.assemble(u, zero_, zero_, factor, {1, 0, by_a}, tangent_);
}

template <int D>
bool StaticEquations<D>::linearize(const Eigen::VectorXd& u, double factor, double by_a, const FreeTension<D>* forces) {
  assemble(u, factor, by_a);
  if (forces != nullptr) forces->add_to(u, tangent_);
  kinks().add_curvature(u.data() + system_.coordinates(), 1, tangent_);
  kinks().add_rows(u.data(), 1, tangent_);
  links_.add_curvature(u.data(), u.data() + size() - links_.count(), 1 / length_, tangent_);
  links_.stiffen(u.data(), stiffening() / (length_ * length_), tangent_);
  links_.add_rows(u.data(), 1 / length_, tangent_);
  system_.supports().project(tangent_);
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (!holds(which)) continue;
    tangent_.fix(static_cast<int>(which), system_.model().section.stiffness.EA / system_.mesh().length());
  }
  return tangent_.factor();
}

template <int D>
Eigen::MatrixXd StaticEquations<D>::dense(const Eigen::VectorXd& u, double factor, double by_a) {
  assemble(u, factor, by_a);
  kinks().add_curvature(u.data() + system_.coordinates(), 1, tangent_);
  links_.add_curvature(u.data(), u.data() + size() - links_.count(), 1 / length_, tangent_);
  const Eigen::Index n = system_.coordinates();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  tangent_.expand(matrix);
  return matrix;
}

template <int D>
Eigen::MatrixXd StaticEquations<D>::directions(const Eigen::VectorXd& u) const {
  const Eigen::MatrixXd free = system_.supports().directions(system_.coordinates());
  if (!system_.has_joint() && system_.links().all().empty()) return free;
  Eigen::MatrixXd ties = kinks().normals(u.data(), system_.coordinates());
  const Eigen::Index conditions = ties.cols();
  ties.conservativeResize(system_.coordinates(), conditions + links_.count());
  ties.rightCols(links_.count()).setZero();
  const ChainView<D> beam = system_.view(u.data(), u.data());
  for (Eigen::Index i = 0; i < links_.count(); ++i) {
    const BeamLink<D>& link = system_.links().all()[static_cast<std::size_t>(i)];
    link.add_force(beam, 1, ties.col(conditions + i).data());
  }
  std::vector<Eigen::Index> held;
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (holds(which)) held.push_back(mark(which));
  }
  const auto marks = static_cast<Eigen::Index>(held.size()), rows = marks + ties.cols();
  if (rows == 0) return free;
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(system_.coordinates(), rows);
  for (Eigen::Index i = 0; i < marks; ++i) gradients(held[static_cast<std::size_t>(i)], i) = 1;
  gradients.rightCols(ties.cols()) = ties;
  // what is orthogonal to the gradients within the free directions
  const Eigen::MatrixXd all = orthogonal_factor(free.transpose() * gradients);
  return free * all.rightCols(free.cols() - rows);
}

template class StaticEquations<2>;
template class StaticEquations<3>;

}  // namespace vlbeam
