#include "core/system/static_equations.hpp"

#include "core/element/moving_tangent.hpp"
#include "core/geometry/dense.hpp"

namespace vlbeam {

template <int D>
Kinks<D>& StaticEquations<D>::kinks() const {
  if (revision_ != system_.revision()) {
    revision_ = system_.revision();
    kinks_.adopt(system_, true);
  }
  for (auto& kink : kinks_.all()) kink.suspended = suspended(kink.joint);
  return kinks_;
}

template <int D>
void StaticEquations<D>::choose_conditions(Eigen::VectorXd& u) {
  const Eigen::Index first = system_.coordinates();
  kinks().choose(u.data(), [&](Eigen::Index at, int count) { u.segment(first + at, count).setZero(); });
}

template <int D>
template <class Function>
void StaticEquations<D>::at_parts(const Function& function) const {
  for (const MovingPart& part : system_.moving_parts()) {
    switch (part.ends) {
      case MovingEnds::a:
        function.template operator()<MovingEnds::a>(part);
        break;
      case MovingEnds::b:
        function.template operator()<MovingEnds::b>(part);
        break;
      case MovingEnds::both:
        function.template operator()<MovingEnds::both>(part);
        break;
    }
  }
}

template <int D>
void StaticEquations<D>::reactions(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const {
  const auto& model = system_.model();
  prepare();
  const ChainView<D> beam = view(u);
  const Vec<double, D> gravity = system_.gravity(factor), on_beam = system_.beam_gravity(factor);
  r.setZero(size());
  system_.left().add_forces(u.data(), zero_.data(), on_beam, r.data());
  system_.right().add_forces(u.data(), zero_.data(), on_beam, r.data());
  for (const auto& span : system_.between()) span.span().add_forces(u.data(), zero_.data(), on_beam, r.data());
  model.loads.add_forces(beam, factor, r.data());
  if (model.masses.present()) model.masses.add_weight(beam, gravity, r.data());
  r = -r;
  if (!system_.has_joint()) return;
  if (model.masses.present()) model.masses.add_residual(beam, zero_.data(), gravity, r.data());
  auto law_at = system_.moving_law(factor);
  at_parts([&]<MovingEnds Ends>(const MovingPart& part) {
    const auto rest = system_.rest_of(part, u.data());
    law_at.rest = rest ? &*rest : nullptr;
    const int k = part.element;
    const MovingCoordinates<double, D> still = beam.rates(k);
    const auto of =
        moving_residual<Ends, double, D>(beam.coordinates(k), still, still, beam.weights(k), part.table, law_at);
    for (int i = 0; i < 4; ++i) {
      Eigen::Map<Vec<double, D>>(r.data() + beam.vector(k, i)) += of.nodes[static_cast<std::size_t>(i)];
    }
    std::size_t end = 0;
    for (const int which : {part.a, part.b}) {
      if (which >= 0) r[mark(static_cast<std::size_t>(which))] += of.ends[end++];
    }
  });
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    position<D>(r.data(), system_.places()[which].node) -= system_.joint(which).law.mass * gravity;
  }
  const Eigen::Index at = system_.coordinates();
  kinks().add_residual(u.data(), u.data() + at, 1, r.data(), r.data() + at);
}

template <int D>
void StaticEquations<D>::residual(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const {
  reactions(u, factor, r);
  system_.holding().project(r.data());
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (holds(which)) r[mark(which)] = 0;
  }
}

template <int D>
void StaticEquations<D>::assemble(const Eigen::VectorXd& u, double factor, double by_a) {
  const auto& model = system_.model();
  prepare();
  const ChainView<D> beam = view(u);
  tangent_.start(system_.mesh().last() + 1, system_.places());
  const TangentWeights by{1, 0, by_a};
  auto *diagonal = tangent_.diagonal.data(), *upper = tangent_.upper.data(), *lower = tangent_.lower.data();
  system_.left().add_tangent(u.data(), zero_.data(), by, diagonal, upper, lower);
  system_.right().add_tangent(u.data(), zero_.data(), by, diagonal, upper, lower);
  for (const auto& span : system_.between()) {
    span.span().add_tangent(u.data(), zero_.data(), by, diagonal, upper, lower);
  }
  const auto add_part = [&](int k, const auto& matrix) { tangent_.add_point(beam, k, matrix); };
  if (system_.has_joint()) {
    auto law_at = system_.moving_law(factor);
    at_parts([&]<MovingEnds Ends>(const MovingPart& part) {
      const auto rest = system_.rest_of(part, u.data());
      law_at.rest = rest ? &*rest : nullptr;
      const int k = part.element;
      const MovingCoordinates<double, D> still = beam.rates(k);
      const std::array<int, 2> marks = Ends == MovingEnds::a   ? std::array{part.a, -1}
                                       : Ends == MovingEnds::b ? std::array{part.b, -1}
                                                               : std::array{part.a, part.b};
      tangent_.add_element(
          beam, k, moving_tangent<Ends, D>(beam.coordinates(k), still, still, by, beam.weights(k), part.table, law_at),
          marks);
    });
    for (std::size_t which = 0; which < system_.places().size(); ++which) {
      tangent_.add_mass(system_.places()[which].node, by_a * system_.joint(which).law.mass);
    }
  }
  model.loads.add_tangent(beam, factor, by, add_part);
  model.masses.add_tangent(beam, zero_.data(), system_.gravity(factor), by, add_part);
}

template <int D>
bool StaticEquations<D>::linearize(const Eigen::VectorXd& u, double factor, double by_a) {
  assemble(u, factor, by_a);
  kinks().add_curvature(u.data() + system_.coordinates(), 1, tangent_);
  kinks().add_rows(u.data(), 1, tangent_);
  system_.holding().project(tangent_);
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
  const Eigen::Index n = system_.coordinates();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  tangent_.expand(matrix);
  return matrix;
}

template <int D>
Eigen::MatrixXd StaticEquations<D>::directions(const Eigen::VectorXd& u) const {
  const Eigen::MatrixXd free = system_.holding().directions(system_.coordinates());
  if (!system_.has_joint()) return free;
  const Eigen::MatrixXd ties = kinks().normals(u.data(), system_.coordinates());
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
