#include "mechanics/motion/parts/acting_loads.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/held_chain.hpp"

namespace vlbeam::test {
namespace {

/// A loaded chain, with masses on it.
template <int D>
HeldChain<D> loaded(const ChainShape& shape, unsigned seed, Constraints constraints = Constraints::eliminated) {
  return {shape, seed, constraints, [&](BeamModel<D>& model, Random& random) {
            const double length = shape.elements * shape.element_length;
            model.loads = loads_on<D>(length, random);
            if (shape.slopes == JointSlopes::continuous) model.masses = masses_on<D>(length);
          }};
}

template <class Dimension>
class LoadsTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LoadsTest, Dimensions);

/// Conservative but for them, the model's own energy changes by what the ledger books.
TYPED_TEST(LoadsTest, DoTheWorkThatIsBooked) {
  constexpr int D = TypeParam::value;
  unsigned seed = 5;
  for (const ChainShape& shape : bearing_shapes) {
    SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
    const HeldChain<D> c = loaded<D>(shape, seed++);
    const Eigen::VectorXd rates = c.rates();
    const double power = rates[rates.size() - 1], held = c.support_power();
    ASSERT_GT(std::abs(power), 0.01);
    EXPECT_NEAR(c.energy_rate(), power + held, 1e-8 * (1 + std::abs(power) + std::abs(held)));
  }
}

TYPED_TEST(LoadsTest, AreTheSameToImplicitMethods) {
  constexpr int D = TypeParam::value;
  unsigned seed = 25;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    for (const ChainShape& shape : bearing_shapes) {
      SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
      HeldChain<D> c = loaded<D>(shape, seed++, constraints);
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, c.now, a);
      const double power = c.rates()[c.y.size() - 1];
      EXPECT_NEAR(implicit.supplied_power(q, v, a, c.now).loads, power, 1e-12 * (1 + std::abs(power)));
      implicit.residual(q, v, a, c.now, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));
      EXPECT_LE(c.tangent_error(q, v), 1e-6);
    }
  }
}

TYPED_TEST(LoadsTest, JacobianHasThem) {
  constexpr int D = TypeParam::value;
  unsigned seed = 45;
  for (const ChainShape& shape : bearing_shapes) {
    if (shape.slopes != JointSlopes::continuous) continue;
    SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
    HeldChain<D> c = loaded<D>(shape, seed++);
    const Eigen::Index size = c.y.size(), n = c.system->coordinates();
    auto f = [&](const Eigen::VectorXd& at, double time) {
      Eigen::VectorXd dydt(size);
      c.system->rhs(at, dydt, time);
      return dydt;
    };
    Eigen::MatrixXd dfdy(size, size);
    Eigen::VectorXd dfdt(size), d = Eigen::VectorXd::Zero(size);
    c.system->jacobian(c.y, c.now, dfdy, dfdt);
    Eigen::VectorXd other = c.y;
    for (Eigen::Index k = 0; k < n; ++k) other[k] += c.random.uniform(-0.01, 0.01);
    d.head(n) = (f(other, c.now) - f(c.y, c.now)).segment(n, n).normalized();  // as supports allow
    d.segment(n, n) = d.head(n).reverse().eval();
    d.segment(n, n) = (f(c.y + 0.01 * d, c.now) - f(c.y, c.now)).segment(n, n).normalized();
    const Eigen::VectorXd expected = slope_of([&](double s) { return f(c.y + s * d, c.now); });
    EXPECT_LE((dfdy * d - expected).norm(), 1e-6 * expected.norm());
    const Eigen::VectorXd in_time = slope_of([&](double s) { return f(c.y, c.now + s); });
    EXPECT_GT(in_time.norm(), 0);
    EXPECT_LE((dfdt - in_time).norm(), 1e-6 * in_time.norm());
  }
}

}  // namespace
}  // namespace vlbeam::test
