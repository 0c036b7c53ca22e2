#include "core/system/implicit_beam.hpp"

#include "core/element/moving_tangent.hpp"

namespace vlbeam {
namespace {

template <class Function>
auto with_law(StrainLaw strain_law, bool bends, const Function& function) {
  auto measured = [&]<StrainLaw Law>() {
    return bends ? function.template operator()<Law, true>() : function.template operator()<Law, false>();
  };
  return strain_law == StrainLaw::green ? measured.template operator()<StrainLaw::green>()
                                        : measured.template operator()<StrainLaw::engineering>();
}

/// Coordinates of one of the two elements at the joint, from the nodal array and the joint's entry.
template <MovingEnds Ends, int D>
MovingCoordinates<double, D> element_of(const double* nodes, int k, double joint, double other) {
  return Ends == MovingEnds::a ? MovingCoordinates<double, D>{element_nodes<D>(nodes, k), joint, other}
                               : MovingCoordinates<double, D>{element_nodes<D>(nodes, k), other, joint};
}

}  // namespace

template <int D>
void ImplicitBeam<D>::refresh() {
  if (revision_ == system_.revision()) return;
  revision_ = system_.revision();
  y_.resize(system_.size());
  dydt_.resize(system_.size());
}

template <int D>
void ImplicitBeam<D>::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) {
  refresh();
  const Eigen::Index n = coordinates();
  y_.setZero();
  y_.head(n) = q;
  y_.segment(n, n) = v;
  system_.rhs(y_, dydt_, t);
  a = dydt_.segment(n, n);
}

template <int D>
template <class Function>
void ImplicitBeam<D>::at_end_nodes(const Function& function) const {
  function(0, system_.model().start);
  function(system_.mesh().last(), system_.model().end);
}

template <int D>
void ImplicitBeam<D>::project(double* nodes) const {
  at_end_nodes([&](int k, const Support<D>& support) {
    auto keep = [&](auto part, const typename Support<D>::Components& free) {
      part = support.out_of_frame((support.into_frame(part).array() * free).matrix());
    };
    keep(position<D>(nodes, k), support.free_position);
    keep(slope<D>(nodes, k), support.free_slope);
  });
}

template <int D>
double ImplicitBeam<D>::residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                 Eigen::VectorXd& r) {
  refresh();
  const auto& model = system_.model();
  r.setZero();
  double dissipation = system_.add_fixed_forces(q.data(), v.data(), t, r.data());
  r = -r;
  system_.add_fixed_inertia(a.data(), r.data());
  const Eigen::Index extra = B * (system_.mesh().last() + 1);
  const Vec<double, D> gravity = system_.moving_law(t).gravity;
  if (system_.has_joint()) {
    const int j = system_.joint();
    const auto ju = static_cast<std::size_t>(j);
    const auto& mesh = system_.mesh();
    const auto law = system_.moving_law(t);
    auto add = [&]<MovingEnds Ends>(int k, double far_end, const ShapeTabulation& table) {
      const auto part = with_law(model.strain_law, model.section.bends(), [&]<StrainLaw Law, bool Bending>() {
        return moving_residual<Ends, Law, Bending, double, D>(
            element_of<Ends, D>(q.data(), k, q[extra], far_end), element_of<Ends, D>(v.data(), k, v[extra], 0),
            element_of<Ends, D>(a.data(), k, a[extra], 0), mesh.weights[static_cast<std::size_t>(k)], table, law,
            &dissipation);
      });
      position<D>(r.data(), k) += part.nodes[0];
      slope<D>(r.data(), k) += part.nodes[1];
      position<D>(r.data(), k + 1) += part.nodes[2];
      slope<D>(r.data(), k + 1) += part.nodes[3];
      r[extra] += part.end;
    };
    add.template operator()<MovingEnds::b>(j - 1, mesh.x[ju - 1], system_.left_table());
    add.template operator()<MovingEnds::a>(j, mesh.x[ju + 1], system_.right_table());
    position<D>(r.data(), j) += model.joint->mass * (position<D>(a.data(), j) - gravity);
  } else if (model.joint) {
    r.segment<D>(extra) = model.joint->mass * (a.segment<D>(extra) - gravity);
  }
  project(r.data());
  return dissipation;
}

template <int D>
void ImplicitBeam<D>::assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                               double by_v, double by_a) {
  refresh();
  by_a_ = by_a;
  const auto& model = system_.model();
  const auto& mesh = system_.mesh();
  const int j = system_.joint();
  tangent_.reset(mesh.last() + 1, system_.has_joint() ? j - 1 : -1);

  system_.add_fixed_tangent(q.data(), v.data(), by_v, by_a, tangent_.diagonal.data(), tangent_.upper.data(),
                            tangent_.lower.data());
  if (system_.has_joint()) {
    const auto ju = static_cast<std::size_t>(j);
    const auto law = system_.moving_law(t);
    const Eigen::Index extra = B * (mesh.last() + 1);
    auto add = [&]<MovingEnds Ends>(int k, double far_end, const ShapeTabulation& table) {
      constexpr int N = 4 * D + 1;
      const auto matrix = with_law(model.strain_law, model.section.bends(), [&]<StrainLaw Law, bool Bending>() {
        return moving_tangent<Ends, Law, Bending, D>(element_of<Ends, D>(q.data(), k, q[extra], far_end),
                                                     element_of<Ends, D>(v.data(), k, v[extra], 0),
                                                     element_of<Ends, D>(a.data(), k, a[extra], 0), by_v, by_a,
                                                     mesh.weights[static_cast<std::size_t>(k)], table, law);
      });
      const auto reach = static_cast<std::size_t>(k - (j - 1));  // 0 for the left element, 1 for the right one
      for (int row_node = 0; row_node < 2; ++row_node) {
        for (int column_node = 0; column_node < 2; ++column_node) {
          auto& blocks = row_node == column_node  ? tangent_.diagonal
                         : row_node < column_node ? tangent_.upper
                                                  : tangent_.lower;
          blocks[static_cast<std::size_t>(k + row_node)] += matrix.template block<B, B>(row_node * B, column_node * B);
        }
        tangent_.column[reach + static_cast<std::size_t>(row_node)] += matrix.template block<B, 1>(row_node * B, N - 1);
        tangent_.row[reach + static_cast<std::size_t>(row_node)] +=
            matrix.template block<1, B>(N - 1, row_node * B).transpose();
      }
      tangent_.corner += matrix(N - 1, N - 1);
    };
    add.template operator()<MovingEnds::b>(j - 1, mesh.x[ju - 1], system_.left_table());
    add.template operator()<MovingEnds::a>(j, mesh.x[ju + 1], system_.right_table());
    tangent_.diagonal[ju].template topLeftCorner<D, D>().diagonal().array() += by_a * model.joint->mass;
  }
  constrain_tangent();
}

template <int D>
bool ImplicitBeam<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                double by_v, double by_a) {
  assemble(q, v, a, t, by_v, by_a);
  return tangent_.factor();
}

template <int D>
void ImplicitBeam<D>::constrain_tangent() {
  const std::size_t last = tangent_.diagonal.size() - 1;
  at_end_nodes([&](int node, const Support<D>& support) {
    if ((support.free_position > 0).all() && (support.free_slope > 0).all()) return;
    Block keep = Block::Zero();
    keep.template topLeftCorner<D, D>() =
        support.frame * support.free_position.matrix().asDiagonal() * support.frame.transpose();
    keep.template bottomRightCorner<D, D>() =
        support.frame * support.free_slope.matrix().asDiagonal() * support.frame.transpose();
    const auto k = static_cast<std::size_t>(node);
    const double scale = tangent_.diagonal[k].diagonal().cwiseAbs().maxCoeff();
    tangent_.diagonal[k] = keep * tangent_.diagonal[k] * keep + scale * (Block::Identity() - keep);
    if (k == 0) {
      tangent_.upper[0] = keep * tangent_.upper[0];
      tangent_.lower[1] = tangent_.lower[1] * keep;
    }
    if (k == last) {
      tangent_.lower[last] = keep * tangent_.lower[last];
      tangent_.upper[last - 1] = tangent_.upper[last - 1] * keep;
    }
    if (!tangent_.bordered()) return;
    const int reach = node - (system_.joint() - 1);
    if (reach < 0 || reach >= BorderedBlockTridiagonal<B>::border_reach) return;
    auto& column = tangent_.column[static_cast<std::size_t>(reach)];
    auto& row = tangent_.row[static_cast<std::size_t>(reach)];
    column = keep * column;
    row = keep * row;
  });
}

template <int D>
void ImplicitBeam<D>::solve(Eigen::VectorXd& r) const {
  if (!system_.has_joint() && system_.model().joint) {
    r.tail<D>() /= by_a_ * system_.model().joint->mass;
  }
  tangent_.solve(r.data());
}

template class ImplicitBeam<2>;
template class ImplicitBeam<3>;

}  // namespace vlbeam
