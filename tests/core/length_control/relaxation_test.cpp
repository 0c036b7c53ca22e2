#include "mechanics/remesh/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/length_control/segmentation.hpp"
#include "tests/core/support/chain_states.hpp"
#include "tests/core/support/element_family.hpp"

namespace vlbeam::test {
namespace {

/// Strain energy of a chain of frozen weights by a rule, from the curve of each element.
template <int D>
double energy_by(const BeamRule& rule, const ChainState<D>& chain, const MovingLaw<D>& law) {
  double sum = 0;
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const auto q = chain.coordinates(k);
    const double l = q.x_b - q.x_a;
    const auto curve = RationalCubic<double, D>::from_nodal(q.e, l, chain.mesh.weights[static_cast<std::size_t>(k)].w);
    for (const auto& [u, weight, feels] : rule) {
      const auto r = curve.evaluate(u);
      const ElasticStress<double, D> elastic(r[1] / l, r[2] / (l * l), law.section.as_felt(feels).stiffness);
      sum += weight * l * (elastic.axial + elastic.bending);
    }
  }
  return sum;
}

template <class Dimension>
class Relaxation : public ::testing::Test {
 protected:
  Random random_{11};
};
TYPED_TEST_SUITE(Relaxation, Dimensions, DimensionNames);

TYPED_TEST(Relaxation, EndsWhereNothingThatGivesWayIsPulled) {
  constexpr int D = TypeParam::value;
  MovingLaw<D> law;
  law.section = {1.3, {200, 0.4}, 0, 0};
  for (const AxialStrain axial : {AxialStrain::full, AxialStrain::lobatto}) {
    for (const bool rational : {false, true}) {
      const BeamRule rule = beam_rule(5, axial);
      const ChainShape shape{.elements = 6, .joint = 2, .rational = rational};
      const auto before = random_chain<D>(shape, this->random_);
      auto chain = before;
      EXPECT_GT(relax(chain, {{2, false, true}, {3, true, true}}, rule, law), 1);
      const double least = energy_by(rule, chain, law);
      EXPECT_LT(least, energy_by(rule, before, law));
      for (int node = 0; node <= 6; ++node) {
        const bool gives_place = node == 3, gives_slope = node == 2 || node == 3;
        EXPECT_EQ(position<D>(chain.q.data(), node) == position<D>(before.q.data(), node), !gives_place) << node;
        EXPECT_EQ(slope<D>(chain.q.data(), node) == slope<D>(before.q.data(), node), !gives_slope) << node;
      }
      // a little further in any direction costs energy, by half the stiffness times the square of the way
      for (int node : {2, 3}) {
        for (int c = 0; c < node_size<D>; ++c) {
          if (node == 2 && c < D) continue;
          for (const double way : {-1e-4, 1e-4}) {
            auto further = chain;
            further.q[static_cast<std::size_t>(node * node_size<D> + c)] += way;
            EXPECT_GT(energy_by(rule, further, law), least) << node << ", " << c;
          }
        }
      }
      EXPECT_EQ(chain.rate, before.rate);

      auto half_way = before;
      const double excess = (energy_by(rule, before, law) - least) / 2;
      relax(half_way, {{2, false, true}, {3, true, true}}, rule, law, excess);
      EXPECT_NEAR(energy_by(rule, half_way, law), least + excess, 1e-12 * least);
      half_way = before;
      EXPECT_EQ(relax(half_way, {{2, false, true}, {3, true, true}}, rule, law, 0), 0);
      EXPECT_EQ(half_way.q, before.q);
    }
  }
}

/// A cut of a bent element whose stretch is sampled: on the old curve it costs what the beam's stiffness makes of it,
/// relaxed what bending leaves.
TYPED_TEST(Relaxation, TheEnergyThatACutCreatesDoesNotGrowWithTheStiffness) {
  constexpr int D = TypeParam::value;
  const BeamRule rule = beam_rule(5, AxialStrain::lobatto);
  const auto jumps = [&](double EA) {
    MovingLaw<D> law;
    law.section = {1, {EA, 1}, 0, 0};
    ChainState<D> chain;  // a quarter of a circle of radius 1 in four elements
    for (int k = 0; k <= 4; ++k) {
      const double x = std::atan(1.0) * k / 2;
      chain.mesh.x.push_back(x);
      Vec<double, D> r = Vec<double, D>::Zero(), s = r;
      r.template head<2>() << std::cos(x), std::sin(x);
      s.template head<2>() << -std::sin(x), std::cos(x);
      chain.q.insert(chain.q.end(), r.begin(), r.end());
      chain.q.insert(chain.q.end(), s.begin(), s.end());
      if (k < 4) chain.mesh.weights.push_back({unit_weights, x, x + std::atan(1.0) / 2});
    }
    chain.rate.assign(chain.q.size(), 0.0);
    relax(chain, {{1, true, true}, {2, true, true}, {3, true, true}}, rule, law);
    const double there_was = energy_by(rule, chain, law);
    const auto node = segment(chain, 1, 0.45, WeightTransport::frozen);
    chain.insert_node(2);
    chain.mesh.x[2] = node.x;
    position<D>(chain.q.data(), 2) = node.r;
    slope<D>(chain.q.data(), 2) = node.r_x;
    const double exact = energy_by(rule, chain, law) - there_was;
    relax(chain, {{2, true, true}}, rule, law);
    return std::array{exact, energy_by(rule, chain, law) - there_was};
  };
  const auto soft = jumps(1e4), stiff = jumps(1e8);
  EXPECT_GT(stiff[0], 1e3 * soft[0]);
  EXPECT_NEAR(stiff[1], soft[1], 0.05 * std::abs(soft[1]));
  EXPECT_LT(std::abs(stiff[1]), 1e-3);
}

}  // namespace
}  // namespace vlbeam::test
