// What a scene puts on its beam: point masses, moments, an initial velocity; and what it refuses of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "mechanics/spin/spin.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

Scene beam(ElementKind element) {
  Scene scene;
  scene.beam.elements = 8;
  scene.beam.element = element;
  scene.start.type = SupportType::clamp;
  scene.integrator.type = IntegratorType::fehlberg78;
  scene.integrator.rtol = scene.integrator.atol = 1e-12;
  scene.duration = 0.3;
  scene.output.interval = 0.05;
  return scene;
}

RunResult run(const Scene& scene) {
  RunResult result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  return result;
}

double largest_energy(const RunResult& result) {
  double largest = 0;
  for (const Sample& s : result.samples) largest = std::max(largest, s.energy.kinetic + std::abs(s.energy.gravity));
  return largest;
}

/// Nodes come and go and the sliding mass passes over two of them: they stay on their material points, and energy is
/// kept. A passage, where the acceleration jumps, is an event.
TEST(PointMasses, SurviveLengthControl) {
  for (const auto element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    Scene scene = beam(element);
    scene.duration = 0.42;
    scene.sliding_mass.emplace().position = 0.1;
    scene.point_masses = {{2, 0.1}, {3, 0.2}, {8, 0.1}};
    const RunResult result = run(scene);
    const auto passages = std::ranges::count(result.events, EventType::passage, &Event::type);
    EXPECT_GE(result.events.size(), 2U + static_cast<std::size_t>(passages));
    EXPECT_EQ(passages, 2);
    EXPECT_GT(*result.samples.back().joint_position, 0.3);
    EXPECT_LE(result.max_energy_drift, 1e-9 * largest_energy(result));
    Scene ahead = scene;
    ahead.point_masses = {{6, 0.2}, {8, 0.1}};
    const RunResult unpassed = run(ahead);
    EXPECT_GE(unpassed.events.size(), 2U);
    EXPECT_LE(unpassed.max_energy_drift, 1e-11 * largest_energy(unpassed));
    Scene implicit = scene;
    implicit.integrator = {};
    implicit.integrator.type = IntegratorType::generalized_alpha;
    implicit.integrator.step = 1e-4;
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      implicit.constraints = constraints;
      const RunResult other = run(implicit);
      EXPECT_NEAR(*other.samples.back().joint_position, *result.samples.back().joint_position, 2e-4);
    }
  }
}

/// A bead on a stiff wire that tilts to and fro passes over a mass there and back.
TEST(PointMasses, ArePassedInBothDirections) {
  Scene scene = beam(ElementKind::ale_ancf);
  scene.gravity = {9.81, 0, 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e4, .EI = 20, .rhoA = 2};
  scene.end.type = SupportType::clamp;
  scene.sliding_mass.emplace().position = 0.55;
  scene.sliding_mass->mass = 0.2;
  scene.sliding_mass->velocity = -2.2;
  scene.point_masses = {{3, 0.3}, {7, 0.1}};
  scene.duration = 0.4;
  const RunResult result = run(scene);
  std::vector<double> passed;
  for (const Event& event : result.events) {
    if (event.type != EventType::passage) continue;
    passed.push_back(event.joint_position);
    EXPECT_NEAR(event.joint_position, 0.375, 1e-12);
    EXPECT_LE(std::abs(event.discrete_jump), 1e-12);
  }
  EXPECT_EQ(passed.size(), 2U) << "there and back";
  EXPECT_LE(result.max_energy_drift, 1e-9 * largest_energy(result));
}

/// The momentum of all there is falls as its weight says.
TEST(PointMasses, HaveMomentumAndWeight) {
  Scene scene = beam(ElementKind::ale_ancf);
  scene.start.type = SupportType::free;
  scene.point_masses = {{0, 0.3}, {5, 0.5}};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 6000, .EI = 0.2, .rhoA = 2};
  const RunResult result = run(scene);
  for (const Sample& s : result.samples) {
    EXPECT_NEAR(s.momentum[1], -9.81 * 2.8 * s.t, 1e-10);
    EXPECT_NEAR(s.energy.total(), result.samples.front().energy.total(), 1e-9);
  }
}

/// What a moment does is booked; the state counts it.
TEST(Moments, DoTheWorkThatIsBooked) {
  Scene scene = beam(ElementKind::ale_ancf);
  scene.loads = {{.type = LoadType::moment, .node = 8, .x = {}, .magnitude = {.value = 0.4, .ramp = 0.1}, .turn = {}},
                 {.type = LoadType::moment, .node = 3, .x = {}, .magnitude = {.rate = -2}, .turn = {}}};
  scene.sliding_mass.emplace().position = 0.2;
  const RunResult result = run(scene);
  EXPECT_GT(std::abs(result.samples.back().flow->ledger.loads), 1e-2);
  EXPECT_LE(result.max_energy_drift, 1e-9 * largest_energy(result));
}

/// A free beam keeps both momenta of the motion that it starts with.
TEST(InitialVelocity, IsThatOfARigidMotion) {
  Scene scene = beam(ElementKind::ale_ancf);
  scene.gravity = {};
  scene.start.type = SupportType::free;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 6000, .EI = 0.2, .rhoA = 2};
  scene.initial_velocity = {.translation = {0.3, -0.2, 0}, .rotation = 4, .about = {0.5, 0, 0}};
  const RunResult result = run(scene);
  for (const Sample& s : result.samples) {
    EXPECT_NEAR(s.momentum[0], 2 * 0.3, 1e-10);
    EXPECT_NEAR(s.momentum[1], -2 * 0.2, 1e-10);
    EXPECT_NEAR(s.angular_momentum[2], 2 * 4 / 12.0 - 0.5 * 2 * 0.2, 1e-10);
  }
  EXPECT_NEAR(result.samples.front().energy.kinetic, 0.5 * (2 * 0.13 + 2.0 / 12 * 16), 1e-12);
}

/// A pinned beam turns about its pin; the mass that slides on it goes along with the beam.
TEST(InitialVelocity, GoesWithASlidingMass) {
  Scene scene = beam(ElementKind::ale_rancf);
  scene.gravity = {};
  scene.start.type = SupportType::pin;
  SlidingMassSpec& mass = scene.sliding_mass.emplace();
  mass.position = 0.5;
  mass.velocity = 0.2;
  scene.initial_velocity = {.rotation = 1.5};
  const Sample first = run(scene).samples.front();
  EXPECT_NEAR(first.joint->velocity, 0.2, 1e-15);
  const double own = 7200 * 3.14159265358979 * 1e-4 / 3 * 2.25 / 2;
  EXPECT_NEAR(first.energy.kinetic, own + 0.4 * (0.2 * 0.2 + 0.75 * 0.75), 1e-10);
}

/// A rod that turns about a ring, and one that runs through it: its node stands still, and the matter does not.
TEST(InitialVelocity, GoesWithWhatAJointLeavesFree) {
  for (const SupportType support : {SupportType::pin, SupportType::clamp}) {
    Scene scene = beam(ElementKind::ale_rancf);
    scene.gravity = {};
    scene.start.type = SupportType::free;
    SlidingJointSpec joint;
    joint.support = support;
    joint.position = 0.4;
    scene.sliding_joints = {joint};
    scene.duration = 0.05;
    scene.initial_velocity = {
        .translation = {0.3, 0, 0}, .rotation = support == SupportType::pin ? 2.0 : 0.0, .about = {0.4, 0, 0}};
    scene.output.configurations = {0};
    const RunResult result = run(scene);
    const Sample& first = result.samples.front();
    EXPECT_NEAR(first.joint->velocity, -0.3, 1e-15);
    const double mass = 7200 * 3.14159265358979 * 1e-4, omega = scene.initial_velocity->rotation;
    const double turning = mass * (1 / 3.0 - 0.4 + 0.16) * omega * omega;
    EXPECT_NEAR(first.energy.kinetic, (mass * 0.09 + turning) / 2, 1e-9);
    for (const Sample& sample : result.samples) EXPECT_NEAR((*sample.mass_position)[0], 0.4, 1e-13);
    EXPECT_LE(result.max_energy_drift, 1e-9 * largest_energy(result));
    if (support == SupportType::pin) {
      EXPECT_NEAR(first.angular_momentum[2], mass * ((1 / 3.0 - 0.4 + 0.16) * omega + 0.4 * 0.1 * omega), 1e-9);
    } else {  // nothing that strains it
      EXPECT_NEAR(*result.samples.back().joint_position, 0.4 - 0.3 * 0.05, 1e-9);
    }
  }
}

struct Refusal {
  const char* field;
  std::function<void(Scene&)> change;
};

TEST(Parts, AreRefusedByName) {
  const auto statics = [](Scene& s) { s.analysis = Analysis::statics; };
  const std::vector<Refusal> all{
      {"/point_masses/0/node",
       [](Scene& s) {
         s.point_masses = {{9, 1}};
       }},
      {"/point_masses/0/mass",
       [](Scene& s) {
         s.point_masses = {{1, 0}};
       }},
      {"/integrator/type",
       [](Scene& s) {
         s.point_masses = {{1, 1}};
         s.integrator.type = IntegratorType::energy_momentum;
       }},
      {"/sliding_mass/slopes",
       [](Scene& s) {
         s.point_masses = {{1, 1}};
         s.sliding_mass.emplace().slopes = JointSlopes::free;
       }},
      {"/initial_velocity",
       [](Scene& s) {
         s.initial_velocity = {.translation = {0, 1, 0}};
       }},
      {"/initial_velocity",
       [](Scene& s) {
         s.initial_velocity = {.rotation = 1, .about = {0.1, 0, 0}};
       }},
      {"/initial_velocity",  // across a ring
       [](Scene& s) {
         s.start.type = SupportType::free;
         SlidingJointSpec joint;
         joint.support = SupportType::pin;
         joint.position = 0.4;
         s.sliding_joints = {joint};
         s.initial_velocity = {.rotation = 1};
       }},
      {"/drag/linear/normal",
       [](Scene& s) {
         s.drag = DragSpec{{-1, 0}, {}};
       }},
      {"/integrator/type",
       [](Scene& s) {
         s.drag = DragSpec{{1, 0}, {}};
         s.integrator.type = IntegratorType::energy_momentum;
       }},
      {"/integrator/type",
       [](Scene& s) {
         s.beam.material.mass_damping = 1;
         s.integrator.type = IntegratorType::energy_momentum;
       }},
      {"/supports/at=start/motion/angle",
       [](Scene& s) {
         s.start.type = SupportType::pin;
         s.start.motion.emplace().angle = {.value = 1, .ramp = 0.1};
       }},
      {"/supports/at=start/motion/angle",
       [](Scene& s) {
         s.dimension = 3;
         s.start.motion.emplace().angle = {.value = 1, .ramp = 0.1};
       }},
      {"/supports/at=start/motion/angle",  // at full speed from the start
       [](Scene& s) { s.start.motion.emplace().angle = {.rate = 1}; }},
      {"/supports/at=start/motion/angle",
       [&](Scene& s) {
         statics(s);
         s.start.motion.emplace().angle = {.value = 1, .ramp = 0.1};
       }},
      {"/integrator/type",
       [](Scene& s) {
         s.start.motion.emplace().angle = {.value = 1, .ramp = 0.1};
         s.integrator.type = IntegratorType::energy_momentum;
       }},
      {"/initial_velocity/axis",
       [](Scene& s) {
         s.initial_velocity = {.axis = {1, 0, 0}};
       }},
      {"/loads/0/at",
       [](Scene& s) {
         s.loads = {{.type = LoadType::moment, .at = LoadPlace::beam, .x = {}, .magnitude = {.value = 1}, .turn = {}}};
       }},
      {"/loads/0/type",
       [](Scene& s) {
         s.dimension = 3;
         s.loads = {{.type = LoadType::moment, .x = {}, .magnitude = {.value = 1}, .turn = {}}};
       }},
      {"/sliding_mass/friction",
       [&](Scene& s) {
         statics(s);
         s.sliding_mass.emplace().friction.emplace();
       }},
      {"/sliding_mass/velocity",
       [&](Scene& s) {
         statics(s);
         s.sliding_mass.emplace().velocity = 1;
       }},
      {"/sliding_joints/0/mass",
       [&](Scene& s) {
         statics(s);
         s.sliding_joints.emplace_back();
       }},
      {"/sliding_joints/0/slopes",
       [&](Scene& s) {
         statics(s);
         s.sliding_joints.emplace_back().support = SupportType::clamp;
         s.sliding_joints.front().slopes = JointSlopes::equal_stretch;
       }},
      {"/formulation",
       [&](Scene& s) {
         statics(s);
         s.sliding_mass.emplace();
         s.formulation = Formulation::virtual_work;
       }},
      {"/length_control/end_merge",
       [&](Scene& s) {
         statics(s);
         s.sliding_mass.emplace();
         s.length_control.end_merge = 0.5;
       }},
      {"/supports",
       [&](Scene& s) {
         statics(s);
         s.start.type = SupportType::free;
       }},
      {"/loads/0/magnitude/rate",
       [&](Scene& s) {
         statics(s);
         s.loads = {{.x = {}, .magnitude = {.rate = 1}, .turn = {}}};
       }},
      {"/statics/control",
       [&](Scene& s) {
         statics(s);
         s.gravity = {};
         s.statics.control = LoadControl::arc_length;
       }},
      {"/statics/steps", [&](Scene& s) {
         statics(s);
         s.statics.steps = 0;
       }}};
  for (const Refusal& refusal : all) {
    Scene scene = beam(ElementKind::ale_ancf);
    refusal.change(scene);
    try {
      validate(scene);
      ADD_FAILURE() << refusal.field << " is not refused";
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.field, refusal.field) << error.what();
    }
  }
}

// A room below scene/ knows the model, not where it stands in a scene.
TEST(Parts, WhoeverReadsASceneSaysWhereTheModelsFaultStands) {
  Scene scene = beam(ElementKind::ale_ancf);
  scene.beam.elements = 4;
  scene.spin.emplace().drives.emplace_back().node = 5;
  const auto thrown = [](const auto& function) -> std::optional<std::array<std::string, 3>> {
    try {
      function();
    } catch (const InvalidInput& error) {
      return std::array{error.field, error.value, error.allowed};
    }
    return std::nullopt;
  };
  const auto by_model = thrown([] { check_drives({{5, steadily(0, 1)}}, 4); });
  const auto by_scene = thrown([&] { validate(scene); });
  ASSERT_TRUE(by_model && by_scene);
  EXPECT_EQ((*by_model)[0], "drives");
  EXPECT_EQ((*by_scene)[0], "/spin/drives");
  EXPECT_EQ((*by_scene)[1], (*by_model)[1]);
  EXPECT_EQ((*by_scene)[2], (*by_model)[2]);
}

}  // namespace
}  // namespace vlbeam
