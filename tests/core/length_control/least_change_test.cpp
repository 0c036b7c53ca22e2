#include "core/length_control/least_change.hpp"

#include <gtest/gtest.h>

#include "core/element/quadrature.hpp"
#include "core/length_control/remeshing.hpp"
#include "tests/core/support/chain_states.hpp"
#include "tests/core/support/element_family.hpp"

namespace vlbeam::test {
namespace {

template <int D>
MovingLaw<D> law_of(double EA, double EI) {
  MovingLaw<D> law;
  law.section = {1.3, {EA, EI}, 0, 0};
  return law;
}

LengthControl control(MergeShape policy, double standard_length, bool rational) {
  LengthControl result;
  result.standard_length = standard_length;
  result.merge = policy;
  result.rational = rational;
  return result;
}

/// Strain energy of a chain of frozen weights, by many points.
template <int D>
double strain_energy(const ChainState<D>& chain, const MovingLaw<D>& law) {
  double sum = 0;
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const auto q = chain.coordinates(k);
    const auto curve =
        RationalCubic<double, D>::from_nodal(q.e, q.x_b - q.x_a, chain.mesh.weights[static_cast<std::size_t>(k)].w);
    const double l = q.x_b - q.x_a;
    for (const auto& [u, weight] : gauss_legendre(25)) {
      const auto r = curve.evaluate(u);
      const ElasticStress<double, D> elastic(r[1] / l, r[2] / (l * l), law.section.stiffness);
      sum += weight * l * (elastic.axial + elastic.bending);
    }
  }
  return sum;
}

template <class Dimension>
class LeastChange : public ::testing::Test {
 protected:
  Random random_{5};
};
TYPED_TEST_SUITE(LeastChange, Dimensions, DimensionNames);

TYPED_TEST(LeastChange, KeepsTheStrainEnergy) {
  constexpr int D = TypeParam::value;
  const auto law = law_of<D>(2000, 0.5);
  for (const bool rational : {true, false}) {
    const ChainShape shape{.elements = 6, .joint = 2, .rational = false};
    const auto before = smooth_chain<D>(shape, 1.5, this->random_);
    auto after = before, fitted = before;
    const auto merged =
        segment_and_merge(after, 0, Direction::forward, {}, control(MergeShape::least_change, 0.2, rational), law);
    segment_and_merge(fitted, 0, Direction::forward, {}, control(MergeShape::point_fit, 0.2, rational), law);
    ASSERT_FALSE(merged.unit_fallback);
    const double was = strain_energy(before, law), is = strain_energy(after, law), paper = strain_energy(fitted, law);
    EXPECT_LE(std::abs(is - was), 1e-7 * was);
    EXPECT_GT(std::abs(paper - was), 1e-4 * was);
    if (!rational) {
      EXPECT_EQ(merged.weights(), unit_weights);
    }
    for (int k = 0; k <= after.mesh.last(); ++k) {  // positions stay
      const Vec<double, D> here = position<D>(after.q.data(), k), there = position<D>(fitted.q.data(), k);
      EXPECT_EQ(here, there);
    }
  }
}

TYPED_TEST(LeastChange, IsTheMirrorImageOfItself) {
  constexpr int D = TypeParam::value;
  const auto law = law_of<D>(2000, 0.5);
  const ChainShape shape{.elements = 6, .joint = 2, .rational = true};
  auto forward = smooth_chain<D>(shape, 1.5, this->random_);
  auto backward = reversed(forward);
  const auto policy = control(MergeShape::least_change, 0.2, true);
  segment_and_merge(forward, 0, Direction::forward, {}, policy, law);
  segment_and_merge(backward, 0, Direction::backward, {}, policy, law);
  const auto mirror = reversed(backward);
  for (std::size_t i = 0; i < forward.q.size(); ++i) EXPECT_NEAR(mirror.q[i], forward.q[i], 1e-7);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(mirror.mesh.weights[3].w[i] / mirror.mesh.weights[3].w[0],
                forward.mesh.weights[3].w[i] / forward.mesh.weights[3].w[0], 1e-6);
  }
}

TYPED_TEST(LeastChange, LeavesAPolynomialAsItIs) {
  // two elements that are one cubic: nothing is lost, nothing may change
  constexpr int D = TypeParam::value;
  const auto law = law_of<D>(2000, 0.5);
  const ChainShape shape{.elements = 6, .joint = 2, .rational = false};
  auto before = smooth_chain<D>(shape, 1.5, this->random_);
  const double x_a = before.mesh.x[2], x_b = before.mesh.x[4], u = (before.mesh.x[3] - x_a) / (x_b - x_a);
  const NodalCubic<double, D> whole{position<D>(before.q.data(), 2), slope<D>(before.q.data(), 2),
                                    position<D>(before.q.data(), 4), slope<D>(before.q.data(), 4)};
  const auto curve = RationalCubic<double, D>::from_nodal(whole, x_b - x_a, unit_weights).evaluate(u);
  position<D>(before.q.data(), 3) = curve[0];
  slope<D>(before.q.data(), 3) = curve[1] / (x_b - x_a);
  auto after = before;
  const auto merged =
      segment_and_merge(after, 0, Direction::forward, {}, control(MergeShape::least_change, 0.2, true), law);
  for (const double k : merged.k) EXPECT_NEAR(k, 1, 1e-8);
  EXPECT_LE((Vec<double, D>(slope<D>(after.q.data(), 3)) - Vec<double, D>(slope<D>(before.q.data(), 2))).norm(), 1e-8);
}

}  // namespace
}  // namespace vlbeam::test
