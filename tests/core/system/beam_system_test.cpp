#include "core/system/beam_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/element_equations.hpp"
#include "tests/core/support/element_family.hpp"

namespace vlbeam::test {
namespace {

/// Columns span the motions a support leaves its node (position and slope).
template <int D>
Eigen::MatrixXd free_motions(const Support<D>& support) {
  Eigen::MatrixXd motions(2 * D, 0);
  auto add = [&](int row, const Vec<double, D>& direction) {
    motions.conservativeResize(Eigen::NoChange, motions.cols() + 1);
    motions.col(motions.cols() - 1).setZero();
    motions.col(motions.cols() - 1).template segment<D>(row) = direction;
  };
  for (int c = 0; c < D; ++c) {
    if (support.free_position[c] != 0) add(0, support.frame.col(c));
    if (support.free_slope[c] != 0) add(D, support.frame.col(c));
  }
  return motions;
}

/// Accelerations of all coordinates (nodes, then x of the joint) by a dense solve of all elements' equations, projected
/// onto what the supports leave free.
template <int D>
Eigen::VectorXd dense_accelerations(const BeamModel<D>& model, const ChainState<D>& chain) {
  const int nodes = chain.mesh.last() + 1, nodal = node_size<D> * nodes, n = nodal + 1;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd Q = Eigen::VectorXd::Zero(n);
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const MovingLaw<D> law{model.section, model.formulation, model.transport, model.gravity};
    const auto eq = dense(element_equations<D>(model.strain_law, model.section.bends(), chain.coordinates(k),
                                               chain.rates(k), chain.mesh.weights[static_cast<std::size_t>(k)],
                                               gauss_legendre(model.quadrature_points), law));
    std::vector<int> rows;
    for (int i = 0; i < 4 * D; ++i) rows.push_back(node_size<D> * k + i);
    for (const int node : {k, k + 1}) rows.push_back(node == chain.joint ? nodal : -1);
    for (int i = 0; i < element_size<D>; ++i) {
      const int row = rows[static_cast<std::size_t>(i)];
      if (row < 0) continue;
      Q[row] += eq.force[i];
      for (int j = 0; j < element_size<D>; ++j) {
        const int column = rows[static_cast<std::size_t>(j)];
        if (column >= 0) M(row, column) += eq.mass(i, j);
      }
    }
  }
  if (chain.joint != no_joint) {
    M.diagonal().segment<D>(node_size<D> * chain.joint).array() += model.joint->mass;
    Q.segment<D>(node_size<D> * chain.joint) += model.joint->mass * model.gravity;
  }
  const Eigen::MatrixXd start = free_motions(model.start), end = free_motions(model.end);
  const Eigen::Index inner = nodal - 4 * D, moving = chain.joint == no_joint ? 0 : 1;
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(n, start.cols() + inner + end.cols() + moving);
  Z.topLeftCorner(2 * D, start.cols()) = start;
  Z.block(2 * D, start.cols(), inner, inner).setIdentity();
  Z.block(2 * D + inner, start.cols() + inner, 2 * D, end.cols()) = end;
  if (moving) Z(nodal, Z.cols() - 1) = 1;
  return Z * (Z.transpose() * M * Z).ldlt().solve(Z.transpose() * Q);
}

/// The chain held by the supports: their nodes move only as they may.
template <int D>
void hold(const BeamModel<D>& model, ChainState<D>& chain) {
  auto project = [&](const Support<D>& support, int node) {
    const Eigen::MatrixXd motions = free_motions(support);
    Eigen::Map<Eigen::VectorXd> rate(chain.rate.data() + node_size<D> * node, node_size<D>);
    rate = (motions * (motions.transpose() * rate)).eval();
  };
  project(model.start, 0);
  project(model.end, chain.mesh.last());
}

template <class Dimension>
class BeamSystemOf : public ::testing::Test {
 protected:
  static constexpr int dim = Dimension::value;

  /// Accelerations (nodes, joint) as the system's right-hand side has them.
  static Eigen::VectorXd accelerations(const BeamModel<dim>& model, const ChainState<dim>& chain, double t = 0) {
    BeamSystem<dim> system(model, chain);
    const Eigen::VectorXd y = system.initial_state();
    Eigen::VectorXd dydt(system.size());
    system.rhs(y, dydt, t);
    const Eigen::Index n = (y.size() - (model.section.damped() ? 1 : 0)) / 2;
    EXPECT_EQ(dydt.head(n), y.segment(n, n)) << "the rates of the coordinates";
    return dydt.segment(n, n);
  }

  static void expect_dense(const BeamModel<dim>& model, const ChainState<dim>& chain) {
    const auto a = accelerations(model, chain);
    const Eigen::VectorXd exact = dense_accelerations(model, chain).head(a.size());
    EXPECT_LE((a - exact).norm(), 1e-10 * exact.norm());
  }

  std::array<Support<dim>, 4> supports() {
    return {Support<dim>::free_end(), Support<dim>::pin(), Support<dim>::clamp(),
            Support<dim>::direction_clamp(random_.vector<dim>())};
  }

  Random random_{6};
};
TYPED_TEST_SUITE(BeamSystemOf, Dimensions, DimensionNames);

TYPED_TEST(BeamSystemOf, AccelerationsAreThoseOfTheDenseSystemUnderAnySupports) {
  for (const auto& start : this->supports()) {
    for (const auto& end : this->supports()) {
      for (const int joint : {no_joint, 1, 3, 5}) {
        const ChainShape shape{.elements = 6, .joint = joint};
        auto model = model_of<TypeParam::value>(shape, this->random_);
        model.start = start;
        model.end = end;
        auto chain = random_chain<TypeParam::value>(shape, this->random_);
        hold(model, chain);
        this->expect_dense(model, chain);
      }
    }
  }
}

TYPED_TEST(BeamSystemOf, AccelerationsAreThoseOfTheDenseSystemForAnyElement) {
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    for (const Formulation formulation : formulations) {
      for (const double EI : {0.0, 0.3}) {
        for (const double damping : {0.0, 0.05}) {
          const ChainShape shape{.elements = 7, .joint = 3, .rational = kind.rational, .transport = kind.transport};
          auto model = model_of<TypeParam::value>(shape, this->random_);
          model.strain_law = kind.law;
          model.formulation = formulation;
          model.section.stiffness.EI = EI;
          model.section.damping = damping;
          model.quadrature_points = 6;
          model.start = Support<TypeParam::value>::clamp();
          auto chain = random_chain<TypeParam::value>(shape, this->random_);
          hold(model, chain);
          this->expect_dense(model, chain);
        }
      }
    }
  }
}

TYPED_TEST(BeamSystemOf, MeshesOfAnySizeAreSolved) {
  for (const int elements : {2, 3, 4, 5, 9, 17}) {
    for (const int joint : {no_joint, 1, elements / 2, elements - 1}) {
      const ChainShape shape{.elements = elements, .joint = joint};
      auto model = model_of<TypeParam::value>(shape, this->random_);
      model.start = Support<TypeParam::value>::pin();
      auto chain = random_chain<TypeParam::value>(shape, this->random_);
      hold(model, chain);
      this->expect_dense(model, chain);
    }
  }
}

TYPED_TEST(BeamSystemOf, TheSameBodyDescribedFromItsOtherEndAcceleratesAlike) {
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    const ChainShape shape{.elements = 6, .joint = 2, .rational = kind.rational, .transport = kind.transport};
    auto model = model_of<TypeParam::value>(shape, this->random_);
    model.start = Support<TypeParam::value>::clamp();
    auto chain = random_chain<TypeParam::value>(shape, this->random_);
    hold(model, chain);
    const auto a = this->accelerations(model, chain);
    std::swap(model.start, model.end);
    auto turned = reversed(chain);
    const auto b = this->accelerations(model, turned);
    const std::vector<double> nodal(b.data(), b.data() + b.size() - 1);
    turned.rate = nodal;
    turned.joint_rate = b[b.size() - 1];
    const auto back = reversed(turned);
    const Eigen::Map<const Eigen::VectorXd> expected(back.rate.data(), a.size() - 1);
    EXPECT_LE((a.head(a.size() - 1) - expected).norm(), 1e-10 * a.norm());
    EXPECT_NEAR(a[a.size() - 1], back.joint_rate, 1e-10 * a.norm());
  }
}

TYPED_TEST(BeamSystemOf, BoostOfAFreeBeamLeavesItsAccelerations) {
  for (const bool rational : {false, true}) {
    for (const Formulation formulation : formulations) {
      const ChainShape shape{.elements = 5, .joint = 2, .rational = rational};
      auto model = model_of<TypeParam::value>(shape, this->random_);
      model.formulation = formulation;
      model.quadrature_points = rational ? 25 : 5;  // the discrete Lagrangian is invariant once it integrates exactly
      auto chain = random_chain<TypeParam::value>(shape, this->random_);
      const auto a = this->accelerations(model, chain);
      const Vec<double, TypeParam::value> boost = this->random_.template vector<TypeParam::value>(10);
      for (int k = 0; k <= chain.mesh.last(); ++k) position<TypeParam::value>(chain.rate.data(), k) += boost;
      EXPECT_LE((this->accelerations(model, chain) - a).norm(), 1e-10 * a.norm());
    }
  }
}

TYPED_TEST(BeamSystemOf, GravityGrowsAsItsRamp) {
  const ChainShape shape{.elements = 4};
  auto model = model_of<TypeParam::value>(shape, this->random_);
  auto chain = random_chain<TypeParam::value>(shape, this->random_);
  const auto full = this->accelerations(model, chain);
  model.gravity_ramp = 0.4;
  const auto none = this->accelerations(model, chain);
  const auto half = this->accelerations(model, chain, 0.2);
  EXPECT_LE((half - (full + none) / 2).norm(), 1e-12 * full.norm()) << "S(1/2) = 1/2";
  EXPECT_EQ(this->accelerations(model, chain, 0.4), full);
  EXPECT_EQ(this->accelerations(model, chain, 7), full);
  auto weightless = model;
  weightless.gravity.setZero();
  EXPECT_EQ(this->accelerations(weightless, chain), none);
}

TEST(GravityShare, IsSmoothAtBothEnds) {
  EXPECT_EQ(gravity_share(0, 0), 1);
  EXPECT_EQ(gravity_share(0, 2), 0);
  EXPECT_EQ(gravity_share(2, 2), 1);
  EXPECT_NEAR(gravity_share(0.6, 2), 0.126036, 1e-15);  // 0.3^4 (35 - 84 0.3 + 70 0.3^2 - 20 0.3^3)
  EXPECT_LE(gravity_share(2e-3, 2), 35e-12);
  EXPECT_LE(1 - gravity_share(2 - 2e-3, 2), 35e-12);
}

}  // namespace
}  // namespace vlbeam::test
