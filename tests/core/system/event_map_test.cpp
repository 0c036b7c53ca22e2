#include <gtest/gtest.h>

#include "core/length_control/chain_motion.hpp"
#include "core/length_control/remeshing.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/motion/system/event_map.hpp"
#include "tests/core/support/chain_models.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class EventMapOf : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(EventMapOf, Dimensions);

/// A beam in random motion before and behind a cut and a merge at its joint, with accelerations at random before.
template <int D>
struct Carried {
  explicit Carried(unsigned seed) : random(seed) {
    const ChainShape shape{.elements = 6, .joint = 2};
    auto model = model_of<D>(shape, random);
    before = random_chain<D>(shape, random);
    beam = std::make_unique<CurrentBeam<D>>(model, before);
    a = Eigen::VectorXd(beam->coordinates());
    for (double& number : a) number = random.uniform(-1, 1);
    map.remember({before, beam->places(), beam->dofs()});
    after = before;
    segment_and_merge(after, 0, Direction::forward, {}, model.length_control, beam->moving_law(0));
    places_before = beam->places();
    beam->adopt(after);
    to = Eigen::VectorXd::Constant(beam->coordinates(), 1e9);
    goes_on = map.carry(*beam, a, to);
  }

  /// Velocity of the material point x, `t` seconds on: a step of q, q' and x along the accelerations.
  Vec<double, D> velocity_at(double x, double t) const {
    ChainState<D> moved = before;
    for (std::size_t i = 0; i < moved.q.size(); ++i) {
      const double acceleration = a[static_cast<Eigen::Index>(i)];
      moved.q[i] += t * before.rate[i] + t * t / 2 * acceleration;
      moved.rate[i] += t * acceleration;
    }
    auto& joint = moved.joints.front();
    const double acceleration = a[places_before.front().mark];
    moved.mesh.x[static_cast<std::size_t>(joint.node)] += t * joint.rate + t * t / 2 * acceleration;
    joint.rate += t * acceleration;
    return motion_at(moved, before.mesh.element_at(x), x, WeightTransport::frozen).v;
  }

  Random random;
  ChainState<D> before, after;
  std::unique_ptr<CurrentBeam<D>> beam;
  std::vector<JointPlace> places_before;
  EventMap<D> map;
  Eigen::VectorXd a, to;
  bool goes_on = false;
};

TYPED_TEST(EventMapOf, NodesThatWereThereKeepTheirAccelerations) {
  constexpr int D = TypeParam::value;
  const Carried<D> carried(7);
  ASSERT_TRUE(carried.goes_on);
  const auto& places = carried.beam->places();
  EXPECT_EQ(places.front().node, carried.places_before.front().node + 1);
  EXPECT_EQ(carried.to[places.front().mark], carried.a[carried.places_before.front().mark]);
  const auto of = [](const Eigen::VectorXd& all, int node) {
    return Eigen::VectorXd(all.segment<node_size<D>>(Eigen::Index{node_size<D>} * node));
  };
  EXPECT_EQ(of(carried.to, 0), of(carried.a, 0));
  EXPECT_EQ(of(carried.to, 1), of(carried.a, 1));
  EXPECT_EQ(of(carried.to, 3), of(carried.a, 2));  // the joint
  for (int node = 4; node <= carried.beam->mesh().last(); ++node) EXPECT_EQ(of(carried.to, node), of(carried.a, node));
}

TYPED_TEST(EventMapOf, ANewNodeTakesTheAccelerationOfItsMaterialPoint) {
  constexpr int D = TypeParam::value;
  const Carried<D> carried(11);
  const double x = carried.beam->mesh().x[2], small = 1e-5, way = 1e-4;
  const auto acceleration = [&](double at) -> Vec<double, D> {
    return (carried.velocity_at(at, small) - carried.velocity_at(at, -small)) / (2 * small);
  };
  const Vec<double, D> slope_acceleration = (acceleration(x + way) - acceleration(x - way)) / (2 * way);
  EXPECT_LE((Vec<double, D>(position<D>(carried.to.data(), 2)) - acceleration(x)).norm(), 1e-6);
  EXPECT_LE((Vec<double, D>(slope<D>(carried.to.data(), 2)) - slope_acceleration).norm(), 1e-3);
}

TYPED_TEST(EventMapOf, NothingGoesOnBehindWhatForgets) {
  constexpr int D = TypeParam::value;
  Carried<D> carried(3);
  carried.map.forget();
  EXPECT_FALSE(carried.map.carry(*carried.beam, carried.a, carried.to));
}

/// There are more coordinates behind a cut than before it, and fewer behind a merge.
TYPED_TEST(EventMapOf, StepsGoOnWhereNodesComeAndGo) {
  constexpr int D = TypeParam::value;
  Random random(11);
  const ChainShape shape{.elements = 8, .joint = 3};
  auto model = model_of<D>(shape, random);
  model.length_control.lower = 0.2;
  ChainState<D> chain = random_chain<D>(shape, random);
  std::ranges::fill(chain.q, 0.0);  // straight and at rest, but for the mass that slides
  std::ranges::fill(chain.rate, 0.0);
  for (int k = 0; k <= chain.mesh.last(); ++k) {
    position<D>(chain.q.data(), k)[0] = chain.mesh.x[static_cast<std::size_t>(k)];
    slope<D>(chain.q.data(), k)[0] = 1;
  }
  auto& joint = chain.joints.front();
  joint.rate = position<D>(chain.rate.data(), joint.node)[0] = 60 * shape.element_length;
  int cuts = 0, merges = 0;
  const auto end_of = [&](const IntegrationOptions& options) {
    BeamSystem<D> system(model, chain);
    system.on_event = [&](const EventRecord<D>& record) {
      const int more = record.after.mesh.elements() - record.before.mesh.elements();
      cuts += more > 0 ? 1 : 0;
      merges += more < 0 ? 1 : 0;
    };
    Eigen::VectorXd y = system.initial_state();
    double t = 0;
    SolverCounters counters;
    EXPECT_TRUE(integrate(system, y, t, 0.04, {}, options, counters));
    return y;
  };
  IntegrationOptions options;
  options.type = IntegrationMethod::fehlberg78;
  options.tolerances = {1e-11, 1e-11};
  const Eigen::VectorXd exact = end_of(options);
  options.type = IntegrationMethod::generalized_alpha;
  options.generalized_alpha.step = 1e-4;
  const Eigen::VectorXd y = end_of(options);
  EXPECT_GE(cuts, 2);
  EXPECT_GE(merges, 2);
  ASSERT_EQ(y.size(), exact.size());
  EXPECT_LE((y - exact).norm(), 1e-3 * exact.norm());
}

}  // namespace
}  // namespace vlbeam::test
