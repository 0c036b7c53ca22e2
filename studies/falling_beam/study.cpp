// The falling beam with a sliding mass (Ding & Ouyang 2022, §6.1): Figures 8-12 and Tables 1-2, and how far the
// answer can be trusted.
#include "studies/harness/study.hpp"

#include "io/files.hpp"
#include "studies/falling_beam/cases.hpp"
#include "studies/falling_beam/convergence.hpp"
#include "studies/falling_beam/curves.hpp"
#include "studies/falling_beam/tables.hpp"

namespace vlbeam {
namespace falling_beam {
namespace {

StudyReport run(const StudyContext& context) {
  using namespace falling_beam;
  const auto reference = [&](const char* file) {
    return parse_json(read_text(context.folder.parent_path().parent_path() / "reference" / file));
  };
  const Json independent = reference("ale_independent_codes.json");
  const Times times = read_times(context.config);
  const Runs runs = run_cases(context, read_scene_cases(context.config));

  StudyReport report;
  report.cases = report_cases(runs);
  report.timing = timing(runs);
  add_paper_tables(report, runs, times, reference("ding_ouyang_2022_table1.json"),
                   reference("ding_ouyang_2022_table2.json"));
  add_energy_audit(report, runs, times);
  add_reference(report, runs, times, independent);
  add_mesh_convergence(report, runs, times, judged_at(context.folder.parent_path(), "falling_beam"));
  add_quadrature_convergence(report, runs, times);
  add_temporal_convergence(report, runs, times);
  add_digits(report, runs, independent);
  add_ramped_twin(report, runs, context.config, independent);
  add_figures(report, runs, context);
  return report;
}

}  // namespace
}  // namespace falling_beam

Study falling_beam_study();

Study falling_beam_study() {
  return {.name = "falling_beam",
          .title = "Falling beam with a sliding mass: Figures 8-12 and Tables 1-2 of Ding & Ouyang 2022",
          .run = falling_beam::run};
}

}  // namespace vlbeam
