// What goes together, by running it: docs/what_goes_together.md is what this writes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "scene/derived.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"
#include "tests/folders.hpp"

namespace vlbeam {
namespace {

struct Feature {
  const char* name;
  std::function<void(Scene&)> add;
  bool of_joint = false;  ///< of the joint that is there, or else of a sliding mass
};

/// A soft straight beam that falls, held at its start.
Scene plain() {
  Scene scene;
  scene.dimension = 3;
  scene.gravity = {0.3, -9.81, 0.2};
  scene.beam.elements = 4;
  scene.beam.element = ElementKind::ale_rancf;
  scene.beam.material.curvature_regularization = 1e-2;
  scene.start.type = SupportType::clamp;
  scene.duration = 0.01;
  scene.output.interval = 0.002;
  return scene;
}

SlidingJointSpec& joint(Scene& scene, SupportType support = SupportType::free) {
  SlidingJointSpec& added = scene.sliding_joints.emplace_back();
  added.support = support;
  added.position = scene.sliding_joints.size() == 1 ? 0.45 : scene.sliding_joints.size() == 2 ? 0.7 : 0.85;
  return added;
}

void mass(Scene& scene) {
  SlidingJointSpec& added = joint(scene);
  added.mass = 0.8;
  added.velocity = 0.5;
}

SlidingJointSpec& joint_that_is_there(Scene& scene) {
  if (scene.sliding_joints.empty()) mass(scene);
  return scene.sliding_joints.back();
}

void held(Scene& scene, SupportType support) {
  joint(scene, support);
  if (!scene.initial_velocity) return;
  scene.start.type = SupportType::free;  // the beam runs through it
  scene.initial_velocity = {.translation = {0.3, 0, 0}};
}

void meeting(Scene& s, AtSupport law) {
  s.beam.elements = 8;  // each joint needs a node
  if (s.sliding_joints.empty()) mass(s);
  if (!s.contact) mass(s);
  s.sliding_joints.back().position = 0.54;
  s.sliding_joints.back().velocity = -8;
  s.contact = ContactSpec{.joints = law, .distance = 0.1};
}

const std::vector<Feature>& features() {
  static const std::vector<Feature> all{
      {"sliding mass", [](Scene& s) { mass(s); }},
      {"ring", [](Scene& s) { held(s, SupportType::pin); }},
      {"sleeve", [](Scene& s) { held(s, SupportType::clamp); }},
      {"ring that is moved",
       [](Scene& s) {
         held(s, SupportType::pin);
         s.sliding_joints.back().motion = {.direction = {0.2, 1, 0},
                                           .displacement = {.amplitude = 0.01, .frequency = 20, .phase_degrees = 90}};
       }},
      {"guided joint",
       [](Scene& s) {
         held(s, SupportType::free);
         SlidingJointSpec& guided = s.sliding_joints.back();
         guided.mass = 0.3;
         guided.x = TimeSpec{.rate = 0.5, .amplitude = 0.01, .frequency = 20};
       }},
      {"joints that rebound", [](Scene& s) { meeting(s, AtSupport::rebound); }},
      {"joints that rest", [](Scene& s) { meeting(s, AtSupport::rest); }},
      {"feed",
       [](Scene& s) {
         if (s.start.type == SupportType::free) s.start.type = SupportType::pin;
         s.start.feed = TimeSpec{.acceleration = 50, .amplitude = 0.02, .frequency = 20, .phase_degrees = 90};
       }},
      {"two slopes at the joint", [](Scene& s) { joint_that_is_there(s).slopes = JointSlopes::equal_stretch; }, true},
      {"friction at the joint",
       [](Scene& s) {
         joint_that_is_there(s).friction = AxialFriction{0.2, 1e-2};
       },
       true},
      {"curved axis, as built",
       [](Scene& s) {
         s.beam.curve = {.type = CurveType::arc,
                         .center = {-1, 0, 0},
                         .radius = 1,
                         .from_degrees = 0,
                         .to_degrees = 180 / std::numbers::pi};
       }},
      {"uneven weights",
       [](Scene& s) {
         s.beam.weights = {1, 0.95, 1.05, 1};
       }},
      {"transported weights", [](Scene& s) { s.weights = WeightTransport::transported; }},
      {"two sections",
       [](Scene& s) {
         const Section section{.type = Section::Type::stiffness, .EA = 6000, .EI = 0.2, .rhoA = 2};
         s.beam.sections = {{.to = 0.5, .section = s.beam.section}, {.section = section}};
       }},
      {"roller", [](Scene& s) { s.bearings.push_back({.name = "roller", .x = 0.35}); }},
      {"spring to the ground",
       [](Scene& s) {
         s.bearings.push_back(
             {.name = "spring", .x = 0.6, .type = BearingType::spring, .stiffness = 200, .damping = 1});
       }},
      {"vehicle",
       [](Scene& s) {
         const AxleSpec axle{.force = 1, .mass = 0.1, .sprung_mass = 0.2, .stiffness = 100, .damping = 1};
         s.vehicles.push_back({.name = "train", .x = {.value = 0.2, .rate = 2}, .axles = {axle}});
       }},
      {"loads",
       [](Scene& s) {
         s.loads = {{.node = 3, .x = {}, .magnitude = {.value = 2, .ramp = 0.01}, .turn = {.rate = 9}},
                    {.type = LoadType::follower,
                     .at = LoadPlace::point,
                     .x = {.value = 0.3, .rate = 2},
                     .magnitude = {.value = 3, .ramp = 0.01},
                     .turn = {}},
                    {.at = LoadPlace::beam, .x = {}, .magnitude = {.amplitude = 4, .frequency = 20}, .turn = {}}};
       }},
      {"point masses",
       [](Scene& s) {
         s.point_masses = {{1, 0.4}, {2, 0.3}, {4, 0.2}};
       }},
      {"clamp that turns",
       [](Scene& s) {
         s.dimension = 2;
         s.gravity[2] = 0;
         s.start.type = SupportType::clamp;
         if (!s.start.motion) s.start.motion.emplace();
         s.start.motion->angle = {.amplitude = 0.2, .frequency = 20, .phase_degrees = 90};
         if (!s.initial_velocity) return;
         s.initial_velocity->axis = {0, 0, 1};
         s.start.motion->angle->rate = s.initial_velocity->rotation;
       }},
      {"initial velocity",
       [](Scene& s) {
         s.start.type = SupportType::pin;
         s.initial_velocity = {.rotation = 3, .axis = {0.2, -0.3, 1}};
       }},
      {"moving support",
       [](Scene& s) {
         s.start.motion = {.direction = {0, 1, 0},
                           .displacement = {.amplitude = 0.01, .frequency = 20, .phase_degrees = 90}};
       }},
      {"start from the equilibrium", [](Scene& s) { s.initial_shape = InitialShape::equilibrium; }},
      {"gravity that grows", [](Scene& s) { s.gravity_ramp = 0.02; }},
      {"damping", [](Scene& s) { s.beam.material.damping = 1e-4; }},
      {"drag",
       [](Scene& s) {
         s.drag = DragSpec{{0.4, 0.1}, {0.3, 0.05}};
         s.beam.material.mass_damping = 2;
       }},
      {"spin",
       [](Scene& s) {
         if (!s.spin) s.spin.emplace();
         s.spin->drives = {{.node = 0, .angle = {.rate = 20}}};
       }},
      {"flow",
       [](Scene& s) {
         s.flow.emplace().nodes = {
             {.node = 0, .x = {}}, {.node = 2, .x = {.value = 0.5, .rate = 0.7}}, {.node = 4, .x = {.value = 1}}};
       }},
      {"rotary inertia", [](Scene& s) { s.beam.rotary_inertia = BendingInertia::rayleigh; }},
      {"nut",
       [](Scene& s) {
         SlidingJointSpec& nut = joint(s);
         nut.mass = 0.5;
         nut.pitch = 0.1;
         s.spin.emplace().angles = AngleField::hermite;
         s.spin->rate = 20;
       }},
      {"wheel",
       [](Scene& s) {
         held(s, SupportType::pin);
         s.sliding_joints.back().pulley = PulleySpec{.radius = 0.1, .inertia = 0.003};
       }},
      {"block",
       [](Scene& s) {
         s.beam.elements = 8;  // each joint needs a node
         const int first = static_cast<int>(s.sliding_joints.size());
         for (int i = 0; i < 2; ++i) joint(s).mass = 0.2;
         s.blocks = {{.joints = {first, first + 1}, .mass = 0.3}};
       }},
      {"drum",
       [](Scene& s) {
         if (s.start.type == SupportType::free) s.start.type = SupportType::pin;
         s.start.drum = DrumSpec{.radius = 0.1, .inertia = 0.01, .torque = {.value = 1}};
         s.start.end_stop = EndStopSpec{.most = 0, .stiffness = 1e4, .depth = 1e-3, .damping = 5};
       }},
      {"fluid",
       [](Scene& s) {
         s.fluid = FluidSpec{.density = 1000, .velocity = {0.5, 1, 0}};
         s.drag = DragSpec{{0.4, 0.1}, {0.3, 0.05}};
       }},
      {"ground",
       [](Scene& s) { s.ground = GroundSpec{.height = -0.02, .stiffness = 500, .depth = 0.01, .damping = 2}; }},
      {"frames", [](Scene& s) { s.beam.space_law = SpaceLaw::frames; }}};
  return all;
}

const std::vector<Feature>& methods() {
  static const std::vector<Feature> all{{"explicit",
                                         [](Scene& s) {
                                           s.integrator.type = IntegratorType::fehlberg78;
                                           s.integrator.rtol = s.integrator.atol = 1e-12;
                                         }},
                                        {"`generalized-alpha`",
                                         [](Scene& s) {
                                           s.integrator.type = IntegratorType::generalized_alpha;
                                           s.integrator.step = 1e-4;
                                         }},
                                        {"with `multipliers`",
                                         [](Scene& s) {
                                           s.integrator.type = IntegratorType::generalized_alpha;
                                           s.integrator.step = 1e-4;
                                           s.constraints = Constraints::multipliers;
                                         }},
                                        {"`energy-momentum`",
                                         [](Scene& s) {
                                           s.integrator.type = IntegratorType::energy_momentum;
                                           s.integrator.step = 1e-4;
                                         }},
                                        {"`rosenbrock4`", [](Scene& s) {
                                           s.integrator.type = IntegratorType::rosenbrock4;
                                           s.integrator.rtol = s.integrator.atol = 1e-7;
                                         }}};
  return all;
}

/// "yes" where the scene runs and its energy is accounted for, "-" where it is refused.
std::string cell(Scene scene) {
  if (scene.dimension == 3 && scene.beam.curve.type != CurveType::line) scene.beam.out_of_plane = OutOfPlane::none;
  try {
    validate(scene);
  } catch (const InvalidInput&) {
    return "-";
  }
  const RunResult run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.failure;
  double largest = 0;
  for (const Sample& s : run.samples) {
    const Energy& e = s.energy;
    largest = std::max(largest, e.kinetic + e.axial + e.bending + e.torsion + std::abs(e.gravity));
  }
  const bool exact =
      scene.integrator.type == IntegratorType::fehlberg78 || scene.integrator.type == IntegratorType::energy_momentum;
  // the work of gravity that grows is summed up from step to step, to order 4: of a ramp of 40 steps 1e-6 is left
  // what a step does beyond a change of section, until the passage is found, is known to the rounding of that alone
  const bool passes = !scene.beam.sections.empty() && !sliding_joints(scene).empty();
  const double allowed = !exact ? 1e-3 : scene.gravity_ramp > 0 ? 1e-5 : passes ? 1e-8 : 1e-9;
  EXPECT_LE(run.max_energy_drift, allowed * largest);
  return "yes";
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string rule(std::size_t columns) {
  std::string text = "|";
  for (std::size_t i = 0; i < columns; ++i) text += "---|";
  return text + "\n";
}

std::string table_of_methods() {
  std::vector<std::string> head{""};
  for (const Feature& method : methods()) head.emplace_back(method.name);
  std::string text = row(head) + rule(head.size());
  const auto add = [&](const char* name, const std::function<void(Scene&)>& feature) {
    std::vector<std::string> cells{name};
    for (const Feature& method : methods()) {
      SCOPED_TRACE(testing::Message() << name << " x " << method.name);
      Scene scene = plain();
      feature(scene);
      method.add(scene);
      cells.push_back(cell(scene));
    }
    text += row(cells);
  };
  add("nothing else", [](Scene&) {});
  for (const Feature& feature : features()) add(feature.name, feature.add);
  return text;
}

std::string table_of_pairs() {
  std::vector<std::string> head{""};
  for (std::size_t i = 0; i < features().size(); ++i) head.push_back(std::to_string(i + 1));
  std::string text = row(head) + rule(head.size());
  for (std::size_t i = 0; i < features().size(); ++i) {
    std::vector<std::string> cells{std::to_string(i + 1) + " " + features()[i].name};
    for (std::size_t j = 0; j < features().size(); ++j) {
      SCOPED_TRACE(testing::Message() << features()[i].name << " x " << features()[j].name);
      if (j >= i) {
        cells.emplace_back();
        continue;
      }
      Scene scene = plain();
      const bool trait = features()[i].of_joint;
      features()[trait ? j : i].add(scene);
      features()[trait ? i : j].add(scene);
      methods().front().add(scene);
      cells.push_back(cell(scene));
    }
    text += row(cells);
  }
  return text;
}

/// Written anew with VLBEAM_WRITE_DOCS set.
TEST(WhatGoesTogether, IsWhatTheDocsSay) {
  const std::string file = test::source_folder() / "docs/what_goes_together.md";
  const std::string text =
      "# Feature compatibility\n\n"
      "Each cell is a scene that the tests run: of four elements, or of eight where joints meet. **yes**: it runs, and "
      "the work of all that acts on\n"
      "the beam accounts for its energy. Explicit methods (`fehlberg78` here) and `energy-momentum` do so to 1e-9, the "
      "latter to 1e-6 where gravity\n"
      "grows within 40 steps, both to 1e-8 where a joint passes a change of section; other methods do so to their "
      "order. "
      "**-**: it is refused,\n"
      "and the message names the key. Made by `tests/scene/matrix_test.cpp`.\n\n"
      "## Features and integrators\n\n" +
      table_of_methods() + "\n## Features in pairs, explicit\n\n" + table_of_pairs();
  if (std::getenv("VLBEAM_WRITE_DOCS") != nullptr) std::ofstream(file) << text;
  std::ifstream in(file);
  std::stringstream written;
  written << in.rdbuf();
  EXPECT_EQ(written.str(), text) << "run it with VLBEAM_WRITE_DOCS=1 to write " << file;
}

}  // namespace
}  // namespace vlbeam
