// Beams that are curved from the start: strains measured from the initial shape, or from a straight beam.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/build.hpp"
#include "scene/names.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

Scene without_gravity(Scene scene) {
  scene.gravity = {0, 0, 0};
  return scene;
}

template <int D>
double largest_acceleration(const Scene& scene) {
  BeamSystem<D> system(build_model<D>(scene), build_chain<D>(scene));
  const Eigen::VectorXd y = system.initial_state();
  Eigen::VectorXd dydt(y.size());
  system.rhs(y, dydt, 0);
  return dydt.cwiseAbs().maxCoeff();
}

TEST(CurvedBeam, AsBuiltItIsFreeOfStressWhereItStarts) {
  // accelerations: forces below 1e-10 EA on nodes of some kg
  const double EA = 2e8 * 3.14159 * 0.02 * 0.02;
  for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
    for (const auto weights : {WeightTransport::frozen, WeightTransport::transported}) {
      auto scene = without_gravity(semicircle(5));
      scene.beam.element = element;
      scene.weights = weights;
      EXPECT_LE(largest_acceleration<2>(scene), 1e-10 * EA);
      scene.dimension = 3;
      scene.beam.out_of_plane = OutOfPlane::none;
      scene.beam.material.curvature_regularization = 0.1;
      EXPECT_LE(largest_acceleration<3>(scene), 1e-10 * EA);
    }
  }
  auto scene = without_gravity(semicircle(5));
  scene.beam.rest_shape = RestShape::paper;
  EXPECT_GT(largest_acceleration<2>(scene), 1e-3 * EA);
}

TEST(CurvedBeam, TheEnergyLedgerCloses) {
  for (const auto rest : {RestShape::as_built, RestShape::paper}) {
    for (const auto weights : {WeightTransport::frozen, WeightTransport::transported}) {
      auto scene = semicircle(8);
      scene.beam.rest_shape = rest;
      scene.weights = weights;
      scene.duration = 0.7;
      const auto result = simulate(scene);
      ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
      EXPECT_GE(result.events.size(), 1U);
      EXPECT_LE(result.max_energy_drift, 1e-9 * result.max_kinetic);
    }
  }
}

TEST(CurvedBeam, ImplicitAndExplicitIntegratorsAgree) {
  auto scene = semicircle(6);
  scene.length_control.enabled = false;
  scene.gravity_ramp = 0.2;
  scene.duration = 0.3;
  const auto fine = simulate(scene);
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.rho_inf = 0.9;
  double coarser = 0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    scene.integrator.step = step;
    const auto result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    const double error = std::abs(*result.samples.back().joint_position - *fine.samples.back().joint_position);
    if (coarser > 0) {
      EXPECT_NEAR(std::log2(coarser / error), 2, 0.25);
    }
    coarser = error;
  }
  EXPECT_LE(coarser, 5e-6);
}

/// A beam along `curve` without load, and a mass that is put anywhere on it, the beam being in its rest shape.
template <int D>
class AtRest {
 public:
  explicit AtRest(const Scene& scene)
      : axis_(build_axis<D>(scene)),
        system_(build_model<D>(scene), build_chain<D>(scene)),
        y_(system_.initial_state()),
        unit_(standard_length(scene)) {}

  /// Puts the mass at x; what then is due happens.
  void move_to(double x) {
    const auto nodal = static_cast<Eigen::Index>(system_.mesh().x.size()) * node_size<D>;
    y_[nodal] = x;
    if (system_.has_joint()) {
      const auto at = axis_.derivatives(x);
      position<D>(y_.data(), system_.places().front().node) = at[0];
      slope<D>(y_.data(), system_.places().front().node) = at[1];
    }
    look();
    const Guards guards = system_.guards(y_, 0);
    for (std::size_t i = 0; i < guards.size(); ++i) {
      if (!(guards[i].value > 0)) continue;
      const double before = system_.observe(y_, 0, 25).energy.gravity;
      system_.handle_event(static_cast<int>(i), y_, 0);
      work_ += std::abs(system_.observe(y_, 0, 25).energy.gravity - before);
      ++events_;
      look();
      return;
    }
  }

  /// There and back again in small steps.
  void sweep() {
    const double L = axis_.length();
    const int steps = static_cast<int>(20 * L / unit_);
    for (int k = 1; k < 2 * steps; ++k) move_to(L * (0.5 + 0.47 * std::sin(std::numbers::pi * k / steps)));
  }

  int events() const { return events_; }
  double energy() const { return energy_; }
  double force() const { return force_; }
  /// How far a node of the rest shape was off the rest curve [m].
  double off_curve() const { return off_curve_; }
  /// What gravity has done at events, for they displace matter [J].
  double work() const { return work_; }

 private:
  void look() {
    const auto& k = system_.model().section.stiffness;
    const Energy energy = system_.observe(y_, 0, 25).energy;
    energy_ = std::max(energy_, (energy.axial + energy.bending) / (k.EA * axis_.length() + k.EI / axis_.length()));
    auto* equations = system_.second_order();
    Eigen::VectorXd q, v, r(equations->coordinates());
    equations->expand(y_, q, v);
    equations->residual(q, Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(q.size()), 0, r);
    force_ = std::max(force_, r.cwiseAbs().maxCoeff() / k.EA);
    const ChainState<D> chain = system_.chain(y_, 0);
    for (int node = 0; node <= chain.mesh.last(); ++node) {
      const auto at = axis_.derivatives(chain.mesh.x[static_cast<std::size_t>(node)]);
      off_curve_ = std::max({off_curve_, (position<D>(chain.rest.data(), node) - at[0]).norm(),
                             (slope<D>(chain.rest.data(), node) - at[1]).norm() * unit_});
    }
  }

  Axis<D> axis_;
  BeamSystem<D> system_;
  Eigen::VectorXd y_;
  double unit_, energy_ = 0, force_ = 0, off_curve_ = 0, work_ = 0;
  int events_ = 0;
};

/// A wave without symmetry, inflection included.
CurveSpec wave() {
  return {.type = CurveType::nurbs,
          .degree = 3,
          .knots = {0, 0, 0, 0, 1, 1, 1, 1},
          .weights = {1, 2, 1, 1.5},
          .control_points = {{0, 0, 0}, {1, 2, 0.2}, {2, -1, 0.6}, {3, 0.5, -0.3}}};
}

template <int D>
void expect_no_stress_anywhere(Scene scene) {
  scene.dimension = D;
  if (D == 3) scene.beam.out_of_plane = OutOfPlane::none;  // by the scalar law
  for (const auto element : {ElementKind::ale_rancf, ElementKind::ale_ancf}) {
    for (const auto weights : {WeightTransport::frozen, WeightTransport::transported}) {
      for (const auto& merge : names(MergePolicy{})) {
        if (merge.value == MergePolicy::own) continue;  // no rule to try
        scene.beam.element = element;
        scene.weights = weights;
        scene.length_control.merge = merge.value;
        AtRest<D> beam(scene);
        beam.sweep();
        SCOPED_TRACE(std::string(to_string(element)) + ", " + std::string(to_string(weights)) + ", " +
                     std::string(merge.name));
        EXPECT_GE(beam.events(), 20);
        EXPECT_LE(beam.off_curve(), 1e-14 * beam_length(scene));
        EXPECT_LE(beam.energy(), 1e-24);
        // the point fit of nearly straight elements has weights far apart, transported further still: they magnify
        // rounding
        const bool far_apart = merge.value == MergePolicy::point_fit && scene.beam.curve.type == CurveType::nurbs;
        EXPECT_LE(beam.force(), far_apart && weights == WeightTransport::transported ? 1e-8 : 1e-12);
      }
    }
  }
}

Scene resting(const CurveSpec& curve) {
  Scene scene = without_gravity(semicircle(12));
  scene.beam.curve = curve;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = 1e6, .EI = 1e6, .rhoA = 1};
  scene.beam.material.curvature_regularization = 1e-3;
  scene.sliding_mass->position = beam_length(scene) / 2;
  scene.sliding_mass->at_support = AtSupport::rest;
  return scene;
}

TEST(CurvedBeam, AMassAnywhereInTheRestShapeStressesNothingThroughManyEvents) {
  const CurveSpec arc = semicircle(12).beam.curve;
  expect_no_stress_anywhere<2>(resting(arc));
  expect_no_stress_anywhere<3>(resting(arc));
  expect_no_stress_anywhere<2>(resting(wave()));
  expect_no_stress_anywhere<3>(resting(wave()));
}

/// A bead on a stiff semicircular wire, clamped at both ends.
Scene bead(int elements, double stiffness) {
  Scene scene = semicircle(elements);
  scene.beam.section = {.type = Section::Type::stiffness, .EA = stiffness, .EI = stiffness, .rhoA = 1};
  scene.start = scene.end = {.type = SupportType::clamp, .clamp = ClampType::full};
  scene.weights = WeightTransport::transported;
  scene.length_control.velocities = VelocityTransfer::projected;
  scene.integrator = {
      .type = IntegratorType::generalized_alpha, .step = 2.5e-4, .rho_inf = 0.5, .newton = NewtonKind::full};
  scene.duration = 1;
  return scene;
}

/// Where it would be on a rigid wire, R angle'' = g cos(angle), by Runge and Kutta's method of order 4.
double on_rigid_wire(const Scene& scene) {
  const double R = scene.beam.curve.radius, g = -scene.gravity[1];
  constexpr int steps = 20000;
  const double h = scene.duration / steps;
  Eigen::Vector2d y(scene.sliding_mass->position / R, 0);
  auto rate = [&](const Eigen::Vector2d& at) { return Eigen::Vector2d(at[1], g / R * std::cos(at[0])); };
  for (int k = 0; k < steps; ++k) {
    const Eigen::Vector2d a = rate(y), b = rate(y + h / 2 * a), c = rate(y + h / 2 * b), d = rate(y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return R * y[0];
}

double bead_error(const Scene& scene) {
  const auto result = simulate(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.failure;
  EXPECT_GE(result.events.size(), 3U);
  return std::abs(*result.samples.back().joint_position - on_rigid_wire(scene)) / beam_length(scene);
}

/// Work of gravity at the events of a mass that goes along a wire in its rest shape, over rhoA g R L.
double work_at_events(Scene scene) {
  AtRest<2> wire(scene);
  const double L = beam_length(scene);
  for (double x = scene.sliding_mass->position; x < 0.9 * L; x += standard_length(scene) / 50) wire.move_to(x);
  EXPECT_GE(wire.events(), scene.beam.elements / 2);
  return wire.work() / (scene.beam.section.rhoA * -scene.gravity[1] * scene.beam.curve.radius * L);
}

TEST(CurvedBeam, EventsDisplaceLittleMatterAlongAWire) {
  double coarse = work_at_events(bead(8, 1e8));
  EXPECT_LE(coarse, 5e-7) << "weights of the arc as it is cut: 9e-6";
  for (const int elements : {16, 32}) {
    const double fine = work_at_events(bead(elements, 1e8));
    EXPECT_GE(std::log2(coarse / fine), 5) << elements;
    coarse = fine;
  }
}

TEST(CurvedBeam, ABeadOnAStiffWireFollowsTheRigidOne) {
  // of which the steps leave 3e-7, and the wire's elasticity 5e-8
  EXPECT_LE(bead_error(bead(8, 1e8)), 1e-5);
  EXPECT_LE(bead_error(bead(16, 1e8)), 1e-6);
  EXPECT_LE(bead_error(bead(16, 1e6)), 1e-5);
  auto scene = bead(16, 1e8);
  scene.weights = WeightTransport::frozen;
  EXPECT_LE(bead_error(scene), 2e-6);
  scene.beam.element = ElementKind::ale_ancf;
  EXPECT_LE(bead_error(scene), 5e-6);
}

TEST(CurvedBeam, ConservativeVelocitiesKeepTheEnergyOfACurvedBeam) {
  auto scene = bead(16, 1e6);
  scene.length_control.velocities = VelocityTransfer::conservative;
  const auto result = simulate(scene);
  ASSERT_GE(result.events.size(), 3U);
  for (const Event& event : result.events) EXPECT_LE(std::abs(event.discrete_jump), 1e-12 * result.max_kinetic);
}

TEST(CurvedBeam, GeneralizedAlphaGainsLittleEnergyOnAStiffWire) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    auto scene = bead(8, 1e6);
    scene.length_control.enabled = false;
    scene.duration = 0.5;
    scene.output.interval = 0.002;
    scene.integrator = {
        .type = IntegratorType::generalized_alpha, .step = 1e-3, .rho_inf = rho, .newton = NewtonKind::full};
    const auto result = simulate(scene);
    ASSERT_EQ(result.status, RunStatus::completed) << result.failure;
    double gain = 0;
    for (const Sample& sample : result.samples) {
      gain = std::max(gain, sample.discrete_total - result.samples.front().discrete_total);
    }
    EXPECT_LE(gain, 1e-3 * result.max_kinetic) << "rho " << rho;
  }
}

TEST(CurvedBeam, InSpaceItIsThePlanarOne) {
  auto scene = semicircle(4);  // not so long that its curvature changes sign, which a magnitude cannot
  scene.duration = 0.02;
  const auto planar = simulate(scene);
  scene.dimension = 3;
  scene.beam.out_of_plane = OutOfPlane::none;
  scene.gravity = {0, -9.81, 0};
  scene.beam.material.curvature_regularization = 1e-6;
  const auto spatial = simulate(scene);
  ASSERT_EQ(spatial.status, RunStatus::completed) << spatial.failure;
  EXPECT_NEAR(*spatial.samples.back().joint_position, *planar.samples.back().joint_position, 1e-8);
  EXPECT_NEAR(spatial.samples.back().energy.bending, planar.samples.back().energy.bending, 1e-6);
}

}  // namespace
}  // namespace vlbeam::test
