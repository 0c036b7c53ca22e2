#include "core/system/static_equations.hpp"

#include "core/element/moving_tangent.hpp"
#include "core/geometry/dense.hpp"
#include "core/system/free_directions.hpp"

namespace vlbeam {

template <int D>
SlopeConditions<D> StaticEquations<D>::slope_conditions(std::size_t which) const {
  if (!system_.kinked(which)) return {};
  const JointSlopes slopes = system_.joint(which).law.slopes;
  const Support<D>* held = system_.held(which);
  const bool sleeve = held != nullptr && (held->free_slope == 0).any();  // both slopes are along it already
  if (sleeve && slopes == JointSlopes::tangent) return {};
  return {slopes, omitted_axis_[static_cast<std::size_t>(system_.joint_index(which))]};
}

template <int D>
template <class Function>
void StaticEquations<D>::at_conditions(const Function& function) const {
  Eigen::Index at = system_.coordinates();
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    const Conditions conditions = slope_conditions(which);
    if (conditions.count() == 0) continue;
    function(which, conditions, at);
    at += conditions.count();
  }
}

template <int D>
int StaticEquations<D>::conditions() const {
  int count = 0;
  at_conditions([&](std::size_t, const Conditions& of, Eigen::Index) { count += of.count(); });
  return count;
}

template <int D>
int StaticEquations<D>::active_conditions() const {
  int count = 0;
  at_conditions(
      [&](std::size_t which, const Conditions& of, Eigen::Index) { count += suspended(which) ? 0 : of.count(); });
  return count;
}

template <int D>
void StaticEquations<D>::choose_conditions(Eigen::VectorXd& u) {
  if (D == 2) return;
  at_conditions([&](std::size_t which, const Conditions& of, Eigen::Index at) {
    const Vec<double, D> before = slope<D>(u.data(), system_.places()[which].node);
    int& omitted = omitted_axis_[static_cast<std::size_t>(system_.joint_index(which))];
    if (std::abs(before[omitted]) >= 0.4 * before.norm()) return;
    omitted = longest_axis<D>(before);
    u.segment(at, of.count()).setZero();
  });
}

template <int D>
template <class Function>
void StaticEquations<D>::at_held_nodes(const Function& function) const {
  function(0, system_.model().start);
  function(system_.mesh().last(), system_.model().end);
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (const Support<D>* held = system_.held(which)) function(system_.places()[which].node, *held);
  }
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
    const auto rest = system_.rest_of(part, u.data(), system_.places());
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
  at_conditions([&](std::size_t which, const Conditions& of, Eigen::Index at) {
    if (suspended(which)) {
      r.segment(at, of.count()) = u.segment(at, of.count());
      return;
    }
    const JointPlace& place = system_.places()[which];
    const auto slopes = system_.joint_slopes(which, u.data());
    for (int i = 0; i < of.count(); ++i) {
      const typename Conditions::Slopes force = u[at + i] * of.gradient(i, slopes);
      slope<D>(r.data(), place.node) += force.template head<D>();
      Eigen::Map<Vec<double, D>>(r.data() + place.behind) += force.template tail<D>();
      r[at + i] = of.value(i, slopes);
    }
  });
}

template <int D>
void StaticEquations<D>::residual(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const {
  reactions(u, factor, r);
  at_held_nodes([&](int node, const Support<D>& support) {
    position<D>(r.data(), node) = keep(support, support.free_position) * position<D>(r.data(), node);
    slope<D>(r.data(), node) = keep(support, support.free_slope) * slope<D>(r.data(), node);
  });
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (holds(which)) r[mark(which)] = 0;
    const Support<D>* held = system_.held(which);
    if (held == nullptr || !system_.kinked(which)) continue;
    Eigen::Map<Vec<double, D>> behind(r.data() + system_.places()[which].behind);
    behind = keep(*held, held->free_slope) * behind;
  }
}

/// Adds the matrix of an element, (r_A, s_A, r_B, s_B, x_A, x_B), to blocks and border.
template <int D>
void StaticEquations<D>::add(const ChainView<D>& beam, int element, const PointMatrix<D>& matrix) {
  const Eigen::Index nodal = Eigen::Index{B} * (system_.mesh().last() + 1);
  std::array<Eigen::Index, point_coordinates<D>> at{};  // where the rows stand, -1 where an end rests
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < D; ++c) at[static_cast<std::size_t>(D * i + c)] = beam.vector(element, i) + c;
  }
  const JointPlace *const a = beam.joint_at(element), *const b = beam.joint_at(element + 1);
  at[4 * D] = a != nullptr ? a->mark : -1;
  at[4 * D + 1] = b != nullptr ? b->mark : -1;
  for (int i = 0; i < point_coordinates<D>; ++i) {
    const Eigen::Index row = at[static_cast<std::size_t>(i)];
    if (row < 0) continue;
    const auto node = static_cast<std::size_t>(row / B);
    for (int j = 0; j < point_coordinates<D>; ++j) {
      const Eigen::Index column = at[static_cast<std::size_t>(j)];
      if (column < 0) continue;
      const auto to = static_cast<std::size_t>(column / B);
      if (row < nodal && column < nodal) {
        auto& block = to == node ? tangent_.diagonal[node] : to > node ? tangent_.upper[node] : tangent_.lower[node];
        block(row % B, column % B) += matrix(i, j);
      } else if (row < nodal) {
        auto& border = tangent_.border[static_cast<std::size_t>(column - nodal)];
        border.column[node - static_cast<std::size_t>(border.first)][row % B] += matrix(i, j);
      } else if (column < nodal) {
        auto& border = tangent_.border[static_cast<std::size_t>(row - nodal)];
        border.row[to - static_cast<std::size_t>(border.first)][column % B] += matrix(i, j);
      } else {
        tangent_.corner(row - nodal, column - nodal) += matrix(i, j);
      }
    }
  }
}

template <int D>
void StaticEquations<D>::assemble(const Eigen::VectorXd& u, double factor, double by_a) {
  const auto& model = system_.model();
  prepare();
  const ChainView<D> beam = view(u);
  tangent_.reset(system_.mesh().last() + 1);
  const TangentWeights by{1, 0, by_a};
  auto *diagonal = tangent_.diagonal.data(), *upper = tangent_.upper.data(), *lower = tangent_.lower.data();
  system_.left().add_tangent(u.data(), zero_.data(), by, diagonal, upper, lower);
  system_.right().add_tangent(u.data(), zero_.data(), by, diagonal, upper, lower);
  for (const auto& span : system_.between()) {
    span.span().add_tangent(u.data(), zero_.data(), by, diagonal, upper, lower);
  }
  const auto add_part = [&](int k, const auto& matrix) { add(beam, k, matrix); };
  if (system_.has_joint()) {
    for (const JointPlace& place : system_.places()) tangent_.add_border(place.node - 1);
    for (const JointPlace& place : system_.places()) {
      for (int c = 0; c < (place.behind < 0 ? 0 : D); ++c) tangent_.add_border(place.node - 1);
    }
    auto law_at = system_.moving_law(factor);
    at_parts([&]<MovingEnds Ends>(const MovingPart& part) {
      const auto rest = system_.rest_of(part, u.data(), system_.places());
      law_at.rest = rest ? &*rest : nullptr;
      const int k = part.element;
      const MovingCoordinates<double, D> still = beam.rates(k);
      // with a row and a column of each end's mark, as those of points inside it have
      const auto own =
          moving_tangent<Ends, D>(beam.coordinates(k), still, still, by, beam.weights(k), part.table, law_at);
      constexpr int X = 4 * D, ends = moving_ends<Ends>, at = Ends == MovingEnds::b ? X + 1 : X;
      PointMatrix<D> matrix = PointMatrix<D>::Zero();
      matrix.template topLeftCorner<X, X>() = own.template topLeftCorner<X, X>();
      matrix.template block<X, ends>(0, at) = own.template topRightCorner<X, ends>();
      matrix.template block<ends, X>(at, 0) = own.template bottomLeftCorner<ends, X>();
      matrix.template block<ends, ends>(at, at) = own.template bottomRightCorner<ends, ends>();
      add(beam, k, matrix);
    });
    for (std::size_t which = 0; which < system_.places().size(); ++which) {
      tangent_.diagonal[static_cast<std::size_t>(system_.places()[which].node)]
          .template topLeftCorner<D, D>()
          .diagonal()
          .array() += by_a * system_.joint(which).law.mass;
    }
  }
  model.loads.add_tangent(beam, factor, by, add_part);
  model.masses.add_tangent(beam, zero_.data(), system_.gravity(factor), by, add_part);
}

/// What the multipliers change of the coordinates' tangent.
template <int D>
void StaticEquations<D>::add_conditions(const Eigen::VectorXd& u) {
  const Eigen::Index nodal = Eigen::Index{B} * (system_.mesh().last() + 1);
  at_conditions([&](std::size_t which, const Conditions& of, Eigen::Index at) {
    if (suspended(which)) return;
    const JointPlace& place = system_.places()[which];
    const Eigen::Index behind = place.behind - nodal;  // in the border
    for (int i = 0; i < of.count(); ++i) {
      const typename Conditions::Form curvature = u[at + i] * of.form(i);
      tangent_.diagonal[static_cast<std::size_t>(place.node)].template bottomRightCorner<D, D>() +=
          curvature.template topLeftCorner<D, D>();
      for (int c = 0; c < D; ++c) {
        auto& border = tangent_.border[static_cast<std::size_t>(behind + c)];
        border.column[1].template tail<D>() += curvature.template topRightCorner<D, D>().col(c);
        border.row[1].template tail<D>() += curvature.template bottomLeftCorner<D, D>().row(c).transpose();
      }
      tangent_.corner.template block<D, D>(behind, behind) += curvature.template bottomRightCorner<D, D>();
    }
  });
}

/// Takes what is held out of rows and columns, and leaves its stiffness in its place.
template <int D>
void StaticEquations<D>::eliminate() {
  const int last = system_.mesh().last();
  const auto slope_size = [&](std::size_t k) {
    const double size = tangent_.diagonal[k].diagonal().template tail<D>().cwiseAbs().maxCoeff();
    return size > 0 ? size : 1;
  };
  at_held_nodes([&](int node, const Support<D>& support) {
    if ((support.free_position != 0).all() && (support.free_slope != 0).all()) return;
    Block kept = Block::Zero();
    kept.template topLeftCorner<D, D>() = keep(support, support.free_position);
    kept.template bottomRightCorner<D, D>() = keep(support, support.free_slope);
    const auto k = static_cast<std::size_t>(node);
    Eigen::Matrix<double, B, 1> size;
    size.template head<D>().setConstant(tangent_.diagonal[k].diagonal().template head<D>().cwiseAbs().maxCoeff());
    size.template tail<D>().setConstant(slope_size(k));
    tangent_.diagonal[k] = kept * tangent_.diagonal[k] * kept + size.asDiagonal() * (Block::Identity() - kept);
    if (node < last) {
      tangent_.upper[k] = kept * tangent_.upper[k];
      tangent_.lower[k + 1] = tangent_.lower[k + 1] * kept;
    }
    if (node > 0) {
      tangent_.lower[k] = kept * tangent_.lower[k];
      tangent_.upper[k - 1] = tangent_.upper[k - 1] * kept;
    }
    for (auto& border : tangent_.border) {
      const int reached = node - border.first;
      if (reached < 0 || reached >= BorderedBlockTridiagonal<B>::reach) continue;
      auto& column = border.column[static_cast<std::size_t>(reached)];
      auto& row = border.row[static_cast<std::size_t>(reached)];
      column = kept * column;
      row = kept * row;
    }
  });
  if (!system_.has_joint()) return;
  const int count = tangent_.borders();
  Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(count, count);
  Eigen::VectorXd size = Eigen::VectorXd::Ones(count);
  const Eigen::Index nodal = Eigen::Index{B} * (last + 1);
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    const JointPlace& place = system_.places()[which];
    if (holds(which)) {
      kept(place.mark - nodal, place.mark - nodal) = 0;
      size[place.mark - nodal] = system_.model().section.stiffness.EA / system_.mesh().length();
    }
    const Support<D>* held = system_.held(which);
    if (held == nullptr || place.behind < 0) continue;
    const Eigen::Index behind = place.behind - nodal;
    kept.template block<D, D>(behind, behind) = keep(*held, held->free_slope);
    size.template segment<D>(behind).setConstant(slope_size(static_cast<std::size_t>(place.node)));
  }
  for (std::size_t n = 0; n < BorderedBlockTridiagonal<B>::reach; ++n) {
    Eigen::MatrixXd columns(B, count), rows(B, count);
    for (int i = 0; i < count; ++i) {
      columns.col(i) = tangent_.border[static_cast<std::size_t>(i)].column[n];
      rows.col(i) = tangent_.border[static_cast<std::size_t>(i)].row[n];
    }
    columns = (columns * kept).eval();
    rows = (rows * kept).eval();
    for (int i = 0; i < count; ++i) {
      tangent_.border[static_cast<std::size_t>(i)].column[n] = columns.col(i);
      tangent_.border[static_cast<std::size_t>(i)].row[n] = rows.col(i);
    }
  }
  auto corner = tangent_.corner.topLeftCorner(count, count);
  corner = (kept * corner * kept).eval();
  corner += size.asDiagonal() * (Eigen::MatrixXd::Identity(count, count) - kept);
}

template <int D>
bool StaticEquations<D>::linearize(const Eigen::VectorXd& u, double factor, double by_a) {
  assemble(u, factor, by_a);
  add_conditions(u);
  const Eigen::Index nodal = Eigen::Index{B} * (system_.mesh().last() + 1);
  at_conditions([&](std::size_t which, const Conditions& of, Eigen::Index) {
    const JointPlace& place = system_.places()[which];
    const Eigen::Index behind = place.behind - nodal;
    const auto slopes = system_.joint_slopes(which, u.data());
    for (int i = 0; i < of.count(); ++i) {
      const typename Conditions::Slopes gradient = of.gradient(i, slopes);
      auto& border = tangent_.add_border(place.node - 1);
      const Eigen::Index own = tangent_.borders() - 1;
      if (suspended(which)) {
        tangent_.corner(own, own) = 1;
        continue;
      }
      border.column[1].template tail<D>() = border.row[1].template tail<D>() = gradient.template head<D>();
      tangent_.corner.template block<D, 1>(behind, own) = gradient.template tail<D>();
      tangent_.corner.template block<1, D>(own, behind) = gradient.template tail<D>().transpose();
    }
  });
  eliminate();
  return tangent_.factor();
}

template <int D>
Eigen::MatrixXd StaticEquations<D>::dense(const Eigen::VectorXd& u, double factor, double by_a) {
  assemble(u, factor, by_a);
  add_conditions(u);
  const Eigen::Index n = system_.coordinates();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  tangent_.expand(matrix);
  return matrix;
}

template <int D>
Eigen::MatrixXd StaticEquations<D>::directions(const Eigen::VectorXd& u) const {
  Eigen::MatrixXd free = free_directions(system_);
  if (!system_.has_joint()) return free;
  std::vector<Eigen::VectorXd> normals;
  for (std::size_t which = 0; which < system_.places().size(); ++which) {
    if (holds(which)) normals.push_back(Eigen::VectorXd::Unit(system_.coordinates(), mark(which)));
  }
  at_conditions([&](std::size_t which, const Conditions& of, Eigen::Index) {
    const JointPlace& place = system_.places()[which];
    for (int i = 0; i < (suspended(which) ? 0 : of.count()); ++i) {
      const typename Conditions::Slopes gradient = of.gradient(i, system_.joint_slopes(which, u.data()));
      Eigen::VectorXd& normal = normals.emplace_back(Eigen::VectorXd::Zero(system_.coordinates()));
      normal.template segment<D>(Eigen::Index{B} * place.node + D) = gradient.template head<D>();
      normal.template segment<D>(place.behind) = gradient.template tail<D>();
    }
  });
  if (normals.empty()) return free;
  const auto rows = static_cast<Eigen::Index>(normals.size());
  Eigen::MatrixXd gradients(system_.coordinates(), rows);
  for (Eigen::Index i = 0; i < rows; ++i) gradients.col(i) = normals[static_cast<std::size_t>(i)];
  // what is orthogonal to the gradients within the free directions
  const Eigen::MatrixXd all = orthogonal_factor(free.transpose() * gradients);
  return free * all.rightCols(free.cols() - rows);
}

template class StaticEquations<2>;
template class StaticEquations<3>;

}  // namespace vlbeam
