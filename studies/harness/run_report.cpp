#include "studies/harness/run_report.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/shape.hpp"
#include "studies/harness/messages.hpp"
#include "studies/harness/sample_quantities.hpp"
#include "studies/harness/scene_json.hpp"

namespace vlbeam {
namespace {

/// A text that goes on to its sink whenever enough of it is there.
class ReportWriter {
 public:
  explicit ReportWriter(const TextSink& sink) : sink_(sink) { text_.reserve(2 * enough); }
  ~ReportWriter() = default;
  ReportWriter(const ReportWriter&) = delete;
  ReportWriter& operator=(const ReportWriter&) = delete;

  ReportWriter& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() > enough) flush();
    return *this;
  }
  /// As short as it can be without losing a digit.
  ReportWriter& operator<<(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  }
  /// A value, indented as what stands at this depth.
  void pretty(const Json& value, std::size_t depth) {
    append_pretty(value, depth, text_);
    *this << "";
  }
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t enough = 1 << 16;

  const TextSink& sink_;
  std::string text_;
};

/// A number of a report: of a type that reads back as one of floating point.
void write_number(double value, ReportWriter& out) {
  if (!std::isfinite(value)) {
    out << "null";
    return;
  }
  const std::string text = number_text(value);
  out << text;
  if (text.find_first_of(".e") == std::string::npos) out << ".0";
}

std::vector<std::string> segments_of(const std::string& path) {
  std::vector<std::string> segments;
  std::istringstream parts(path);
  for (std::string segment; std::getline(parts, segment, '/');) segments.push_back(segment);
  return segments;
}

void write_column(const SampleQuantity& quantity, const std::vector<Sample>& samples, ReportWriter& out) {
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
void write_samples(const std::vector<SampleQuantity>& quantities, const std::vector<Sample>& samples,
                   ReportWriter& out) {
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
  for (const char* column : {"element", "x", "r", "v", "strain", "curvature", "tension"}) json[column] = Json::array();
  for (const ShapePoint& point : points) {
    json["element"].push_back(point.element);
    json["x"].push_back(point.x);
    json["r"].push_back(components(point.r, d));
    json["v"].push_back(components(point.v, d));
    json["strain"].push_back(point.strain);
    json["curvature"].push_back(point.curvature);
    json["tension"].push_back(point.tension);
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
  Json json = {
      {"t", shape.t}, {"x", shape.x}, {"r", points(shape.r)}, {"r_x", points(shape.r_x)}, {"weights", shape.weights}};
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
  if (scene.output.points > 0) json["axis"] = axis(points_along(scene, shape, scene.output.points), d);
  return json;
}

Json event(const Event& e) {
  return {{"t", e.t},
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

Json solver(const RunResult& result) {
  const SolverCounters& s = result.solver;
  return {{"steps", s.steps},
          {"rejected", s.rejected},
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

std::string short_number(double value, int digits = 6) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

std::string point_text(const Point& point, int dimension) {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
    text += (i > 0 ? ", " : "(") + short_number(point[i], 8);
  }
  return text + ") m";
}

std::string beam_text(const Scene& scene) {
  std::string text = std::to_string(scene.beam.elements) + " elements " + std::string(to_string(scene.beam.element)) +
                     ", " + std::string(to_string(scene.formulation)) + ", " + short_number(beam_length(scene)) + " m";
  for (const SlidingJointSpec& joint : sliding_joints(scene)) {
    text += joint.support == SupportType::pin     ? "; runs through a ring"
            : joint.support == SupportType::clamp ? "; runs through a sleeve"
                                                  : "; " + short_number(joint.mass) + " kg slides on it";
  }
  if (scene.spin) text += "; spins";
  if (scene.flow) text += "; flows";
  if (const auto count = scene.point_masses.size(); count > 0) {
    text += "; " + std::to_string(count) + (count == 1 ? " point mass" : " point masses");
  }
  if (const auto count = scene.loads.size(); count > 0) {
    text += "; bears " + std::to_string(count) + (count == 1 ? " load" : " loads");
  }
  return text;
}

std::string integrator_text(const IntegratorSpec& integrator) {
  const std::string type = std::string(to_string(integrator.type)) + (integrator.automatic ? " (auto)" : "");
  const bool fixed = has_fixed_step(integrator.type) && !integrator.adaptive;
  if (fixed) return type + ", steps of " + number_text(integrator.step) + " s";
  const auto& by_kind = integrator.atol_by_kind;
  const std::string atol = by_kind ? short_number(by_kind->length) + " m, " + short_number(by_kind->velocity) + " m/s"
                                   : short_number(integrator.atol);
  const std::string longest = integrator.adaptive ? ", steps up to " + short_number(integrator.step) + " s" : "";
  return type + ", rtol " + short_number(integrator.rtol) + ", atol " + atol + longest;
}

/// What was asked of an automatic run, what error that means, and why this method was taken.
std::string choice_text(const Scene& scene) {
  const IntegratorSpec& integrator = scene.integrator;
  return "for an accuracy of " + short_number(integrator.accuracy) + ", in time, so " +
         short_number(integrator.accuracy * beam_length(scene), 2) + " m: " + integrator.reason;
}

std::string events_text(const std::vector<Event>& events) {
  std::map<std::string_view, int> counts;
  for (const Event& event : events) ++counts[to_string(event.type)];
  std::string text;
  for (const auto& [type, count] : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(type);
  return text.empty() ? "none" : text;
}

/// When the run failed, or what slides left the beam.
std::string when_text(const RunResult& result) {
  if (result.status == RunStatus::failed) return " at t = " + short_number(result.failure_time) + " s";
  std::string text;
  for (const Event& event : result.events) {
    if (event.type == EventType::separation) text += (text.empty() ? " at t = " : ", ") + short_number(event.t) + " s";
  }
  return text;
}

/// How many steps there were and what made them as short as they are.
std::string steps_text(const Scene& scene, const RunResult& result) {
  const SolverCounters& s = result.solver;
  std::string text = std::to_string(s.steps) + ", " + std::to_string(s.rejected) + " rejected, the shortest " +
                     short_number(s.smallest_step, 3) + " s; limited by ";
  if (!has_fixed_step(scene.integrator.type)) return text + "the error tolerance";
  if (scene.integrator.type == IntegratorType::generalized_alpha && scene.integrator.adaptive) {
    return text + "the error tolerance and the longest step";
  }
  return text + "the step given" + (s.rejected > 0 ? " and, where rejected, by Newton's iteration" : "");
}

/// Energy [J] beside others, the largest of which is `size`: what is rounding of those is shown as 0.
std::string energy_text(double energy, double size, int digits) {
  constexpr double shown = 1e-14;
  return short_number(std::abs(energy) > shown * size ? energy : 0, digits) + " J";
}

/// The largest of all energies of a run [J].
double largest_energy(const RunResult& result) {
  double size = 0;
  for (const Sample& sample : result.samples) {
    const Energy& e = sample.energy;
    for (const double part : {e.kinetic, e.axial, e.bending, e.torsion, e.gravity, e.dissipated, e.supplied}) {
      size = std::max(size, std::abs(part));
    }
  }
  return size;
}

std::string ledger_text(const EnergyLedger& ledger, double size) {
  const auto joules = [size](double energy) { return energy_text(energy, size, 4); };
  return "changed by " + joules(ledger.change) + " = supplied " + joules(ledger.supplied) + ", at events " +
         joules(ledger.at_events) + (ledger.at_contacts != 0 ? ", at contacts " + joules(ledger.at_contacts) : "") +
         ", unexplained " + joules(ledger.unexplained) + " (at most " + joules(ledger.largest_unexplained) +
         "); dissipated " + joules(ledger.dissipated);
}

}  // namespace

void write_run_report(const Scene& scene, const RunResult& result, const Json& more, const TextSink& sink) {
  ReportWriter out(sink);
  bool first = true;
  const auto key = [&](const char* name) {
    out << (first ? "{\n  \"" : ",\n  \"") << name << "\": ";
    first = false;
  };
  const auto value = [&](const char* name, const Json& json) {
    key(name);
    out.pretty(json, 1);
  };
  const auto list = [&](const char* name, const auto& entries, const auto& to_json) {
    key(name);
    out << "[";
    for (const auto& entry : entries) {
      out << (&entry == &entries.front() ? "\n    " : ",\n    ");
      out.pretty(to_json(entry), 2);
    }
    out << (entries.empty() ? "]" : "\n  ]");
  };
  value("schema_version", "vlbeam.run/1");
  value("status", to_string(result.status));
  if (result.status == RunStatus::failed) {
    value("failure", {{"message", result.failure}, {"t", result.failure_time}});
  }
  value("warnings", warnings_json(result.warnings));
  value("scene", scene_to_json(scene));
  key("samples");
  write_samples(sample_quantities(scene), result.samples, out);
  list("configurations", result.configurations, [&scene](const Configuration& c) { return configuration(c, scene); });
  list("events", result.events, event);
  value("energy_ledger", ledger_json(energy_ledger(result)));
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

Json run_timing(const RunTiming& timing) {
  return {{"motion", timing.motion}, {"length_control", timing.length_control}};
}

void write_samples_csv(const Scene& scene, const RunResult& result, const TextSink& sink) {
  const std::vector<SampleQuantity> quantities = sample_quantities(scene);
  ReportWriter out(sink);
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

std::string stability_text(const StaticSample& at) {
  const int falls = at.negative_pivots;
  return falls == 0 ? ", stable" : ", not stable: the energy falls in " + std::to_string(falls) + " directions";
}

/// What a motion starts from.
std::string start_text(const StaticSample& at, bool with_joint) {
  const std::string held =
      at.holding_force == 0 ? "" : ", held until then by " + short_number(at.holding_force, 8) + " N";
  return "equilibrium" + stability_text(at) + (with_joint ? "; joint free" + held : "");
}

std::string static_summary(const Scene& scene, const RunResult& result) {
  std::ostringstream text;
  const auto line = [&text](const char* name, const std::string& value) {
    text << "  " << name << std::string(16 - std::string_view(name).size(), ' ') << value << '\n';
  };
  text << (scene.title.empty() ? "Untitled scene" : printable(scene.title)) << '\n';
  line("status",
       std::string(to_string(result.status)) +
           (result.status == RunStatus::failed ? " at load factor " + short_number(result.failure_time) : ""));
  line("beam", beam_text(scene));
  line("equilibria", std::to_string(result.samples.size()) + ", control by " +
                         std::string(to_string(scene.statics.control)) + ", " +
                         std::to_string(result.solver.newton.iterations) + " iterations");
  if (!result.samples.empty()) {
    const Sample& last = result.samples.back();
    const StaticSample& at = *last.equilibrium;
    line("last", "load factor " + short_number(at.load_factor, 8) + stability_text(at));
    line("end of beam", point_text(last.end, scene.dimension));
    if (last.joint_position) {
      const double holding = last.equilibrium->holding_force;
      line("joint", "at " + short_number(*last.joint_position, 10) + " m along the beam" +
                        (holding == 0 ? ", free" : ", held by " + short_number(holding, 8) + " N"));
    }
    line("energy", short_number(last.energy.total(), 8) + " J");
  }
  for (const double frequency : result.frequencies) line("frequency", short_number(frequency, 8) + " Hz");
  line("wall time", short_number(result.timing.motion, 3) + " s");
  return text.str();
}

std::string run_summary(const Scene& scene, const RunResult& result) {
  if (scene.analysis == Analysis::statics) return static_summary(scene, result);
  std::ostringstream text;
  text.precision(8);
  const auto line = [&text](const char* name, const std::string& value) {
    text << "  " << name << std::string(16 - std::string_view(name).size(), ' ') << value << '\n';
  };
  text << (scene.title.empty() ? "Untitled scene" : printable(scene.title)) << '\n';
  line("status", std::string(to_string(result.status)) + when_text(result));
  line("beam", beam_text(scene));
  line("integrator", integrator_text(scene.integrator));
  if (!scene.integrator.reason.empty()) line("", choice_text(scene));
  if (!result.samples.empty()) {
    const Sample &first = result.samples.front(), &last = result.samples.back();
    if (first.equilibrium) line("start", start_text(*first.equilibrium, sliding_joint(scene) != nullptr));
    line("time reached", short_number(last.t, 8) + " s of " + short_number(scene.duration, 8) + " s");
    line("end of beam", point_text(last.end, scene.dimension));
    if (last.joint_position) line("joint position", short_number(*last.joint_position, 8) + " m");
    if (last.mass_position) line("mass position", point_text(*last.mass_position, scene.dimension));
    const double size = largest_energy(result);
    line("total energy", energy_text(last.energy.total(), size, 8) + ", at the start " +
                             energy_text(result.samples.front().energy.total(), size, 8) + ", kinetic up to " +
                             energy_text(result.max_kinetic, size, 4));
    line("energy ledger", ledger_text(energy_ledger(result), size));
  }
  line("events", events_text(result.events));
  line("steps", steps_text(scene, result));
  line("wall time", short_number(result.timing.motion, 3) + " s motion, " +
                        short_number(result.timing.length_control, 3) + " s length control");
  for (const Warning& warning : result.warnings) {
    line("warning", warning.message);
    line("", "try: " + warning.remedy);
  }
  return text.str();
}

}  // namespace vlbeam
