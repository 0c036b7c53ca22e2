#include "tools/sudden_gravity.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "scene/assembly.hpp"
#include "scene/derived.hpp"
#include "scene/simulate.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

constexpr double warned_share = 0.1;      // of the largest strain energy
constexpr double share_of_swing = 0.005;  // of a pendulum as long as the beam: a step that damps what is faster
constexpr int damping_steps = 4;          // until fast vibrations have died out
constexpr int most_damping_steps = 40;    // where they have to be cut: else no such equilibrium is near

double strain_energy(const Sample& sample) {
  return sample.energy.axial + sample.energy.bending + sample.energy.torsion;
}

double gravity_of(const Scene& scene) { return std::hypot(scene.gravity[0], scene.gravity[1], scene.gravity[2]); }

/// The scene without what moves it but its weight, and loads that always act along the whole beam, which may bear it.
Scene left_to_gravity(const Scene& given) {
  Scene scene = given;
  std::erase_if(scene.loads,
                [](const LoadSpec& load) { return load.at != LoadPlace::beam || !is_constant(load.magnitude); });
  scene.vehicles.clear();
  scene.initial_velocity.reset();
  if (!given.assembly) return scene;
  AssemblySpec parts = *given.assembly;
  for (AssemblySpec::Beam& beam : parts.beams) beam.scene = left_to_gravity(beam.scene);
  for (BodySpec& body : parts.bodies) {
    body.loads.clear();
    body.velocity = body.angular_velocity = {};
  }
  scene.assembly = std::make_shared<const AssemblySpec>(std::move(parts));
  return scene;
}

/// The strain energy [J] that fast vibrations have in their equilibrium under the weight; 0 where it is not found.
double borne_by_the_stiff(const Scene& given) {
  Scene scene = left_to_gravity(given);
  const double step = share_of_swing * 2 * std::numbers::pi * std::sqrt(beam_length(scene) / gravity_of(scene));
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.rho_inf = 0;
  scene.integrator.step = step;
  scene.duration = damping_steps * step;
  scene.output = {.interval = scene.duration, .configurations = {}};
  try {
    int steps = 0;
    const RunResult result = simulate(scene, [&steps](double) { return ++steps <= most_damping_steps; });
    if (result.status != RunStatus::completed) return 0;
    return strain_energy(result.samples.back()) - strain_energy(result.samples.front());
  } catch (const InvalidInput&) {
    return 0;
  }
}

}  // namespace

std::optional<Warning> sudden_gravity(const Scene& scene, const RunResult& result) {
  const bool sudden = scene.analysis == Analysis::dynamics && gravity_of(scene) > 0 && scene.gravity_ramp == 0 &&
                      scene.initial_shape == InitialShape::built;
  if (!sudden || result.samples.empty()) return {};
  double largest = 0;
  for (const Sample& sample : result.samples) largest = std::max(largest, strain_energy(sample));
  const double borne = borne_by_the_stiff(scene);
  if (!(borne > warned_share * largest) || largest == 0) return {};
  std::ostringstream message;
  message.precision(2);
  message << "gravity acts at once on " << (scene.assembly ? "beams that are" : "a beam that is")
          << " drawn unstrained: " << std::min(borne, largest) << " J of " << largest
          << " J of strain energy are vibrations about the equilibrium under weight, and forces and moments are up to "
          << "twice as large as without them";
  return Warning{
      WarningKind::sudden_gravity, message.str(),
      std::string("\"gravity_ramp\": a few periods of the beam [s]") +
          (scene.vehicles.empty() && scene.blocks.empty() && !scene.assembly ? ", or \"initial_shape\": \"equilibrium\""
                                                                             : "")};
}

}  // namespace vlbeam
