#include "core/system/implicit_beam.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/chain_models.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class ImplicitBeamTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ImplicitBeamTest, Dimensions);

/// A supported, damped chain in motion, with its coordinates, velocities and some acceleration.
template <int D>
struct Case {
  explicit Case(const ChainShape& shape, unsigned seed) : random(seed) {
    auto model = model_of<D>(shape, random);
    model.section.damping = 0.01;
    model.start = Support<D>::direction_clamp(random.vector<D>());
    model.end = Support<D>::pin();
    system = std::make_unique<BeamSystem<D>>(model, random_chain<D>(shape, random));
    const Eigen::Index n = system->coordinates();
    const auto y = system->initial_state();
    q = y.head(n);
    v = y.segment(n, n);
    a = Eigen::VectorXd::NullaryExpr(n, [this] { return random.uniform(-3, 3); });
  }

  Random random;
  std::unique_ptr<BeamSystem<D>> system;
  Eigen::VectorXd q, v, a;
};

const std::vector<ChainShape> shapes{
    {.elements = 5, .joint = no_joint},
    {.elements = 5, .joint = 1, .rational = true},
    {.elements = 5, .joint = 2, .rational = true},
    {.elements = 6, .joint = 5},
    {.elements = 2, .joint = 1, .rational = true},
    {.elements = 5, .joint = 3, .rational = true, .transport = WeightTransport::transported}};

TYPED_TEST(ImplicitBeamTest, ResidualVanishesAtTheExplicitAcceleration) {
  constexpr int D = TypeParam::value;
  unsigned seed = 1;
  for (const auto& shape : shapes) {
    Case<D> c(shape, seed++);
    auto& implicit = *c.system->second_order();
    Eigen::VectorXd a(c.q.size()), r(c.q.size());
    implicit.acceleration(c.q, c.v, 0, a);
    implicit.residual(c.q, c.v, a, 0, r);
    EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm())) << "joint " << shape.joint;
  }
}

/// Along the direction of an implicit step (d, by_v d, by_a d) the solve must undo the residual's change.
TYPED_TEST(ImplicitBeamTest, TangentIsTheDerivativeOfTheResidual) {
  constexpr int D = TypeParam::value;
  unsigned seed = 11;
  for (const auto& shape : shapes) {
    Case<D> c(shape, seed++);
    auto& implicit = *c.system->second_order();
    const Eigen::Index n = c.q.size();
    const double by_v = 7, by_a = 300;
    Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(n, [&] { return c.random.uniform(-1, 1); });
    // only directions that the supports allow: what the solve itself returns
    ASSERT_TRUE(implicit.linearize(c.q, c.v, c.a, 0, by_v, by_a));
    Eigen::VectorXd projected(n);
    implicit.residual(c.q, c.v, c.a + d, 0, projected);
    implicit.solve(projected);
    d = projected / projected.norm();

    // fourth-order central difference
    auto change = [&](double s) {
      Eigen::VectorXd plus(n), minus(n);
      implicit.residual(c.q + s * d, c.v + s * by_v * d, c.a + s * by_a * d, 0, plus);
      implicit.residual(c.q - s * d, c.v - s * by_v * d, c.a - s * by_a * d, 0, minus);
      return Eigen::VectorXd((plus - minus) / (2 * s));
    };
    Eigen::VectorXd r = (4 * change(5e-4) - change(1e-3)) / 3;
    implicit.solve(r);
    EXPECT_LE((r - d).norm(), 1e-6) << "elements " << shape.elements << " joint " << shape.joint;
  }
}

}  // namespace
}  // namespace vlbeam::test
