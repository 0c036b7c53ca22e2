#include <gtest/gtest.h>

#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class JacobianTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(JacobianTest, Dimensions);

/// Along random directions that the supports allow, against fourth-order differences of the right-hand side.
TYPED_TEST(JacobianTest, IsTheDerivativeOfTheRightHandSide) {
  constexpr int D = TypeParam::value;
  const std::vector<ChainShape> chains{{.elements = 4, .joint = no_joint},
                                       {.elements = 5, .joint = 2, .rational = true},
                                       {.elements = 5, .joint = 1, .transport = WeightTransport::transported},
                                       {.elements = 4, .rational = true, .rider = 3},
                                       {.elements = 4, .rider = 0, .held = true}};
  unsigned seed = 21;
  for (const auto& shape : chains) {
    for (const auto& [damping, friction] : {std::pair{0.0, 0.0}, {0.01, 0.0}, {0.01, 0.3}}) {
      Random random(seed++);
      auto model = model_of<D>(shape, random);
      model.section.damping = damping;
      if (!model.joints.empty() && friction > 0) model.joints.front().law.friction = AxialFriction{friction, 0.5};
      model.gravity_ramp = 1;
      model.gravity = random.vector<D>();
      model.start = Support<D>::direction_clamp(random.vector<D>());
      model.end = Support<D>::pin();
      BeamSystem<D> system(model, random_chain<D>(shape, random));
      const Eigen::VectorXd y = system.initial_state();
      const Eigen::Index size = y.size(), n = system.coordinates();
      const double t = 0.4;
      auto f = [&](const Eigen::VectorXd& at, double time) {
        Eigen::VectorXd dydt(size);
        system.rhs(at, dydt, time);
        return dydt;
      };

      Eigen::MatrixXd dfdy(size, size);
      Eigen::VectorXd dfdt(size);
      system.jacobian(y, t, dfdy, dfdt);
      for (int i = 0; i < 3; ++i) {
        auto allowed = [&]() -> Eigen::VectorXd {  // as accelerations are
          Eigen::VectorXd other = y;
          for (Eigen::Index k = 0; k < n; ++k) other[k] += random.uniform(-0.01, 0.01);
          return (f(other, t) - f(y, t)).segment(n, n).normalized();
        };
        Eigen::VectorXd d = Eigen::VectorXd::Zero(size);
        d.head(n) = allowed();
        d.segment(n, n) = allowed();
        const Eigen::VectorXd expected = slope_of([&](double s) { return f(y + s * d, t); });
        EXPECT_LE((dfdy * d - expected).norm(), 1e-6 * expected.norm()) << "joint " << shape.joint;
        if (damping == 0) continue;
        const double terms = dfdy.row(size - 1).cwiseAbs() * d.cwiseAbs();
        EXPECT_NEAR((dfdy * d)[size - 1], expected[size - 1], 1e-6 * terms) << "of the energy that is lost";
      }
      const Eigen::VectorXd in_time = slope_of([&](double s) { return f(y, t + s); });
      EXPECT_GT(in_time.norm(), 0);
      EXPECT_LE((dfdt - in_time).norm(), 1e-7 * in_time.norm());
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
