#include "mechanics/motion/system/implicit_beam.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "mechanics/spin/spin_unknowns.hpp"

#include <gtest/gtest.h>

#include <numbers>

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
  Case(const ChainShape& shape, unsigned seed, Constraints constraints = Constraints::eliminated, bool friction = false,
       bool held = false, bool nut = false)
      : random(seed) {
    auto model = model_of<D>(shape, random);
    model.section.damping = 0.01;
    model.start = Support<D>::direction_clamp(random.vector<D>());
    model.end = Support<D>::pin();
    model.constraints = constraints;
    const auto sleeve = held ? Support<D>::direction_clamp(random.vector<D>()) : Support<D>{};
    for (auto& joint : model.joints) {
      if (friction) joint.law.friction = AxialFriction{0.3, 0.4};
      if (held) joint.support = &joint == &model.joints.back() ? Support<D>::pin() : sleeve;
    }
    if (nut) {
      spin_in(model) = SpinModel{.section = {0.2, 0.3, 0.05},
                                 .field = AngleField::hermite,
                                 .rate = 0.8,
                                 .drives = {{shape.elements, steadily(0, 1.5)}},
                                 .pitch = {pitch}};
    }
    system = std::make_unique<BeamSystem<D>>(model, random_chain<D>(shape, random));
    system->second_order()->expand(system->initial_state(), q, v);
    const Eigen::Index n = q.size();
    a = Eigen::VectorXd::NullaryExpr(n, [this] { return random.uniform(-3, 3); });
    if (nut) put_on_thread(shape.elements + 1, 0.1 * shape.element_length);
  }

  /// The nut a bit on, off the node of the angles where it starts and the twist's gradient jumps, and some angles that
  /// have it there.
  void put_on_thread(int nodes, double way) {
    const Spin& spin = *spin_of(*system);
    const Eigen::Index at = q.size() - spin.coordinates(), mark = node_size<D> * nodes;
    q[mark] += way;
    for (Eigen::Index i = at; i < q.size(); ++i) {
      q[i] = random.uniform(-1, 1);
      v[i] = random.uniform(-1, 1);
    }
    const double angle = spin.section(q.data() + at, v.data() + at, q[mark]).at.angle +
                         2 * std::numbers::pi / pitch * way;  // the sum was 0
    for (int node = 0; node < nodes; ++node) q[at + spin.angle(node)] -= angle;
    v[mark] = dynamic_cast<const SpinUnknowns<D>&>(*system->unknowns())
                  .nut()
                  .place(spin, q.data() + at, v.data() + at, q[mark])
                  .rate;
  }

  static constexpr double pitch = 0.7;
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
    {.elements = 5, .joint = 3, .rational = true, .transport = WeightTransport::transported},
    {.elements = 5, .rational = true, .rider = 4},
    {.elements = 2, .rational = true, .rider = 0},
    {.elements = 4, .rational = true, .rider = 3, .held = true},
    {.elements = 7, .joint = 1, .rational = true, .more = {{4}}},
    {.elements = 7, .joint = 1, .rational = true, .more = {{2}, {4}}},
    {.elements = 7, .joint = 2, .rational = true, .transport = WeightTransport::transported, .more = {{3}, {6}}}};

struct Kind {
  ChainShape shape;
  Constraints constraints;
  bool friction;
  bool held = false;  ///< the last joint by a ring, the others by sleeves
  bool nut = false;   ///< the first joint
};

std::vector<Kind> cases() {
  std::vector<Kind> result;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    for (const auto& shape : shapes) result.push_back({shape, constraints, false});
    result.push_back({shapes[2], constraints, true});
    result.push_back({shapes[6], constraints, true});
    result.push_back({shapes[10], constraints, true});
    for (const bool friction : {false, true}) {
      for (const std::size_t i : {1U, 3U, 5U, 10U, 11U}) result.push_back({shapes[i], constraints, friction, true});
    }
  }
  for (const bool held : {false, true}) {
    for (const bool friction : {false, true}) {
      for (const std::size_t i : {2U, 5U, 10U}) result.push_back({shapes[i], {}, friction, held, true});
    }
  }
  for (const auto slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    for (const bool friction : {false, true}) {
      result.push_back({{.elements = 5, .joint = 2, .rational = true, .slopes = slopes},
                        Constraints::multipliers,
                        friction,
                        slopes != JointSlopes::equal_stretch});
      result.push_back(
          {{.elements = 5, .joint = 2, .rational = true, .slopes = slopes}, Constraints::multipliers, friction});
      result.push_back({{.elements = 8, .joint = 2, .rational = true, .slopes = slopes, .more = {{3}, {6, slopes}}},
                        Constraints::multipliers,
                        friction});
    }
  }
  return result;
}

TYPED_TEST(ImplicitBeamTest, ResidualVanishesAtTheExplicitAcceleration) {
  constexpr int D = TypeParam::value;
  unsigned seed = 1;
  for (const auto& [shape, constraints, friction, held, nut] : cases()) {
    Case<D> c(shape, seed++, constraints, friction, held, nut);
    auto& implicit = *c.system->second_order();
    Eigen::VectorXd a(c.q.size()), r(c.q.size());
    implicit.acceleration(c.q, c.v, 0, a);
    implicit.residual(c.q, c.v, a, 0, r);
    EXPECT_LE(r.norm(), 1e-11 * (1 + a.norm())) << "joint " << shape.joint;
  }
}

TYPED_TEST(ImplicitBeamTest, InertiaIsWhatMoreAccelerationAddsToTheResidual) {
  constexpr int D = TypeParam::value;
  unsigned seed = 5;
  int seen = 0;
  for (const auto& [shape, constraints, friction, held, nut] : cases()) {
    Case<D> c(shape, seed++, constraints, friction, held, nut);
    auto& implicit = *c.system->second_order();
    Eigen::VectorXd more =
        Eigen::VectorXd::NullaryExpr(c.q.size(), [&] { return static_cast<double>(c.random.uniform(-2, 2)); });
    more.tail(implicit.multipliers()).setZero();
    if (shape.held) more[c.system->dofs().mark()] = 0;
    Eigen::VectorXd inertia(c.q.size()), r(c.q.size()), r_of_more(c.q.size());
    const bool known = implicit.inertia(c.q, more, 0, inertia);
    EXPECT_EQ(known, !nut);
    if (!known || friction) continue;  // which changes with the force that presses
    implicit.residual(c.q, c.v, c.a, 0, r);
    implicit.residual(c.q, c.v, c.a + more, 0, r_of_more);
    EXPECT_LE((r_of_more - r - inertia).norm(), 1e-12 * r.norm()) << "joint " << shape.joint;
    ++seen;
  }
  EXPECT_GE(seen, 30);
}

/// Along the direction of an implicit step (d, by.v d, by.a d) the solve must undo the residual's change.
TYPED_TEST(ImplicitBeamTest, TangentIsTheDerivativeOfTheResidual) {
  constexpr int D = TypeParam::value;
  unsigned seed = 11;
  for (const auto& [shape, constraints, friction, held, nut] : cases()) {
    Case<D> c(shape, seed++, constraints, friction, held, nut);
    auto& implicit = *c.system->second_order();
    const Eigen::Index n = c.q.size();
    const TangentWeights by{1, 7, 300};
    Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(n, [&] { return c.random.uniform(-1, 1); });
    // only directions that the supports allow: what the solve itself returns
    ASSERT_TRUE(implicit.linearize(c.q, c.v, c.a, 0, by));
    Eigen::VectorXd projected(n);
    implicit.residual(c.q, c.v, c.a + d, 0, projected);
    implicit.solve(projected);
    d = projected / projected.norm();

    // fourth-order central difference
    auto change = [&](double s) {
      Eigen::VectorXd plus(n), minus(n);
      implicit.residual(c.q + s * d, c.v + s * by.v * d, c.a + s * by.a * d, 0, plus);
      implicit.residual(c.q - s * d, c.v - s * by.v * d, c.a - s * by.a * d, 0, minus);
      return Eigen::VectorXd((plus - minus) / (2 * s));
    };
    Eigen::VectorXd r = (4 * change(5e-5) - change(1e-4)) / 3;
    implicit.solve(r);
    EXPECT_LE((r - d).norm(), 1e-6) << "elements " << shape.elements << " joint " << shape.joint;
  }
}

/// A linear combination of its columns is the residual's change along (d, by.v d, by.a d), multipliers by one each.
TYPED_TEST(ImplicitBeamTest, DenseTangentIsTheDerivativeOfTheResidual) {
  constexpr int D = TypeParam::value;
  unsigned seed = 51;
  for (const auto& [shape, constraints, friction, held, nut] : cases()) {
    if (constraints != Constraints::multipliers) continue;
    Case<D> c(shape, seed++, constraints, friction, held, nut);
    auto& implicit = *c.system->second_order();
    const Eigen::Index n = c.q.size(), m = implicit.multipliers();
    const TangentWeights by{1, 7, 300};
    Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(n, [&] { return c.random.uniform(-1, 1); });
    d *= 0.1 / d.norm();
    Eigen::VectorXd of_a = by.a * d;
    of_a.tail(m) = d.tail(m);
    Eigen::MatrixXd dense;
    implicit.tangent(c.q, c.v, c.a, 0, by, dense);
    auto change = [&](double s) {
      Eigen::VectorXd plus(n), minus(n);
      implicit.residual(c.q + s * d, c.v + s * by.v * d, c.a + s * of_a, 0, plus);
      implicit.residual(c.q - s * d, c.v - s * by.v * d, c.a - s * of_a, 0, minus);
      return Eigen::VectorXd((plus - minus) / (2 * s));
    };
    const double step = friction ? 1e-5 : 1e-3;  // the force that presses may turn within less
    const Eigen::VectorXd expected = (4 * change(step / 2) - change(step)) / 3;
    EXPECT_LE((dense * d - expected).norm(), 1e-7 * expected.norm()) << "joint " << shape.joint;
    EXPECT_EQ(dense.topRightCorner(n - m, m),
              (implicit.multiplier_unit() * dense.bottomLeftCorner(m, n - m).transpose()).eval());
    Eigen::VectorXd rates(n), more(n);
    for (Eigen::Index i = 0; i < m; ++i) {  // linear or quadratic forms: C_q v changes by d.C_qq v
      Eigen::MatrixXd second = Eigen::MatrixXd::Zero(n, n);
      implicit.add_curvature(i, 1, second);
      implicit.constraint_rates(c.q, c.v, 0, rates);
      implicit.constraint_rates(c.q + d, c.v, 0, more);
      EXPECT_NEAR(more[n - m + i] - rates[n - m + i], d.dot(second * c.v), 1e-12);
    }
  }
}

TYPED_TEST(ImplicitBeamTest, ReactionsOfAKinkedBeamDoNotDependOnHowItsConstraintsAreTreated) {
  constexpr int D = TypeParam::value;
  for (const auto slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    const ChainShape shape{.elements = 4, .joint = 2, .slopes = slopes};
    Case<D> eliminated(shape, 41), multipliers(shape, 41, Constraints::multipliers);
    const auto a = eliminated.system->forces(eliminated.system->initial_state(), 0).supports,
               b = multipliers.system->forces(multipliers.system->initial_state(), 0).supports;
    for (const std::size_t end : {0, 1}) {
      EXPECT_GT(a[end].norm(), 1e-3);
      EXPECT_LE((a[end] - b[end]).norm(), 1e-11 * a[end].norm());
    }
  }
}

TYPED_TEST(ImplicitBeamTest, ReactionsAreTheMultipliers) {
  constexpr int D = TypeParam::value;
  constexpr int B = node_size<D>;
  const ChainShape shape{.elements = 5, .joint = 2, .rational = true};
  Case<D> c(shape, 31, Constraints::multipliers);
  const auto y = c.system->initial_state();
  const auto reactions = c.system->forces(y, 0).supports;
  auto& implicit = *c.system->second_order();
  Eigen::VectorXd a;
  implicit.acceleration(c.q, c.v, 0, a);
  ASSERT_EQ(implicit.multipliers(), (2 * D - 1) + D);  // direction clamp, pin
  // the pin at the end: what the multipliers leave out of M a - Q is what its node gets
  Eigen::VectorXd r(a.size());
  Eigen::VectorXd without = a;
  without.tail(implicit.multipliers()).setZero();
  implicit.residual(c.q, c.v, without, 0, r);
  EXPECT_LE((r.template head<B>() - reactions[0]).norm(), 1e-10);
  const Eigen::Index last = implicit.coordinates() - implicit.multipliers() - 1 - B;
  EXPECT_LE((r.template segment<B>(last) - reactions[1]).norm(), 1e-10);
  EXPECT_GT(reactions[1].template head<D>().norm(), 1e-3);
  EXPECT_LE(reactions[1].template tail<D>().norm(), 1e-10) << "a pin holds no slope";
}

}  // namespace
}  // namespace vlbeam::test
