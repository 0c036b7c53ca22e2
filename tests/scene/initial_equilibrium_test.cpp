// Motions that start from an equilibrium.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scene/build.hpp"
#include "scene/energy_ledger.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

/// A beam under gravity and under loads of every kind, that starts from its equilibrium.
Scene bent(int dimension, ElementKind element) {
  Scene scene;
  scene.dimension = dimension;
  scene.beam.element = element;
  scene.beam.elements = 10;
  scene.start.type = SupportType::clamp;
  scene.initial_shape = InitialShape::equilibrium;
  const Point aslant{0.3, 0.5, dimension == 3 ? -1.0 : 0.0};
  scene.loads = {
      {.node = 7, .x = {}, .magnitude = {.value = 3}, .direction = aslant, .turn = {}},
      {.type = LoadType::follower, .at = LoadPlace::point, .x = {.value = 0.43}, .magnitude = {.value = 5}, .turn = {}},
      {.at = LoadPlace::beam, .x = {}, .magnitude = {.value = 4}, .direction = aslant, .turn = {}}};
  if (dimension == 2) {
    scene.loads.push_back({.type = LoadType::moment, .node = 5, .x = {}, .magnitude = {.value = 2}, .turn = {}});
  }
  scene.point_masses = {{.node = 3, .mass = 0.2}};
  scene.duration = 0.1;
  scene.output.interval = 0.01;
  return scene;
}

/// What rounding may set in motion: strains of 1e-10 all over the beam.
double rounding(const Scene& scene) { return 1e-20 * build_section(scene.beam).stiffness.EA * beam_length(scene); }

Scene by(IntegratorType type, Scene scene) {
  set_tolerance(scene, type, 1e-10);
  scene.integrator.step = 1e-3;
  return scene;
}

constexpr IntegratorType explicit_and_implicit[] = {IntegratorType::fehlberg78, IntegratorType::generalized_alpha};

TEST(InitialEquilibrium, OfABeamStaysAtRest) {
  for (const int dimension : {2, 3}) {
    for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
      for (const IntegratorType type : explicit_and_implicit) {
        const Scene scene = by(type, bent(dimension, element));
        const RunResult run = completed(scene);
        const Sample &first = run.samples.front(), &last = run.samples.back();
        EXPECT_GT(std::hypot(first.end[0] - 1, first.end[1], first.end[2]), 0.05) << "it is bent";
        EXPECT_LE(run.max_kinetic, rounding(scene));
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(last.end[c], first.end[c], 1e-10);
        EXPECT_EQ(first.equilibrium->negative_pivots, 0);
      }
    }
  }
}

TEST(InitialEquilibrium, HasReactionsThatBearTheWeight) {
  for (const IntegratorType type : explicit_and_implicit) {
    Scene scene = by(type, bent(3, ElementKind::ale_ancf));
    scene.loads.clear();
    scene.end.type = SupportType::pin;
    scene.beam.material.curvature_regularization = 1e-2;
    const RunResult run = completed(scene);
    const double mass = build_section(scene.beam).rhoA * beam_length(scene) + 0.2;
    for (const Sample* sample : {&run.samples.front(), &run.samples.back()}) {
      const double sum = sample->reactions[0].position[1] + sample->reactions[1].position[1];
      EXPECT_NEAR(sum, mass * 9.81, 1e-8 * mass * 9.81);
      EXPECT_NEAR(sample->reactions[0].position[0], -sample->reactions[1].position[0], 1e-7);
      EXPECT_LT(sample->reactions[0].position[0], -1) << "the beam hangs between its supports";
    }
  }
}

/// A load on top of gravity is taken off at t = 0: what is left is a sum of the modes about the equilibrium without it,
/// at rest at first, so of cosines. Of these the frequencies are those that statics give.
TEST(InitialEquilibrium, SwingsAtTheFrequenciesOfTheOtherOne) {
  Scene scene = bent(2, ElementKind::ale_ancf);
  scene.beam.material.youngs_modulus = 2e9;
  const double size = 1e-3;
  scene.loads = {{.node = 10, .x = {}, .magnitude = {.value = size}, .turn = {}}};
  Scene other = scene;
  other.initial_shape = InitialShape::built;
  other.analysis = Analysis::statics;
  other.loads.clear();
  constexpr int modes = 6;
  other.statics.frequencies = modes;
  const RunResult at_rest = completed(other);

  scene.loads.push_back({.node = 10, .x = {}, .magnitude = {.value = -size, .ramp = 1e-12}, .turn = {}});
  scene = by(IntegratorType::generalized_alpha, scene);
  scene.duration = 4 / at_rest.frequencies.front();
  scene.integrator.step = scene.duration / 16000;  // 50 steps a period of the sixth mode
  scene.integrator.rho_inf = 1;
  scene.output.interval = scene.duration / 400;
  const RunResult run = completed(scene);
  const auto misfit = [&](double share) {
    Eigen::MatrixXd cosines(static_cast<Eigen::Index>(run.samples.size()), modes + 1);
    Eigen::VectorXd seen(cosines.rows());
    for (Eigen::Index i = 0; i < cosines.rows(); ++i) {
      const Sample& sample = run.samples[static_cast<std::size_t>(i)];
      seen[i] = sample.end[1] - at_rest.samples.back().end[1];
      cosines(i, modes) = 1;
      for (Eigen::Index k = 0; k < modes; ++k) {
        const double hertz = at_rest.frequencies[static_cast<std::size_t>(k)] * (k == 0 ? share : 1);
        cosines(i, k) = std::cos(2 * std::numbers::pi * hertz * sample.t);
      }
    }
    const Eigen::VectorXd sizes = cosines.colPivHouseholderQr().solve(seen);
    if (share == 1) {
      EXPECT_LE(std::abs(sizes[modes]), 1e-3 * std::abs(sizes[0])) << "about the other equilibrium";
    }
    return (cosines * sizes - seen).norm() / seen.norm();
  };
  const double exact = misfit(1);
  EXPECT_LE(exact, 1e-3);
  for (const double off : {0.998, 1.002}) EXPECT_GE(misfit(off), 5 * exact);
}

/// A rod through a sleeve inclined upwards by `degrees`, `outside` of it beyond the sleeve, with a weight of 1 N at its
/// end; EI = 1 N m^2.
Scene sleeve_scene(double degrees, double length, double outside, int elements) {
  Scene scene;
  const double beta = degrees * std::numbers::pi / 180;
  scene.gravity = {0, -1, 0};
  scene.beam.curve.end = {length * std::cos(beta), length * std::sin(beta), 0};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1000, .EI = 1, .rhoA = 0.02};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = elements;
  scene.point_masses = {{.node = elements, .mass = 1}};
  SlidingJointSpec sleeve;
  sleeve.support = SupportType::clamp;
  sleeve.position = length - outside;
  scene.sliding_joints = {sleeve};
  scene.initial_shape = InitialShape::equilibrium;
  return scene;
}

/// A light rod without stretch that slides in a sleeve, and a load at its end, which is seen from the sleeve; EI = 1
/// N m^2. The sleeve lets the rod through where its configurational force M^2/2 EI is the pull
/// along it, and the integral of the elastica puts the load across the rod's end. Under a load F at the angle d from
/// straight down, which the sleeve meets at b = beta - d from the perpendicular e_1, the end is at
/// sqrt(EI/F) (a e_1 + c e_2), e_2 against the load, with integrals over t from 0 to b
///   a = of cos(t)/sqrt(2 sin(t)) = sqrt(2 sin(b)),   c = of sqrt(sin(t)/2),   length outside: of 1/sqrt(2 sin(t)).
struct LightRod {
  double beta, force, angle;

  double b() const { return beta - angle; }
  /// With t = b s^2, which takes the root at 0 away.
  template <class F>
  double integral(const F& f) const {
    return boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double s) { return 2 * b() * s * f(std::sin(b() * s * s)); }, 0.0, 1.0);
  }
  double outside() const {
    return integral([](double sine) { return 1 / std::sqrt(2 * sine); }) / std::sqrt(force);
  }
  Eigen::Vector2d along() const { return {std::cos(angle), std::sin(angle)}; }
  Eigen::Vector2d against() const { return {-std::sin(angle), std::cos(angle)}; }
  double a() const { return std::sqrt(2 * std::sin(b())); }
  double c() const {
    return integral([](double sine) { return std::sqrt(sine / 2); });
  }
  Eigen::Vector2d end() const { return (a() * along() + c() * against()) / std::sqrt(force); }
  /// Columns: by the force, and by its angle, which turns e_1 and e_2 and leaves less of b.
  Eigen::Matrix2d derivatives() const {
    Eigen::Matrix2d columns;
    const double a_b = std::cos(b()) / a(), c_b = std::sqrt(std::sin(b()) / 2);
    columns << -end() / (2 * force), ((a() - c_b) * against() - (a_b + c()) * along()) / std::sqrt(force);
    return columns;
  }
  /// Loads it so that its end is there, from loads that are near.
  void lead_to(const Eigen::Vector2d& place) {
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector2d change = derivatives().inverse() * (place - end());
      force += change[0];
      angle += change[1];
    }
  }
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Of a mass of 1 kg under 1 N at its end: the squares of the frequencies [1/s^2], the least first.
std::array<double, 2> squares_of_light_rod(double degrees) {
  const Eigen::Matrix2d by = LightRod{radians(degrees), 1, 0}.derivatives();
  Eigen::Matrix2d compliance;
  compliance << by.col(1), -by.col(0);  // the angle is the load to the right, the force that downwards
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> stiffness(compliance.inverse());
  return {stiffness.eigenvalues()[0], stiffness.eigenvalues()[1]};
}

/// Length outside where a rod without stretch is balanced: the same integral.
constexpr double balanced_at_30 = 1.02805680105213, balanced_at_60 = 1.47494154080637;

TEST(RodFromItsSleeve, HasTheRateOfGrowthOfALightRod) {
  for (const auto& [degrees, outside] : {std::pair{30.0, balanced_at_30}, std::pair{60.0, balanced_at_60}}) {
    const auto squares = squares_of_light_rod(degrees);
    ASSERT_LT(squares[0], 0);
    Scene scene = sleeve_scene(degrees, 2 * outside, outside, 48);
    scene.beam.section.rhoA = 1e-5;
    scene.beam.section.EA = 1e4;
    scene.initial_shape = InitialShape::built;
    scene.analysis = Analysis::statics;
    scene.statics.frequencies = 2;
    const RunResult result = completed(scene);
    const double growth = std::sqrt(-squares[0]), swing = std::sqrt(squares[1]);
    EXPECT_NEAR(2 * std::numbers::pi * result.frequencies[0], -growth, 5e-5 * growth);
    EXPECT_NEAR(2 * std::numbers::pi * result.frequencies[1], swing, 5e-5 * swing);
  }
}

double outside_of(const Scene& scene, const Sample& sample) { return beam_length(scene) - *sample.joint_position; }

/// Free in its sleeve the rod starts where it is balanced, through length control, and stays there for a while.
TEST(RodFromItsSleeve, StartsBalancedWhereTheSleeveIsReleased) {
  for (const auto& [degrees, outside] : {std::pair{30.0, balanced_at_30}, std::pair{60.0, balanced_at_60}}) {
    Scene scene = sleeve_scene(degrees, 2 * outside, 0.7 * outside, 24);
    scene.beam.section.EA = 1e4;
    scene.beam.section.rhoA = 1e-4;
    scene.statics.joints = StaticJoints::released;
    scene = by(IntegratorType::generalized_alpha, scene);
    scene.duration = 0.5;
    const RunResult run = completed(scene);
    const Sample& first = run.samples.front();
    EXPECT_NEAR(outside_of(scene, first), outside, 1e-4 * outside);
    EXPECT_EQ(first.equilibrium->negative_pivots, 1) << "it is not stable";
    EXPECT_EQ(first.equilibrium->holding_force, 0);
    EXPECT_LE(run.max_kinetic, rounding(scene));
    EXPECT_NEAR(outside_of(scene, run.samples.back()), outside_of(scene, first), 1e-8);
  }
}

/// Held a little off the balance and let go, it is drawn in where less of it is outside, and thrown out where more is.
TEST(RodFromItsSleeve, IsDrawnInOrThrownOut) {
  for (const auto& [share, duration] : {std::pair{0.9, 2.8}, std::pair{1.1, 4.5}}) {
    Scene scene = by(IntegratorType::fehlberg78, sleeve_scene(30, 3 * balanced_at_30, share * balanced_at_30, 12));
    scene.beam.strain_law = StrainLaw::green;  // whose energy is a polynomial: the ledger sums it without an error
    scene.integrator.rtol = scene.integrator.atol = 1e-12;
    scene.beam.section.rhoA = 0.05;
    scene.duration = duration;
    scene.output.interval = 0.05;
    const RunResult run = completed(scene);
    const double force = run.samples.front().equilibrium->holding_force;
    EXPECT_GT(std::abs(force), 0.05);
    EXPECT_EQ(run.samples.front().energy.kinetic, 0);
    const double moved = outside_of(scene, run.samples.back()) - share * balanced_at_30;
    EXPECT_GT(share < 1 ? -moved : moved, 0.7);
    EXPECT_GT(share < 1 ? -force : force, 0) << "what held it, along the beam, against the way the sleeve goes";
    EXPECT_GE(run.events.size(), 3U);
    EXPECT_LE(run.max_energy_drift, 1e-9 * run.max_kinetic);
    EXPECT_LE(energy_ledger(run).largest_unexplained, 1e-9 * run.max_kinetic);
  }
}

/// An upward pull that helps to bear the weight fades: the rod is too far out for the weight alone. A light one takes
/// at each instant the shape that belongs to where its end is, so that the weight moves by two equations.
TEST(RodFromItsSleeve, ThrowsItsWeightAsALightRodDoes) {
  const double pull = 0.05, fading = 0.3, outside = 1.05 * balanced_at_30;
  Scene scene = sleeve_scene(30, 3, outside, 24);
  scene.beam.section.EA = 1e4;
  scene.beam.section.rhoA = 1e-4;
  const TimeSpec fades{
      .value = pull, .amplitude = pull, .frequency = 0.5 / fading, .phase_degrees = 90, .until = fading};
  scene.loads = {{.node = 24, .x = {}, .magnitude = fades, .direction = {0, 1, 0}, .turn = {}}};
  scene.statics.joints = StaticJoints::released;
  scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 3e-3};
  scene.duration = 3.6;
  scene.output.interval = 0.4;
  const RunResult run = completed(scene);

  LightRod rod{radians(30), 1 - 2 * pull, 0};
  using State = std::array<double, 4>;
  State y{rod.end()[0], rod.end()[1], 0, 0};
  const auto rate = [&](const State& at, State& out, double t) {
    rod.lead_to({at[0], at[1]});
    const double helps = pull * (1 + std::cos(std::numbers::pi * std::min(t / fading, 1.0)));
    const Eigen::Vector2d force = rod.force * rod.against();
    out = {at[2], at[3], force[0], force[1] + helps - 1};
  };
  boost::numeric::odeint::runge_kutta4<State> stepper;
  double t = 0;
  const double step = 4e-3, start = rod.outside();
  for (const Sample& sample : run.samples) {
    for (; t < sample.t - step / 2; t += step) stepper.do_step(rate, y, t, step);
    rod.lead_to({y[0], y[1]});
    const double moved = std::abs(rod.outside() - start);
    EXPECT_NEAR(outside_of(scene, sample), rod.outside(), 2e-4 + 2e-3 * moved) << sample.t;
    EXPECT_NEAR(sample.end[0] - (*sample.mass_position)[0], y[0], 2e-4 + 2e-3 * moved) << sample.t;
    EXPECT_NEAR(sample.end[1] - (*sample.mass_position)[1], y[1], 2e-4 + 2e-3 * moved) << sample.t;
  }
  EXPECT_GT(rod.outside(), start + 0.4);
}

/// Where it leaves its balance, it does so at the rate of growth about it.
TEST(RodFromItsSleeve, LeavesItsBalanceAtTheRateOfGrowth) {
  Scene scene = sleeve_scene(30, 2 * balanced_at_30, balanced_at_30, 16);
  scene.beam.section.rhoA = 1e-3;
  scene = by(IntegratorType::generalized_alpha, scene);
  scene.integrator.step = 5e-3;
  scene.duration = 1e-2;
  scene.statics.joints = StaticJoints::released;
  double& position = scene.sliding_joints.front().position;
  for (int i = 0; i < 3; ++i) position = *completed(scene).samples.front().joint_position;  // on its own mesh
  const double balance = position;

  scene.statics.joints = StaticJoints::held;
  position += 1e-6;
  scene.duration = 8;
  const RunResult run = completed(scene);
  const auto off = [&](double t) {
    const auto at = std::ranges::min_element(run.samples, {}, [t](const Sample& s) { return std::abs(s.t - t); });
    return *at->joint_position - balance;
  };
  const double rate = std::log(off(8) / off(5)) / 3, light = std::sqrt(-squares_of_light_rod(30)[0]);
  EXPECT_NEAR(rate, light, 5e-3 * light);
}

/// A cable without bending stiffness through a ring hangs in two catenaries that pull the ring alike: of length s and
/// chord (h, v) one has 2 a sinh(h/2a) = sqrt(s^2 - v^2), and pulls its end by w (s coth(h/2a) -+ v)/2.
TEST(CableInARing, StartsInTwoCatenariesAndStays) {
  Scene scene;
  scene.beam.curve = {.type = CurveType::arc, .center = {0, 0, 0}, .radius = 1, .from_degrees = 200, .to_degrees = 340};
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e5, .EI = 0, .rhoA = 1};
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = 40;
  scene.start.type = scene.end.type = SupportType::pin;
  SlidingJointSpec ring;
  ring.support = SupportType::pin;
  ring.slopes = JointSlopes::equal_stretch;
  ring.position = 1.0;
  scene.sliding_joints = {ring};
  scene.initial_shape = InitialShape::equilibrium;
  scene.statics.joints = StaticJoints::released;
  scene = by(IntegratorType::fehlberg78, scene);
  scene.duration = 0.02;
  scene.output.interval = 0.002;
  const RunResult run = completed(scene);

  const double degree = std::numbers::pi / 180;
  const auto on_arc = [degree](double degrees) {
    return Point{std::cos(degrees * degree), std::sin(degrees * degree)};
  };
  const Point at_ring = on_arc(200 + 1 / degree);
  const auto bracket = boost::math::tools::eps_tolerance<double>(50);
  const auto pull = [&](const Point& from, double s) {
    const double h = std::abs(at_ring[0] - from[0]), v = at_ring[1] - from[1], root = std::sqrt(s * s - v * v);
    std::uintmax_t most = 200;
    const auto u =
        boost::math::tools::bisect([&](double x) { return std::sinh(x) / x - root / h; }, 1e-6, 20.0, bracket, most);
    return 9.81 * (s / std::tanh(u.first) + v) / 2;
  };
  const double length = beam_length(scene);
  std::uintmax_t most = 200;
  const auto chord = [&](const Point& from) { return std::hypot(at_ring[0] - from[0], at_ring[1] - from[1]); };
  const double least = chord(on_arc(200)) + 1e-3, largest = length - chord(on_arc(340)) - 1e-3;
  const auto x = boost::math::tools::bisect(
      [&](double s) { return pull(on_arc(200), s) - pull(on_arc(340), length - s); }, least, largest, bracket, most);
  const Sample &first = run.samples.front(), &last = run.samples.back();
  EXPECT_GT(std::abs(x.first - 1.0), 1e-2) << "the cable has run through the ring";
  EXPECT_NEAR(*first.joint_position, x.first, 1e-4);
  EXPECT_NEAR(*last.joint_position, *first.joint_position, 1e-9);
  EXPECT_EQ(first.equilibrium->negative_pivots, 0);
  EXPECT_LE(run.max_kinetic, rounding(scene));
}

/// A mass held on a cable, which is to kink at it with one stretch: it meets that condition from the start.
TEST(InitialEquilibrium, OfAKinkMeetsItsConditions) {
  for (const JointSlopes slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    SlidingJointSpec mass;
    mass.mass = 0.5;
    mass.position = 0.7;
    mass.slopes = slopes;
    Scene scene = rope({mass});
    scene.initial_shape = InitialShape::equilibrium;
    scene.duration = 0.05;
    const RunResult run = completed(scene);
    EXPECT_LE(run.slopes.position, 1e-9);
    EXPECT_LE(run.slopes.velocity, 1e-9);
    EXPECT_EQ(*run.samples.front().joint_position, 0.7);
    EXPECT_EQ(run.samples.front().energy.kinetic, 0);
    EXPECT_GT(*run.samples.back().joint_position, 0.7 + 1e-4) << "it slides down";
    // last digits decide how the steps err: starts from 0.66 to 0.73 m drift by 0.2 to 1.2 of a billionth
    EXPECT_LE(run.max_energy_drift, 2e-9 * run.max_kinetic);
  }
}

/// A guide that rests where the joint is, and a mass that slides: the one stays at rest, the other starts with its
/// velocity along a beam at rest.
TEST(InitialEquilibrium, HasVelocitiesOnTopOfIt) {
  SlidingJointSpec mass;
  mass.mass = 0.5;
  mass.position = 0.7;
  mass.x.emplace();
  Scene scene = rope({mass});
  scene.initial_shape = InitialShape::equilibrium;
  scene.duration = 0.02;
  EXPECT_LE(completed(scene).max_kinetic, rounding(scene));

  scene.sliding_joints.front().x.reset();
  scene.sliding_joints.front().velocity = 2;
  const RunResult sliding = completed(scene);
  EXPECT_NEAR(sliding.samples.front().energy.kinetic, 0.5 * 4 / 2, 0.05);
  EXPECT_NEAR(sliding.samples.front().joint->velocity, 2, 0);
  EXPECT_LE(sliding.max_energy_drift, 1e-9 * sliding.max_kinetic);

  Scene pendulum = bent(2, ElementKind::ale_ancf);
  pendulum.loads.clear();
  pendulum.start.type = SupportType::pin;
  pendulum.initial_velocity = InitialVelocitySpec{.rotation = 1};
  const RunResult swinging = completed(pendulum);
  const Sample& first = swinging.samples.front();
  EXPECT_NEAR(first.end[0], 0, 1e-9) << "it hangs";
  const double inertia = build_section(pendulum.beam).rhoA / 3 + 0.2 * 0.09;
  EXPECT_NEAR(first.energy.kinetic, inertia / 2, 0.01 * inertia);
  EXPECT_GT(first.energy.kinetic, inertia / 2) << "its weight stretches it";
}

TEST(InitialEquilibrium, RefusesWhatHasNone) {
  const auto with = [](const auto& change) {
    SlidingJointSpec ring;
    ring.support = SupportType::pin;
    ring.position = 0.7;
    Scene scene = rope({ring});
    scene.initial_shape = InitialShape::equilibrium;
    change(scene);
    return refused(scene);
  };
  EXPECT_EQ(with([](Scene& s) { s.gravity_ramp = 1; }), "/gravity_ramp");
  EXPECT_EQ(with([](Scene& s) {
              s.sliding_joints.clear();
              s.spin.emplace();
            }),
            "/spin");
  EXPECT_EQ(with([](Scene& s) {
              s.sliding_joints.clear();
              s.flow.emplace();
            }),
            "/flow");
  EXPECT_EQ(with([](Scene& s) { s.formulation = Formulation::virtual_work; }), "/formulation");
  EXPECT_EQ(with([](Scene& s) {
              s.sliding_joints.clear();
              s.start.type = s.end.type = SupportType::free;
            }),
            "/supports");
  EXPECT_EQ(with([](Scene& s) {
              s.statics.joints = StaticJoints::released;
              s.sliding_joints.front().x.emplace();
            }),
            "/statics/joints");
  EXPECT_EQ(with([](Scene& s) {
              s.sliding_joints.front() = {};
              s.sliding_joints.front().mass = 1;
              s.sliding_joints.front().position = 0.7;
              s.sliding_joints.front().velocity = 1;
              s.sliding_joints.front().slopes = JointSlopes::tangent;
            }),
            "/sliding_joints/0/slopes");
  EXPECT_EQ(with([](Scene& s) {
              s.end.type = s.start.type = SupportType::slide;
              s.initial_velocity = InitialVelocitySpec{.translation = {1, 0, 0}};
            }),
            "/initial_velocity")
      << "which way the beam runs through the ring is not known before";
}

TEST(InitialEquilibrium, ThatIsNotFoundFailsTheRun) {
  Scene scene = bent(2, ElementKind::ale_ancf);
  scene.start.type = SupportType::slide;
  scene.gravity = {1, 0, 0};
  scene.loads.clear();
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::failed);
  EXPECT_EQ(run.failure_time, 0);
  EXPECT_EQ(run.failure.find("there is no equilibrium to start from: "), 0U) << run.failure;
  EXPECT_NE(run.failure.find("nothing holds it along (1, 0)"), std::string::npos) << run.failure;
  EXPECT_TRUE(run.samples.empty());

  const RunResult stopped = simulate(bent(2, ElementKind::ale_ancf), [](double) { return false; });
  EXPECT_EQ(stopped.status, RunStatus::interrupted);
}

}  // namespace
}  // namespace vlbeam::test
