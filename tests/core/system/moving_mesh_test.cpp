
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/flow/moving_mesh.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "mechanics/spin/spin_unknowns.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/flows.hpp"

namespace vlbeam::test {
namespace {

const CircularShaft soft_shaft{.radius = 0.02, .density = 1300, .youngs_modulus = 1e7};

/// Nodes at rest, at 0 and length, but for what the tests make of them.
template <int D>
BeamModel<D> resting(int elements, double length = 1) {
  BeamModel<D> model;
  model.section = soft_shaft.section();
  flow_in(model).motion = MeshMotion({{0, steadily(0, 0)}, {elements, steadily(length, 0)}});
  return model;
}

template <class Dimension>
class MovingMeshTest : public ::testing::Test {
 protected:
  Random random_{11};
};
TYPED_TEST_SUITE(MovingMeshTest, Dimensions, DimensionNames);

TYPED_TEST(MovingMeshTest, WithNodesAtRestItIsTheBeamOfFixedElements) {
  constexpr int D = TypeParam::value;
  const Vec<double, D> tangent = this->random_.template vector<D>();
  const Vec<double, D> gravity = this->random_.template vector<D>(10);
  BeamModel<D> model = resting<D>(6);
  model.gravity = gravity;
  model.section.damping = D == 2 ? 0.01 : 0;
  model.start = Support<D>::direction_clamp(tangent);
  model.end = Support<D>::pin();
  BeamSystem<D> flowing(model, straight_chain(model));
  const Eigen::VectorXd y = random_state(flowing, this->random_);

  BeamModel<D> fixed;
  fixed.section = model.section;
  fixed.gravity = gravity;
  fixed.start = Support<D>::direction_clamp(tangent);
  fixed.end = Support<D>::pin();
  ChainState<D> chain;
  for (int k = 0; k <= 6; ++k) chain.mesh.x.push_back(k / 6.0);
  chain.mesh.weights.resize(6);
  chain.q.assign(y.data(), y.data() + flowing.coordinates());
  chain.rate.assign(y.data() + flowing.coordinates(), y.data() + 2 * flowing.coordinates());
  BeamSystem<D> system(fixed, chain);

  Eigen::VectorXd a(flowing.size()), b(system.size());
  flowing.rhs(y, a, 0);
  system.rhs(y.head(b.size()), b, 0);
  const Eigen::Index n = 2 * flowing.coordinates();
  EXPECT_LE((a - b).head(n).norm(), 1e-10 * b.head(n).norm());
}

TYPED_TEST(MovingMeshTest, AStraightBeamMovesOnFreelyHoweverItsNodesTravel) {
  constexpr int D = TypeParam::value;
  auto wave = [](double size, double speed) -> TimeFunction {
    return [=](double t) {
      return Prescribed{size * std::sin(speed * t), size * speed * std::cos(speed * t),
                        -size * speed * speed * std::sin(speed * t)};
    };
  };
  auto shifted = [](double by, const TimeFunction& f) -> TimeFunction {
    return [=](double t) {
      const Prescribed at = f(t);
      return Prescribed{by + at.value, at.rate, at.acceleration};
    };
  };
  // stiffness, mass and spin of order one, so that no force hides behind another
  BeamModel<D> model = resting<D>(5);
  model.section = {.rhoA = 1.3, .stiffness = {2.1, 0.7}};
  spin_in(model).section = {.rhoIp = 1.3, .GIp = 0.9};
  flow_in(model).motion =
      MeshMotion({{0, shifted(0, wave(0.1, 1.3))}, {2, shifted(2, wave(0.3, 2.1))}, {5, shifted(5, wave(0.4, 0.7))}});
  BeamSystem<D> beam(model, straight_chain(model));
  const double t = 0.4, spin = 1.7, velocity = 0.6;
  const Vec<double, D> along = this->random_.template vector<D>().normalized();
  const Eigen::VectorXd y = straight_state<D>(beam, Vec<double, D>::Zero(), along, 1, velocity, spin, t);
  const Eigen::Index n = beam.coordinates();
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(n), residual(n);
  beam.move_nodes(t);
  for (int k = 0; k <= beam.mesh().last(); ++k) {
    position<D>(acceleration.data(), k) = along * (*beam.marks())[static_cast<std::size_t>(k)].acceleration;
  }
  beam.new_second_order()->residual(y.head(n), y.segment(n, n), acceleration, t, residual);
  EXPECT_LE(residual.template lpNorm<Eigen::Infinity>(), 1e-13);
}

TYPED_TEST(MovingMeshTest, DrivenAnglesFollowTheirFunctions) {
  constexpr int D = TypeParam::value;
  BeamModel<D> model = resting<D>(4);
  spin_in(model).section = soft_shaft.spin();
  spin_in(model).drives = {{0, [](double t) { return Prescribed{t * t, 2 * t, 2}; }}};
  BeamSystem<D> beam(model, straight_chain(model));
  Eigen::VectorXd y = random_state(beam, this->random_), dydt(y.size());
  beam.rhs(y, dydt, 0);
  EXPECT_EQ(dydt[beam.coordinates() + angle_of(beam, 0)], 2);
}

TYPED_TEST(MovingMeshTest, StaticTorqueIsExactWithOneElement) {
  constexpr int D = TypeParam::value;
  const double length = 1.7, torque = 0.3;
  BeamModel<D> model = resting<D>(1, length);
  spin_in(model).section = soft_shaft.spin();
  model.start = Support<D>::clamp();
  spin_in(model).drives = {{0, steadily(0, 0)}};
  spin_in(model).torques.points = {{.node = 1, .torque = [=](double) { return torque; }}};
  BeamSystem<D> beam(model, straight_chain(model));
  Eigen::VectorXd y = straight_state<D>(beam, Vec<double, D>::Zero(), Vec<double, D>::UnitX(), 1, 0, 0);
  y[angle_of(beam, 1)] = torque * length / spin_in(model).section.GIp;
  Eigen::VectorXd dydt(y.size());
  beam.rhs(y, dydt, 0);
  EXPECT_LE(dydt.head(2 * beam.coordinates()).norm(), 1e-9 * torque / (spin_in(model).section.rhoIp * length));
}

TEST(MovingMesh, WithoutSpinThereIsNoAngle) {
  BeamModel<3> model = resting<3>(4);
  EXPECT_EQ(BeamSystem<3>(model, straight_chain(model)).coordinates(), 6 * 5);
  spin_in(model).section = soft_shaft.spin();
  EXPECT_EQ(BeamSystem<3>(model, straight_chain(model)).coordinates(), 7 * 5);
}

TEST(MovingMesh, SpinLeavesTheAxisAlone) {
  Random random(3);
  BeamModel<3> model = resting<3>(4);
  flow_in(model).motion = MeshMotion({{0, steadily(0, -2)}, {4, steadily(1, -1)}});
  BeamSystem<3> plain(model, straight_chain(model));
  spin_in(model).section = soft_shaft.spin();
  BeamSystem<3> spinning(model, straight_chain(model));
  const Eigen::VectorXd y = random_state(spinning, random);
  const Eigen::Index n = plain.coordinates(), m = spinning.coordinates();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(plain.size()), dzdt(plain.size()), dydt(spinning.size());
  z.head(2 * n) << y.head(n), y.segment(m, n);
  plain.rhs(z, dzdt, 0);
  spinning.rhs(y, dydt, 0);
  EXPECT_EQ(dydt.segment(m, n), dzdt.segment(n, n));
}

TEST(MovingMesh, StopsWhereItsNodesTangle) {
  BeamModel<3> model = resting<3>(3);
  flow_in(model).motion = MeshMotion({{0, steadily(0, 0)}, {1, steadily(0.5, 2)}, {3, steadily(1, 0)}});
  for (const IntegrationMethod type : {IntegrationMethod::dopri5, IntegrationMethod::generalized_alpha}) {
    BeamSystem<3> beam(model, straight_chain(model));
    EXPECT_NO_THROW(moving_mesh_of(beam).check_motion(0.24));
    EXPECT_THROW(moving_mesh_of(beam).check_motion(0.26), InvalidInput);
    Eigen::VectorXd y = straight_state<3>(beam, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 1, 0, 0);
    IntegrationOptions options;
    options.type = type;
    options.tolerances = {1e-6, 1e-6};
    SolverCounters counters;
    double t = 0;
    try {
      integrate(beam, y, t, 1, {}, options, counters);
      ADD_FAILURE() << "ran on";
    } catch (const ComputationFailed& failure) {
      EXPECT_LE(failure.t, 0.25);
      EXPECT_NE(std::string(failure.what()).find("tangle"), std::string::npos) << failure.what();
    }
  }
}

/// The pointer of the field that is wrong.
template <class Change>
std::string field_of(const Change& change) {
  BeamModel<3> model = resting<3>(4);
  spin_in(model).section = soft_shaft.spin();
  change(model);
  try {
    const BeamSystem<3> beam(model, straight_chain(model));
  } catch (const InvalidInput& error) {
    return error.field;
  }
  return "";
}

TEST(MovingMesh, RefusesWhatMakesNoSense) {
  auto unit = [](double) { return 1.0; };
  EXPECT_EQ(field_of([](auto&) {}), "");
  EXPECT_EQ(field_of([](auto& m) {
              flow_in(m).motion = MeshMotion({{0, steadily(1, 0)}, {4, steadily(0, 0)}});
            }),
            "mesh motion");
  for (const int node : {0, 4}) {
    EXPECT_EQ(field_of([&](auto& m) { m.held_nodes = {{node, Support<3>::pin()}}; }), "supports");
  }
  EXPECT_EQ(field_of([](auto& m) { m.held_nodes = {{1, Support<3>::pin()}, {1, Support<3>::clamp()}}; }), "supports");
  EXPECT_EQ(field_of([](auto& m) {
              m.start = Support<3>::slide({1, 0, 0});
              m.end = Support<3>::slide({0, 1, 0});
            }),
            "supports");
  EXPECT_EQ(field_of([&](auto& m) { m.loads.points = {{.node = 5, .follower = unit}}; }), "loads");
  EXPECT_EQ(field_of([](auto& m) { spin_in(m).drives = {{0, steadily(0, 1)}, {0, steadily(0, 1)}}; }), "drives");
  EXPECT_EQ(field_of([](auto& m) { spin_in(m).drives = {{0, steadily(0, 1)}, {4, steadily(0, 2)}}; }), "drives");
  EXPECT_EQ(field_of([&](auto& m) {
              spin_in(m).drives = {{4, steadily(0, 1)}};
              spin_in(m).torques.points = {{.node = 4, .torque = unit}};
            }),
            "loads");
}

TEST(CircularShaft, RefusesWhatIsNoShaft) {
  auto field = [](CircularShaft of) -> std::string {
    try {
      of.check();
    } catch (const InvalidInput& error) {
      return error.field;
    }
    return "";
  };
  EXPECT_EQ(field({}), "");
  EXPECT_EQ(field({.radius = 0}), "radius");
  EXPECT_EQ(field({.density = -1}), "density");
  EXPECT_EQ(field({.youngs_modulus = 0}), "youngs_modulus");
  EXPECT_EQ(field({.poisson_ratio = 0.5}), "poisson_ratio");
  EXPECT_EQ(field({.poisson_ratio = -1}), "poisson_ratio");
}

}  // namespace
}  // namespace vlbeam::test
