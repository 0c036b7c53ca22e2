#include "mechanics/motion/system/beam_system.hpp"

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

/// Conditions A a = b on the accelerations of the slopes s and p, before and behind a joint, in all three dimensions:
/// twice the time derivative of s x p = 0, or of |s|^2 = |p|^2.
struct DenseConditions {
  Eigen::MatrixXd on_s, on_p;
  Eigen::VectorXd b;
};

template <int D>
DenseConditions dense_conditions(JointSlopes slopes, const ChainState<D>& chain,
                                 const typename ChainState<D>::Joint& joint) {
  auto in_space = [](const Vec<double, D>& v) {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    result.head<D>() = v;
    return result;
  };
  const Eigen::Vector3d s = in_space(slope<D>(chain.q.data(), joint.node)), p = in_space(joint.kink->slope),
                        s_rate = in_space(slope<D>(chain.rate.data(), joint.node)), p_rate = in_space(joint.kink->rate);
  DenseConditions result{Eigen::MatrixXd(0, D), Eigen::MatrixXd(0, D), Eigen::VectorXd(0)};
  if (slopes == JointSlopes::equal_stretch) {
    result = {s.head<D>().transpose(), -p.head<D>().transpose(), Eigen::VectorXd(1)};
    result.b << p_rate.squaredNorm() - s_rate.squaredNorm();
  } else if (slopes == JointSlopes::tangent) {
    result = {Eigen::MatrixXd(3, D), Eigen::MatrixXd(3, D), -2 * s_rate.cross(p_rate)};
    for (int c = 0; c < D; ++c) {
      result.on_s.col(c) = Eigen::Vector3d(Eigen::Vector3d::Unit(c)).cross(p);
      result.on_p.col(c) = s.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(c)));
    }
  }
  return result;
}

/// Accelerations of all coordinates (nodes, then x of the joints, then the slopes behind them) by a dense solve of all
/// elements' equations, projected onto what supports and what holds joints leave free. `force_on_x` is added to those
/// on the x of joints; those that are guided take their accelerations.
template <int D>
Eigen::VectorXd dense_accelerations(const BeamModel<D>& model, const ChainState<D>& chain,
                                    const std::vector<double>& force_on_x = {}) {
  const int nodes = chain.mesh.last() + 1, nodal = node_size<D> * nodes;
  const auto count_of_joints = static_cast<int>(chain.joints.size());
  std::vector<int> behind(chain.joints.size(), -1);
  int n = nodal + count_of_joints;
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    if (!chain.joints[i].kink) continue;
    behind[i] = n;
    n += D;
  }
  const auto joint_at = [&](int node) {
    for (std::size_t i = 0; i < chain.joints.size(); ++i) {
      if (chain.joints[i].node == node) return static_cast<int>(i);
    }
    return -1;
  };
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd Q = Eigen::VectorXd::Zero(n);
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const MovingLaw<D> law{model.section, model.formulation, model.transport, model.gravity};
    const auto eq = dense(element_equations<D>(chain.coordinates(k), chain.rates(k),
                                               chain.mesh.weights[static_cast<std::size_t>(k)],
                                               beam_rule(model.quadrature_points, model.axial_strain), law));
    std::vector<int> rows;
    for (int i = 0; i < 4 * D; ++i) rows.push_back(node_size<D> * k + i);
    for (const int node : {k, k + 1}) rows.push_back(joint_at(node) < 0 ? -1 : nodal + joint_at(node));
    const int start = joint_at(k) < 0 ? -1 : behind[static_cast<std::size_t>(joint_at(k))];
    for (int i = 0; i < D && start >= 0; ++i) rows[static_cast<std::size_t>(D + i)] = start + i;
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
  std::vector<std::pair<int, Support<D>>> held{{0, model.start}, {chain.mesh.last(), model.end}};
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const int node = chain.joints[i].node;
    M.diagonal().segment<D>(node_size<D> * node).array() += model.joints[i].law.mass;
    Q.segment<D>(node_size<D> * node) += model.joints[i].law.mass * model.gravity;
    if (!force_on_x.empty()) Q[nodal + static_cast<int>(i)] += force_on_x[i];
    if (model.joints[i].support) held.emplace_back(node, *model.joints[i].support);
  }
  Eigen::MatrixXd Z(n, 0);
  const auto add = [&](int row, const Eigen::MatrixXd& motions) {
    const Eigen::Index first = Z.cols();
    Z.conservativeResize(Eigen::NoChange, first + motions.cols());
    Z.rightCols(motions.cols()).setZero();
    Z.block(row, first, motions.rows(), motions.cols()) = motions;
  };
  for (int node = 0; node < nodes; ++node) {
    Eigen::MatrixXd motions = Eigen::MatrixXd::Identity(2 * D, 2 * D);
    for (const auto& [at, support] : held) {
      if (at == node) motions = free_motions(support);
    }
    add(node_size<D> * node, motions);
  }
  if (n > nodal) add(nodal, Eigen::MatrixXd::Identity(n - nodal, n - nodal));
  Eigen::MatrixXd A(0, n);
  Eigen::VectorXd b(0);
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    if (behind[i] < 0) continue;
    const DenseConditions conditions = dense_conditions<D>(model.joints[i].law.slopes, chain, chain.joints[i]);
    const Eigen::Index count = conditions.b.size(), before = A.rows();
    A.conservativeResize(before + count, Eigen::NoChange);
    A.bottomRows(count).setZero();
    A.block(before, node_size<D> * chain.joints[i].node + D, count, D) = conditions.on_s;
    A.block(before, behind[i], count, D) = conditions.on_p;
    b.conservativeResize(before + count);
    b.tail(count) = conditions.b;
  }
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    if (!model.joints[i].x) continue;
    A.conservativeResize(A.rows() + 1, Eigen::NoChange);
    A.bottomRows(1).setZero();
    A(A.rows() - 1, nodal + static_cast<Eigen::Index>(i)) = 1;
    b.conservativeResize(A.rows());
    b[b.size() - 1] = model.joints[i].x(0).acceleration;
  }
  if (A.rows() == 0) return Z * (Z.transpose() * M * Z).ldlt().solve(Z.transpose() * Q);
  const Eigen::Index count = A.rows(), free = Z.cols();
  Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(free + count, free + count);
  kkt.topLeftCorner(free, free) = Z.transpose() * M * Z;
  kkt.topRightCorner(free, count) = (A * Z).transpose();
  kkt.bottomLeftCorner(count, free) = A * Z;
  Eigen::VectorXd rhs(free + count);
  rhs << Z.transpose() * Q, b;
  return Z * kkt.completeOrthogonalDecomposition().solve(rhs).head(free);  // the conditions are not independent
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
    const Eigen::Index n = system.coordinates();
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

TYPED_TEST(BeamSystemOf, AKinkedJointsAccelerationsAreThoseOfADenseSolve) {
  constexpr int D = TypeParam::value;
  for (const auto slopes : all_slopes) {
    for (const auto& kind : element_family) {
      SCOPED_TRACE(std::string(kind.name()) + ", slopes " + std::to_string(static_cast<int>(slopes)));
      for (const int joint : {1, 3}) {
        const ChainShape shape{
            .elements = 4, .joint = joint, .rational = kind.rational, .transport = kind.transport, .slopes = slopes};
        auto model = model_of<D>(shape, this->random_);
        model.section.stiffness.law = kind.law;
        model.start = Support<D>::pin();
        auto chain = random_chain<D>(shape, this->random_);
        hold(model, chain);
        this->expect_dense(model, chain);
      }
    }
  }
}

TYPED_TEST(BeamSystemOf, SeveralJointsAccelerationsAreThoseOfADenseSolve) {
  constexpr int D = TypeParam::value;
  using Joints = std::vector<ChainShape::Joint>;
  const std::vector<Joints> apart{{{2}}, {{3}}, {{4}}, {{5}}, {{3}, {5}}, {{3}, {4}, {8}}};
  for (const auto& kind : element_family) {
    for (const auto slopes : {JointSlopes::continuous, JointSlopes::tangent, JointSlopes::equal_stretch}) {
      for (std::size_t held = 0; held < 3; ++held) {
        for (const Joints& more : apart) {
          SCOPED_TRACE(std::string(kind.name()) + ", slopes " + std::to_string(static_cast<int>(slopes)) + ", " +
                       std::to_string(more.size()) + " more, held " + std::to_string(held));
          ChainShape shape{
              .elements = 9, .joint = 1, .rational = kind.rational, .transport = kind.transport, .more = more};
          shape.more.back().slopes = slopes;
          auto model = model_of<D>(shape, this->random_);
          model.section.stiffness.law = kind.law;
          model.start = Support<D>::direction_clamp(this->random_.template vector<D>());
          model.joints[1].law.mass = 0.15;
          auto chain = random_chain<D>(shape, this->random_);
          if (held > 0) {
            model.joints.front().support =
                held == 1 ? Support<D>::pin() : Support<D>::direction_clamp(slope<D>(chain.q.data(), 1));
            model.joints.front().law.mass = 0;
            position<D>(chain.rate.data(), 1).setZero();
          }
          hold(model, chain);
          this->expect_dense(model, chain);
        }
      }
    }
  }
}

TYPED_TEST(BeamSystemOf, GuidedJointsTakeTheirAccelerationsAndTheRestFollows) {
  constexpr int D = TypeParam::value;
  using Joints = std::vector<ChainShape::Joint>;
  for (const auto& kind : element_family) {
    for (const Joints& more : {Joints{}, Joints{{2}}, Joints{{3}}, Joints{{3}, {4}, {8}}}) {
      for (std::size_t guided = 0; guided < std::size_t{2} << more.size(); ++guided) {
        const ChainShape shape{
            .elements = 9, .joint = 1, .rational = kind.rational, .transport = kind.transport, .more = more};
        auto model = model_of<D>(shape, this->random_);
        model.section.stiffness.law = kind.law;
        model.start = Support<D>::pin();
        auto chain = random_chain<D>(shape, this->random_);
        hold(model, chain);
        for (std::size_t i = 0; i < model.joints.size(); ++i) {
          if ((guided >> i & 1U) != 0) model.joints[i].x = guide_of(chain, i, this->random_.uniform(-1, 1));
        }
        if (guided == 1) model.joints.front().law.mass = 0;  // it has no motion of its own, and needs none
        SCOPED_TRACE(std::string(kind.name()) + ", " + std::to_string(more.size()) + " more, guided " +
                     std::to_string(guided));
        this->expect_dense(model, chain);
      }
    }
  }
}

TYPED_TEST(BeamSystemOf, AGuideDoesTheWorkOfTheForceThatAFreeJointWouldNeed) {
  constexpr int D = TypeParam::value;
  for (const auto& kind : element_family) {
    const ChainShape shape{
        .elements = 9, .joint = 2, .rational = kind.rational, .transport = kind.transport, .more = {{3}, {6}}};
    auto model = model_of<D>(shape, this->random_);
    model.section.stiffness.law = kind.law;
    auto chain = random_chain<D>(shape, this->random_);
    const auto free = model;
    for (std::size_t i = 0; i < 3; ++i) model.joints[i].x = guide_of(chain, i, this->random_.uniform(-1, 1));
    const Eigen::VectorXd a = this->accelerations(model, chain);
    BeamSystem<D> system(model, chain);
    const Eigen::VectorXd y = system.initial_state();
    const std::vector<double> force = system.forces(y, 0).guiding;
    ASSERT_EQ(force.size(), 3U);
    const Eigen::VectorXd needed = dense_accelerations(free, chain, force).head(a.size());
    EXPECT_LE((a - needed).norm(), 1e-10 * needed.norm()) << kind.name();
    Eigen::VectorXd dydt(system.size());
    system.rhs(y, dydt, 0);
    double power = 0;
    for (std::size_t i = 0; i < 3; ++i) power += force[i] * chain.joints[i].rate;
    EXPECT_NEAR(model.balance().of(dydt).supports, power, 1e-10 * std::abs(power)) << kind.name();
  }
}

/// Friction at a joint under the force `pull` of the beam, and the stretch that takes it to x: mu N along a tangent, or
/// the difference of the tensions that pull around a drum with that force.
template <int D>
std::pair<double, double> rubbing(const SlidingJoint& law, const ChainState<D>& chain,
                                  const typename ChainState<D>::Joint& joint, const Vec<double, D>& pull) {
  const Vec<double, D> before = slope<D>(chain.q.data(), joint.node);
  const Vec<double, D> behind = joint.kink ? Vec<double, D>(joint.kink->slope) : before;
  const bool around = law.slopes == JointSlopes::free;
  const double stretch = around ? (before.norm() + behind.norm()) / 2 : ((before + behind) / 2).norm();
  const double mu = law.friction->coefficient * std::tanh(stretch * joint.rate / law.friction->velocity);
  if (!around) {
    const Vec<double, D> tangent = (before + behind).normalized();
    return {-mu * (pull - tangent * tangent.dot(pull)).norm(), stretch};
  }
  const double cosine = before.normalized().dot(behind.normalized()), ratio = std::exp(mu * std::acos(cosine));
  return {-pull.norm() / std::sqrt(1 + ratio * ratio - 2 * ratio * cosine) * (ratio - 1), stretch};
}

TYPED_TEST(BeamSystemOf, FrictionAtSeveralJointsIsTheCoefficientTimesTheNormalForces) {
  constexpr int D = TypeParam::value;
  const ChainShape shape{.elements = 9, .joint = 2, .more = {{3}, {6, JointSlopes::free}}};
  auto model = model_of<D>(shape, this->random_);
  model.joints[0].law.friction = AxialFriction{0.4, 0.3};
  model.joints[1].law.friction = AxialFriction{0.2, 0.1};
  model.joints[2].law.friction = AxialFriction{0.1, 0.2};
  const auto chain = random_chain<D>(shape, this->random_);
  BeamSystem<D> system(model, chain);
  const Eigen::VectorXd y = system.initial_state();
  Eigen::VectorXd dydt(system.size());
  system.rhs(y, dydt, 0);
  const Eigen::VectorXd a = dydt.segment(system.coordinates(), system.coordinates());
  std::vector<double> on_x;
  double power = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& joint = chain.joints[i];
    const Vec<double, D> pull = 0.4 * (a.segment<D>(node_size<D> * joint.node) - model.gravity);
    const auto [force, stretch] = rubbing<D>(model.joints[i].law, chain, joint, pull);
    const double v = stretch * joint.rate;
    on_x.push_back(force * stretch);
    power -= force * v;
  }
  const Eigen::VectorXd exact = dense_accelerations(model, chain, on_x).head(a.size());
  EXPECT_LE((a - exact).norm(), 1e-10 * exact.norm());
  EXPECT_NEAR(dydt[dydt.size() - 1], power, 1e-10) << "the power it takes";
}

TYPED_TEST(BeamSystemOf, FrictionIsTheCoefficientTimesTheNormalForceOfTheAccelerations) {
  constexpr int D = TypeParam::value;
  for (const auto slopes : {JointSlopes::continuous, JointSlopes::tangent, JointSlopes::free}) {
    const ChainShape shape{.elements = 4, .joint = 2, .slopes = slopes};
    auto model = model_of<D>(shape, this->random_);
    model.joints.front().law.friction = AxialFriction{0.4, 0.3};
    const auto chain = random_chain<D>(shape, this->random_);
    BeamSystem<D> system(model, chain);
    const Eigen::VectorXd y = system.initial_state();
    Eigen::VectorXd dydt(system.size());
    system.rhs(y, dydt, 0);
    const Eigen::VectorXd a = dydt.segment(system.coordinates(), system.coordinates());
    const Vec<double, D> pull = model.joints.front().law.mass * (a.segment<D>(2 * node_size<D>) - model.gravity);
    const auto& joint = chain.joints.front();
    const auto [friction, stretch] = rubbing<D>(model.joints.front().law, chain, joint, pull);
    EXPECT_GT(std::abs(friction), 0.01);
    const double v = stretch * joint.rate;
    const Eigen::VectorXd exact = dense_accelerations(model, chain, {friction * stretch}).head(a.size());
    EXPECT_LE((a - exact).norm(), 1e-10 * exact.norm());
    EXPECT_NEAR(dydt[dydt.size() - 1], -friction * v, 1e-10) << "the power it takes";
  }
}

TYPED_TEST(BeamSystemOf, TheRateOfItsLengthIsTheDerivativeOfItsLength) {
  constexpr int D = TypeParam::value;
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    const ChainShape shape{
        .elements = 4, .joint = 2, .rational = kind.rational, .transport = kind.transport, .slopes = JointSlopes::free};
    BeamSystem<D> system(model_of<D>(shape, this->random_), random_chain<D>(shape, this->random_));
    const Eigen::VectorXd y = system.initial_state();
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(y.size());
    motion.head(system.coordinates()) = y.segment(system.coordinates(), system.coordinates());
    const double h = 1e-5;
    auto length = [&](double s) { return system.observe(y + s * motion, 0, 7).beam_length; };
    EXPECT_NEAR(system.observe(y, 0, 7).beam_length_rate, (length(h) - length(-h)) / (2 * h), 1e-8);
  }
}

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
          model.section.stiffness.law = kind.law;
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
    turned.joints.front().rate = b[b.size() - 1];
    const auto back = reversed(turned);
    const Eigen::Map<const Eigen::VectorXd> expected(back.rate.data(), a.size() - 1);
    EXPECT_LE((a.head(a.size() - 1) - expected).norm(), 1e-10 * a.norm());
    EXPECT_NEAR(a[a.size() - 1], back.joints.front().rate, 1e-10 * a.norm());
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

}  // namespace
}  // namespace vlbeam::test
