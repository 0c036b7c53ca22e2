#include "core/parts/loads.hpp"

#include <gtest/gtest.h>

#include "core/system/implicit_beam.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"

namespace vlbeam::test {
namespace {

constexpr double now = 0.13;

/// A loaded chain in motion, with masses on it, held at its ends.
template <int D>
struct Loaded {
  explicit Loaded(const ChainShape& shape, unsigned seed, Constraints constraints = Constraints::eliminated)
      : random(seed) {
    auto model = model_of<D>(shape, random);
    model.start = Support<D>::direction_clamp(random.vector<D>());
    model.end = Support<D>::pin();
    model.constraints = constraints;
    model.quadrature_points = 7;
    model.loads = loads_on<D>(shape.elements * shape.element_length, random);
    if (shape.slopes == JointSlopes::continuous) model.masses = masses_on<D>(shape.elements * shape.element_length);
    system = std::make_unique<BeamSystem<D>>(model, random_chain<D>(shape, random));
    y = system->initial_state();
  }

  Eigen::VectorXd rates() const {
    Eigen::VectorXd dydt(y.size());
    system->rhs(y, dydt, now);
    return dydt;
  }

  Random random;
  std::unique_ptr<BeamSystem<D>> system;
  Eigen::VectorXd y;
};

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
    const Loaded<D> c(shape, seed++);
    const Eigen::VectorXd rates = c.rates();
    const double power = rates[rates.size() - 1];
    ASSERT_GT(std::abs(power), 0.01);
    // the random state moves what supports hold
    const double change = slope_of([&](double s) {
      const auto seen = c.system->observe(c.y + s * rates, now, c.system->model().quadrature_points);
      return Eigen::VectorXd::Constant(1, seen.energy.total());
    })[0];
    const auto forces = c.system->forces(c.y, now).supports;
    const Eigen::Index n = c.system->coordinates(), last = Eigen::Index{node_size<D>} * c.system->mesh().last();
    const double held = forces[0].dot(c.y.template segment<node_size<D>>(n)) +
                        forces[1].dot(c.y.template segment<node_size<D>>(n + last));
    EXPECT_NEAR(change, power + held, 1e-8 * (1 + std::abs(power) + std::abs(held)));
  }
}

TYPED_TEST(LoadsTest, AreTheSameToImplicitMethods) {
  constexpr int D = TypeParam::value;
  unsigned seed = 25;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    for (const ChainShape& shape : bearing_shapes) {
      SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
      Loaded<D> c(shape, seed++, constraints);
      auto& implicit = *c.system->second_order();
      Eigen::VectorXd q, v;
      implicit.expand(c.y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, now, a);
      const double power = c.rates()[c.y.size() - 1];
      EXPECT_NEAR(implicit.supplied_power(q, v, a, now).loads, power, 1e-12 * (1 + std::abs(power)));
      if (shape.slopes != JointSlopes::continuous && constraints == Constraints::eliminated) continue;
      implicit.residual(q, v, a, now, r);
      EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm()));

      // along (d, by_v d, by_a d) the solve undoes the residual's change
      const double by_v = 7, by_a = 300;
      a = Eigen::VectorXd::NullaryExpr(q.size(), [&] { return c.random.uniform(-3, 3); });
      Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(q.size(), [&] { return c.random.uniform(-1, 1); });
      ASSERT_TRUE(implicit.linearize(q, v, a, now, by_v, by_a));
      implicit.residual(q, v, a + d, now, r);
      implicit.solve(r);
      d = r / r.norm();
      Eigen::VectorXd change = slope_of([&](double s) {
        implicit.residual(q + s * d, v + s * by_v * d, a + s * by_a * d, now, r);
        return r;
      });
      implicit.solve(change);
      EXPECT_LE((change - d).norm(), 1e-6);
    }
  }
}

TYPED_TEST(LoadsTest, JacobianHasThem) {
  constexpr int D = TypeParam::value;
  unsigned seed = 45;
  for (const ChainShape& shape : bearing_shapes) {
    if (shape.slopes != JointSlopes::continuous) continue;
    SCOPED_TRACE(testing::Message() << "elements " << shape.elements << " joint " << shape.joint);
    Loaded<D> c(shape, seed++);
    const Eigen::Index size = c.y.size(), n = c.system->coordinates();
    auto f = [&](const Eigen::VectorXd& at, double time) {
      Eigen::VectorXd dydt(size);
      c.system->rhs(at, dydt, time);
      return dydt;
    };
    Eigen::MatrixXd dfdy(size, size);
    Eigen::VectorXd dfdt(size), d = Eigen::VectorXd::Zero(size);
    c.system->jacobian(c.y, now, dfdy, dfdt);
    Eigen::VectorXd other = c.y;
    for (Eigen::Index k = 0; k < n; ++k) other[k] += c.random.uniform(-0.01, 0.01);
    d.head(n) = (f(other, now) - f(c.y, now)).segment(n, n).normalized();  // as supports allow
    d.segment(n, n) = d.head(n).reverse().eval();
    d.segment(n, n) = (f(c.y + 0.01 * d, now) - f(c.y, now)).segment(n, n).normalized();
    const Eigen::VectorXd expected = slope_of([&](double s) { return f(c.y + s * d, now); });
    EXPECT_LE((dfdy * d - expected).norm(), 1e-6 * expected.norm());
    const Eigen::VectorXd in_time = slope_of([&](double s) { return f(c.y, now + s); });
    EXPECT_GT(in_time.norm(), 0);
    EXPECT_LE((dfdt - in_time).norm(), 1e-6 * in_time.norm());
  }
}

}  // namespace
}  // namespace vlbeam::test
