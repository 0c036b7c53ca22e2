#include "io/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

#include "io/messages.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "io/text_writer.hpp"
#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/sample_quantities.hpp"
#include "scene/shape.hpp"

namespace vlbeam {
namespace {

/// A number of a report: of a type that reads back as one of floating point.
void write_number(double value, TextWriter& out) {
  if (!std::isfinite(value)) {
    out << "null";
    return;
  }
  const std::string text = number_text(value);
  out << text;
  if (text.find_first_of(".e") == std::string::npos) out << ".0";
}

/// A value, indented as what stands at this depth.
void write_pretty(const Json& value, std::size_t depth, TextWriter& out) {
  std::string text;
  append_pretty(value, depth, text);
  out << text;
}

std::vector<std::string> segments_of(const std::string& path) {
  std::vector<std::string> segments;
  std::istringstream parts(path);
  for (std::string segment; std::getline(parts, segment, '/');) segments.push_back(segment);
  return segments;
}

void write_column(const SampleQuantity& quantity, const std::vector<Sample>& samples, TextWriter& out) {
  const std::size_t count = quantity.columns.size(), dimension = quantity.dimension;
  std::vector<double> values(count);
  const auto write_vector = [&](std::size_t first) {
    for (std::size_t i = 0; i < dimension; ++i) {
      out << (i == 0 ? "[" : ",");
      write_number(values[first + i], out);
    }
    out << "]";
  };
  out << "[";
  for (const Sample& sample : samples) {
    if (&sample != &samples.front()) out << ",";
    if (!quantity.values(sample, values.data())) {
      out << "null";
    } else if (quantity.shape == SampleShape::number) {
      write_number(values.front(), out);
    } else if (quantity.shape == SampleShape::vector) {
      write_vector(0);
    } else {
      for (std::size_t first = 0; first < count; first += dimension) {
        out << (first == 0 ? "[" : ",");
        write_vector(first);
      }
      out << "]";
    }
  }
  out << "]";
}

/// The samples as columns: an object of arrays, and of parts whose path goes deeper.
void write_samples(const std::vector<SampleQuantity>& quantities, const std::vector<Sample>& samples, TextWriter& out) {
  constexpr std::size_t depth = 1;  // of /samples
  std::vector<std::string> open;
  bool first = true;  // of the innermost object that is open
  const auto line = [&](std::size_t level) {
    out << (first ? "\n" : ",\n") << std::string(2 * (depth + 1 + level), ' ');
    first = false;
  };
  const auto close_to = [&](std::size_t level) {
    for (; open.size() > level; open.pop_back()) {
      out << (first ? "}" : "\n" + std::string(2 * (depth + open.size()), ' ') + "}");
      first = false;
    }
  };
  out << "{";
  for (const SampleQuantity& quantity : quantities) {
    std::vector<std::string> path = segments_of(quantity.path);
    const std::string name = path.back();
    if (!quantity.columns.empty()) path.pop_back();
    close_to(static_cast<std::size_t>(std::ranges::mismatch(open, path).in1 - open.begin()));
    while (open.size() < path.size()) {
      line(open.size());
      out << "\"" << path[open.size()] << "\": {";
      open.push_back(path[open.size()]);
      first = true;
    }
    if (quantity.columns.empty()) continue;
    line(open.size());
    out << "\"" << name << "\": ";
    write_column(quantity, samples, out);
  }
  close_to(0);
  out << "\n" << std::string(2 * depth, ' ') << "}";
}

Json components(const Point& point, int dimension) {
  return Json(std::vector<double>(point.begin(), point.begin() + dimension));
}

/// Points along the axis, column by column.
Json axis(const std::vector<ShapePoint>& points, int d) {
  Json json;
  for (const char* column : {"element", "x", "r", "v", "strain", "curvature", "tension", "shear", "moment", "torque"})
    json[column] = Json::array();
  for (const ShapePoint& point : points) {
    json["element"].push_back(point.element);
    json["x"].push_back(point.x);
    json["r"].push_back(components(point.r, d));
    json["v"].push_back(components(point.v, d));
    json["strain"].push_back(point.strain);
    json["curvature"].push_back(point.curvature);
    json["tension"].push_back(point.tension);
    json["shear"].push_back(point.force.shear);
    json["moment"].push_back(point.force.moment);
    json["torque"].push_back(point.force.torque);
  }
  return json;
}

Json configuration(const Configuration& shape, const Scene& scene) {
  const int d = scene.dimension;
  const auto points = [d](const std::vector<Point>& list) {
    Json array = Json::array();
    for (const Point& point : list) array.push_back(components(point, d));
    return array;
  };
  Json json;
  if (!shape.beam.empty()) json["beam"] = shape.beam;
  json.update(
      {{"t", shape.t}, {"x", shape.x}, {"r", points(shape.r)}, {"r_x", points(shape.r_x)}, {"weights", shape.weights}});
  if (!shape.angles.empty()) json["angles"] = shape.angles;
  json["x_rate"] = shape.rates.x;
  json["v"] = points(shape.rates.v);
  json["r_x_rate"] = points(shape.rates.r_x);
  if (!shape.angles.empty()) json["spins"] = shape.rates.spins;
  if (!shape.rest.r.empty()) json["rest"] = {{"r", points(shape.rest.r)}, {"r_x", points(shape.rest.r_x)}};
  Json kinks = Json::array();
  for (const auto& kink : shape.kinks) {
    kinks.push_back(
        {{"node", kink.node}, {"r_x", components(kink.r_x, d)}, {"r_x_rate", components(kink.r_x_rate, d)}});
  }
  if (kinks.size() == 1) json["kink"] = kinks.front();
  if (kinks.size() > 1) json["kinks"] = kinks;
  for (const Configuration::Action& action : shape.actions) {
    json["actions"].push_back({{"x", action.x}, {"force", components(action.force, d)}});
  }
  if (!shape.moments.empty()) json["moments"] = shape.moments;
  if (scene.output.points > 0) json["axis"] = axis(points_along(scene, shape, scene.output.points), d);
  return json;
}

Json event(const Event& e) {
  Json json = {{"t", e.t},
               {"type", to_string(e.type)},
               {"joint", e.joint},
               {"joint_position", e.joint_position},
               {"weights", e.weights},
               {"unit_fallback", e.unit_fallback},
               {"energy_jumps",
                {{"kinetic", e.energy_jump.kinetic},
                 {"axial", e.energy_jump.axial},
                 {"bending", e.energy_jump.bending},
                 {"gravity", e.energy_jump.gravity},
                 {"discrete_total", e.discrete_jump}}},
               {"momentum_jumps", e.momentum_jump},
               {"relaxation", e.relaxation},
               {"energy_restored", e.restored}};
  if (!e.beam.empty()) json["beam"] = e.beam;
  return json;
}

/// Of each number of the samples, by its name.
Json extremes_json(const Scene& scene, const std::vector<Extreme>& extremes) {
  Json json = Json::object();
  for (const Quantity& quantity : quantities(scene)) {
    const Extreme& of = extremes[quantity.number];
    json[quantity.name] = {{"largest", number_or_null(of.largest)},
                           {"largest_at", number_or_null(of.at_largest)},
                           {"least", number_or_null(of.least)},
                           {"least_at", number_or_null(of.at_least)},
                           {"unit", quantity.unit}};
  }
  return json;
}

Json ledger_json(const EnergyLedger& ledger) {
  return {{"change", ledger.change},           {"supplied", ledger.supplied},
          {"dissipated", ledger.dissipated},   {"at_events", ledger.at_events},
          {"event_jumps", ledger.event_jumps}, {"at_contacts", ledger.at_contacts},
          {"unexplained", ledger.unexplained}, {"largest_unexplained", ledger.largest_unexplained}};
}

Json warnings_json(const std::vector<Warning>& warnings) {
  Json array = Json::array();
  for (const Warning& warning : warnings) {
    array.push_back({{"kind", to_string(warning.kind)}, {"message", warning.message}, {"remedy", warning.remedy}});
  }
  return array;
}

Json error_json(const Scene& scene, const RunError& error) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json quantities = Json::array();
  for (const QuantityError& of : error.quantities) {
    quantities.push_back(
        {{"quantity", of.quantity}, {"unit", of.unit}, {"time", number(of.time)}, {"mesh", number(of.mesh)}});
  }
  Json json = {{"time", number(error.time)},
               {"mesh", number(error.mesh)},
               {"trusted_until", scene.analysis == Analysis::dynamics ? Json(error.trusted_until) : Json()},
               {"allowed_in_time", error.allowed > 0 ? Json(error.allowed) : Json()},
               {"motion", error.motion},
               {"repeats", error.repeats},
               {"elements_wanted", error.elements_wanted > 0 ? Json(error.elements_wanted) : Json()}};
  if (!error.no_time.empty()) json["no_time"] = error.no_time;
  if (!error.no_mesh.empty()) json["no_mesh"] = error.no_mesh;
  json["quantities"] = quantities;
  return json;
}

Json solver(const RunResult& result) {
  const SolverCounters& s = result.solver;
  const auto& [given, error, newton, events] = s.limited_by;
  const auto& [never, by_error, by_newton, by_events] = s.rejected_by;
  return {{"steps", s.steps},
          {"rejected", s.rejected},
          {"limited_by", {{"given_step", given}, {"error", error}, {"newton", newton}, {"events", events}}},
          {"rejected_by", {{"error", by_error}, {"newton", by_newton}, {"events", by_events}}},
          {"rhs_evaluations", s.rhs_evaluations},
          {"smallest_step", s.smallest_step},
          {"newton_iterations", s.newton.iterations},
          {"tangents", s.newton.tangents},
          {"longest_newton_iteration", s.newton.longest},
          {"constraint_residual",
           {{"position", s.newton.constraints.position}, {"velocity", s.newton.constraints.velocity}}},
          {"slope_residual", {{"position", result.slopes.position}, {"velocity", result.slopes.velocity}}},
          {"largest_kinetic_energy", result.max_kinetic},
          {"largest_energy_drift", result.max_energy_drift}};
}

}  // namespace

void write_run_report(const Scene& scene, const RunResult& result, const Shapes& shapes, const Json& more,
                      const TextSink& sink) {
  TextWriter out(sink);
  bool first = true;
  const auto key = [&](const char* name) {
    out << (first ? "{\n  \"" : ",\n  \"") << name << "\": ";
    first = false;
  };
  const auto value = [&](const char* name, const Json& json) {
    key(name);
    write_pretty(json, 1, out);
  };
  const auto list = [&](const char* name, const auto& each) {
    key(name);
    out << "[";
    bool none = true;
    each([&](const Json& entry) {
      out << (none ? "\n    " : ",\n    ");
      none = false;
      write_pretty(entry, 2, out);
    });
    out << (none ? "]" : "\n  ]");
  };
  value("schema_version", "vlbeam.run/1");
  value("status", to_string(result.status));
  if (result.status == RunStatus::failed) {
    value("failure", {{"message", result.failure}, {"t", result.failure_time}});
  }
  value("warnings", warnings_json(result.warnings));
  if (result.error) value("error", error_json(scene, *result.error));
  value("scene", scene_to_json(scene));
  value("law", law_in_words(scene));
  key("samples");
  write_samples(sample_quantities(scene), result.samples, out);
  if (!result.samples.empty() && result.samples.back().extremes) {
    value("extremes", extremes_json(scene, *result.samples.back().extremes));
  }
  list("configurations",
       [&](const auto& entry) { shapes([&](const Configuration& shape) { entry(configuration(shape, scene)); }); });
  list("events", [&](const auto& entry) {
    for (const Event& e : result.events) entry(event(e));
  });
  EnergyLedger ledger = energy_ledger(result);
  if (scene.analysis == Analysis::statics) {  // nobody adds up what loads do on the way to an equilibrium
    ledger.supplied = ledger.unexplained = ledger.largest_unexplained = nan;
  }
  value("energy_ledger", ledger_json(ledger));
  if (!result.frequencies.empty()) value("frequencies", result.frequencies);
  if (starts_in_equilibrium(scene) && !result.samples.empty()) {
    const StaticSample& start = *result.samples.front().equilibrium;
    value("initial_equilibrium", {{"negative_pivots", start.negative_pivots}, {"holding_force", start.holding_force}});
  }
  value("solver", solver(result));
  if (!scene.integrator.reason.empty()) {
    value("integrator_choice", {{"accuracy", scene.integrator.accuracy}, {"reason", scene.integrator.reason}});
  }
  for (const auto& item : more.items()) value(item.key().c_str(), item.value());
  out << "\n}\n";
  out.flush();
}

void write_run_report(const Scene& scene, const RunResult& result, const Json& more, const TextSink& sink) {
  write_run_report(scene, result, shapes_of(result), more, sink);
}

Json run_timing(const RunTiming& timing) {
  return {{"motion", timing.motion}, {"length_control", timing.length_control}};
}

void write_samples_csv(const Scene& scene, const RunResult& result, const TextSink& sink) {
  const std::vector<SampleQuantity> quantities = sample_quantities(scene);
  TextWriter out(sink);
  bool first = true;
  std::size_t most = 0;
  for (const SampleQuantity& quantity : quantities) {
    most = std::max(most, quantity.columns.size());
    for (const std::string& column : quantity.columns) {
      out << (first ? "" : ",") << column << " [" << quantity.unit << "]";
      first = false;
    }
  }
  out << "\n";
  std::vector<double> values(most);
  for (const Sample& sample : result.samples) {
    first = true;
    for (const SampleQuantity& quantity : quantities) {
      const bool there = !quantity.columns.empty() && quantity.values(sample, values.data());
      for (std::size_t i = 0; i < quantity.columns.size(); ++i) {
        if (!first) out << ",";
        first = false;
        if (there && std::isfinite(values[i])) out << values[i];
      }
    }
    out << "\n";
  }
  out.flush();
}

}  // namespace vlbeam
