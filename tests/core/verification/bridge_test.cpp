#include <gtest/gtest.h>

#include "tests/core/support/reference.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam {
namespace {

/// reference/bridge.py: modes of the linear beam, with the acceleration of a mass that moves over one that moves.
TEST(Bridge, UnderADrivenMassBendsAsTheModesDo) {
  const auto exact = test::reference("bridge.json");
  const double unit = exact.at("static_deflection");
  for (const ElementKind element : {ElementKind::ale_ancf, ElementKind::ale_rancf}) {
    Scene scene = test::by_greens_law();
    scene.gravity_ramp = exact.at("beam").at("gravity_ramp");
    scene.beam.element = element;
    scene.beam.elements = 32;
    scene.beam.curve.end = {exact.at("beam").at("length"), 0, 0};
    scene.beam.section = {.type = Section::Type::stiffness,
                          .EA = 1.2e11,
                          .EI = exact.at("beam").at("EI"),
                          .rhoA = exact.at("beam").at("rhoA")};
    scene.start.type = SupportType::pin;
    scene.end.type = SupportType::slide;
    SlidingJointSpec& mass = scene.sliding_joints.emplace_back();
    mass.mass = exact.at("driven").at("mass");
    mass.position = exact.at("driven").at("start");
    mass.x = TimeSpec{.rate = exact.at("driven").at("speed")};
    scene.integrator = {.type = IntegratorType::generalized_alpha, .step = 2.5e-5};
    scene.duration = 0.6;
    scene.output.interval = 0.1;
    const RunResult run = test::completed(scene);
    EXPECT_GE(run.events.size(), 20U);
    std::size_t sample = 0;
    for (const auto& at : exact.at("under_the_mass")) {
      const Sample& seen = run.samples.at(++sample);
      ASSERT_NEAR(seen.t, at.at("t").get<double>(), 1e-12);
      EXPECT_NEAR((*seen.mass_position)[1], at.at("y").get<double>(), 1e-5 * unit) << seen.t;
    }
  }
}

}  // namespace
}  // namespace vlbeam
