// Every problem of reference/exact that a scene, or the library, can say: what is known beside what is computed.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/files.hpp"
#include "studies/exact_solutions/problem.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {
namespace exact_solutions {
namespace {

using Make = Problems (*)(const FamilyData&);
constexpr std::array<std::pair<const char*, Make>, 23> families{{{"roll-up", roll_ups},
                                                                 {"elastica", elasticae},
                                                                 {"arm scale", arm_scales},
                                                                 {"rod in a sleeve", rods_in_sleeves},
                                                                 {"catenary", catenaries},
                                                                 {"sliding weight", sliding_weights},
                                                                 {"three weights", three_weights},
                                                                 {"hanging chain", hanging_chains},
                                                                 {"Beck's column", beck_columns},
                                                                 {"moving string", moving_strings},
                                                                 {"moving beam", moving_beams},
                                                                 {"torsion", torsional_frequencies},
                                                                 {"point torque", point_torques},
                                                                 {"moving torque", moving_torques},
                                                                 {"rotating load", rotating_loads},
                                                                 {"straight wire", straight_wires},
                                                                 {"circular wire", circular_wires},
                                                                 {"rotating wire", rotating_wires},
                                                                 {"moving force", moving_forces},
                                                                 {"moving mass", moving_masses},
                                                                 {"capstan", capstans},
                                                                 {"elastic pendulum", elastic_pendulums},
                                                                 {"hoisted pendulum", hoisted_pendulums}}};

/// A problem on one of its levels.
struct Run {
  std::size_t problem;
  double level;
  double share = 1;  ///< of the steps
};

/// How far the orders of a fit are from what is stated: pairs below it, and the slope either way. NaN where it shows
/// none.
double order_off(const OrderFit& fit, double stated, bool at_least = false) {
  if (at_least) return fit.pairwise_orders.size() < 2 ? std::nan("") : std::max(0.0, stated - fit.slope);
  if (!fit.refusal.empty()) return std::nan("");
  double off = std::abs(fit.slope - stated);
  for (const double pair : fit.pairwise_orders) off = std::max(off, stated - pair);
  return off;
}

/// For tables that gnuplot reads.
std::string without_commas(std::string text) {
  std::erase(text, ',');
  return text;
}

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        exact_(
            parse_json(read_text(context.folder.parent_path().parent_path() / "reference" / "exact" / "exact.json"))) {
    for (const auto& [name, data] : context.config.at("families").items()) {
      const auto family = std::ranges::find(families, name, [](const auto& entry) { return std::string(entry.first); });
      if (family == families.end()) throw InvalidInput("/families", name, "a family of this study");
      for (Problem& problem : family->second({exact_, data})) problems_.push_back(std::move(problem));
    }
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      for (const double level : problems_[i].levels) runs_.push_back({i, level});
      if (problems_[i].steps) runs_.push_back({i, checked_level(problems_[i]), 0.5});
    }
  }

  StudyReport operator()() {
    const auto outcomes = context_.sweep(
        runs_, [&](const Run& run) { return problems_[run.problem].run(run.level, run.share); },
        [&](const Run& run) { return problems_[run.problem].cost * run.level; });
    for (std::size_t i = 0, next = 0; i < problems_.size(); ++i) {
      std::vector<const Found*> found;
      for (const double level : problems_[i].levels) {
        const auto& outcome = outcomes[next++];
        report_.cases.push_back(
            {.options = {{"family", problems_[i].family}, {"case", problems_[i].name}, {problems_[i].refined, level}},
             .results = outcome ? Json{{"values", outcome->values}} : Json::object(),
             .failure = outcome.failure});
        if (outcome) found.push_back(&*outcome);
      }
      const Found* fewer_steps = nullptr;
      if (problems_[i].steps) {
        const auto& outcome = outcomes[next++];
        report_.cases.push_back({.options = {{"family", problems_[i].family},
                                             {"case", problems_[i].name},
                                             {problems_[i].refined, checked_level(problems_[i])},
                                             {"steps", "half"}},
                                 .results = outcome ? Json{{"values", outcome->values}} : Json::object(),
                                 .failure = outcome.failure});
        if (!outcome) continue;
        fewer_steps = &*outcome;
      }
      if (found.size() == problems_[i].levels.size()) judge(problems_[i], found, fewer_steps);
    }
    report_.measured["problems"] = static_cast<double>(problems_.size());
    report_.measured["disagreements"] = disagreements_;
    report_.tables = {std::move(answers_), std::move(errors_)};
    std::string present;  // for the figures' scripts
    for (const Problem& problem : problems_) {
      present += "|" + problem.family + "|" + without_commas(problem.name) + "|";
    }
    const GnuplotVariables variables{{"folder", context_.folder.string()}, {"present", present}};
    report_.figures = {{.name = "statics",
                        .caption = "Equilibria and frequencies: error against the number of elements, by family",
                        .script = "statics.gp",
                        .variables = variables},
                       {.name = "motions",
                        .caption = "Motions: error against what is refined, by family",
                        .script = "motions.gp",
                        .variables = variables}};
    return std::move(report_);
  }

 private:
  /// The last level but one: where half of the steps show what these leave.
  static double checked_level(const Problem& problem) { return problem.levels[problem.levels.size() - 2]; }

  void largest(const std::string& name, double value) {
    const auto [at, fresh] = report_.measured.try_emplace(name, value);
    if (!fresh && !(at->second >= value)) at->second = value;  // a NaN stays seen
    if (!fresh && std::isnan(value)) at->second = value;
  }

  /// The order of errors, where theory states one: into the fits, and how far it is off.
  OrderFit order_of(const Problem& problem, const std::string& of, const std::vector<double>& errors, double stated) {
    const std::string name = problem.family + ", " + problem.name + (of.empty() ? "" : ", " + of);
    LevelRule rule = level_rule_of(context_.config, name);
    if (rule.reason.empty()) rule = level_rule_of(context_.config, problem.family);
    const OrderFit fit = fit_order(name, problem.levels, errors, {.floor = problem.floor, .rule = rule});
    for (std::size_t i = 0; i < errors.size(); ++i) {
      errors_.rows.push_back(
          {problem.family, without_commas(problem.name), of.empty() ? "values" : of, problem.levels[i], errors[i]});
    }
    if (stated > 0) {
      report_.fits.push_back(fit);
      const std::string key = problem.family + (of.empty() ? "" : "/" + of);
      const auto least = report_.measured.try_emplace("least_order/" + key, fit.slope).first;
      least->second = std::min(least->second, fit.slope);
      largest("greatest_order/" + key, fit.slope);
      largest("order_off/" + problem.family + (of.empty() ? "" : "/" + of),
              order_off(fit, stated, of.empty() && problem.at_least));
    }
    return fit;
  }

  /// What our own values say of the error of the finest: its largest member, by mesh and by steps.
  static double own_uncertainty(const Problem& problem, const std::vector<const Found*>& found,
                                const Found* fewer_steps) {
    const double floor = problem.floor * problem.scale;
    double most = floor;
    for (std::size_t q = 0; q < problem.known.values.size() && found.size() > 1; ++q) {
      std::vector<double> values;
      for (const Found* at : found) values.push_back(at->values[q]);
      double own = grid_convergence(problem.known.names[q], problem.levels, values,
                                    {.expected_order = problem.order, .floor = floor})
                       .uncertainty;
      if (fewer_steps != nullptr) own += std::abs(fewer_steps->values[q] - found[found.size() - 2]->values[q]);
      most = std::max(most, own);
    }
    return most;
  }

  void judge(const Problem& problem, const std::vector<const Found*>& found, const Found* fewer_steps) {
    const Known& known = problem.known;
    const std::size_t levels = found.size(), finest = levels - 1;
    std::vector<double> errors, means, displacements, slopes;
    std::size_t shown = 0;
    for (const Found* at : found) {
      double worst = -1, squares = 0;
      for (std::size_t q = 0; q < known.values.size(); ++q) {
        const double off = std::abs(at->values.at(q) - known.values[q]) / problem.scale;
        if (off > worst) shown = q;
        worst = std::max(worst, off);
        squares += off * off;
      }
      errors.push_back(worst);
      means.push_back(std::sqrt(squares / static_cast<double>(known.values.size())));
      displacements.push_back(at->displacement);
      slopes.push_back(at->slope);
    }
    const bool shaped = std::isfinite(displacements.front());
    // values at single points may meet the reference by chance: orders are those of norms where there are any
    const OrderFit fit = levels > 1 ? order_of(problem, "", means, shaped ? 0 : problem.order) : OrderFit{};
    const double own = own_uncertainty(problem, found, fewer_steps), error = errors[finest] * problem.scale;
    const bool agrees = error <= own + *std::ranges::max_element(known.errors);
    if (!agrees) ++disagreements_;
    largest("disagreements/" + problem.family, agrees ? 0 : 1);
    largest("error/" + problem.family, errors[finest]);
    report_.measured["error/" + problem.family + "/" + problem.name] = errors[finest];
    answers_.rows.push_back({problem.family, problem.name, known.names[shown], problem.refined, problem.levels.front(),
                             problem.levels[finest], known.values[shown], known.errors[shown],
                             found.front()->values[shown], found[finest]->values[shown],
                             levels > 2 ? number_or_null(fit.slope) : Json(),
                             problem.order > 0 && !shaped ? Json(problem.order) : Json(), own, error, errors[finest],
                             agrees ? "agrees" : "differs"});
    if (!shaped) return;
    for (const auto& [of, norms, stated] : {std::tuple{"L2", displacements, 4.0}, std::tuple{"H1", slopes, 3.0}}) {
      const OrderFit of_norm = order_of(problem, of, norms, stated);
      const double off = order_off(of_norm, stated);
      largest("error/" + problem.family + "/" + of, norms[finest]);
      answers_.rows.push_back({problem.family, problem.name, of, problem.refined, problem.levels.front(),
                               problem.levels[finest], 0, 0, norms.front(), norms[finest],
                               number_or_null(of_norm.slope), stated, number_or_null(of_norm.slope_uncertainty),
                               norms[finest], norms[finest], off <= 0.3 ? "of its order" : "not of its order"});
    }
  }

  const StudyContext& context_;
  References exact_;
  Problems problems_;
  std::vector<Run> runs_;
  StudyReport report_;
  int disagreements_ = 0;
  Table answers_{
      .name = "answers",
      .caption =
          "What is known beside what is computed on the coarsest and on the finest level, for the value "
          "that is farthest off on the finest: order of the mean square of the case's errors, what "
          "theory states of it, uncertainty by our own meshes and steps, error, largest error over the scale of the "
          "case. L2 and H1: the norm of what the axis is off, over the length, and its order with its uncertainty",
      .columns = {"family", "case", "quantity", "refined", "coarsest", "finest", "reference", "reference_error",
                  "computed_coarsest", "computed_finest", "order", "stated", "uncertainty", "error", "error_over_scale",
                  "verdict"}};
  Table errors_{.name = "errors",
                .caption = "Root of the mean square of a case's errors over its scale, or norm of its axis, by level",
                .columns = {"family", "case", "of", "level", "error"},
                .curve = true};
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace exact_solutions

Study exact_solutions_study();

Study exact_solutions_study() {
  return {.name = "exact_solutions",
          .title = "What is known without elements, and what they make of it",
          .run = exact_solutions::run};
}

}  // namespace vlbeam
