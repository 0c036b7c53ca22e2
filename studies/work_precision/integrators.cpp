#include "studies/work_precision/integrators.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/json.hpp"
#include "scene/options.hpp"

namespace vlbeam::work_precision {
namespace {

constexpr double certified = 100;  // errors nearer to the reference's own, by this factor, are left out

struct Climb {
  Ladder ladder;
  State reference;
  std::vector<Rung> rungs;

  double error(const Rung& rung) const {
    return rung.ending == Ending::completed ? position_error(rung.state, reference) : nan;
  }
};

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Table evaluations_table(const std::vector<Climb>& climbs) {
  Table table{.name = "evaluations",
              .caption =
                  "temporal error at the end of each run against evaluations of the equations; a capped run "
                  "stands with what it had done",
              .columns = {"problem", "element", "integrator", "setting", "ending", "error", "evaluations", "steps",
                          "rejected", "events"}};
  for (const Climb& climb : climbs) {
    for (const Rung& rung : climb.rungs) {
      // how far a capped run came is a matter of the machine
      const auto count = [&](std::size_t n) { return rung.ending == Ending::capped ? Json() : Json(n); };
      table.rows.push_back({climb.ladder.problem, climb.ladder.element, climb.ladder.integrator.name,
                            climb.ladder.integrator.setting(rung.value), to_string(rung.ending),
                            number(climb.error(rung)), count(rung.solver.rhs_evaluations), count(rung.solver.steps),
                            count(rung.solver.rejected), count(rung.events)});
    }
  }
  return table;
}

/// A capped run has no error: `shown_at` is the last one of its integrator, where the figure puts its mark.
Table times_table(const std::vector<Climb>& climbs) {
  Table table{
      .name = "times",
      .caption = "temporal error at the end of each run against time",
      .columns = {"problem", "element", "integrator", "setting", "ending", "error", "seconds", "reached", "shown_at"},
      .timing = true};
  for (const Climb& climb : climbs) {
    double last_error = 1;
    for (const Rung& rung : climb.rungs) {
      const double error = climb.error(rung);
      if (std::isfinite(error)) last_error = error;
      table.rows.push_back({climb.ladder.problem, climb.ladder.element, climb.ladder.integrator.name,
                            climb.ladder.integrator.setting(rung.value), to_string(rung.ending), number(error),
                            rung.seconds, rung.reached, rung.ending == Ending::capped ? Json(last_error) : Json()});
    }
  }
  return table;
}

struct Best {
  const Climb* climb = nullptr;
  const Rung* rung = nullptr;
};

template <class Cost>
Best cheapest(const std::vector<Climb>& climbs, const std::string& problem, const std::string& element, double wanted,
              const Cost& cost) {
  Best best;
  for (const Climb& climb : climbs) {
    if (climb.ladder.problem != problem || climb.ladder.element != element) continue;
    for (const Rung& rung : climb.rungs) {
      if (!(climb.error(rung) <= wanted)) continue;
      if (!best.rung || cost(rung) < cost(*best.rung)) best = {&climb, &rung};
    }
  }
  return best;
}

/// "For 1e-4 use ...", for each problem and element.
template <class Cost, class Words>
Table advice_table(const std::vector<Climb>& climbs, const Json& config, const std::string& by, const Cost& cost,
                   const Words& words) {
  Table table{.name = "advice_by_" + by,
              .caption = "the cheapest run by " + by + " that has the wanted error or less",
              .columns = {"problem", "element", "wanted", "advice"},
              .timing = by == "time"};
  for (const auto& [name, problem] : config.at("problems").items()) {
    for (const Json& element : problem.at("elements")) {
      for (const double wanted : config.at("wanted_errors").get<std::vector<double>>()) {
        const Best best = cheapest(climbs, name, element.get<std::string>(), wanted, cost);
        std::string advice = "For " + number_text(wanted) + " nothing here is good enough within the cap.";
        if (best.rung) {
          const Integrator& integrator = best.climb->ladder.integrator;
          advice = "For " + number_text(wanted) + " use " + integrator.name + " with " +
                   integrator.setting(best.rung->value) + ": " + words(*best.rung) + ".";
        }
        table.rows.push_back({name, element, wanted, advice});
      }
    }
  }
  return table;
}

/// Observed orders where a problem asks for one, {"order": {"integrator", "levels"}}: of all steps that were run to the
/// end, but for what the rule `levels` leaves out.
void fit_orders(StudyReport& report, const std::vector<Climb>& climbs, const Json& problems) {
  for (const Climb& climb : climbs) {
    const Ladder& ladder = climb.ladder;
    const Json order = problems.at(ladder.problem).value("order", Json::object());
    if (order.value("integrator", "") != ladder.integrator.name) continue;
    std::vector<double> steps, errors;
    for (const Rung& rung : climb.rungs) {
      if (rung.ending != Ending::completed) continue;
      steps.push_back(rung.value);
      errors.push_back(climb.error(rung));
    }
    if (steps.empty()) continue;
    const std::string name = ladder.problem + "/" + ladder.element;
    const OrderFit fit =
        fit_order(name, steps, errors,
                  {.floor = climb.reference.error, .rule = level_rule_from_json(order.value("levels", Json()))});
    if (!fit.pairwise_orders.empty()) {
      report.measured["least_pair/" + name] = *std::ranges::min_element(fit.pairwise_orders);
      report.measured["error_at_finest_step/" + name] = errors.back();
    }
    report.fits.push_back(fit);
  }
}

}  // namespace

GnuplotVariables style(const Json& config) {
  GnuplotVariables style{{"names", ""}, {"colours", ""}, {"marks", ""}};
  const auto append = [&](const char* key, const std::string& word) {
    style[key] += (style[key].empty() ? "" : " ") + word;
  };
  for (const Json& entry : config.at("integrators")) {
    append("names", entry.at("name").get<std::string>());
    append("colours", config.at("families").at(entry.at("family").get<std::string>()).get<std::string>());
    append("marks", std::to_string(entry.at("mark").get<int>()));
  }
  return style;
}

void compare_integrators(StudyReport& report, const StudyContext& context, const Json& references) {
  const Json& config = context.config;
  const double cap = config.at("most_element_steps").get<double>();
  std::vector<Climb> climbs;
  for (const auto& [name, problem] : config.at("problems").items()) {
    for (const Json& element : problem.at("elements")) {
      const auto kind = element.get<std::string>();
      const Json scene =
          merged(merged(config.at("scene"), problem.value("scene", Json::object())), {{"beam", {{"element", kind}}}});
      const State reference = state_from_json(references.at(name).at(kind));
      for (const Integrator& integrator : read_integrators(config.at("integrators"), name)) {
        climbs.push_back({{name, kind, scene, integrator}, reference, {}});
      }
    }
  }
  const auto outcomes =
      context.sweep(climbs, [&](const Climb& climb) { return work_precision::climb(climb.ladder, cap); });

  std::map<std::string, double> smallest;
  std::set<std::string> tried;
  for (std::size_t i = 0; i < climbs.size(); ++i) {
    Climb& climb = climbs[i];
    const std::string key = climb.ladder.problem + "/" + climb.ladder.element;
    tried.insert(climb.ladder.integrator.name);
    StudyCase row{.options = {{"problem", climb.ladder.problem},
                              {"element", climb.ladder.element},
                              {"integrator", climb.ladder.integrator.name}},
                  .results = Json::object(),
                  .failure = outcomes[i].failure};
    if (outcomes[i]) {
      climb.rungs = *outcomes[i];
      std::erase_if(climb.rungs,
                    [&](const Rung& rung) { return climb.error(rung) < certified * climb.reference.error; });
      std::size_t completed = 0;
      double best = nan;
      for (const Rung& rung : climb.rungs) {
        const double error = climb.error(rung);
        if (!std::isfinite(error)) continue;
        ++completed;
        best = std::isfinite(best) ? std::min(best, error) : error;
      }
      row.results = {{"completed", completed}, {"smallest_error", number(best)}};
      if (std::isfinite(best)) {
        const auto at = smallest.try_emplace(key, best).first;
        at->second = std::min(at->second, best);
      }
    }
    report.cases.push_back(row);
    report.measured["reference_error/" + key] = climb.reference.error;
  }
  report.measured["integrators"] = static_cast<double>(tried.size());
  for (const auto& [key, error] : smallest) {
    report.measured["smallest_error/" + key] = error;
    report.measured["smallest_error_over_reference/" + key] = error / report.measured.at("reference_error/" + key);
  }
  for (const auto& [name, problem] : config.at("problems").items()) {
    for (const Json& element : problem.at("elements")) {
      for (const double wanted : config.at("wanted_errors").get<std::vector<double>>()) {
        const auto evaluations = [](const Rung& rung) { return static_cast<double>(rung.solver.rhs_evaluations); };
        const Best best = cheapest(climbs, name, element.get<std::string>(), wanted, evaluations);
        if (!best.rung) continue;
        report.measured["evaluations/" + name + "/" + element.get<std::string>() + "/" + number_text(wanted)] =
            evaluations(*best.rung);
      }
    }
  }

  fit_orders(report, climbs, config.at("problems"));
  report.tables.push_back(evaluations_table(climbs));
  report.tables.push_back(times_table(climbs));
  report.tables.push_back(advice_table(
      climbs, config, "evaluations", [](const Rung& rung) { return static_cast<double>(rung.solver.rhs_evaluations); },
      [](const Rung& rung) { return std::to_string(rung.solver.rhs_evaluations) + " evaluations"; }));
  report.tables.push_back(advice_table(
      climbs, config, "time", [](const Rung& rung) { return rung.seconds; },
      [](const Rung& rung) { return milliseconds(rung.seconds); }));
  for (const auto& [name, problem] : config.at("problems").items()) {
    GnuplotVariables variables = style(config);
    variables["problem"] = name;
    variables["title_text"] = problem.at("title").get<std::string>();
    for (const Json& element : problem.at("elements")) {
      variables["elements"] += (variables["elements"].empty() ? "" : " ") + element.get<std::string>();
    }
    variables["cap"] = number_text(config.at("shown_seconds").get<double>());
    variables["work"] = "evaluations";
    report.figures.push_back(
        {.name = "evaluations_" + name,
         .caption = "Temporal error against evaluations of the equations, " + problem.at("title").get<std::string>(),
         .script = "work.gp",
         .variables = variables});
    variables["work"] = "seconds";
    report.figures.push_back({.name = "times_" + name,
                              .caption = "Temporal error against time, " + problem.at("title").get<std::string>() +
                                         "; hollow marks at the right are capped",
                              .script = "work.gp",
                              .variables = variables,
                              .timing = true});
  }
}

}  // namespace vlbeam::work_precision
