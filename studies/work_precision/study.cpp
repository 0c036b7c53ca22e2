// Speed against error: what the time integrators cost and what they give, and which mesh and step are cheapest for a
// wanted total error.
#include "studies/harness/study.hpp"

#include "io/files.hpp"
#include "studies/work_precision/integrators.hpp"
#include "studies/work_precision/meshes.hpp"
#include "studies/work_precision/sizes.hpp"

namespace vlbeam {
namespace work_precision {
namespace {

StudyReport run(const StudyContext& context) {
  using namespace work_precision;
  const Json reference =
      parse_json(read_text(context.folder.parent_path().parent_path() / "reference" / "work_precision.json"));
  StudyReport report;
  compare_integrators(report, context, reference.at("problems"));
  compare_meshes(report, context, state_from_json(reference.at("converged")));
  compare_sizes(report, context);
  return report;
}

}  // namespace
}  // namespace work_precision

Study work_precision_study();

Study work_precision_study() {
  return {.name = "work_precision",
          .title = "Error against time and evaluations: integrators, steps and meshes",
          .run = work_precision::run,
          .measures_time = true};
}

}  // namespace vlbeam
