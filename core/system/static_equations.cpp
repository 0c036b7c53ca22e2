#include "core/system/static_equations.hpp"

#include <Eigen/QR>

#include "core/element/moving_tangent.hpp"
#include "core/system/free_directions.hpp"

namespace vlbeam {

template <int D>
SlopeConditions<D> StaticEquations<D>::slope_conditions() const {
  if (!system_.kinked()) return {};
  const Support<D>* held = this->held();
  const bool sleeve = held != nullptr && (held->free_slope == 0).any();  // both slopes are along it already
  if (sleeve && law().slopes == JointSlopes::tangent) return {};
  return {law().slopes, omitted_axis_};
}

template <int D>
int StaticEquations<D>::conditions() const {
  return slope_conditions().count();
}

template <int D>
void StaticEquations<D>::choose_conditions(Eigen::VectorXd& u) {
  if (D == 2 || conditions() == 0) return;
  const Vec<double, D> before = slope<D>(u.data(), place().node);
  if (std::abs(before[omitted_axis_]) >= 0.4 * before.norm()) return;
  omitted_axis_ = longest_axis<D>(before);
  u.tail(conditions()).setZero();
}

template <int D>
template <class Function>
void StaticEquations<D>::at_held_nodes(const Function& function) const {
  function(0, system_.model().start);
  function(system_.mesh().last(), system_.model().end);
  if (const Support<D>* held = this->held()) function(place().node, *held);
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
  model.loads.add_forces(beam, factor, r.data());
  if (model.masses.present()) model.masses.add_weight(beam, gravity, r.data());
  r = -r;
  if (!system_.has_joint()) return;
  if (model.masses.present()) model.masses.add_residual(beam, zero_.data(), gravity, r.data());
  auto law_at = system_.moving_law(factor);
  const auto add_element = [&]<MovingEnds Ends>(const MovingPart& part) {
    const auto rest = system_.rest_of(part, u.data(), system_.places());
    law_at.rest = rest ? &*rest : nullptr;
    const int k = part.element;
    const MovingCoordinates<double, D> still = beam.rates(k);
    const auto of =
        moving_residual<Ends, double, D>(beam.coordinates(k), still, still, beam.weights(k), part.table, law_at);
    for (int i = 0; i < 4; ++i) {
      Eigen::Map<Vec<double, D>>(r.data() + beam.vector(k, i)) += of.nodes[static_cast<std::size_t>(i)];
    }
    r[mark()] += of.ends[0];
  };
  const int j = place().node;
  add_element.template operator()<MovingEnds::b>(system_.moving_parts()[0]);
  add_element.template operator()<MovingEnds::a>(system_.moving_parts()[1]);
  position<D>(r.data(), j) -= law().mass * gravity;
  const Conditions conditions = slope_conditions();
  if (conditions.count() == 0) return;
  const Eigen::Index first = system_.coordinates();
  if (suspended()) {
    r.tail(conditions.count()) = u.tail(conditions.count());
    return;
  }
  const auto slopes = system_.joint_slopes(0, u.data());
  for (int i = 0; i < conditions.count(); ++i) {
    const typename Conditions::Slopes force = u[first + i] * conditions.gradient(i, slopes);
    slope<D>(r.data(), j) += force.template head<D>();
    Eigen::Map<Vec<double, D>>(r.data() + place().behind) += force.template tail<D>();
    r[first + i] = conditions.value(i, slopes);
  }
}

template <int D>
void StaticEquations<D>::residual(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const {
  reactions(u, factor, r);
  at_held_nodes([&](int node, const Support<D>& support) {
    position<D>(r.data(), node) = keep(support, support.free_position) * position<D>(r.data(), node);
    slope<D>(r.data(), node) = keep(support, support.free_slope) * slope<D>(r.data(), node);
  });
  if (holds_joint()) r[mark()] = 0;
  const Support<D>* held = this->held();
  if (held == nullptr || !system_.kinked()) return;
  Eigen::Map<Vec<double, D>> behind(r.data() + place().behind);
  behind = keep(*held, held->free_slope) * behind;
}

/// Adds the matrix of an element, (r_A, s_A, r_B, s_B, x_A, x_B), to blocks and border.
template <int D>
void StaticEquations<D>::add(const ChainView<D>& beam, int element, const PointMatrix<D>& matrix) {
  constexpr int N = 4 * D + 1;
  const Eigen::Index nodal = mark();
  const bool a_moves = beam.joint_at(element) != nullptr;
  const int rows = beam.at_joint(element) ? N : N - 1;
  std::array<Eigen::Index, N> at{};
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < D; ++c) at[static_cast<std::size_t>(D * i + c)] = beam.vector(element, i) + c;
  }
  at[N - 1] = nodal;
  const auto entry = [&](int i) { return i < N - 1 || a_moves ? i : i + 1; };
  for (int i = 0; i < rows; ++i) {
    const Eigen::Index row = at[static_cast<std::size_t>(i)];
    const auto node = static_cast<std::size_t>(row / B);
    for (int j = 0; j < rows; ++j) {
      const Eigen::Index column = at[static_cast<std::size_t>(j)];
      const auto to = static_cast<std::size_t>(column / B);
      if (row < nodal && column < nodal) {
        auto& block = to == node ? tangent_.diagonal[node] : to > node ? tangent_.upper[node] : tangent_.lower[node];
        block(row % B, column % B) += matrix(entry(i), entry(j));
      } else if (row < nodal) {
        auto& border = tangent_.border[static_cast<std::size_t>(column - nodal)];
        border.column[node - static_cast<std::size_t>(border.first)][row % B] += matrix(entry(i), entry(j));
      } else if (column < nodal) {
        auto& border = tangent_.border[static_cast<std::size_t>(row - nodal)];
        border.row[to - static_cast<std::size_t>(border.first)][column % B] += matrix(entry(i), entry(j));
      } else {
        tangent_.corner(row - nodal, column - nodal) += matrix(entry(i), entry(j));
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
  auto *diagonal = tangent_.diagonal.data(), *upper = tangent_.upper.data(), *lower = tangent_.lower.data();
  system_.left().add_tangent(u.data(), zero_.data(), 0, by_a, diagonal, upper, lower);
  system_.right().add_tangent(u.data(), zero_.data(), 0, by_a, diagonal, upper, lower);
  const auto add_part = [&](int k, const auto& matrix) { add(beam, k, matrix); };
  if (system_.has_joint()) {
    const int j = place().node;
    for (Eigen::Index i = mark(); i < system_.coordinates(); ++i) tangent_.add_border(j - 1);
    auto law_at = system_.moving_law(factor);
    const auto add_element = [&]<MovingEnds Ends>(const MovingPart& part) {
      const auto rest = system_.rest_of(part, u.data(), system_.places());
      law_at.rest = rest ? &*rest : nullptr;
      const int k = part.element;
      const MovingCoordinates<double, D> still = beam.rates(k);
      // with a row and a column of each end's mark, as those of points inside it have
      const auto own =
          moving_tangent<Ends, D>(beam.coordinates(k), still, still, 0, by_a, beam.weights(k), part.table, law_at);
      constexpr int X = 4 * D, at = Ends == MovingEnds::a ? X : X + 1;
      PointMatrix<D> matrix = PointMatrix<D>::Zero();
      matrix.template topLeftCorner<X, X>() = own.template topLeftCorner<X, X>();
      matrix.template block<X, 1>(0, at) = own.template topRightCorner<X, 1>();
      matrix.template block<1, X>(at, 0) = own.template bottomLeftCorner<1, X>();
      matrix(at, at) = own(X, X);
      add(beam, k, matrix);
    };
    add_element.template operator()<MovingEnds::b>(system_.moving_parts()[0]);
    add_element.template operator()<MovingEnds::a>(system_.moving_parts()[1]);
    tangent_.diagonal[static_cast<std::size_t>(j)].template topLeftCorner<D, D>().diagonal().array() +=
        by_a * law().mass;
  }
  model.loads.add_tangent(beam, factor, add_part);
  model.masses.add_tangent(beam, zero_.data(), system_.gravity(factor), 0, by_a, add_part);
}

/// What the multipliers change of the coordinates' tangent.
template <int D>
void StaticEquations<D>::add_conditions(const Eigen::VectorXd& u) {
  const Conditions conditions = slope_conditions();
  if (conditions.count() == 0 || suspended()) return;
  const auto j = static_cast<std::size_t>(place().node);
  const Eigen::Index first = system_.coordinates();
  for (int i = 0; i < conditions.count(); ++i) {
    const typename Conditions::Form curvature = u[first + i] * conditions.form(i);
    tangent_.diagonal[j].template bottomRightCorner<D, D>() += curvature.template topLeftCorner<D, D>();
    for (int c = 0; c < D; ++c) {  // s+ is the border behind x
      auto& border = tangent_.border[static_cast<std::size_t>(1 + c)];
      border.column[1].template tail<D>() += curvature.template topRightCorner<D, D>().col(c);
      border.row[1].template tail<D>() += curvature.template bottomLeftCorner<D, D>().row(c).transpose();
    }
    tangent_.corner.template block<D, D>(1, 1) += curvature.template bottomRightCorner<D, D>();
  }
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
  if (held_) {
    kept(0, 0) = 0;
    size[0] = system_.model().section.stiffness.EA / system_.mesh().length();
  }
  const Support<D>* held = this->held();
  if (held != nullptr && system_.kinked()) {
    kept.template block<D, D>(1, 1) = keep(*held, held->free_slope);
    size.template segment<D>(1).setConstant(slope_size(static_cast<std::size_t>(place().node)));
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
  const Conditions conditions = slope_conditions();
  if (conditions.count() > 0) {
    const auto slopes = system_.joint_slopes(0, u.data());
    const int j = place().node;
    for (int i = 0; i < conditions.count(); ++i) {
      const typename Conditions::Slopes gradient = conditions.gradient(i, slopes);
      auto& border = tangent_.add_border(j - 1);
      if (suspended()) {
        tangent_.corner(tangent_.borders() - 1, tangent_.borders() - 1) = 1;
        continue;
      }
      border.column[1].template tail<D>() = border.row[1].template tail<D>() = gradient.template head<D>();
      const Eigen::Index own = tangent_.borders() - 1;
      tangent_.corner.template block<D, 1>(1, own) = gradient.template tail<D>();
      tangent_.corner.template block<1, D>(own, 1) = gradient.template tail<D>().transpose();
    }
  }
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
  const Conditions conditions = slope_conditions();
  const int held = holds_joint() ? 1 : 0, count = conditions.count() > 0 && suspended() ? 0 : conditions.count(),
            rows = held + count;
  if (rows == 0) return free;
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(system_.coordinates(), rows);
  if (held > 0) gradients(mark(), 0) = 1;
  for (int i = 0; i < count; ++i) {
    const typename Conditions::Slopes gradient = conditions.gradient(i, system_.joint_slopes(0, u.data()));
    gradients.col(held + i).template segment<D>(Eigen::Index{B} * place().node + D) = gradient.template head<D>();
    gradients.col(held + i).template segment<D>(place().behind) = gradient.template tail<D>();
  }
  // what is orthogonal to the gradients within the free directions
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(free.transpose() * gradients);
  const Eigen::MatrixXd all = qr.householderQ();
  return free * all.rightCols(free.cols() - rows);
}

template class StaticEquations<2>;
template class StaticEquations<3>;

}  // namespace vlbeam
