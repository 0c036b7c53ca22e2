#include "scene/validate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "core/error.hpp"
#include "io/json.hpp"

namespace vlbeam {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Scene example() {
  Scene scene;
  scene.start.type = SupportType::clamp;
  scene.sliding_mass.emplace();
  return scene;
}

struct Rule {
  const char* field;
  std::function<void(Scene&)> breach;

  friend void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.field; }
};

class BrokenRule : public testing::TestWithParam<Rule> {};

TEST_P(BrokenRule, IsNamed) {
  Scene scene = example();
  GetParam().breach(scene);
  try {
    validate(scene);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, GetParam().field) << error.what();
  }
}

const Rule ranges[] = {
    {"/dimension", [](Scene& s) { s.dimension = 1; }},
    {"/gravity/1", [](Scene& s) { s.gravity[1] = nan; }},
    {"/gravity/2", [](Scene& s) { s.gravity[2] = 1; }},
    {"/gravity_ramp", [](Scene& s) { s.gravity_ramp = -1; }},
    {"/beam/curve/end/0", [](Scene& s) { s.beam.curve.end[0] = inf; }},
    {"/beam/curve/start/2", [](Scene& s) { s.beam.curve.start[2] = 0.5; }},
    {"/beam/curve/pitch",
     [](Scene& s) {
       s.beam.curve.type = CurveType::arc;
       s.beam.curve.pitch = 0.1;
     }},
    {"/beam/section/radius", [](Scene& s) { s.beam.section.radius = 0; }},
    {"/beam/section/EA",
     [](Scene& s) {
       s.beam.section = {Section::Type::stiffness, 0, 0, 1, 1};
     }},
    {"/beam/section/EI",
     [](Scene& s) {
       s.beam.section = {Section::Type::stiffness, 0, 1, -1, 1};
     }},
    {"/beam/section/rhoA",
     [](Scene& s) {
       s.beam.section = {Section::Type::stiffness, 0, 1, 1, 0};
     }},
    {"/beam/material/density", [](Scene& s) { s.beam.material.density = -1; }},
    {"/beam/material/youngs_modulus", [](Scene& s) { s.beam.material.youngs_modulus = nan; }},
    {"/beam/material/damping", [](Scene& s) { s.beam.material.damping = -1e-9; }},
    {"/beam/elements", [](Scene& s) { s.beam.elements = 1; }},
    {"/beam/quadrature_points", [](Scene& s) { s.beam.quadrature_points = 26; }},
    {"/beam/weights/2", [](Scene& s) { s.beam.weights[2] = 0; }},
    {"/sliding_mass/mass", [](Scene& s) { s.sliding_mass->mass = 0; }},
    {"/sliding_mass/velocity", [](Scene& s) { s.sliding_mass->velocity = -inf; }},
    {"/sliding_mass/friction/coefficient", [](Scene& s) { s.sliding_mass->friction = AxialFriction{-0.1}; }},
    {"/sliding_mass/friction/velocity",
     [](Scene& s) {
       s.sliding_mass->friction = AxialFriction{0.1, 0};
     }},
    {"/length_control/hysteresis", [](Scene& s) { s.length_control.hysteresis = -0.1; }},
    {"/integrator/rtol", [](Scene& s) { s.integrator.rtol = 0; }},
    {"/integrator/atol", [](Scene& s) { s.integrator.atol = nan; }},
    {"/integrator/atol/length",
     [](Scene& s) {
       s.integrator.atol_by_kind = {0, 1, {}, {}};
     }},
    {"/integrator/atol/angle",
     [](Scene& s) {
       s.integrator.atol_by_kind = {1, 1, inf, {}};
     }},
    {"/integrator/step",
     [](Scene& s) {
       s.integrator.type = IntegratorType::adams_bashforth_moulton;
       s.integrator.step = 0;
     }},
    {"/integrator/rho_inf",
     [](Scene& s) {
       s.integrator.type = IntegratorType::generalized_alpha;
       s.integrator.rho_inf = 1.1;
     }},
    {"/duration", [](Scene& s) { s.duration = 0; }},
    {"/output/interval", [](Scene& s) { s.output.interval = 0; }},
    {"/output/configurations/1",
     [](Scene& s) {
       s.output.configurations = {0, nan};
     }},
};
INSTANTIATE_TEST_SUITE_P(Ranges, BrokenRule, testing::ValuesIn(ranges));

const Rule rules[] = {
    {"/beam/curve/end", [](Scene& s) { s.beam.curve.end = s.beam.curve.start; }},
    {"/beam/quadrature_points", [](Scene& s) { s.beam.quadrature_points = 2; }},
    {"/beam/weights/1",
     [](Scene& s) {
       s.beam.weights = {1, 1.2, 1.2, 1};
       s.beam.curve.type = CurveType::arc;
     }},
    {"/beam/axis",
     [](Scene& s) {  // with a sliding mass
       s.beam.curve.type = CurveType::arc;
       s.beam.axis = AxisForm::exact;
     }},
    {"/beam/axis",
     [](Scene& s) {
       s.beam.curve.type = CurveType::arc;
       s.beam.rest_shape = RestShape::paper;
       s.beam.element = ElementKind::ale_ancf;
       s.beam.axis = AxisForm::exact;
     }},
    {"/beam/curve/to_degrees",
     [](Scene& s) {
       s.beam.curve.type = CurveType::arc;
       s.beam.curve.from_degrees = s.beam.curve.to_degrees = 90;
     }},
    {"/beam/elements",
     [](Scene& s) {
       s.beam.curve.type = CurveType::arc;
       s.beam.curve.to_degrees = 360;
       s.beam.elements = 2;
     }},
    {"/beam/curve/knots/4",
     [](Scene& s) {
       s.beam.curve = {.type = CurveType::nurbs,
                       .degree = 2,
                       .knots = {0, 0, 0, 1, 0.5, 2, 2, 2},
                       .weights = {},
                       .control_points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}, {4, 1, 0}}};
     }},
    {"/beam/curve/knots",
     [](Scene& s) {
       s.beam.curve = {.type = CurveType::nurbs,
                       .degree = 2,
                       .knots = {0, 0, 0, 1, 1},
                       .weights = {},
                       .control_points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}};
     }},
    {"/beam/curve/control_points/1/2",
     [](Scene& s) {
       s.beam.curve = {.type = CurveType::nurbs,
                       .degree = 2,
                       .knots = {0, 0, 0, 1, 1, 1},
                       .weights = {},
                       .control_points = {{0, 0, 0}, {1, 0, 1}, {2, 1, 0}}};
     }},
    {"/beam/material/curvature_regularization",
     [](Scene& s) {
       s.dimension = 3;
       s.beam.curve.type = CurveType::arc;
       s.beam.out_of_plane = OutOfPlane::none;
     }},
    {"/sliding_mass/slopes",  // with frames, which it has by default, a joint has one slope
     [](Scene& s) {
       s.dimension = 3;
       s.beam.curve.type = CurveType::arc;
       s.beam.material.curvature_regularization = 1e-3;
       s.sliding_mass->slopes = JointSlopes::free;
     }},
    {"/beam/out_of_plane", [](Scene& s) { s.beam.out_of_plane = OutOfPlane::none; }},
    {"/beam/weights/1",
     [](Scene& s) {
       s.beam.weights = {1, 1.2, 1.2, 1};
       s.beam.rest_shape = RestShape::paper;
       s.beam.element = ElementKind::ale_ancf;
     }},
    {"/beam/material/curvature_regularization",
     [](Scene& s) {
       s.dimension = 3;
       s.beam.material.damping = 0.01;
     }},
    {"/beam/element", [](Scene& s) { s.beam.element = ElementKind::rancf; }},
    {"/beam/element", [](Scene& s) { s.beam.element = ElementKind::ancf; }},
    {"/sliding_mass/position", [](Scene& s) { s.sliding_mass->position = 0; }},
    {"/sliding_mass/position", [](Scene& s) { s.sliding_mass->position = 1e-10; }},
    {"/sliding_mass/position", [](Scene& s) { s.sliding_mass->position = 1; }},
    {"/sliding_mass/position", [](Scene& s) { s.sliding_mass->position = 1.5; }},
    {"/sliding_mass/position", [](Scene& s) { s.sliding_mass->position = -0.5; }},
    {"/sliding_mass/separation_distance", [](Scene& s) { s.sliding_mass->separation_distance = 0.025; }},
    {"/sliding_mass/slopes",
     [](Scene& s) {
       s.sliding_mass->slopes = JointSlopes::tangent;
       s.integrator.type = IntegratorType::rosenbrock4;
     }},
    {"/sliding_mass/slopes",
     [](Scene& s) {
       s.sliding_mass->slopes = JointSlopes::free;
       s.integrator.type = IntegratorType::rosenbrock4;
     }},
    {"/sliding_mass/slopes",
     [](Scene& s) {
       s.sliding_mass->slopes = JointSlopes::equal_stretch;
       s.integrator.type = IntegratorType::energy_momentum;
       s.formulation = Formulation::variational;
     }},
    {"/sliding_mass/friction",
     [](Scene& s) {
       s.sliding_mass->friction = AxialFriction{0.1};
       s.integrator.type = IntegratorType::energy_momentum;
       s.formulation = Formulation::variational;
     }},
    {"/integrator/step",
     [](Scene& s) {
       s.integrator.type = IntegratorType::generalized_alpha;
       s.integrator.step = 1.01 * s.duration;
     }},
    {"/integrator/step",
     [](Scene& s) {
       s.integrator.type = IntegratorType::adams_bashforth_moulton;
       s.integrator.step = 1.01 * s.duration;
     }},
    {"/sliding_mass/separation_distance", [](Scene& s) { s.sliding_mass->separation_distance = 0; }},
    {"/length_control/end_merge", [](Scene& s) { s.length_control.end_merge = 0.91; }},
    {"/length_control/end_merge",
     [](Scene& s) {
       s.length_control.enabled = false;
       s.length_control.end_merge = 0.5;
     }},
    {"/length_control/end_merge",
     [](Scene& s) {
       s.length_control.end_merge = 0;
       s.sliding_mass->at_support = AtSupport::rest;
     }},
    {"/length_control/enabled",
     [](Scene& s) {
       s.length_control.enabled = false;
       s.sliding_mass->at_support = AtSupport::rebound;
     }},
    {"/sliding_mass/restitution",
     [](Scene& s) {
       s.sliding_mass->at_support = AtSupport::rebound;
       s.sliding_mass->restitution = 1.1;
     }},
    {"/length_control/upper", [](Scene& s) { s.length_control.upper = 1.49; }},
    {"/length_control/upper", [](Scene& s) { s.length_control.upper = 2; }},
    {"/length_control/upper",
     [](Scene& s) {
       s.length_control.upper = 1.9;
       s.length_control.hysteresis = 0.1;
     }},
    {"/output/interval", [](Scene& s) { s.output.interval = 1e-12; }},
    {"/output/configurations/1",
     [](Scene& s) {
       s.output.configurations = {0, 0.6};
     }},
    {"/output/configurations/1",
     [](Scene& s) {
       s.output.configurations = {0.2, 0.1};
     }},
};
INSTANTIATE_TEST_SUITE_P(CrossField, BrokenRule, testing::ValuesIn(rules));

TEST(Validate, AcceptsTheExample) { EXPECT_NO_THROW(validate(example())); }

TEST(Validate, AcceptsTheLimits) {
  Scene scene = example();
  scene.beam.elements = 2;
  scene.length_control = {.enabled = true, .upper = 1.5, .hysteresis = 0, .end_merge = {}};
  scene.output.configurations = {0, scene.duration};
  scene.beam.quadrature_points = 3;
  EXPECT_NO_THROW(validate(scene));
}

TEST(Validate, AcceptsAKinkWithImplicitMethods) {
  Scene scene = example();
  scene.sliding_mass->slopes = JointSlopes::tangent;
  scene.sliding_mass->friction = AxialFriction{0.2};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = 1e-3;
  for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
    scene.constraints = constraints;
    EXPECT_NO_THROW(validate(scene));
  }
}

TEST(Validate, DampingOfACableNeedsNoCurvatureRegularization) {
  Scene scene = example();
  scene.dimension = 3;
  scene.beam.section = {Section::Type::stiffness, 0, 100, 0, 1};
  scene.beam.material.damping = 0.1;
  EXPECT_NO_THROW(validate(scene));
}

TEST(Validate, OptionsThatDoNotApplyAreNotChecked) {
  Scene scene = example();
  scene.beam.section = {Section::Type::stiffness, -1, 100, 1, 1};  // no radius with stiffnesses
  EXPECT_NO_THROW(validate(scene));
}

}  // namespace
}  // namespace vlbeam
