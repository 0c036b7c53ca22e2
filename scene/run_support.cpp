#include "scene/run_support.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <numbers>

#include "core/error.hpp"
#include "mechanics/conserving/energy_momentum.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/sundials/sundials_stepper.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/build.hpp"
#include "scene/timetable.hpp"

namespace vlbeam {
namespace {

constexpr double largest_overshoot = 0.25;  // over L_std: of a step that chooses its length by the motion
// the first turn, of generalized-alpha in an automatic run at the usual accuracy; by its root at others
constexpr double steps_a_turn = 800;
constexpr double first_step_courant = 0.01;  // of the time an axial wave takes through the shortest element

std::vector<double> sample_times(const Scene& scene) {
  std::vector<double> times;
  const double interval = scene.output.interval;
  const auto count = static_cast<long>(std::floor(scene.duration / interval * (1 + 1e-12)));
  for (long i = 0; i <= count; ++i) times.push_back(std::min(static_cast<double>(i) * interval, scene.duration));
  if (times.back() < scene.duration * (1 - 1e-12)) times.push_back(scene.duration);
  return times;
}

Tolerances tolerances_of(const Scene& scene) {
  const auto& integrator = scene.integrator;
  Tolerances tolerances{integrator.rtol, integrator.atol};
  if (!integrator.atol_by_kind) return tolerances;
  const AbsoluteTolerances atol = with_defaults(*integrator.atol_by_kind, scene);
  const double length = atol.length, velocity = atol.velocity, unit = standard_length(scene);
  tolerances.motion = atol.motion.value_or(0);
  FieldTolerances& by_field = tolerances.by_field.emplace();
  const auto set = [&](Field field, double value, double rate) {
    by_field.of[static_cast<std::size_t>(field)] = value;
    by_field.of_rate[static_cast<std::size_t>(field)] = rate;
  };
  for (const Field field : {Field::position, Field::mark, Field::mass}) set(field, length, velocity);
  set(Field::slope, length / unit, velocity / unit);
  set(Field::angle, *atol.angle, *atol.spin);
  set(Field::twist, *atol.angle / unit, *atol.spin / unit);
  const double acceleration = velocity * velocity / length;  // over the time that the two make
  set(Field::multiplier, acceleration, velocity);
  set(Field::slope_multiplier, acceleration * unit, velocity * unit);
  return tolerances;
}

}  // namespace

Stops::Stops(const Scene& scene) : samples(sample_times(scene)), configurations(scene.output.configurations) {
  std::sort(configurations.begin(), configurations.end());
}

std::vector<double> Stops::all() const {
  std::vector<double> stops;
  std::set_union(samples.begin(), samples.end(), configurations.begin(), configurations.end(),
                 std::back_inserter(stops));
  return stops;
}

bool Stops::end_at(double t) {
  samples.erase(std::upper_bound(samples.begin(), samples.end(), t), samples.end());
  if (!samples.empty() && samples.back() == t) return false;
  samples.push_back(t);
  return true;
}

namespace {

/// Of a method that is no room's.
IntegrationMethod method_of(IntegratorType type) {
  using Method = IntegrationMethod;
  switch (type) {
    case IntegratorType::cash_karp:
      return Method::cash_karp;
    case IntegratorType::fehlberg78:
      return Method::fehlberg78;
    case IntegratorType::bulirsch_stoer:
      return Method::bulirsch_stoer;
    case IntegratorType::adams_bashforth_moulton:
      return Method::adams_bashforth_moulton;
    case IntegratorType::rosenbrock4:
      return Method::rosenbrock4;
    case IntegratorType::generalized_alpha:
      return Method::generalized_alpha;
    default:
      return Method::dopri5;
  }
}

}  // namespace

void set_method(IntegratorType type, double step, IntegrationOptions& options) {
  options.step = step;
  options.type = method_of(type);
  if constexpr (has_room("conserving")) {
    if (type == IntegratorType::energy_momentum) options.other = energy_momentum({.step = step});
  }
  if constexpr (has_room("sundials")) {
    if (of_sundials(type)) {
      options.other = method_of_sundials(type == IntegratorType::ida     ? SundialsMethod::ida
                                         : type == IntegratorType::cvode ? SundialsMethod::cvode
                                                                         : SundialsMethod::arkode);
    }
  }
}

IntegrationOptions integration_options(const Scene& scene, const BeamSection& section, double shortest) {
  const double stiffness = std::max(section.stiffness.EA, section.stiffness.EI / (shortest * shortest));
  const double wave_time = shortest * std::sqrt(section.rhoA / stiffness);
  const auto& integrator = scene.integrator;
  IntegrationOptions options;
  options.tolerances = tolerances_of(scene);
  options.first_step = first_step_courant * wave_time;
  options.timetable = timetable(scene);
  options.locate_events = integrator.locate_events;
  if (options.tolerances.motion > 0) options.largest_overshoot = largest_overshoot;
  set_method(integrator.type, integrator.step, options);
  options.generalized_alpha = {.step = integrator.step,
                               .rho_inf = integrator.rho_inf,
                               .newton = integrator.newton,
                               .newton_tolerance = integrator.newton_tolerance,
                               .adaptive = integrator.adaptive,
                               .tolerances = options.tolerances,
                               .error_estimate = integrator.error_estimate,
                               .first_step = options.tolerances.motion > 0 ? wave_time : 0};
  const auto turned = [](const SupportSpec& end) { return end.motion && end.motion->angle; };
  if (integrator.automatic && !turned(scene.start) && !turned(scene.end)) {  // a turn that is given does not err
    options.generalized_alpha.most_turn =
        2 * std::numbers::pi / steps_a_turn * std::sqrt(integrator.accuracy / usual_accuracy);
  }
  return options;
}

void run_to_end(const Scene& scene, EventedOde& ode, const std::function<Eigen::VectorXd()>& initial, Stops& stops,
                const IntegrationOptions& options, const Checkpoints* checkpoints, RunResult& result) {
  double t = 0;
  Eigen::VectorXd y;
  const auto started = std::chrono::steady_clock::now();
  try {
    result.samples.reserve(stops.samples.size());
    y = initial();
    if (!integrate(ode, y, t, scene.duration, stops.all(), options, result.solver, checkpoints)) {
      result.status = RunStatus::interrupted;
    }
  } catch (const ComputationFailed& failure) {
    result.status = RunStatus::failed;
    result.failure = failure.what();
    result.failure_time = failure.t;
    try {
      if (y.size() > 0 && stops.end_at(t)) ode.sample(y, t);
    } catch (const ComputationFailed& unstable) {  // looking at it is what failed, or shows why
      if (result.failure != unstable.what()) result.failure += "; there, " + std::string(unstable.what());
    }
  } catch (const std::domain_error& refused) {  // a merge that cannot be made
    result.status = RunStatus::failed;
    result.failure = refused.what();
    result.failure_time = t;
  } catch (const std::bad_alloc&) {
    result.status = RunStatus::failed;
    result.failure = "out of memory after " + std::to_string(result.samples.size()) +
                     " samples: take fewer of them (/output/interval), fewer shapes (/output/configurations) or fewer "
                     "elements";
    result.failure_time = t;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started;
  result.timing.motion =
      elapsed.count() + (checkpoints != nullptr && checkpoints->from ? checkpoints->from->seconds : 0);
}

}  // namespace vlbeam
