// A study of one's own: how fast does the tip of a swinging beam converge with its elements? It writes a report and a
// table as the studies of vlbeam do, and its gates judge it.
//   own_study [FOLDER]     (a folder that holds own_study/; default: where this file is)
#include <cmath>
#include <iostream>

#include <vlbeam/harness/study.hpp>
#include <vlbeam/vlbeam.hpp>

namespace {

using namespace vlbeam;

StudyReport swing(const StudyContext& context) {
  const Scene base = scene_from_json(context.config.at("scene"));
  const auto meshes = context.config.at("elements").get<std::vector<int>>();
  const double reference = context.config.at("reference");  // another program's answer

  // All threads, the costliest first; outcomes stand in the order of the cases.
  const auto outcomes = context.sweep(
      meshes,
      [&](int elements) {
        Scene scene = base;
        scene.beam.elements = elements;
        return StudyContext::simulate_to_the_end(scene);
      },
      [](int elements) { return elements * elements; });

  StudyReport report;
  Table table{
      .name = "meshes", .caption = "Height of the tip [m] and its error", .columns = {"elements", "y", "error"}};
  std::vector<double> levels, errors;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!outcomes[i]) {  // a case that failed makes the study fail, and says why
      report.cases.push_back({.options = {{"elements", meshes[i]}}, .results = {}, .failure = outcomes[i].failure});
      continue;
    }
    const double y = outcomes[i]->samples.back().end[1];
    report.cases.push_back({.options = {{"elements", meshes[i]}}, .results = {{"y", y}}});
    table.rows.push_back({meshes[i], y, std::abs(y - reference)});
    levels.push_back(meshes[i]);
    errors.push_back(std::abs(y - reference));
  }
  if (!errors.empty()) report.measured["finest_error"] = errors.back();
  report.fits.push_back(
      fit_order("tip", levels, errors, {.floor = 1e-9, .rule = level_rule_of(context.config, "tip")}));
  report.tables = {table};
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const StudyVerdict verdict =
        run_study({.name = "own_study", .title = "Convergence of a flexible pendulum", .run = swing},
                  {.out = "own_study_report", .sources = argc > 1 ? argv[1] : OWN_STUDY_SOURCES, .jobs = 2});
    std::cout << gates_text("own_study: " + verdict.status, verdict.gates) << verdict.failure << '\n';
    return verdict.status == "completed" && all_passed(verdict.gates) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
