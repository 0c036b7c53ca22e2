#include "mechanics/ride/rider.hpp"

#include <gtest/gtest.h>

#include "mechanics/ride/rider_step.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {

// What friction needs of a dual number.
inline bool operator>(const Dual<double>& a, double b) { return a.value > b; }
inline Dual<double> asin(const Dual<double>& a) {
  return {std::asin(a.value), a.rate / std::sqrt(1 - a.value * a.value)};
}

inline Dual<double> tanh(const Dual<double>& a) {
  const double t = std::tanh(a.value);
  return {t, (1 - t * t) * a.rate};
}

namespace {

template <int D>
using Column = Eigen::Matrix<double, 4 * D + 1, 1>;

template <class Real, int D>
NodalCubic<Real, D> nodes(const Eigen::Matrix<Real, 4 * D + 1, 1>& q) {
  return {q.template segment<D>(0), q.template segment<D>(D), q.template segment<D>(2 * D),
          q.template segment<D>(3 * D)};
}

/// A mass inside a random element, in random motion; x is behind the element's coordinates.
template <int D>
struct Case {
  Case(unsigned seed, bool rational) : random(seed) {
    element = {0.3, 0.25, rational ? random.weights(2) : unit_weights};
    const Vec<double, D> along = random.rotation<D>().col(0);
    q << random.vector<D>(0.01), along + random.vector<D>(0.1), 0.25 * along + random.vector<D>(0.01),
        along + random.vector<D>(0.1), element.x_a + element.length * random.uniform(0.1, 0.9);
    for (int i = 0; i <= 4 * D; ++i) {
      rate[i] = random.uniform(-1, 1);
      a[i] = random.uniform(-5, 5);
    }
    gravity = random.vector<D>(10);
  }

  template <class Real>
  RiderMotion<Real, D> motion(const Eigen::Matrix<Real, 4 * D + 1, 1>& at,
                              const Eigen::Matrix<Real, 4 * D + 1, 1>& moving) const {
    return rider_motion<Real, D>(element, nodes<Real, D>(at), nodes<Real, D>(moving), at[4 * D], moving[4 * D]);
  }

  template <class Real>
  Eigen::Matrix<Real, 4 * D + 1, 1> residual(const Eigen::Matrix<Real, 4 * D + 1, 1>& at,
                                             const Eigen::Matrix<Real, 4 * D + 1, 1>& moving,
                                             const Eigen::Matrix<Real, 4 * D + 1, 1>& acceleration, bool held) const {
    auto where = motion<Real>(at, moving);
    if (held) {  // at the end of its element, whatever the coordinate
      where = rider_motion<Real, D>(element, nodes<Real, D>(at), nodes<Real, D>(moving),
                                    Real(element.x_a + element.length), Real(0));
    }
    const auto force =
        rider_residual<Real, D>(where, nodes<Real, D>(acceleration), acceleration[4 * D], joint, gravity, held);
    Eigen::Matrix<Real, 4 * D + 1, 1> result;
    for (int i = 0; i < 4; ++i) result.template segment<D>(D * i) = force.nodes[static_cast<std::size_t>(i)];
    result[4 * D] = force.x;
    return result;
  }

  /// m r'.r'/2 + m g.r from where the mass is alone.
  template <class Real>
  Real lagrangian(const Eigen::Matrix<Real, 4 * D + 1, 1>& at, const Eigen::Matrix<Real, 4 * D + 1, 1>& moving) const {
    using Moving = Dual<Real>;
    const Eigen::Matrix<Moving, 4 * D + 1, 1> in_time = in_motion(at, moving);
    const auto& w = element.weights;
    const auto curve = RationalCubic<Moving, D>::from_nodal(
        nodes<Moving, D>(in_time), Moving(element.length),
        {Moving(Real(w[0])), Moving(Real(w[1])), Moving(Real(w[2])), Moving(Real(w[3]))});
    const auto r = curve.evaluate((in_time[4 * D] - Moving(Real(element.x_a))) / Moving(Real(element.length)))[0];
    const Vec<Real, D> v = rate_of<Real, D>(r), g = gravity.template cast<Real>();
    return Real(joint.mass) * (v.dot(v) / Real(2) + g.dot(value_of<Real, D>(r)));
  }

  Random random;
  RiderElement element;
  Column<D> q, rate, a;
  Vec<double, D> gravity;
  SlidingJoint joint{0.7};
};

template <class Dimension>
class RiderTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RiderTest, Dimensions);

TYPED_TEST(RiderTest, EquationsAreThoseOfItsLagrangian) {
  constexpr int D = TypeParam::value;
  for (unsigned seed = 1; seed < 9; ++seed) {
    const Case<D> c(seed, seed % 2 == 0);
    const auto lagrangian = [&c]<class Real>(const auto& q, const auto& rate) {
      return c.template lagrangian<Real>(q, rate);
    };
    const Column<D> expected = lagrange_residual<4 * D + 1>(lagrangian, c.q, c.rate, c.a);
    EXPECT_LE((c.template residual<double>(c.q, c.rate, c.a, false) - expected).norm(), 1e-13 * expected.norm());
  }
}

TYPED_TEST(RiderTest, TangentIsTheDerivativeOfTheResidual) {
  constexpr int D = TypeParam::value;
  using Real = Dual<double>;
  const TangentWeights by{0.7, 30, 900};
  for (unsigned seed = 1; seed < 13; ++seed) {
    Case<D> c(seed, seed % 2 == 0);
    const bool held = seed % 3 == 0;
    if (seed % 4 > 1) c.joint.friction = AxialFriction{0.3, 0.4};
    const auto at = held ? rider_motion<double, D>(c.element, nodes<double, D>(c.q), nodes<double, D>(c.rate),
                                                   c.element.x_a + c.element.length, 0)
                         : c.template motion<double>(c.q, c.rate);
    const auto tangent = rider_tangent<D>(at, nodes<double, D>(c.a), c.a[4 * D], c.joint, c.gravity, held, by);
    for (int j = 0; j <= 4 * D; ++j) {
      const Column<D> unit = Column<D>::Unit(j);
      const auto moving =
          c.template residual<Real>(in_motion(c.q, (by.q * unit).eval()), in_motion(c.rate, (by.v * unit).eval()),
                                    in_motion(c.a, (by.a * unit).eval()), held);
      const Column<D> expected = rate_of<double, 4 * D + 1>(moving);
      EXPECT_LE((tangent.col(j) - expected).norm(), 1e-12 * tangent.norm()) << "column " << j << ", seed " << seed;
    }
  }
}

/// Whatever the two states, the residual does the work T_1 - T_0 - m g.(r_1 - r_0) on q_1 - q_0 = h (v_0 + v_1)/2.
TYPED_TEST(RiderTest, DiscreteGradientKeepsEnergy) {
  constexpr int D = TypeParam::value;
  for (unsigned seed = 1; seed < 9; ++seed) {
    Case<D> c(seed, seed % 2 == 0);
    for (const double speed : {1.0, 1e-3, 1e-7}) {  // along the beam: by differences, at last by derivatives
      const double h = 0.05;
      c.rate[4 * D] = speed * c.random.uniform(0.5, 1);
      Column<D> rate1 = c.rate;
      for (int i = 0; i < 4 * D; ++i) rate1[i] += c.random.uniform(-0.5, 0.5);
      rate1[4 * D] += speed * c.random.uniform(-0.3, 0.3);
      const Column<D> q1 = c.q + h / 2 * (c.rate + rate1);
      const auto force = conserving_rider<D>(
          c.element, {nodes<double, D>(c.q), nodes<double, D>(q1)}, {nodes<double, D>(c.rate), nodes<double, D>(rate1)},
          {c.q[4 * D], q1[4 * D]}, {c.rate[4 * D], rate1[4 * D]}, h, c.joint.mass, c.gravity, false);
      double work = force.x * (q1[4 * D] - c.q[4 * D]);
      for (int i = 0; i < 4; ++i) {
        work += force.nodes[static_cast<std::size_t>(i)].dot((q1 - c.q).template segment<D>(D * i));
      }
      const auto was = c.template motion<double>(c.q, c.rate), is = c.template motion<double>(q1, rate1);
      const double kinetic = c.joint.mass / 2 * (is.v.squaredNorm() - was.v.squaredNorm());
      EXPECT_NEAR(work, kinetic - c.joint.mass * c.gravity.dot(is.r - was.r), 1e-14 * (1 + is.v.squaredNorm()));
    }
  }
}

/// The normal force of friction is that of the whole motion.
TYPED_TEST(RiderTest, FrictionOfTheSolutionIsThatOfTheResidual) {
  constexpr int D = TypeParam::value;
  Random random(5);
  Mesh mesh{{0, 0.2, 0.4, 0.6}, {}};
  for (std::size_t k = 0; k < 3; ++k) mesh.weights.push_back({unit_weights, mesh.x[k], mesh.x[k + 1]});
  const BeamSection section{1.3, {20, 0.3}, 0, 0.1};
  const BeamRule rule = beam_rule(5);
  const auto clamp = Support<D>::direction_clamp(random.vector<D>());
  const Span<D> left(mesh, 0, 1, clamp, section, rule, nullptr);
  const Span<D> right(mesh, 3, 1, Support<D>::pin(), section, rule, nullptr);
  Case<D> c(3, false);
  c.element = {0.4, 0.2, unit_weights};
  c.q[4 * D] = 0.47;
  c.joint.friction = AxialFriction{0.4, 0.1};
  const RiderMass<D> mass(left, right, 4, 2);
  const auto at = c.template motion<double>(c.q, c.rate);
  Eigen::VectorXd force = Eigen::VectorXd::NullaryExpr(node_size<D> * 4, [&] { return random.uniform(-3, 3); }),
                  a = force;
  solve_without_joint(left, right, a.data());
  const auto solved = solve_with_rider<D>(mass, c.joint, at, element_nodes<D>(a.data(), 2), at.remainder - c.gravity, 0,
                                          false, true, a.data());
  ASSERT_TRUE(solved.has_value());
  EXPECT_GT(std::abs(solved->dissipation), 1e-3);
  const auto lacks = rider_residual<double, D>(at, element_nodes<D>(a.data(), 2), solved->x, c.joint, c.gravity, false);
  EXPECT_NEAR(lacks.x, 0, 1e-12);
  EXPECT_NEAR(lacks.dissipation, solved->dissipation, 1e-12);
  Eigen::VectorXd rest = -force;
  left.add_inertia(a.data(), rest.data());
  right.add_inertia(a.data(), rest.data());
  position<D>(rest.data(), 2) += lacks.nodes[0];
  slope<D>(rest.data(), 2) += lacks.nodes[1];
  slope<D>(rest.data(), 3) += lacks.nodes[3];
  EXPECT_LE(rest.segment(node_size<D>, 2 * node_size<D>).norm(), 1e-12);
  EXPECT_LE(slope<D>(rest.data(), 3).norm(), 1e-12) << "a pin leaves the slope free";
}

}  // namespace
}  // namespace vlbeam::test
