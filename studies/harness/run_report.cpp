#include "studies/harness/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>
#include <vector>

#include "core/scene/build.hpp"
#include "core/scene/build_flow.hpp"
#include "core/scene/names.hpp"
#include "core/scene/options.hpp"
#include "studies/harness/scene_json.hpp"

namespace vlbeam {
namespace {

Json components(const Point& point, int dimension) {
  Json array = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) array.push_back(point[i]);
  return array;
}

template <class T>
Json column(const std::vector<T>& rows, const std::function<Json(const T&)>& cell) {
  Json array = Json::array();
  for (const T& row : rows) array.push_back(cell(row));
  return array;
}

/// The energies by name.
const std::vector<std::pair<const char*, double (*)(const Energy&)>>& energies() {
  static const std::vector<std::pair<const char*, double (*)(const Energy&)>> table = {
      {"kinetic", [](const Energy& e) { return e.kinetic; }},
      {"axial", [](const Energy& e) { return e.axial; }},
      {"bending", [](const Energy& e) { return e.bending; }},
      {"torsion", [](const Energy& e) { return e.torsion; }},
      {"gravity", [](const Energy& e) { return e.gravity; }},
      {"dissipated", [](const Energy& e) { return e.dissipated; }},
      {"total", [](const Energy& e) { return e.total(); }}};
  return table;
}

bool moves_supports(const Scene& scene) { return scene.start.motion || scene.end.motion; }

/// What a beam that spins, flows or bears loads adds to its samples.
Json flow_samples(const Scene& scene, const std::vector<Sample>& rows) {
  const int d = scene.dimension;
  const auto of = [&rows](const std::function<Json(const FlowSample&)>& cell) {
    return column<Sample>(rows, [&cell](const Sample& s) { return cell(*s.flow); });
  };
  Json json = {{"mass", of([](const FlowSample& s) -> Json { return s.mass; })}};
  if (scene.spin) {
    json["end_angles"] = of([](const FlowSample& s) -> Json { return *s.end_angles; });
    json["spin_momentum"] = of([](const FlowSample& s) -> Json { return s.spin_momentum; });
  }
  if (!scene.loads.empty()) {
    json["loads"] = of(
        [d](const FlowSample& s) { return column<Point>(s.loads, [d](const Point& p) { return components(p, d); }); });
  }
  if (keeps_ledger(scene)) {
    const auto entry = [&of](double FlowSample::Ledger::*member) {
      return of([member](const FlowSample& s) -> Json { return (*s.ledger).*member; });
    };
    json["ledger"] = {{"mass", entry(&FlowSample::Ledger::mass)},
                      {"ends", entry(&FlowSample::Ledger::ends)},
                      {"loads", entry(&FlowSample::Ledger::loads)},
                      {"mesh", entry(&FlowSample::Ledger::mesh)}};
  }
  return json;
}

Json samples(const Scene& scene, const std::vector<Sample>& rows) {
  const int d = scene.dimension;
  const auto of = [&rows](const std::function<Json(const Sample&)>& cell) { return column<Sample>(rows, cell); };
  Json energy;
  for (const auto& [name, value] : energies()) {
    energy[name] = of([value = value](const Sample& s) -> Json { return value(s.energy); });
  }
  if (moves_supports(scene)) energy["supplied"] = of([](const Sample& s) -> Json { return s.energy.supplied; });
  energy["discrete_total"] = of([](const Sample& s) -> Json { return s.discrete_total; });
  Json reactions = Json::object();
  const std::array<std::pair<const char*, SupportType>, 2> ends{{{"start", scene.start.type}, {"end", scene.end.type}}};
  for (std::size_t i = 0; i < 2; ++i) {
    if (flows(scene) || ends[i].second == SupportType::free) continue;
    reactions[ends[i].first] = {
        {"position", of([d, i](const Sample& s) { return components(s.reactions[i].position, d); })},
        {"slope", of([d, i](const Sample& s) { return components(s.reactions[i].slope, d); })}};
  }
  Json json = {
      {"t", of([](const Sample& s) -> Json { return s.t; })},
      {"joint_position", of([](const Sample& s) { return s.joint_position ? Json(*s.joint_position) : Json(); })},
      {"mass_position",
       of([d](const Sample& s) { return s.mass_position ? components(*s.mass_position, d) : Json(); })},
      {"end", of([d](const Sample& s) { return components(s.end, d); })},
      {"beam_length", of([](const Sample& s) -> Json { return s.beam_length; })},
      {"beam_length_rate", of([](const Sample& s) -> Json { return s.beam_length_rate; })},
      {"energy", energy},
      {"momentum", of([d](const Sample& s) { return components(s.momentum, d); })},
      {"reactions", reactions}};
  if (flows(scene)) json["flow"] = flow_samples(scene, rows);
  return json;
}

Json configuration(const Configuration& shape, int d) {
  const auto points = [d](const std::vector<Point>& list) {
    return column<Point>(list, [d](const Point& p) { return components(p, d); });
  };
  Json json = {
      {"t", shape.t}, {"x", shape.x}, {"r", points(shape.r)}, {"r_x", points(shape.r_x)}, {"weights", shape.weights}};
  if (!shape.angles.empty()) json["angles"] = shape.angles;
  if (shape.kink) json["kink"] = {{"node", shape.kink->node}, {"r_x", components(shape.kink->r_x, d)}};
  return json;
}

Json event(const Event& e) {
  return {{"t", e.t},
          {"type", to_string(e.type)},
          {"joint_position", e.joint_position},
          {"weights", e.weights},
          {"unit_fallback", e.unit_fallback},
          {"energy_jumps",
           {{"kinetic", e.energy_jump.kinetic},
            {"axial", e.energy_jump.axial},
            {"bending", e.energy_jump.bending},
            {"gravity", e.energy_jump.gravity},
            {"discrete_total", e.discrete_jump}}},
          {"momentum_jumps", e.momentum_jump}};
}

}  // namespace

Json run_report(const Scene& scene, const RunResult& result) {
  const int d = scene.dimension;
  Json report;
  report["schema_version"] = "vlbeam.run/1";
  report["status"] = to_string(result.status);
  if (result.status == RunStatus::failed) {
    report["failure"] = {{"message", result.failure}, {"t", result.failure_time}};
  }
  report["scene"] = scene_to_json(scene);
  report["samples"] = samples(scene, result.samples);
  report["configurations"] =
      column<Configuration>(result.configurations, [d](const Configuration& c) { return configuration(c, d); });
  report["events"] = column<Event>(result.events, event);
  report["solver"] = {{"steps", result.solver.steps},
                      {"rejected", result.solver.rejected},
                      {"rhs_evaluations", result.solver.rhs_evaluations},
                      {"smallest_step", result.solver.smallest_step},
                      {"newton_iterations", result.solver.newton.iterations},
                      {"tangents", result.solver.newton.tangents},
                      {"longest_newton_iteration", result.solver.newton.longest},
                      {"constraint_residual",
                       {{"position", result.solver.newton.constraints.position},
                        {"velocity", result.solver.newton.constraints.velocity}}},
                      {"slope_residual", {{"position", result.slopes.position}, {"velocity", result.slopes.velocity}}},
                      {"largest_kinetic_energy", result.max_kinetic},
                      {"largest_energy_drift", result.max_energy_drift}};
  return report;
}

Json run_timing(const RunTiming& timing) {
  return {{"motion", timing.motion}, {"length_control", timing.length_control}};
}

std::string samples_csv(const Scene& scene, const RunResult& result) {
  static constexpr std::array axes{"x", "y", "z"};
  const auto d = static_cast<std::size_t>(scene.dimension);
  std::string text = "t,joint_position";
  for (const char* vector : {"mass", "end"}) {
    for (std::size_t i = 0; i < d; ++i) text += std::string(",") + vector + "_" + axes[i];
  }
  text += ",beam_length,beam_length_rate";
  for (const auto& [name, value] : energies()) text += std::string(",energy_") + name;
  for (std::size_t i = 0; i < d; ++i) text += std::string(",momentum_") + axes[i];
  if (moves_supports(scene)) text += ",energy_supplied";
  if (flows(scene)) text += ",mass";
  if (scene.spin) text += ",angle_start,angle_end";
  const std::size_t loads = flows(scene) && !result.samples.empty() ? result.samples.front().flow->loads.size() : 0;
  for (std::size_t k = 0; k < loads; ++k) {
    for (std::size_t i = 0; i < d; ++i) text += ",load" + std::to_string(k) + "_" + axes[i];
  }
  text += '\n';

  for (const Sample& s : result.samples) {
    const auto cell = [&text](double value) { text += "," + (std::isfinite(value) ? number_text(value) : ""); };
    text += number_text(s.t) + ",";
    if (s.joint_position) text += number_text(*s.joint_position);
    for (std::size_t i = 0; i < d; ++i) text += s.mass_position ? "," + number_text((*s.mass_position)[i]) : ",";
    for (std::size_t i = 0; i < d; ++i) cell(s.end[i]);
    cell(s.beam_length);
    cell(s.beam_length_rate);
    for (const auto& [name, value] : energies()) cell(value(s.energy));
    for (std::size_t i = 0; i < d; ++i) cell(s.momentum[i]);
    if (moves_supports(scene)) cell(s.energy.supplied);
    if (s.flow) {
      cell(s.flow->mass);
      if (s.flow->end_angles) std::ranges::for_each(*s.flow->end_angles, cell);
      for (const Point& load : s.flow->loads) std::for_each_n(load.begin(), d, cell);
    }
    text += '\n';
  }
  return text;
}

std::string run_summary(const Scene& scene, const RunResult& result) {
  std::ostringstream text;
  text << (scene.title.empty() ? "Untitled scene" : scene.title) << '\n'
       << "  status          " << to_string(result.status);
  if (result.status == RunStatus::failed) text << " at t = " << result.failure_time << " s: " << result.failure;
  text << '\n'
       << "  beam            " << scene.beam.elements << " elements " << to_string(scene.beam.element) << ", "
       << to_string(scene.formulation) << ", " << beam_length(scene) << " m\n";
  if (!result.samples.empty()) {
    const Sample& last = result.samples.back();
    const auto point = [&](const Point& p) {
      std::ostringstream out;
      out.precision(8);
      for (std::size_t i = 0; i < static_cast<std::size_t>(scene.dimension); ++i) out << (i > 0 ? ", " : "(") << p[i];
      return out.str() + ")";
    };
    text.precision(8);
    text << "  time reached    " << last.t << " s\n"
         << "  end of beam     " << point(last.end) << " m\n";
    if (last.joint_position) text << "  joint position  " << *last.joint_position << " m\n";
    if (last.mass_position) text << "  mass position   " << point(*last.mass_position) << " m\n";
    text << "  total energy    " << last.energy.total() << " J, at the start " << result.samples.front().energy.total()
         << " J\n";
  }
  text << "  events          " << result.events.size() << '\n'
       << "  solver          " << result.solver.steps << " steps, " << result.solver.rejected << " rejected, "
       << result.solver.rhs_evaluations << " right-hand sides\n"
       << "  wall time       " << result.timing.motion << " s motion, " << result.timing.length_control
       << " s length control\n";
  return text.str();
}

}  // namespace vlbeam
