// Problems that others published, run by default: how far their printed numbers and ours are from the answer.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/files.hpp"
#include "io/json.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "tools/checked_run.hpp"
#include "tools/converge.hpp"

namespace vlbeam {
namespace field {
namespace {

constexpr double told_share = 1.5;  // of the told error: the true one may be as many times larger

/// One printed number of a problem: what it is, and what is right.
struct Printed {
  std::string quantity, what, unit;
  double value, within;          ///< half a unit of its last digit, or what their test allows
  double answer, known_to;       ///< of the model that both have, from outside this project
  std::optional<double> theirs;  ///< of the model that they have, where it is another one
  double factor, offset;         ///< factor * our quantity + offset is theirs
  std::optional<double> at;      ///< [s]
};

struct Problem {
  std::string name, community, title;
  Scene scene;
  std::vector<Printed> numbers;
};

/// Ours for one number.
struct Ours {
  double value = std::nan(""), told = std::nan("");
  std::optional<double> converged = {}, uncertainty = {};
};

struct Found {
  std::string status, failure, warnings;
  std::size_t steps = 0;
  bool warned = false;
  std::vector<Ours> numbers;
};

Json or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

std::vector<Problem> read_problems(const StudyContext& context) {
  const Json file = read_json(context.folder.parent_path().parent_path() / "reference" / "field.json");
  std::vector<Problem> problems;
  for (const Json& item : file.at("problems")) {
    Problem problem{item.at("name"), item.at("community"), item.at("title"), scene_from_json(item.at("scene")), {}};
    for (const Json& number : item.at("numbers")) {
      const auto optional = [&number](const char* key) {
        return number.contains(key) ? std::optional(number.at(key).get<double>()) : std::nullopt;
      };
      problem.numbers.push_back({number.at("quantity"), number.at("what"), number.at("unit"), number.at("printed"),
                                 number.at("within"), number.at("answer"), number.at("known_to"), optional("theirs"),
                                 number.value("factor", 1.0), number.value("offset", 0.0), optional("at")});
      problem.scene = keeping(problem.scene, number.at("quantity"));
    }
    problems.push_back(std::move(problem));
  }
  return problems;
}

const Sample& sample_of(const RunResult& result, const std::optional<double>& at) {
  if (!at) return result.samples.back();
  const auto near = [&](const Sample& sample) { return std::abs(sample.t - *at); };
  return *std::ranges::min_element(result.samples, {}, near);
}

Found judge(const Problem& problem, const std::optional<double>& converged_to) {
  Found found;
  const RunResult result =
      checked_run(problem.scene, StudyContext::until_interrupted(), {.shape = {}, .event_shapes = false}, 1);
  found.status = to_string(result.status);
  found.failure = result.failure;
  found.steps = result.solver.steps;
  for (const Warning& warning : result.warnings) {
    found.warnings += (found.warnings.empty() ? "" : " ") + std::string(to_string(warning.kind));
    found.warned =
        found.warned || warning.kind == WarningKind::error_in_time || warning.kind == WarningKind::error_of_mesh;
  }
  for (const Printed& number : problem.numbers) {
    Ours ours;
    const Quantity quantity = find_quantity(problem.scene, number.quantity);
    if (!result.samples.empty()) ours.value = number.factor * quantity.of(sample_of(result, number.at)) + number.offset;
    if (result.error) {
      const auto row = std::ranges::find(result.error->quantities, number.quantity, &QuantityError::quantity);
      if (row != result.error->quantities.end() && row->mesh)
        ours.told = std::abs(number.factor) * (*row->mesh + row->time.value_or(0));
    }
    if (converged_to && &number == &problem.numbers.front()) {  // one of each: refinement takes most of the time
      const Convergence limit = converge(problem.scene, {.quantity = number.quantity,
                                                         .error = *converged_to,
                                                         .relative = true,
                                                         .at = number.at,
                                                         .jobs = 1,
                                                         .most_elements = 640});
      ours.converged = number.factor * limit.answer + number.offset;
      ours.uncertainty = std::abs(number.factor) * limit.uncertainty;
    }
    found.numbers.push_back(ours);
  }
  return found;
}

/// What the printed number says beside the answer.
std::string verdict_of(const Printed& number) {
  const double off = std::abs(number.value - number.answer), within = number.within + number.known_to;
  if (off <= within) return "agree";
  if (number.theirs && std::abs(number.value - *number.theirs) <= within) return "another model";
  return "off";
}

StudyReport run(const StudyContext& context) {
  const auto problems = read_problems(context);
  const auto to = context.config.contains("converged_to")
                      ? std::optional(context.config.at("converged_to").get<double>())
                      : std::nullopt;
  const auto outcomes = context.sweep(
      problems, [&](const Problem& problem) { return judge(problem, to); },
      [](const Problem& problem) {
        return problem.scene.beam.elements * (problem.scene.analysis == Analysis::dynamics ? 100 : 1);
      });
  StudyReport report;
  Table table{.name = "numbers",
              .caption =
                  "Printed numbers, the answer from outside this project, and ours by default: errors in units "
                  "of the answer; `within` is what the printed digits or their own test allow; `theirs` is the "
                  "answer of their model, where it is another one",
              .columns = {"problem", "community", "what", "unit", "printed", "within", "answer", "known_to", "theirs",
                          "verdict", "ours", "our_error", "their_error", "told", "converged", "uncertainty", "steps"}};
  int agree = 0, err = 0, other = 0, ran = 0, told = 0, covered = 0, silent = 0, limits = 0, limits_held = 0;
  double worst = 0;
  double furthest = 0;  // of what converge finds, in its uncertainties
  int closer = 0;
  std::vector<double> errors;
  std::set<std::string> communities;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const Problem& problem = problems[i];
    if (!outcomes[i]) {
      report.cases.push_back({.options = {{"problem", problem.name}}, .results = {}, .failure = outcomes[i].failure});
      continue;
    }
    const Found& found = *outcomes[i];
    ran += found.status == "completed" ? 1 : 0;
    report.cases.push_back({.options = {{"problem", problem.name}},
                            .results = {{"status", found.status},
                                        {"title", problem.title},
                                        {"warnings", found.warnings},
                                        {"failure", found.failure}}});
    for (std::size_t k = 0; k < problem.numbers.size(); ++k) {
      const Printed& number = problem.numbers[k];
      const Ours& ours = found.numbers[k];
      const std::string verdict = verdict_of(number);
      (verdict == "agree" ? agree : verdict == "off" ? err : other) += 1;
      const double size = std::abs(number.answer) > 0 ? std::abs(number.answer) : 1;
      const double off = std::abs(ours.value - number.answer);
      closer += verdict == "off" && off < std::abs(number.value - number.answer) ? 1 : 0;
      errors.push_back(std::isfinite(off) ? off / size : std::numeric_limits<double>::infinity());
      communities.insert(problem.community);
      worst = std::max(worst, errors.back());
      if (std::isfinite(ours.told)) {
        ++told;
        covered += told_share * ours.told + number.known_to >= off ? 1 : 0;
      }
      silent += off - number.known_to > 0.01 * size && !found.warned ? 1 : 0;
      if (ours.converged) {
        ++limits;
        const double of_uncertainty = std::abs(*ours.converged - number.answer) / (*ours.uncertainty + number.known_to);
        limits_held += of_uncertainty <= 1 ? 1 : 0;
        furthest = std::max(furthest, of_uncertainty);
      }
      table.rows.push_back({problem.name, problem.community, number.what, number.unit, number.value, number.within,
                            number.answer, number.known_to, number.theirs ? Json(*number.theirs) : Json(), verdict,
                            or_null(ours.value), or_null(off / size), std::abs(number.value - number.answer) / size,
                            or_null(ours.told), ours.converged ? Json(*ours.converged) : Json(),
                            ours.uncertainty ? Json(*ours.uncertainty) : Json(), found.steps});
    }
  }
  std::ranges::sort(errors);
  report.measured = {{"communities", static_cast<double>(communities.size())},
                     {"closer", closer},
                     {"median", errors[errors.size() / 2]},
                     {"problems", static_cast<double>(problems.size())},
                     {"not_run", static_cast<double>(problems.size()) - ran},
                     {"numbers", static_cast<double>(table.rows.size())},
                     {"agree", agree},
                     {"off", err},
                     {"another_model", other},
                     {"worst", worst},
                     {"told", told},
                     {"not_covered", told - covered},
                     {"silent", silent},
                     {"furthest_limit", furthest},
                     {"limits", limits},
                     {"limits_missed", limits - limits_held}};
  report.tables = {std::move(table)};
  report.figures = {{.name = "errors",
                     .caption = "How far printed numbers and ours by default are from the answer",
                     .script = "errors.gp",
                     .variables = {{"folder", context.folder.string()}}}};
  return report;
}

}  // namespace
}  // namespace field

Study field_study();

Study field_study() {
  return {.name = "field",
          .title = "The field's own tables: printed numbers, the answer, and ours by default",
          .run = field::run};
}

}  // namespace vlbeam
