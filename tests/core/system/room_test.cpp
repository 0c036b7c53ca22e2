// What a user adds to a beam besides forces: a source of events, and a constraint, each one class.
#include "mechanics/motion/system/room.hpp"

#include <gtest/gtest.h>

#include "mechanics/motion/system/beam_system.hpp"

namespace vlbeam::test {
namespace {

constexpr double floor_level = -0.3;  // [m]

/// A node strikes the floor and rebounds without loss.
class FloorUnderNode final : public EventSource<2> {
 public:
  FloorUnderNode(const BeamInside<2>& inside, int node) : inside_(inside), height_(node_size<2> * node + 1) {}

  void add_guards(const Eigen::VectorXd& y, double /*t*/, Guards& guards) const override {
    guards.push_back({0, 0, floor_level - y[height_]});
  }
  std::vector<PendingEvent> due(const Guard& /*first*/, const Eigen::VectorXd& /*y*/, double /*t*/) const override {
    return {{.type = EventType::contact, .observes_all = true}};
  }
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& /*dues*/, ChainState<2>& chain, Eigen::VectorXd& y,
                                   double t) override {
    const Eigen::Index n = inside_.beam.coordinates();
    Eigen::VectorXd answer = Eigen::VectorXd::Unit(n, height_);  // to an impulse there
    inside_.mass.solve(inside_.beam.masses_at(y, t), y.data(), answer.data());
    y.segment(n, n) -= 2 * y[n + height_] / answer[height_] * answer;
    chain = inside_.beam.chain(y, t);
    return {{}};
  }

 private:
  BeamInside<2> inside_;
  Eigen::Index height_;
};

struct Floor final : Room<2> {
  void add_sources(const BeamInside<2>& inside, EventSources<2>& sources) const override {
    sources.push_back(std::make_unique<FloorUnderNode>(inside, 1));
  }
};

/// A rod between the ends of a beam.
struct RodBetweenEnds final : Room<2> {
  void add_links(const CurrentBeam<2>& beam, std::vector<BeamLink<2>>& links) const override {
    links.push_back({0, beam.mesh().last(), 1, {}, {}});
  }
};

/// A beam of 1 m that bends and falls, free of all but the room.
struct Falling {
  explicit Falling(std::shared_ptr<const Room<2>> room) {
    BeamModel<2> model;
    model.section = {1.3, {200, 0.3}, 0, 0};
    model.gravity = {0, -9.81};
    model.length_control.standard_length = 0.25;
    model.rooms = {std::move(room)};
    ChainState<2> chain;
    for (int k = 0; k <= 4; ++k) {
      const double x = 0.25 * k;
      chain.mesh.x.push_back(x);
      if (k > 0) chain.mesh.weights.push_back({unit_weights, x - 0.25, x});
      chain.q.insert(chain.q.end(), {x, 0, 1, 0});
      chain.rate.insert(chain.rate.end(), {0, 0, 0, k - 2.0});
    }
    system = std::make_unique<BeamSystem<2>>(model, chain);
    y = system->initial_state();
  }
  Observation<2> seen() const { return system->observe(y, t, own_points); }
  void run(double until, IntegrationMethod type) {
    IntegrationOptions options;
    options.type = type;
    options.tolerances.rtol = options.tolerances.atol = 1e-10;
    options.generalized_alpha.step = 1e-4;
    SolverCounters counters;
    ASSERT_TRUE(integrate(*system, y, t, until, {}, options, counters));
  }

  std::unique_ptr<BeamSystem<2>> system;
  Eigen::VectorXd y;
  double t = 0;
};

TEST(Room, BringsEventsOfItsOwn) {
  Falling beam(std::make_shared<Floor>());
  const double before = beam.seen().energy.total();
  int strikes = 0;
  beam.system->on_event = [&](const EventRecord<2>& event) { strikes += event.type == EventType::contact ? 1 : 0; };
  beam.run(0.5, IntegrationMethod::dopri5);
  EXPECT_GE(strikes, 1);
  EXPECT_GE(beam.y[node_size<2> + 1], floor_level - 1e-9);
  EXPECT_NEAR(beam.seen().energy.total(), before, 1e-6);
  EXPECT_GT(beam.seen().momentum[1], -1.3 * 9.81 * 0.5 + 0.1) << "the floor pushes";
}

TEST(Room, BringsLinksOfItsOwn) {
  for (const IntegrationMethod type : {IntegrationMethod::dopri5, IntegrationMethod::generalized_alpha}) {
    Falling beam(std::make_shared<RodBetweenEnds>());
    const double before = beam.seen().energy.total(), fell = beam.seen().momentum[1] - 1.3 * 9.81 * 0.3;
    beam.run(0.3, type);
    const Vec<double, 2> apart = position<2>(beam.y.data(), 4) - position<2>(beam.y.data(), 0);
    EXPECT_NEAR(apart.norm(), 1, 1e-8);
    EXPECT_NEAR(beam.seen().energy.total(), before, type == IntegrationMethod::dopri5 ? 1e-6 : 1e-4);
    EXPECT_NEAR(beam.seen().momentum[1], fell, 1e-8) << "it acts within the beam";
  }
}

}  // namespace
}  // namespace vlbeam::test
