#include "studies/falling_beam/convergence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/elementary.hpp"
#include "io/json.hpp"
#include "scene/derived.hpp"
#include "tools/measures.hpp"

namespace vlbeam::falling_beam {
namespace {

constexpr double reference_temporal_error = 1e-7;  // of runs at a tolerance of 1e-6, the study's table `temporal` [m]
constexpr std::array elements_compared = {ElementKind::ale_rancf, ElementKind::ale_ancf};

std::string short_name(ElementKind kind) { return kind == ElementKind::ale_rancf ? "rancf" : "ancf"; }

/// The finest run of the reference sweep.
const Run* finest(const Runs& runs, ElementKind kind) {
  const Run* best = nullptr;
  for (const Run* run : runs.select("reference", {.element = kind})) {
    if (!best || run->scene.beam.elements > best->scene.beam.elements) best = run;
  }
  return best;
}

const Sample* error_sample(const Run* run, double t) { return run ? sample_at(*run->result, t) : nullptr; }

/// Error of a run against the finest mesh of the same element.
double error_of(const Runs& runs, const Run* run, double t) {
  const Run* reference = run ? finest(runs, run->scene.beam.element) : nullptr;
  return reference ? position_error(*run->result, *reference->result, t) : nan;
}

/// A quantity of a sample that the reference table lists.
struct Quantity {
  const char* name;
  double (*of)(const Sample&);
};
constexpr std::array quantities = {
    Quantity{"joint_position", [](const Sample& s) { return s.joint_position.value_or(nan); }},
    Quantity{"end_x", [](const Sample& s) { return s.end[0]; }},
    Quantity{"end_y", [](const Sample& s) { return s.end[1]; }},
};

/// What the meshes of the reference sweep say about the limit of a quantity. No order is expected: merges happen at
/// other times on other meshes.
GridConvergence reference_convergence(const Runs& runs, ElementKind kind, const Quantity& quantity, double t) {
  std::vector<double> meshes, values;
  for (const Run* run : runs.select("reference", {.element = kind})) {
    meshes.push_back(run->scene.beam.elements);
    values.push_back(quantity.of(*sample_at(*run->result, t)));
  }
  return grid_convergence("reference_" + std::string(quantity.name) + "_" + short_name(kind), meshes, values,
                          {.floor = reference_temporal_error});
}

}  // namespace

void add_reference(StudyReport& report, const Runs& runs, const Times& times, const Json& independent) {
  double error = 0;
  for (const ElementKind kind : elements_compared) {
    for (const Quantity& quantity : quantities) {
      if (runs.select("reference", {.element = kind}).empty()) continue;
      report.grid_convergence.push_back(reference_convergence(runs, kind, quantity, times.error));
      auto& worst = report.measured["reference_uncertainty"];
      worst = std::max(worst, report.grid_convergence.back().uncertainty);
    }
    const auto meshes = runs.select("reference", {.element = kind});
    if (meshes.size() < 2) continue;
    const Run& fine = *meshes.back();
    const double difference = position_error(*meshes[meshes.size() - 2]->result, *fine.result, times.error);
    report.measured["reference_mesh_difference_" + short_name(kind)] = difference;
    error = std::max(error, difference);
  }
  const Run* rational = finest(runs, ElementKind::ale_rancf);
  const Run* polynomial = finest(runs, ElementKind::ale_ancf);
  if (!rational || !polynomial) return;
  const double between = position_error(*rational->result, *polynomial->result, times.error);
  report.measured["reference_element_difference"] = between;
  report.measured["reference_error"] = std::max(error, between);

  const Sample& sample = *error_sample(polynomial, times.error);
  const Json& green = independent.at("green");
  report.measured["reference_joint_position"] = *sample.joint_position;
  report.measured["reference_end_y"] = sample.end[1];
  report.measured["independent_joint_position_gap"] =
      std::abs(*sample.joint_position - green.at("joint_position").get<double>());
  report.measured["independent_end_y_gap"] = std::abs(sample.end[1] - green.at("end_y").get<double>());

  if (const auto engineering = runs.select("engineering"); !engineering.empty()) {
    const Sample& other = *error_sample(engineering.back(), times.error);
    const Json& law = independent.at("engineering");
    report.measured["engineering_joint_position"] = *other.joint_position;
    report.measured["engineering_end_y"] = other.end[1];
    report.measured["engineering_joint_position_gap"] =
        std::abs(*other.joint_position - law.at("joint_position").get<double>());
    report.measured["engineering_end_y_gap"] = std::abs(other.end[1] - law.at("end_y").get<double>());
  }
}

void add_mesh_convergence(StudyReport& report, const Runs& runs, const Times& times, const Judged& judged) {
  Table errors{.name = "errors",
               .caption = "Error at 0.5 s against the finest mesh of the same element, over the beam's length",
               .columns = {"elements", "rancf_variational_direction", "rancf_variational_full", "rancf_paper_direction",
                           "rancf_paper_full", "ancf_variational_direction", "ancf_variational_full",
                           "ancf_paper_direction", "ancf_paper_full"}};
  std::vector<int> meshes;
  for (const Run* run : runs.select("variational", {.element = ElementKind::ale_rancf, .clamp = direction})) {
    meshes.push_back(run->scene.beam.elements);
  }
  for (const int n : meshes) {
    std::vector<Json> row{n};
    for (const ElementKind kind : elements_compared) {
      for (const char* sweep : {"variational", "paper"}) {
        for (const ClampType clamp : {direction, ClampType::full}) {
          const Run* run = runs.find(sweep, {.elements = n, .element = kind, .clamp = clamp});
          row.push_back(number_or_null(error_of(runs, run, times.error)));
        }
      }
    }
    errors.rows.push_back(row);
  }
  for (const ElementKind kind : elements_compared) {
    std::vector<double> levels;
    std::vector<double> found;
    for (const int n : meshes) {
      const Run* run = runs.find("variational", {.elements = n, .element = kind, .clamp = direction});
      levels.push_back(n);
      found.push_back(error_of(runs, run, times.error));
    }
    if (levels.empty()) continue;
    report.measured["finest_error_" + short_name(kind)] = found.back();
    const Run* run = runs.find("variational", {.elements = meshes.back(), .element = kind, .clamp = direction});
    const Sample* sample = run != nullptr ? sample_at(*run->result, judged.t) : nullptr;
    if (sample != nullptr) {
      report.measured["judged_error_" + short_name(kind)] = judged.error(*sample) / beam_length_m;
      report.measured["judge_uncertainty"] = judged.uncertainty / beam_length_m;
    }
    // errors are known to what the reference is
    const auto known_to = report.measured.find("reference_error");
    report.fits.push_back(fit_order("falling_beam_error_" + short_name(kind), levels, found,
                                    {.floor = known_to == report.measured.end() ? 0 : known_to->second}));
  }
  report.tables.push_back(errors);

  Table difference{.name = "rancf_against_ancf",
                   .caption =
                       "ALE-RANCF against ALE-ANCF on the same mesh, direction clamp: difference of positions "
                       "over the beam's length at 0.5 s, and the largest until 0.65 s",
                   .columns = {"elements", "variational", "variational_largest", "paper", "paper_largest"}};
  for (const int n : meshes) {
    std::vector<Json> row{n};
    for (const char* sweep : {"variational", "paper"}) {
      const Run* rational = runs.find(sweep, {.elements = n, .element = ElementKind::ale_rancf, .clamp = direction});
      const Run* polynomial = runs.find(sweep, {.elements = n, .element = ElementKind::ale_ancf, .clamp = direction});
      double at_time = nan;
      double largest = nan;
      if (rational && polynomial) {
        at_time = position_error(*rational->result, *polynomial->result, times.error);
        largest = 0;
        for (const Sample& sample : rational->result->samples) {
          if (sample.t > times.tables + 1e-9) break;
          largest = std::max(largest, position_error(*rational->result, *polynomial->result, sample.t));
        }
      }
      row.push_back(number_or_null(at_time));
      row.push_back(number_or_null(largest));
      const std::string suffix = std::string(sweep) + "_n" + std::to_string(n);
      report.measured["element_difference_" + suffix] = at_time;
      report.measured["element_difference_largest_" + suffix] = largest;
    }
    difference.rows.push_back(row);
  }
  report.tables.push_back(difference);

  Table separation{.name = "separation",
                   .caption =
                       "When the mass leaves the beam [s], at the separation distance from its end [m]; empty "
                       "where it has not by the end of the run",
                   .columns = {"sweep", "elements", "element", "clamp", "separation_distance", "separation_time",
                               "furthest_joint_position"}};
  for (const char* sweep : {"paper", "variational", "exit"}) {
    for (const Run* run : runs.select(sweep)) {
      const double time = separation_time(*run->result);
      const double furthest = furthest_joint_position(*run->result, run->scene.duration);
      const std::string name = std::string("separation_time_") + sweep + "_" + short_name(run->scene.beam.element) +
                               "_n" + std::to_string(run->scene.beam.elements);
      if (run->scene.start.clamp == direction) report.measured[name] = time;
      separation.rows.push_back({sweep, run->scene.beam.elements, to_string(run->scene.beam.element),
                                 to_string(run->scene.start.clamp), *run->scene.sliding_mass->separation_distance,
                                 number_or_null(time), furthest});
    }
  }
  report.tables.push_back(separation);
  std::vector<double> exits, exit_times;
  for (const Run* run : runs.select("exit")) {
    exits.push_back(run->scene.beam.elements);
    exit_times.push_back(separation_time(*run->result));
  }
  if (!exits.empty()) {
    report.grid_convergence.push_back(
        grid_convergence("separation_time", exits, exit_times, {.floor = reference_temporal_error}));
    report.measured["separation_time_uncertainty"] = report.grid_convergence.back().uncertainty;
  }
}

void add_quadrature_convergence(StudyReport& report, const Runs& runs, const Times& times) {
  Table table{.name = "quadrature",
              .caption =
                  "Gauss points an element: error at 0.5 s against 25 points on the same mesh, and the error of "
                  "the mesh itself (with 25 points, against the reference), over the beam's length",
              .columns = {"points"}};
  struct Column {
    int elements;
    ElementKind kind;
  };
  std::vector<Column> columns;
  std::vector<int> counts;
  for (const Run* run : runs.select("quadrature")) {
    const Column column{run->scene.beam.elements, run->scene.beam.element};
    const auto same = [&](const Column& c) { return c.elements == column.elements && c.kind == column.kind; };
    if (std::ranges::none_of(columns, same)) columns.push_back(column);
    const int points = quadrature_points(run->scene);
    if (std::ranges::find(counts, points) == counts.end()) counts.push_back(points);
  }
  if (counts.size() < 2) return;
  std::ranges::sort(counts);
  const int most = counts.back();
  for (const Column& c : columns) {
    const std::string name = short_name(c.kind) + "_n" + std::to_string(c.elements);
    table.columns.push_back(name);
    table.columns.push_back(name + "_mesh");
  }
  for (const Column& c : columns) {
    const Run* by_default = runs.find("default_points", {.elements = c.elements, .element = c.kind});
    const Run* best = runs.find("quadrature", {.elements = c.elements, .element = c.kind, .points = most});
    if (by_default == nullptr || best == nullptr) continue;
    report.measured["quadrature_error_share_" + short_name(c.kind) + "_n" + std::to_string(c.elements)] =
        position_error(*by_default->result, *best->result, times.error) / error_of(runs, best, times.error);
  }
  for (const int points : counts) {
    if (points == most) continue;
    std::vector<Json> row{points};
    for (const Column& c : columns) {
      const Run* run = runs.find("quadrature", {.elements = c.elements, .element = c.kind, .points = points});
      const Run* best = runs.find("quadrature", {.elements = c.elements, .element = c.kind, .points = most});
      const double error = run && best ? position_error(*run->result, *best->result, times.error) : nan;
      const double mesh = error_of(runs, best, times.error);
      row.push_back(number_or_null(error));
      row.push_back(number_or_null(mesh));
      if (run && counts.size() > 2 && points == counts[counts.size() - 2]) {
        report.measured["quadrature_known_to_" + short_name(c.kind) + "_n" + std::to_string(c.elements)] = error / mesh;
      }
    }
    table.rows.push_back(row);
  }
  report.tables.push_back(table);
}

void add_temporal_convergence(StudyReport& report, const Runs& runs, const Times& times) {
  Table table{.name = "temporal",
              .caption =
                  "Tolerance of the integrator: error at 0.5 s against the same mesh at the tightest tolerance, "
                  "over the beam's length",
              .columns = {"elements", "element", "tolerance", "error", "steps", "rejected", "rhs_evaluations"}};
  const auto sweep = runs.select("temporal");
  if (sweep.empty()) return;
  const Run& tightest = *sweep.back();
  for (const Run* run : sweep) {
    const double error = position_error(*run->result, *tightest.result, times.error);
    const double tolerance = run->scene.integrator.rtol;
    if (run != &tightest) {
      report.measured["temporal_error_1e" + std::to_string(std::lround(portable::log10(tolerance)))] = error;
    }
    table.rows.push_back({run->scene.beam.elements, to_string(run->scene.beam.element), tolerance,
                          run == &tightest ? Json() : Json(error), run->result->solver.steps,
                          run->result->solver.rejected, run->result->solver.rhs_evaluations});
  }
  report.tables.push_back(table);
}

void add_digits(StudyReport& report, const Runs& runs, const Json& independent) {
  Table table{.name = "digits",
              .caption = "Another program on the same meshes: 15 Gauss points, direction clamp, tolerance 1e-9",
              .columns = {"element", "elements", "t", "joint_position_other", "joint_position", "end_x_other", "end_x",
                          "end_y_other", "end_y", "largest_difference", "events_other", "events"}};
  for (const Json& row : independent.at("digits_of_coarse_meshes").at("rows")) {
    const auto kind = from_string<ElementKind>(row.at("element").get<std::string>());
    const Run* run = runs.find("digits", {.elements = row.at("elements").get<int>(), .element = kind});
    const double t = row.at("t");
    const Sample* sample = error_sample(run, t);
    if (!sample || !sample->joint_position) continue;
    const double x = row.at("joint_position");
    const double end_x = row.at("end").at(0);
    const double end_y = row.at("end").at(1);
    const double difference = std::max(
        {std::abs(*sample->joint_position - x), std::abs(sample->end[0] - end_x), std::abs(sample->end[1] - end_y)});
    double& worst = report.measured[t < 0.45 ? "digits_difference_at_0.4" : "digits_difference_at_0.5"];
    worst = std::max(worst, difference);
    table.rows.push_back({row.at("element"), row.at("elements"), t, x, *sample->joint_position, end_x, sample->end[0],
                          end_y, sample->end[1], difference, row.at("events"), merges_until(*run->result, t).size()});
  }
  report.tables.push_back(table);
}

void add_ramped_twin(StudyReport& report, const Runs& runs, const Json& config, const Json& independent) {
  const Json& twin = independent.at("ramped_twin");
  Sample exact;
  exact.joint_position = twin.at("joint_position").get<double>();
  exact.end = {twin.at("end").at(0), twin.at("end").at(1), 0};
  exact.mass_position = Point{twin.at("mass").at(0), twin.at("mass").at(1), 0};
  Table table{.name = "ramped",
              .caption =
                  "The ramped twin (gravity grows over 0.3 s, 0.2 kg at 0.4 m) at 0.3 s, before any event: error "
                  "over the beam's length",
              .columns = {"elements", "element", "error", "events"}};
  double events = 0;
  for (const ElementKind kind : elements_compared) {
    std::vector<double> levels;
    std::vector<double> errors;
    for (const Run* run : runs.select("ramped", {.element = kind})) {
      const Sample* sample = sample_at(*run->result, twin.at("t"));
      levels.push_back(run->scene.beam.elements);
      errors.push_back(sample ? position_error(*sample, exact) : nan);
      events += static_cast<double>(run->result->events.size());
      table.rows.push_back(
          {run->scene.beam.elements, to_string(kind), number_or_null(errors.back()), run->result->events.size()});
    }
    const std::string name = "ramped_twin_" + short_name(kind);
    if (levels.empty()) continue;
    report.fits.push_back(fit_order(name, levels, errors, {.rule = level_rule_of(config, name)}));
  }
  report.measured["ramped_twin_events"] = events;
  report.tables.push_back(table);
}

}  // namespace vlbeam::falling_beam
