#include "core/scene/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/scene/build.hpp"
#include "core/scene/names.hpp"
#include "core/scene/validate.hpp"

namespace vlbeam {
namespace {

// Of one cubic element with free ends and consistent mass: squares of the largest frequency, for l = EA = EI = rhoA
// = 1.
constexpr double axial = 170.12490249604053;  // the larger root of x^2 - 180 x + 1680
constexpr double bending = 8400;

constexpr double many_steps = 1e4;
constexpr double near = 0.6;        // of the limit: a mean step as long is held by stability at least now and then
constexpr double worth_while = 20;  // explicit steps that an implicit one must replace
constexpr double automatic_tolerance = 1e-6;  // of the beam's length, for implicit steps

/// Mean step times largest frequency of runs that stability limits, measured on steel wires at tolerances of 1e-9 to
/// 1e-3; 0 for methods that it does not limit.
double stability_limit(IntegratorType type) {
  switch (type) {
    case IntegratorType::dopri5:
    case IntegratorType::cash_karp:
    case IntegratorType::arkode:
      return 1.6;
    case IntegratorType::fehlberg78:
      return 3.4;
    case IntegratorType::bulirsch_stoer:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

double largest_frequency(const Scene& scene) {
  const BeamSection section = build_section(scene.beam);
  const double l = beam_length(scene) / scene.beam.elements;
  return std::sqrt(std::max(axial * section.stiffness.EA, bending * section.stiffness.EI / (l * l)) / section.rhoA) / l;
}

IntegratorSpec automatic_integrator(const Scene& scene) {
  IntegratorSpec dopri5;
  dopri5.automatic = true;
  IntegratorSpec implicit = dopri5;
  implicit.type = IntegratorType::generalized_alpha;
  implicit.step = std::min(implicit.step, scene.duration);
  const double explicit_step = stability_limit(IntegratorType::dopri5) / largest_frequency(scene);
  if (implicit.step < worth_while * explicit_step) return dopri5;
  implicit.adaptive = true;
  implicit.rtol = automatic_tolerance;
  const double length = automatic_tolerance * beam_length(scene);
  implicit.atol_by_kind.emplace();
  implicit.atol_by_kind->length = length;
  implicit.atol_by_kind->velocity = length / implicit.step;
  Scene tried = scene;
  tried.integrator = implicit;
  try {
    validate(tried);
  } catch (const InvalidInput&) {
    return dopri5;
  }
  return implicit;
}

std::optional<Warning> stability_warning(const Scene& scene, const RunResult& result) {
  const auto steps = static_cast<double>(result.solver.steps);
  const double limit = stability_limit(scene.integrator.type);
  if (limit == 0 || steps < many_steps || result.samples.empty()) return std::nullopt;
  const double reached = result.status == RunStatus::failed ? result.failure_time : result.samples.back().t;
  const double share = reached / steps * largest_frequency(scene) / limit;
  if (share < near) return std::nullopt;
  std::ostringstream message;
  message.precision(2);
  message << "stability, not accuracy, limits the steps of " << to_string(scene.integrator.type) << ": "
          << result.solver.steps << " of " << reached / steps << " s, " << 100 * share
          << " % of what the fastest wave in an element allows";
  return Warning{WarningKind::stability_limits_steps, message.str(),
                 "/integrator/type \"generalized-alpha\", whose steps no wave limits, or \"integrator\": \"auto\""};
}

}  // namespace vlbeam
