#include "studies/work_precision/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "scene/options.hpp"
#include "studies/work_precision/integrators.hpp"

namespace vlbeam::work_precision {
namespace {

struct MeshClimb {
  Ladder ladder;
  int elements = 0;
  bool exact = false;  ///< leaves no temporal error worth the name
  std::vector<Rung> rungs;
};

/// A run with its errors over the beam's length.
struct Measured {
  const MeshClimb* climb;
  const Rung* rung;
  double total, spatial, temporal;
};

/// Of points in the order of their cost, those of which none before is as good.
std::vector<const Measured*> front_of(const std::vector<Measured>& points) {
  std::vector<const Measured*> front;
  for (const Measured& point : points) {
    if (front.empty() || point.total < front.back()->total) front.push_back(&point);
  }
  return front;
}

std::vector<Json> row(const Measured& point, double cost) {
  const Integrator& integrator = point.climb->ladder.integrator;
  return {integrator.name,
          point.climb->ladder.element,
          point.climb->elements,
          integrator.setting(point.rung->value),
          point.total,
          point.temporal,
          cost};
}

/// The integrators of the study, with the rungs that they have here.
Json with_rungs(const Json& integrators, const Json& rungs) {
  Json result = Json::array();
  for (const Json& entry : rungs) {
    const auto of_name = [&](const Json& other) { return other.at("name") == entry.at("name"); };
    const auto found = std::ranges::find_if(integrators, of_name);
    if (found == integrators.end()) throw std::invalid_argument("no integrator " + entry.at("name").dump());
    result.push_back(merged(*found, entry));
  }
  return result;
}

struct Cost {
  std::string name, unit, title;
  std::function<double(const Measured&)> of;
  bool timing;
};

/// Of each integrator and of all together the runs of which none is as good and costs less.
void add_fronts(StudyReport& report, const Json& config, std::vector<Measured> points, const Cost& cost) {
  std::ranges::stable_sort(points, {}, cost.of);
  Table fronts{.name = "best_meshes_by_" + cost.name,
               .caption = "of each integrator the runs of which none is as good and needs less " + cost.name,
               .columns = {"integrator", "element", "elements", "setting", "total", "temporal", cost.unit},
               .timing = cost.timing};
  Table front = fronts;
  front.name = "pareto_front_by_" + cost.name;
  front.caption = "of all runs those of which none is as good and needs less " + cost.name;
  for (const Measured* point : front_of(points)) front.rows.push_back(row(*point, cost.of(*point)));
  for (const Json& integrator : config.at("integrators")) {
    std::vector<Measured> own;
    std::ranges::copy_if(points, std::back_inserter(own), [&](const Measured& point) {
      return point.climb->ladder.integrator.name == integrator.at("name");
    });
    for (const Measured* point : front_of(own)) fronts.rows.push_back(row(*point, cost.of(*point)));
  }
  report.tables.push_back(fronts);
  report.tables.push_back(front);
  GnuplotVariables variables = style(config);
  variables["work"] = cost.unit;
  variables["work_title"] = cost.title;
  variables["table"] = fronts.name + (cost.timing ? ".timing.csv" : ".csv");
  report.figures.push_back({.name = "best_meshes_by_" + cost.name,
                            .caption = "Total error of the falling beam at 0.5 s against " + cost.name +
                                       ", each integrator on its best meshes",
                            .script = "meshes.gp",
                            .variables = variables,
                            .timing = cost.timing});
}

}  // namespace

void compare_meshes(StudyReport& report, const StudyContext& context, const State& converged) {
  const Json& config = context.config.at("meshes");
  const double cap = context.config.at("most_element_steps").get<double>();
  std::vector<MeshClimb> climbs;
  for (const Json& element : config.at("elements")) {
    for (const int n : config.at("counts").get<std::vector<int>>()) {
      const Json scene = merged(context.config.at("scene"), {{"beam", {{"element", element}, {"elements", n}}},
                                                             {"duration", config.at("duration")}});
      const auto add = [&](const char* key, bool exact) {
        const Json all = exact ? config.at(key) : with_rungs(context.config.at("integrators"), config.at(key));
        for (const Integrator& integrator : read_integrators(all, "meshes")) {
          climbs.push_back({{"meshes", element.get<std::string>(), scene, integrator}, n, exact, {}});
        }
      };
      add("exact", true);
      add("integrators", false);
    }
  }
  const auto outcomes =
      context.sweep(climbs, [&](const MeshClimb& climb) { return work_precision::climb(climb.ladder, cap); });
  for (std::size_t i = 0; i < climbs.size(); ++i) {
    if (outcomes[i]) climbs[i].rungs = *outcomes[i];
    if (!outcomes[i]) {
      report.cases.push_back({.options = {{"elements", climbs[i].elements},
                                          {"element", climbs[i].ladder.element},
                                          {"integrator", climbs[i].ladder.integrator.name}},
                              .results = Json::object(),
                              .failure = outcomes[i].failure});
    }
  }

  Table errors{
      .name = "total_errors",
      .caption = "error at the end against the converged beam, and what mesh and integrator leave of it",
      .columns = {"element", "elements", "integrator", "setting", "total", "spatial", "temporal", "evaluations"}};
  Table skipped{.name = "skipped",
                .caption = "what is not shown, for its work reaches the cap or it fails",
                .columns = {"element", "elements", "integrator", "setting", "ending"}};
  std::vector<Measured> points;
  for (const MeshClimb& climb : climbs) {
    for (const Rung& rung : climb.rungs) {
      if (rung.ending == Ending::completed) continue;
      skipped.rows.push_back({climb.ladder.element, climb.elements, climb.ladder.integrator.name,
                              climb.ladder.integrator.setting(rung.value), to_string(rung.ending)});
    }
    if (climb.exact) continue;
    const auto exact = std::ranges::find_if(climbs, [&](const MeshClimb& other) {
      return other.exact && other.elements == climb.elements && other.ladder.element == climb.ladder.element;
    });
    if (exact == climbs.end() || exact->rungs.empty() || exact->rungs.back().ending != Ending::completed) continue;
    const State& mesh = exact->rungs.back().state;
    const double spatial = position_error(mesh, converged);
    report.measured["spatial_error/" + climb.ladder.element + "/N" + std::to_string(climb.elements)] = spatial;
    for (const Rung& rung : climb.rungs) {
      if (rung.ending != Ending::completed) continue;
      const double total = position_error(rung.state, converged), temporal = position_error(rung.state, mesh);
      if (!std::isfinite(total)) continue;
      points.push_back({&climb, &rung, total, spatial, temporal});
      errors.rows.push_back({climb.ladder.element, climb.elements, climb.ladder.integrator.name,
                             climb.ladder.integrator.setting(rung.value), total, spatial, temporal,
                             rung.solver.rhs_evaluations});
    }
  }
  report.measured["converged_error"] = converged.error;

  report.tables.push_back(errors);
  report.tables.push_back(skipped);
  add_fronts(report, context.config, points,
             {.name = "work",
              .unit = "evaluations_of_an_element",
              .title = "evaluations of an element",
              .of =
                  [](const Measured& point) {
                    return static_cast<double>(point.rung->solver.rhs_evaluations) * point.climb->elements;
                  },
              .timing = false});
  const auto seconds = [](const Measured& point) { return point.rung->seconds; };
  add_fronts(report, context.config, points,
             {.name = "time", .unit = "seconds", .title = "time [s]", .of = seconds, .timing = true});

  std::ranges::sort(points, {}, seconds);
  Table advice{.name = "advice_total_error",
               .caption = "the fastest mesh and integrator for a wanted total error",
               .columns = {"wanted", "advice"},
               .timing = true};
  for (const double wanted : config.at("wanted_errors").get<std::vector<double>>()) {
    const auto found = std::ranges::find_if(points, [&](const Measured& point) { return point.total <= wanted; });
    std::string text = "For " + number_text(wanted) + " none of these meshes is fine enough.";
    if (found != points.end()) {
      const Integrator& integrator = found->climb->ladder.integrator;
      text = "For " + number_text(wanted) + " use N = " + std::to_string(found->climb->elements) + " " +
             found->climb->ladder.element + " and " + integrator.name + " with " +
             integrator.setting(found->rung->value) + ": " + milliseconds(found->rung->seconds) + ".";
    }
    advice.rows.push_back({wanted, text});
  }
  report.tables.push_back(advice);
}

}  // namespace vlbeam::work_precision
