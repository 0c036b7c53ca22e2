// Events of a long beam look at the part around its joint: they do to it what looking at all of it does.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scene/build.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

constexpr int elements = 190, middle = 94;

/// Where the joint is at time t, in elements from where it starts.
Prescribed to_and_fro(double t) {
  const double omega = 2 * std::numbers::pi;
  return {8 * std::sin(omega * t), 8 * omega * std::cos(omega * t), -8 * omega * omega * std::sin(omega * t)};
}

/// The events of a beam whose joint is led to and fro along it by hand, its nodes moving at random.
template <int D>
struct Walk {
  Walk(BeamModel<D> model, const ChainState<D>& chain, int most_whole) {
    model.length_control.most_whole = most_whole;
    BeamSystem<D> system(model, chain);
    system.on_event = [this](const EventRecord<D>& record) {
      jumps.push_back(record.jump.total());
      momentum_jumps.push_back(record.momentum_jump);
      held.push_back(record.before.mesh.elements());
    };
    Eigen::VectorXd y = system.initial_state();
    const double unit = model.length_control.standard_length, from = y[system.dofs().mark()];
    constexpr int steps = 240;
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      y[system.dofs().mark()] = from + unit * to_and_fro(t).value;
      const Guards guards = system.guards(y, t);
      const auto due = std::ranges::find_if(guards, [](const Guard& guard) { return guard.value > 0; });
      if (due == guards.end()) continue;
      system.handle_event(static_cast<int>(due - guards.begin()), y, t);
      states.push_back(y);
      Eigen::VectorXd to = Eigen::VectorXd::Zero(system.coordinates());
      EXPECT_TRUE(system.accelerations().last_event().carry(system, y.head(y.size()), to));
      carried.push_back(to);
    }
    rates = Eigen::VectorXd::Zero(y.size());
    system.rhs(y, rates, 0);
    BeamSystem<D> anew(model, system.chain(y, 0));
    rates_anew = Eigen::VectorXd::Zero(y.size());
    anew.rhs(y, rates_anew, 0);
  }

  std::vector<Eigen::VectorXd> states, carried, momentum_jumps;
  std::vector<double> jumps;
  std::vector<int> held;
  Eigen::VectorXd rates, rates_anew;
};

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

template <int D>
void expect_the_same(const BeamModel<D>& model, const ChainState<D>& chain, std::size_t least_events) {
  const Walk<D> local(model, chain, 20), whole(model, chain, std::numeric_limits<int>::max());
  ASSERT_GE(local.states.size(), least_events);
  ASSERT_EQ(local.states.size(), whole.states.size());
  for (std::size_t i = 0; i < local.states.size(); ++i) {
    EXPECT_LT(local.held[i], 120);
    EXPECT_GE(whole.held[i], elements - 1);
    EXPECT_LE(difference(local.states[i], whole.states[i]), 1e-15) << "event " << i;
    EXPECT_LE(difference(local.carried[i], whole.carried[i]), 1e-15) << "event " << i;
    EXPECT_NEAR(local.jumps[i], whole.jumps[i], 1e-12 * std::abs(whole.jumps[i]) + 1e-13);
    EXPECT_LE((local.momentum_jumps[i] - whole.momentum_jumps[i]).cwiseAbs().maxCoeff(),
              1e-15 * whole.states[i].squaredNorm())
        << "event " << i;
  }
  EXPECT_LE(difference(local.rates, whole.rates), 1e-12);
  EXPECT_LE(difference(local.rates, local.rates_anew), 1e-9) << "what is kept of the beam is that of the beam";
}

template <class Dimension>
class LocalEvent : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LocalEvent, Dimensions);

TYPED_TEST(LocalEvent, DoesAsOneOfTheWholeBeam) {
  constexpr int D = TypeParam::value;
  for (const auto velocities : {VelocityTransfer::nodal, VelocityTransfer::projected}) {
    for (const auto slopes : {JointSlopes::continuous, JointSlopes::tangent}) {
      for (const bool rational : {false, true}) {
        Random random(3);
        const ChainShape shape{.elements = elements, .joint = middle, .rational = rational, .slopes = slopes};
        auto model = model_of<D>(shape, random);
        model.length_control.velocities = velocities;
        model.masses = masses_on<D>(elements * shape.element_length);
        expect_the_same(model, random_chain<D>(shape, random), 25);
      }
    }
  }
}

TYPED_TEST(LocalEvent, CutsAndMergesApart) {
  constexpr int D = TypeParam::value;
  Random random(5);
  const ChainShape shape{.elements = elements, .joint = middle};
  auto model = model_of<D>(shape, random);
  model.length_control.velocities = VelocityTransfer::projected;
  model.length_control.lower = 0.2;
  const auto chain = random_chain<D>(shape, random);
  expect_the_same(model, chain, 40);
}

TYPED_TEST(LocalEvent, GivesGuidedJointsTheSameVelocities) {
  constexpr int D = TypeParam::value;
  Random random(7);
  const ChainShape shape{.elements = elements, .joint = middle};
  auto model = model_of<D>(shape, random);
  model.length_control.velocities = VelocityTransfer::projected;
  const auto chain = random_chain<D>(shape, random);
  model.joints.front().x = [from = chain.mesh.x[middle], unit = shape.element_length](double t) -> Prescribed {
    const Prescribed at = to_and_fro(t);
    return {from + unit * at.value, unit * at.rate, unit * at.acceleration};
  };
  expect_the_same(model, chain, 25);
}

/// A beam that waves, and moves as a wave on it does.
template <int D>
ChainState<D> waving(ChainState<D> chain) {
  const double k = 20 / chain.mesh.length();
  for (int node = 0; node <= chain.mesh.last(); ++node) {
    const double u = k * chain.mesh.x[static_cast<std::size_t>(node)];
    for (int c = 0; c < D; ++c) {
      const double a = 0.02 / k * (c + 1), phase = 0.7 * c;
      position<D>(chain.q.data(), node)[c] += a * std::sin(u + phase);
      slope<D>(chain.q.data(), node)[c] += a * k * std::cos(u + phase);
      position<D>(chain.rate.data(), node)[c] = 5 * a * k * std::cos(u + phase) + 0.1 * c;
      slope<D>(chain.rate.data(), node)[c] = -5 * a * k * k * std::sin(u + phase);
    }
  }
  for (auto& joint : chain.joints) {
    if (!joint.kink) continue;
    joint.kink->slope = slope<D>(chain.q.data(), joint.node);
    joint.kink->rate = slope<D>(chain.rate.data(), joint.node);
  }
  return chain;
}

/// What conservative velocities change near the joint alone is another choice than what they change everywhere.
TYPED_TEST(LocalEvent, KeepsEnergyAndMomentaByVelocitiesNearTheJoint) {
  constexpr int D = TypeParam::value;
  for (const auto slopes : {JointSlopes::continuous, JointSlopes::tangent}) {
    Scene scene = falling_beam(ElementKind::ale_rancf, elements);
    scene.dimension = D;
    scene.sliding_mass->position = (middle + 0.499) / elements;  // a cut behind it and a merge ahead are due
    scene.length_control.velocities = VelocityTransfer::conservative;
    scene.sliding_mass->slopes = slopes;
    auto model = build_model<D>(scene);
    model.length_control.most_whole = 20;
    BeamSystem<D> system(model, waving(build_chain<D>(scene)));
    std::vector<EventRecord<D>> records;
    system.on_event = [&records](const EventRecord<D>& record) { records.push_back(record); };
    Eigen::VectorXd y = system.initial_state();
    for (const int guard : {0, 1, 0, 1}) {  // each undoes the one before
      const Eigen::VectorXd before = y;
      const Observation<D> seen = system.observe(y, 0, own_points);
      system.handle_event(guard, y, 0);
      const Observation<D> now = system.observe(y, 0, own_points);
      EXPECT_LT(records.back().before.mesh.elements(), 120);
      EXPECT_TRUE(records.back().conserved);
      EXPECT_NEAR(now.energy.total(), seen.energy.total(), 1e-13 * (seen.energy.kinetic + seen.energy.axial));
      EXPECT_LE((now.momentum - seen.momentum).norm(), 1e-13 * seen.momentum.norm());
      EXPECT_LE((now.angular_momentum - seen.angular_momentum).norm(), 1e-13 * seen.momentum.norm());
      const Eigen::Index far = 30 * node_size<D>, rates = system.coordinates();
      EXPECT_EQ(y.segment(rates, far), before.segment(rates, far)) << "beyond the part";
    }
    EXPECT_EQ(records.size(), 4U);
  }
}

TEST(LocalEventOfCurvedBeam, DoesAsOneOfTheWholeBeam) {
  for (const auto merge : {MergePolicy::rest_arc, MergePolicy::point_fit, MergePolicy::relaxed}) {
    Scene scene = semicircle(elements);
    scene.sliding_mass->position = std::numbers::pi;
    scene.length_control.merge = merge;
    auto model = build_model<2>(scene);
    model.length_control.velocities = VelocityTransfer::projected;
    auto chain = build_chain<2>(scene);
    Random random(11);
    for (double& rate : chain.rate) rate = random.uniform(-1, 1);
    expect_the_same(model, chain, 25);
  }
}

}  // namespace
}  // namespace vlbeam::test
