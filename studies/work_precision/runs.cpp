#include "studies/work_precision/runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <stdexcept>

#include "core/geometry/elementary.hpp"
#include "io/scene_json.hpp"
#include "scene/options.hpp"

namespace vlbeam::work_precision {
namespace {

constexpr double beam_length_m = 1;  // of every problem
constexpr double short_run = 0.1;    // [s]: shorter ones are repeated and the fastest counts
constexpr int repeats = 3;

double distance(const Point& a, const Point& b) { return portable::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

Point point_from_json(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>(), 0}; }

/// Processor time of this thread [s]: what the wall clock shows where nothing else runs.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Rung run(const Scene& scene, const Integrator& integrator, double most_element_steps) {
  const double started = thread_seconds();
  const auto elapsed = [&] { return thread_seconds() - started; };
  const auto undisturbed = StudyContext::until_interrupted();
  Rung rung;
  const double most_steps = std::min(integrator.most_steps, most_element_steps / scene.beam.elements);
  double steps = 0;
  const RunResult result = simulate(scene, [&](double t) {
    if (!undisturbed(t)) throw std::runtime_error("interrupted");
    rung.reached = t;
    return ++steps <= most_steps;
  });
  rung.seconds = elapsed();
  rung.ending = result.status == RunStatus::interrupted ? Ending::capped
                : result.status == RunStatus::failed    ? Ending::failed
                                                        : Ending::completed;
  if (rung.ending == Ending::completed) rung.state = state_of(result);
  rung.events = result.events.size();
  rung.solver = result.solver;
  return rung;
}

}  // namespace

std::string Integrator::setting(double value) const {
  return fixed_step ? "step = " + number_text(value) + " s" : "rtol = atol = " + number_text(value);
}

std::vector<Integrator> read_integrators(const Json& config, const std::string& problem) {
  std::vector<Integrator> integrators;
  for (const Json& entry : config) {
    Integrator integrator;
    integrator.name = entry.at("name").get<std::string>();
    integrator.family = entry.at("family").get<std::string>();
    integrator.scene = entry.at("integrator");
    integrator.fixed_step = entry.contains("steps");
    const Json& values = entry.at(integrator.fixed_step ? "steps" : "tolerances");
    const std::string key = values.contains(problem) ? problem : "others";
    integrator.values = (values.is_object() ? values.at(key) : values).get<std::vector<double>>();
    const Json& most = entry.at("most_steps");
    integrator.most_steps =
        (most.is_object() ? most.at(most.contains(problem) ? problem : "others") : most).get<double>();
    if (entry.contains("fine")) {
      integrator.fine_below = entry.at("fine").at("below").get<double>();
      integrator.fine = entry.at("fine").at("integrator");
    }
    integrators.push_back(std::move(integrator));
  }
  return integrators;
}

State state_of(const RunResult& result) {
  const Sample& last = result.samples.back();
  return {.joint_position = last.joint_position, .mass_position = last.mass_position, .end = last.end};
}

State state_from_json(const Json& json) {
  State state;
  state.end = point_from_json(json.at("end"));
  state.error = json.at("error").get<double>();
  if (!json.at("joint_position").is_null()) {
    state.joint_position = json.at("joint_position").get<double>();
    state.mass_position = point_from_json(json.at("mass_position"));
  }
  return state;
}

double position_error(const State& a, const State& b) {
  double error = distance(a.end, b.end);
  if (a.joint_position.has_value() != b.joint_position.has_value()) return std::numeric_limits<double>::quiet_NaN();
  if (a.joint_position) {
    error = std::max(
        {error, std::abs(*a.joint_position - *b.joint_position), distance(*a.mass_position, *b.mass_position)});
  }
  return error / beam_length_m;
}

std::vector<Rung> climb(const Ladder& ladder, double most_element_steps) {
  std::vector<Rung> rungs;
  const Integrator& integrator = ladder.integrator;
  for (const double value : integrator.values) {
    Json choice = value < integrator.fine_below ? merged(integrator.scene, integrator.fine) : integrator.scene;
    for (const char* key : {"rtol", "atol"}) {
      if (!integrator.fixed_step) choice[key] = value;
    }
    if (integrator.fixed_step) choice["step"] = value;
    Json json = merged(ladder.scene, {{"integrator", choice}});
    json["output"]["interval"] = json.at("duration");
    const Scene scene = scene_from_json(json);
    Rung rung = run(scene, integrator, most_element_steps);
    for (int again = 1; again < repeats && rung.seconds < short_run && rung.ending == Ending::completed; ++again) {
      rung.seconds = std::min(rung.seconds, run(scene, integrator, most_element_steps).seconds);
    }
    rung.value = value;
    rungs.push_back(rung);
    // a finer rung takes longer still, unless this one was held up by steps that were too long
    if (rung.ending == Ending::capped && (!integrator.fixed_step || rung.solver.rejected == 0)) break;
  }
  return rungs;
}

std::string milliseconds(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), seconds < 0.01 ? "%.1f ms" : "%.0f ms", 1e3 * seconds);
  return text.data();
}

Json merged(Json target, const Json& patch) {
  target.merge_patch(patch);
  return target;
}

}  // namespace vlbeam::work_precision
