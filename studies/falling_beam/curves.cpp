#include "studies/falling_beam/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/measures.hpp"

namespace vlbeam::falling_beam {
namespace {

struct Setting {
  const char* sweep;
  const char* title;
};
constexpr std::array settings = {
    Setting{"paper", "the paper\\047s setting: virtual work, 5 Gauss points, tolerance 10^{-6}"},
    Setting{"variational", "variational equations, converged Gauss points, tolerance 10^{-9}"},
};

struct Element {
  const char* name;
  ElementKind kind;
};
constexpr std::array elements = {Element{"rancf", ElementKind::ale_rancf}, Element{"ancf", ElementKind::ale_ancf}};

std::string text_of(double t) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.4g", t);
  return text.data();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<int> meshes_of(const Runs& runs, std::string_view sweep) {
  std::vector<int> meshes;
  for (const Run* run : runs.select(sweep, {.element = ElementKind::ale_rancf, .clamp = direction})) {
    meshes.push_back(run->scene.beam.elements);
  }
  return meshes;
}

std::string words(const std::vector<int>& numbers) {
  std::vector<std::string> list;
  list.reserve(numbers.size());
  for (const int n : numbers) list.push_back(std::to_string(n));
  return joined(list);
}

std::string column(const std::string& name, const Element& element, int n) {
  return name + "_" + element.name + "_n" + std::to_string(n);
}

/// Nodes of the initial meshes: Figure 8.
Table initial_nodes(const Runs& runs) {
  Table table{.name = "initial_nodes",
              .caption = "Material coordinates of the nodes at t = 0 [m]; joint: 1 for the node under the mass",
              .columns = {"row", "elements", "x", "joint"},
              .curve = true};
  int row = 0;
  for (const int n : meshes_of(runs, "paper")) {
    ++row;
    const Run& run = *runs.find("paper", {.elements = n});
    const double mass = run.result->samples.front().joint_position.value_or(-1);
    for (const double x : run.result->configurations.front().x) table.rows.push_back({row, n, x, x == mass ? 1 : 0});
  }
  return table;
}

/// Whole shapes at the times kept, evaluated on the elements' curves: Figure 9.
Table configurations(const Runs& runs, const char* sweep, int n, int points) {
  Table table{.name = std::string("configurations_") + sweep,
              .caption = "Positions of material points x at the times in the column names [m]",
              .columns = {"x"},
              .curve = true};
  for (int i = 0; i < points; ++i) table.rows.push_back({static_cast<double>(i) / (points - 1) * beam_length_m});
  for (const Element& element : elements) {
    const Run* run = runs.find(sweep, {.elements = n, .element = element.kind, .clamp = direction});
    if (!run) continue;
    for (const Configuration& shape : run->result->configurations) {
      const std::string name = std::string(element.name) + "_" + text_of(shape.t);
      table.columns.push_back(name + "_x");
      table.columns.push_back(name + "_y");
      for (auto& row : table.rows) {
        const auto r = point_at(shape, row.front().get<double>());
        row.push_back(r[0]);
        row.push_back(r[1]);
      }
    }
  }
  return table;
}

Table configuration_masses(const Runs& runs, const char* sweep, int n) {
  Table table{.name = std::string("configuration_masses_") + sweep,
              .caption = "Positions of the sliding mass at the times of the configurations [m]",
              .columns = {"t", "rancf_x", "rancf_y", "ancf_x", "ancf_y"},
              .curve = true};
  const Run* first = runs.find(sweep, {.elements = n, .element = ElementKind::ale_rancf, .clamp = direction});
  for (const double t : first ? first->scene.output.configurations : std::vector<double>{}) {
    std::vector<Json> row{t};
    for (const Element& element : elements) {
      const Run* run = runs.find(sweep, {.elements = n, .element = element.kind, .clamp = direction});
      const Sample* sample = run ? sample_at(*run->result, t) : nullptr;
      row.push_back(sample ? Json((*sample->mass_position)[0]) : Json());
      row.push_back(sample ? Json((*sample->mass_position)[1]) : Json());
    }
    table.rows.push_back(row);
  }
  return table;
}

/// Tip heights, and paths of the sliding node while it is on the beam: Figures 10 and 11.
Table histories(const Runs& runs, const char* sweep, const std::vector<int>& meshes) {
  Table table{.name = std::string("histories_") + sweep,
              .caption = "Y of the beam's end and path of the sliding node [m] against time [s]",
              .columns = {"t"},
              .curve = true};
  for (const Element& element : elements) {
    for (const int n : meshes) {
      const Run* run = runs.find(sweep, {.elements = n, .element = element.kind, .clamp = direction});
      if (!run) continue;
      const auto& samples = run->result->samples;
      if (table.rows.empty()) {
        for (const Sample& sample : samples) table.rows.push_back({sample.t});
      }
      for (const char* name : {"end_y", "joint_x", "joint_y"}) table.columns.push_back(column(name, element, n));
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const bool on_beam = samples[i].joint_position.has_value();
        table.rows[i].push_back(samples[i].end[1]);
        table.rows[i].push_back(on_beam ? Json((*samples[i].mass_position)[0]) : Json());
        table.rows[i].push_back(on_beam ? Json((*samples[i].mass_position)[1]) : Json());
      }
    }
  }
  return table;
}

/// Shapes before and after the first two events: Figure 12.
void add_length_control(StudyReport& report, const Runs& runs, const char* sweep, int n, int points) {
  Table curves{.name = std::string("length_control_") + sweep,
               .caption = "Elements changed by the first two length-control events, before and after [m]",
               .columns = {"s"},
               .curve = true};
  Table nodes{.name = std::string("length_control_nodes_") + sweep,
              .caption = "Their nodes [m]; element: 0 ALE-RANCF, 1 ALE-ANCF; after: 0 or 1; joint: 1 under the mass",
              .columns = {"event", "element", "after", "joint", "x", "y"},
              .curve = true};
  for (int i = 0; i < points; ++i) curves.rows.push_back({static_cast<double>(i) / (points - 1)});
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Run* run = runs.find(sweep, {.elements = n, .element = elements[e].kind, .clamp = direction});
    if (!run) continue;
    const auto events = merges_until(*run->result, run->scene.duration);
    for (std::size_t k = 0; k < std::min<std::size_t>(2, events.size()); ++k) {
      const Stretch stretch = changed_by(*events[k]);
      for (const bool after : {false, true}) {
        const Configuration& shape = after ? events[k]->after : events[k]->before;
        const std::string name =
            std::string(elements[e].name) + "_lc" + std::to_string(k + 1) + (after ? "_after" : "_before");
        curves.columns.push_back(name + "_x");
        curves.columns.push_back(name + "_y");
        for (auto& row : curves.rows) {
          const double s = row.front().get<double>();
          const auto r = point_at(shape, stretch.begin + s * (stretch.end - stretch.begin));
          row.push_back(r[0]);
          row.push_back(r[1]);
        }
        for (std::size_t i = 0; i < shape.x.size(); ++i) {
          if (shape.x[i] < stretch.begin - 1e-9 || shape.x[i] > stretch.end + 1e-9) continue;
          const bool joint = std::abs(shape.x[i] - events[k]->joint_position) < 1e-9;
          nodes.rows.push_back({k + 1, e, after ? 1 : 0, joint ? 1 : 0, shape.r[i][0], shape.r[i][1]});
        }
      }
    }
  }
  report.tables.push_back(curves);
  report.tables.push_back(nodes);
}

/// How far length control moves material points, on the segmented and on the merged side.
Table shape_changes(const Runs& runs, double t) {
  Table table{.name = "shape_changes",
              .caption =
                  "What length control changes until 0.65 s, direction clamp: largest displacement of a material "
                  "point at an event over the standard element length, on the segmented and on the merged side, "
                  "and sums of the jumps of energy [J]",
              .columns = {"sweep", "elements", "element", "events", "segmented_side", "merged_side", "kinetic_jumps",
                          "elastic_jumps"}};
  for (const Setting& setting : settings) {
    for (const Run* run : runs.select(setting.sweep, {.clamp = direction})) {
      double segmented = 0;
      double merged = 0;
      double kinetic = 0;
      double elastic = 0;
      const auto events = merges_until(*run->result, t);
      for (const Event* event : events) {
        kinetic += std::abs(event->energy_jump.kinetic);
        elastic += std::abs(event->energy_jump.axial + event->energy_jump.bending);
        const Displacement moved = displacement_by(*event);
        segmented = std::max(segmented, moved.segmented);
        merged = std::max(merged, moved.merged);
      }
      const double standard = beam_length_m / run->scene.beam.elements;
      table.rows.push_back({setting.sweep, run->scene.beam.elements, to_string(run->scene.beam.element), events.size(),
                            segmented / standard, merged / standard, kinetic, elastic});
    }
  }
  return table;
}

/// Total energy, and the same without what length control has added.
Table energy_histories(const Runs& runs, const std::vector<int>& meshes) {
  Table table{.name = "energy_histories",
              .caption = "Total energy by the 25-point rule, and without the jumps of the length-control events [J]",
              .columns = {"t"},
              .curve = true};
  for (const Setting& setting : settings) {
    for (const Element& element : elements) {
      for (const int n : meshes) {
        const Run* run = runs.find(setting.sweep, {.elements = n, .element = element.kind, .clamp = direction});
        if (!run) continue;
        const auto& samples = run->result->samples;
        if (table.rows.empty()) {
          for (const Sample& sample : samples) table.rows.push_back({sample.t});
        }
        const double separation = separation_time(*run->result);
        table.columns.push_back(column(std::string("total_") + setting.sweep, element, n));
        table.columns.push_back(column(std::string("kept_") + setting.sweep, element, n));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
          const bool on_beam = !(samples[i].t >= separation);
          table.rows[i].push_back(on_beam ? Json(samples[i].energy.total()) : Json());
          table.rows[i].push_back(on_beam ? Json(energy_without_jumps(*run->result, samples[i])) : Json());
        }
      }
    }
  }
  return table;
}

}  // namespace

void add_figures(StudyReport& report, const Runs& runs, const StudyContext& context) {
  const Json& config = context.config.at("figures");
  const int n = config.at("elements");
  const int points = config.at("configuration_points");
  const auto energy_meshes = config.at("energy_elements").get<std::vector<int>>();
  const double until = context.config.at("times").at("tables");
  const GnuplotVariables common{{"folder", context.folder.string()}};
  const auto figure = [&](const std::string& name, const std::string& caption, const std::string& script,
                          GnuplotVariables variables = {}) {
    variables.insert(common.begin(), common.end());
    report.figures.push_back({.name = name, .caption = caption, .script = script, .variables = variables});
  };

  report.tables.push_back(initial_nodes(runs));
  figure("figure8", "Figure 8: initial configuration, and the meshes at t = 0", "figure8.gp");
  for (const Setting& setting : settings) {
    const std::string sweep = setting.sweep;
    const auto meshes = meshes_of(runs, sweep);
    if (meshes.empty()) continue;
    const std::string in_words = sweep == "paper" ? "the paper's setting" : "variational equations";
    report.tables.push_back(configurations(runs, setting.sweep, n, points));
    report.tables.push_back(configuration_masses(runs, setting.sweep, n));
    report.tables.push_back(histories(runs, setting.sweep, meshes));
    add_length_control(report, runs, setting.sweep, meshes.front(), points);

    std::vector<std::string> times;
    for (const double t : runs.find(sweep)->scene.output.configurations) times.push_back(text_of(t));
    const GnuplotVariables shared{{"sweep", sweep}, {"setting", setting.title}, {"meshes", words(meshes)}};
    const auto with = [&](GnuplotVariables more) {
      more.insert(shared.begin(), shared.end());
      return more;
    };
    figure("figure9_" + sweep, "Figure 9: configurations of the beam and the mass, " + in_words, "figure9.gp",
           with({{"times", joined(times)}, {"elements", std::to_string(n)}}));
    figure("figure10_" + sweep, "Figure 10: Y of the beam's right end, " + in_words, "figure10.gp", shared);
    figure("figure11_" + sweep, "Figure 11: trajectories of the sliding node, " + in_words, "figure11.gp", shared);
    figure("figure12_" + sweep, "Figure 12: before and after length control, " + in_words, "figure12.gp",
           with({{"elements", std::to_string(meshes.front())}}));
  }
  report.tables.push_back(shape_changes(runs, until));
  report.tables.push_back(energy_histories(runs, energy_meshes));
  figure("energy", "Total energy against time for both formulations", "energy.gp", {{"meshes", words(energy_meshes)}});
  figure("errors", "Error at 0.5 s against the number of elements", "errors.gp",
         {{"clamps", runs.find("variational", {.clamp = ClampType::full}) ? "direction full" : "direction"}});
  figure("quadrature", "Convergence in the number of Gauss points", "quadrature.gp");
  const Run* temporal = runs.find("temporal");
  figure("temporal", "Temporal error against tolerance", "temporal.gp",
         {{"mesh", temporal ? std::string(to_string(temporal->scene.beam.element)) +
                                  ", N = " + std::to_string(temporal->scene.beam.elements)
                            : ""}});
}

}  // namespace vlbeam::falling_beam
