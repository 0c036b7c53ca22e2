#include "core/system/implicit_beam.hpp"

#include <Eigen/LU>
#include <unsupported/Eigen/AutoDiff>

namespace vlbeam {
namespace {

template <int N>
using Gradient = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;

/// Derivative of a fixed element's nodal force residual (r_B - r_A, s_A, s_B), block (c, d) of D x D.
template <int D>
using ChordTangent = std::array<std::array<Eigen::Matrix<double, D, D>, 3>, 3>;

template <StrainLaw Law, bool Bending, int D>
ChordTangent<D> fixed_tangent(const FixedBasis<double>& basis, const NodalCubic<double, D>& e,
                              const NodalCubic<double, D>& rate, const BeamSection& section, double by_v) {
  constexpr int N = 2 * D;
  using Real = Gradient<N>;
  ChordTangent<D> tangent;
  for (auto& row : tangent) {
    for (auto& block : row) block.setZero();
  }
  const Vec<double, D> chord = e.r_b - e.r_a, chord_rate = rate.r_b - rate.r_a;
  for (const auto& point : basis.points) {
    auto combine = [&](const std::array<double, 3>& s, const Vec<double, D>& a, const Vec<double, D>& b,
                       const Vec<double, D>& c) -> Vec<double, D> { return a * s[0] + b * s[1] + c * s[2]; };
    // directions of differentiation: the components of r_x, then of r_xx; rates follow by by_v
    auto seed = [&](const Vec<double, D>& value, int first, double scale) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) {
        result[c].value() = value[c];
        result[c].derivatives() = scale * Eigen::Matrix<double, N, 1>::Unit(first + c);
      }
      return result;
    };
    const Vec<Real, D> r_x = seed(combine(point.s_x, chord, e.s_a, e.s_b), 0, 1);
    const Vec<Real, D> r_xx = seed(combine(point.s_xx, chord, e.s_a, e.s_b), D, 1);
    const ElasticStress<Law, Bending, Real, D> elastic(r_x, r_xx, section.stiffness);
    Vec<Real, D> p = elastic.p, m = elastic.m;
    if (section.damped()) {
      const Vec<Real, D> v_x = seed(combine(point.s_x, chord_rate, rate.s_a, rate.s_b), 0, by_v);
      const Vec<Real, D> v_xx = seed(combine(point.s_xx, chord_rate, rate.s_a, rate.s_b), D, by_v);
      const DampingStress<Law, Bending, Real, D> viscous(r_x, r_xx, v_x, v_xx, section.stiffness, section.damping,
                                                         section.curvature_regularization);
      p += viscous.p;
      m += viscous.m;
    }
    Eigen::Matrix<double, D, N> by_p, by_m = Eigen::Matrix<double, D, N>::Zero();
    for (int c = 0; c < D; ++c) {
      by_p.row(c) = point.weight * p[c].derivatives().transpose();
      if constexpr (Bending) by_m.row(c) = point.weight * m[c].derivatives().transpose();
    }
    for (std::size_t d = 0; d < 3; ++d) {
      const Eigen::Matrix<double, D, D> dp =
          by_p.template leftCols<D>() * point.s_x[d] + by_p.template rightCols<D>() * point.s_xx[d];
      const Eigen::Matrix<double, D, D> dm =
          by_m.template leftCols<D>() * point.s_x[d] + by_m.template rightCols<D>() * point.s_xx[d];
      for (std::size_t c = 0; c < 3; ++c) tangent[c][d] += point.s_x[c] * dp + point.s_xx[c] * dm;
    }
  }
  return tangent;
}

/// Residual M a - Q of a variable-length element: (r_A, s_A, r_B, s_B) and that of the moving end.
template <class Real, int D>
struct MovingResidual {
  std::array<Vec<Real, D>, 4> nodes;
  Real end;
};

template <MovingEnds Ends, StrainLaw Law, bool Bending, class Real, int D>
MovingResidual<Real, D> moving_residual(const MovingCoordinates<Real, D>& q, const MovingCoordinates<Real, D>& rate,
                                        const MovingCoordinates<Real, D>& a, const WeightFunction& weights,
                                        const ShapeTabulation& table, const MovingLaw<D>& law, double* dissipation) {
  const auto eq = moving_equations<Law, Bending, Real, D, Ends>(q, rate, weights, table, law);
  const std::array<Vec<Real, D>, 4> nodal{a.e.r_a, a.e.s_a, a.e.r_b, a.e.s_b};
  constexpr bool at_a = Ends == MovingEnds::a;
  const auto& border = at_a ? eq.mass_a : eq.mass_b;
  const Real& end = at_a ? a.x_a : a.x_b;
  MovingResidual<Real, D> r;
  r.end = (at_a ? eq.mass_aa : eq.mass_bb) * end - (at_a ? eq.force_a : eq.force_b);
  for (std::size_t i = 0; i < 4; ++i) {
    r.nodes[i] = border[i] * end - eq.force[i];
    for (std::size_t j = 0; j < 4; ++j) r.nodes[i] += nodal[j] * eq.mass[i][j];
    r.end += border[i].dot(nodal[i]);
  }
  if constexpr (std::is_same_v<Real, double>) *dissipation += eq.dissipation;
  return r;
}

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

/// The same with every free coordinate a direction of differentiation, scaled by `scale`: 4 D nodal ones, then the end.
template <MovingEnds Ends, int D>
MovingCoordinates<Gradient<4 * D + 1>, D> seeded(const MovingCoordinates<double, D>& q, double scale) {
  constexpr int N = 4 * D + 1;
  using Real = Gradient<N>;
  auto vector = [&](const Vec<double, D>& value, int first) {
    Vec<Real, D> result;
    for (int c = 0; c < D; ++c) {
      result[c].value() = value[c];
      result[c].derivatives() = scale * Eigen::Matrix<double, N, 1>::Unit(first + c);
    }
    return result;
  };
  MovingCoordinates<Real, D> result;
  result.e = {vector(q.e.r_a, 0), vector(q.e.s_a, D), vector(q.e.r_b, 2 * D), vector(q.e.s_b, 3 * D)};
  result.x_a.value() = q.x_a;
  result.x_b.value() = q.x_b;
  result.x_a.derivatives().setZero();
  result.x_b.derivatives().setZero();
  (Ends == MovingEnds::a ? result.x_a : result.x_b).derivatives()[N - 1] = scale;
  return result;
}

}  // namespace

template <int D>
void ImplicitBeam<D>::refresh() {
  if (revision_ == system_.revision()) return;
  revision_ = system_.revision();
  const auto& mesh = system_.mesh();
  const auto& rule = gauss_legendre(system_.model().quadrature_points);
  const int joint = system_.joint();
  fixed_.clear();
  for (int k = 0; k < mesh.elements(); ++k) {
    if (joint != no_joint && (k == joint || k + 1 == joint)) continue;
    const auto i = static_cast<std::size_t>(k);
    const double l = mesh.x[i + 1] - mesh.x[i];
    FixedElement element{k, fixed_basis(l, mesh.weights[i].w, rule), fixed_inertia(l, mesh.weights[i].w, rule).mass};
    for (auto& row : element.mass) {
      for (auto& entry : row) entry *= system_.model().section.rhoA;
    }
    fixed_.push_back(std::move(element));
  }
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
  for (const auto& element : fixed_) {
    const auto nodal = element_nodes<D>(a.data(), element.index);
    const auto& m = element.mass;
    auto inertia = [&](std::size_t i) -> Vec<double, D> {
      return m[i][0] * nodal.r_a + m[i][1] * nodal.s_a + m[i][2] * nodal.r_b + m[i][3] * nodal.s_b;
    };
    position<D>(r.data(), element.index) += inertia(0);
    slope<D>(r.data(), element.index) += inertia(1);
    position<D>(r.data(), element.index + 1) += inertia(2);
    slope<D>(r.data(), element.index + 1) += inertia(3);
  }
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
bool ImplicitBeam<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                double by_v, double by_a) {
  refresh();
  ++factorizations_;
  by_a_ = by_a;
  const auto& model = system_.model();
  const auto& mesh = system_.mesh();
  const int j = system_.joint();
  tangent_.reset(mesh.last() + 1, system_.has_joint() ? j - 1 : -1);

  auto add_block = [&](int node_i, int node_j, const Block& block) {
    const auto i = static_cast<std::size_t>(node_i);
    (node_i == node_j ? tangent_.diagonal : node_i < node_j ? tangent_.upper : tangent_.lower)[i] += block;
  };
  for (const auto& element : fixed_) {
    const auto e = element_nodes<D>(q.data(), element.index), rate = element_nodes<D>(v.data(), element.index);
    const ChordTangent<D> k = with_law(model.strain_law, model.section.bends(), [&]<StrainLaw Law, bool Bending>() {
      return fixed_tangent<Law, Bending, D>(element.basis, e, rate, model.section, by_v);
    });
    // r_A enters through minus the chord, r_B through the chord
    constexpr std::array<std::size_t, 4> chord_row{0, 1, 0, 2};
    constexpr std::array<double, 4> sign{-1, 1, 1, 1};
    for (std::size_t row_node = 0; row_node < 2; ++row_node) {
      for (std::size_t column_node = 0; column_node < 2; ++column_node) {
        Block block;
        for (std::size_t x = 0; x < 2; ++x) {
          for (std::size_t y = 0; y < 2; ++y) {
            const std::size_t i = 2 * row_node + x, c = 2 * column_node + y;
            auto part = block.template block<D, D>(static_cast<int>(x) * D, static_cast<int>(y) * D);
            part = sign[i] * sign[c] * k[chord_row[i]][chord_row[c]];
            part.diagonal().array() += by_a * element.mass[i][c];
          }
        }
        add_block(element.index + static_cast<int>(row_node), element.index + static_cast<int>(column_node), block);
      }
    }
  }
  if (system_.has_joint()) {
    const auto ju = static_cast<std::size_t>(j);
    const auto law = system_.moving_law(t);
    const Eigen::Index extra = B * (mesh.last() + 1);
    auto add = [&]<MovingEnds Ends>(int k, double far_end, const ShapeTabulation& table) {
      constexpr int N = 4 * D + 1;
      const auto part = with_law(model.strain_law, model.section.bends(), [&]<StrainLaw Law, bool Bending>() {
        return moving_residual<Ends, Law, Bending, Gradient<N>, D>(
            seeded<Ends, D>(element_of<Ends, D>(q.data(), k, q[extra], far_end), 1),
            seeded<Ends, D>(element_of<Ends, D>(v.data(), k, v[extra], 0), by_v),
            seeded<Ends, D>(element_of<Ends, D>(a.data(), k, a[extra], 0), by_a),
            mesh.weights[static_cast<std::size_t>(k)], table, law, nullptr);
      });
      Eigen::Matrix<double, N, N> matrix;
      for (int i = 0; i < 4; ++i) {
        for (int c = 0; c < D; ++c) {
          matrix.row(i * D + c) = part.nodes[static_cast<std::size_t>(i)][c].derivatives().transpose();
        }
      }
      matrix.row(N - 1) = part.end.derivatives().transpose();
      const auto reach = static_cast<std::size_t>(k - (j - 1));  // 0 for the left element, 1 for the right one
      for (int row_node = 0; row_node < 2; ++row_node) {
        for (int column_node = 0; column_node < 2; ++column_node) {
          add_block(k + row_node, k + column_node, matrix.template block<B, B>(row_node * B, column_node * B));
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
