#include "core/length_control/remeshing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support/chain_states.hpp"
#include "tests/core/support/element_family.hpp"

namespace vlbeam::test {
namespace {

constexpr double standard = 0.2;
constexpr std::array<MergeShape, 2> policies{MergeShape::point_fit, MergeShape::unit};
/// Position and slope of node k of a nodal array.
template <int D>
Vec<double, node_size<D>> node(const std::vector<double>& nodes, int k) {
  return Eigen::Map<const Vec<double, node_size<D>>>(nodes.data() + node_size<D> * k);
}

template <int D>
void expect_same(const ChainState<D>& a, const ChainState<D>& b, double tolerance) {
  ASSERT_EQ(a.joints.size(), b.joints.size());
  if (a.joints.empty()) return;
  EXPECT_EQ(a.joints.front().node, b.joints.front().node);
  EXPECT_NEAR(a.joints.front().rate, b.joints.front().rate, tolerance);
  ASSERT_EQ(a.joints.front().kink.has_value(), b.joints.front().kink.has_value());
  if (a.joints.front().kink) {
    EXPECT_LE((a.joints.front().kink->slope - b.joints.front().kink->slope).norm(), tolerance);
    EXPECT_LE((a.joints.front().kink->rate - b.joints.front().kink->rate).norm(), tolerance);
  }
  ASSERT_EQ(a.mesh.x.size(), b.mesh.x.size());
  for (std::size_t k = 0; k < a.mesh.x.size(); ++k) EXPECT_NEAR(a.mesh.x[k], b.mesh.x[k], tolerance);
  for (std::size_t i = 0; i < a.q.size(); ++i) {
    EXPECT_NEAR(a.q[i], b.q[i], tolerance);
    EXPECT_NEAR(a.rate[i], b.rate[i], tolerance);
  }
  for (std::size_t k = 0; k < a.mesh.weights.size(); ++k) {
    const auto& v = a.mesh.weights[k].w;
    const auto& w = b.mesh.weights[k].w;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(v[i] / v[0], w[i] / w[0], 1e-9) << "weight " << i << " of element " << k;
    }
  }
}

template <class Dimension>
class LengthControlOf : public ::testing::Test {
 protected:
  static constexpr int dim = Dimension::value;

  static MovingLaw<dim> law(WeightTransport transport) {
    MovingLaw<dim> law;
    law.section = {1.3, {2.1, 0.7}, 0, 0};
    law.transport = transport;
    return law;
  }
  static LengthControl control(MergeShape policy) {
    LengthControl result;
    result.standard_length = standard;
    result.merge = policy;
    return result;
  }

  Random random_{11};
};
TYPED_TEST_SUITE(LengthControlOf, Dimensions, DimensionNames);

TYPED_TEST(LengthControlOf, ATradedNodeIsOneInsertedAndOneErased) {
  constexpr int D = TypeParam::value;
  const auto start = smooth_chain<D>({.elements = 8, .joint = 4, .rational = true}, 1.5, this->random_);
  const auto expect_trade = [&](int at, int erased) {
    ChainState<D> expected = start, traded = start;
    expected.insert_node(at);
    expected.erase_node(erased < at ? erased : erased + 1);
    const int now = traded.trade_node(at, erased);
    EXPECT_EQ(now, erased < at ? at - 1 : at);
    for (ChainState<D>* chain : {&expected, &traded}) {  // what the new node holds is up to the caller
      chain->copy_node(now, start, 0);
    }
    expect_same(traded, expected, 0);
  };
  expect_trade(4, 5);
  expect_trade(4, 6);
  expect_trade(5, 3);
  expect_trade(5, 2);
}

TYPED_TEST(LengthControlOf, AForwardEventPutsANodeBehindTheJointAndTakesOneAheadAway) {
  constexpr int D = TypeParam::value;
  for (const WeightTransport transport : transports) {
    for (const MergeShape policy : policies) {
      const ChainShape shape{.elements = 6, .joint = 2, .rational = true, .transport = transport};
      const auto before = smooth_chain<D>(shape, 1.5, this->random_);
      auto after = before;
      const auto merged =
          segment_and_merge(after, 0, Direction::forward, {}, this->control(policy), this->law(transport));
      EXPECT_EQ(after.joints.front().node, 3);
      EXPECT_EQ(after.joints.front().rate, before.joints.front().rate);
      EXPECT_EQ(after.mesh.elements(), before.mesh.elements());
      EXPECT_DOUBLE_EQ(after.mesh.x[2], before.mesh.x[1] + standard) << "the new node";
      EXPECT_EQ(after.mesh.x[3], before.mesh.x[2]) << "the joint stays where it was";
      EXPECT_EQ(after.mesh.x[4], before.mesh.x[4]) << "node 3 is gone";
      EXPECT_DOUBLE_EQ(after.mesh.x[4] - after.mesh.x[3], 1.5 * standard);
      EXPECT_EQ(after.mesh.weights[3].w, merged.weights());
      const std::array<std::array<int, 2>, 6> kept{{{0, 0}, {1, 1}, {3, 2}, {4, 4}, {5, 5}, {6, 6}}};
      for (const auto& [now, then] : kept) {
        EXPECT_EQ(node<D>(after.q, now), node<D>(before.q, then));
        EXPECT_EQ(node<D>(after.rate, now), node<D>(before.rate, then));
      }
    }
  }
}

TYPED_TEST(LengthControlOf, TheMotionBehindTheJointIsWhatItWas) {
  constexpr int D = TypeParam::value;
  const ChainShape shape{.elements = 6, .joint = 2, .rational = true, .transport = WeightTransport::transported};
  const auto before = smooth_chain<D>(shape, 1.5, this->random_);
  auto after = before;
  segment_and_merge(after, 0, Direction::forward, {}, this->control(MergeShape::point_fit), this->law(shape.transport));
  for (double x = before.mesh.x[0]; x < before.mesh.x[2]; x += 0.013) {
    const auto a = point_motion(before, shape.transport, x), b = point_motion(after, shape.transport, x);
    EXPECT_LE((a.r - b.r).norm(), 1e-14);
    EXPECT_LE((a.v - b.v).norm(), 1e-13);
  }
}

TYPED_TEST(LengthControlOf, PointFitKeepsTheDeletedNodesPlace) {
  constexpr int D = TypeParam::value;
  const ChainShape shape{.elements = 6, .joint = 2};
  const auto before = smooth_chain<D>(shape, 1.5, this->random_);
  auto fitted = before, unit = before;
  const auto merged = segment_and_merge(fitted, 0, Direction::forward, {}, this->control(MergeShape::point_fit),
                                        this->law(shape.transport));
  segment_and_merge(unit, 0, Direction::forward, {}, this->control(MergeShape::unit), this->law(shape.transport));
  ASSERT_FALSE(merged.unit_fallback);
  const Vec<double, D> deleted = position<D>(before.q.data(), 3);
  auto miss = [&](const ChainState<D>& chain) {
    return (point_motion(chain, shape.transport, before.mesh.x[3]).r - deleted).norm();
  };
  EXPECT_LE(miss(fitted), 1e-14);
  EXPECT_GT(miss(unit), 1e-4);
}

TYPED_TEST(LengthControlOf, ABackwardEventIsTheMirrorImage) {
  constexpr int D = TypeParam::value;
  for (const WeightTransport transport : transports) {
    for (const MergeShape policy : policies) {
      for (const auto slopes : {JointSlopes::continuous, JointSlopes::free}) {
        const ChainShape shape{.elements = 6, .joint = 2, .rational = true, .transport = transport, .slopes = slopes};
        auto forward = smooth_chain<D>(shape, 1.5, this->random_);
        auto backward = reversed(forward);
        const Vec<double, D> deleted = position<D>(forward.q.data(), 3);
        const double x_deleted = forward.mesh.x[3];
        segment_and_merge(forward, 0, Direction::forward, {}, this->control(policy), this->law(transport));
        segment_and_merge(backward, 0, Direction::backward, {}, this->control(policy), this->law(transport));
        auto mirror = reversed(backward);
        if (policy ==
            MergeShape::point_fit) {  // the paper's norm prefers one end: other weights through the same point
          EXPECT_LE((point_motion(mirror, transport, x_deleted).r - deleted).norm(), 1e-14);
          mirror.mesh.weights[3] = forward.mesh.weights[3];
        }
        expect_same(mirror, forward, 1e-12);
      }
    }
  }
}

TYPED_TEST(LengthControlOf, SeparationBringsBackTheUniformMesh) {
  constexpr int D = TypeParam::value;
  for (const WeightTransport transport : transports) {
    for (const MergeShape policy : policies) {
      const JointSlopes slopes = policy == MergeShape::unit ? JointSlopes::continuous : JointSlopes::free;
      const ChainShape shape{.elements = 5, .joint = 4, .rational = true, .transport = transport, .slopes = slopes};
      auto chain = smooth_chain<D>(shape, 1.995, this->random_);  // about to leave
      auto mirror = reversed(chain);
      const auto before = chain;
      separate(chain, Direction::forward, this->control(policy), transport);
      EXPECT_TRUE(chain.joints.empty());
      for (std::size_t k = 0; k < chain.mesh.x.size(); ++k) {
        EXPECT_NEAR(chain.mesh.x[k], standard * static_cast<double>(k), 1e-15);
      }
      const auto tip = point_motion(chain, transport, 4 * standard),
                 was = point_motion(before, transport, 4 * standard);
      EXPECT_LE((tip.r - was.r).norm(), 1e-14) << "the new node lies on the old curve";
      EXPECT_LE((tip.v - was.v).norm(), 1e-13) << "and moves with its material point";
      separate(mirror, Direction::backward, this->control(policy), transport);
      expect_same(reversed(mirror), chain, 1e-12);
    }
  }
}

TYPED_TEST(LengthControlOf, AnEndMergeKeepsTheMotionBehindItsCutAndThePlaceOfTheMass) {
  constexpr int D = TypeParam::value;
  for (const WeightTransport transport : transports) {
    for (const MergeShape policy : policies) {
      const ChainShape shape{.elements = 5, .joint = 4, .rational = true, .transport = transport};
      auto chain = smooth_chain<D>(shape, 1.6, this->random_);
      auto mirror = reversed(chain);
      const auto before = chain;
      const auto merged = merge_at_end(chain, Direction::forward, this->control(policy), this->law(transport));
      EXPECT_TRUE(chain.joints.empty());
      ASSERT_TRUE(chain.loose.has_value());
      EXPECT_EQ(chain.loose->element, 4);
      EXPECT_EQ(chain.loose->x, before.mesh.x[4]);
      EXPECT_EQ(chain.loose->rate, before.joints.front().rate);
      for (std::size_t k = 0; k < chain.mesh.x.size(); ++k) {
        EXPECT_NEAR(chain.mesh.x[k], standard * static_cast<double>(k), 1e-15);
      }
      for (double x = 0.01; x < 4 * standard; x += 0.03) {
        const auto is = point_motion(chain, transport, x), was = point_motion(before, transport, x);
        EXPECT_LE((is.r - was.r).norm(), 1e-14);
        if (transport == WeightTransport::transported || x < 3 * standard) {
          EXPECT_LE((is.v - was.v).norm(), 1e-13);
        }
      }
      if (policy == MergeShape::point_fit && !merged.unit_fallback) {
        EXPECT_LE((point_motion(chain, transport, chain.loose->x).r - position<D>(before.q.data(), 4)).norm(), 1e-14);
      }
      merge_at_end(mirror, Direction::backward, this->control(policy), this->law(transport));
      auto image = reversed(mirror);
      EXPECT_EQ(image.loose->element, 4);
      EXPECT_NEAR(image.loose->x, chain.loose->x, 1e-15);
      EXPECT_EQ(image.loose->rate, chain.loose->rate);
      if (policy == MergeShape::point_fit) image.mesh.weights[4] = chain.mesh.weights[4];
      expect_same(image, chain, 1e-12);
    }
  }
}

TYPED_TEST(LengthControlOf, AnEndCutKeepsTheMotionAheadAndThatOfTheMass) {
  constexpr int D = TypeParam::value;
  for (const WeightTransport transport : transports) {
    for (const MergeShape policy : policies) {
      const ChainShape shape{.elements = 5, .rational = true, .transport = transport, .rider = 4};
      auto chain = random_chain<D>(shape, this->random_);
      chain.loose->x = 4.49 * standard;
      auto mirror = reversed(chain);
      const auto before = chain;
      cut_at_end<D>(chain, this->control(policy), this->law(transport));
      EXPECT_FALSE(chain.loose.has_value());
      EXPECT_EQ(chain.joints.front().node, 4);
      EXPECT_EQ(chain.mesh.x[4], before.loose->x);
      EXPECT_EQ(chain.joints.front().rate, before.loose->rate);
      const auto mass = point_motion(before, transport, before.loose->x);
      EXPECT_LE((position<D>(chain.rate.data(), 4) - mass.v - before.loose->rate * mass.r_x).norm(), 1e-13);
      EXPECT_LE((slope<D>(chain.rate.data(), 4) - mass.v_x - before.loose->rate * mass.r_xx).norm(), 1e-12);
      for (double x = before.loose->x + 0.001; x < 5 * standard; x += 0.01) {
        const auto is = point_motion(chain, transport, x), was = point_motion(before, transport, x);
        EXPECT_LE((is.r - was.r).norm(), 1e-14);
        if (transport == WeightTransport::transported) {
          EXPECT_LE((is.v - was.v).norm(), 1e-12);
        }
      }
      cut_at_end<D>(mirror, this->control(policy), this->law(transport));
      auto image = reversed(mirror);
      if (policy == MergeShape::point_fit) image.mesh.weights[3] = chain.mesh.weights[3];
      expect_same(image, chain, 1e-12);
    }
  }
}

TEST(LengthControl, TriggerHasHysteresis) {
  LengthControl control;
  control.standard_length = 0.2;
  EXPECT_DOUBLE_EQ(control.trigger_length(), 0.3003);
  control.hysteresis = 0;
  EXPECT_DOUBLE_EQ(control.trigger_length(), 0.3);
}

}  // namespace
}  // namespace vlbeam::test
