#include "studies/app/registry.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace vlbeam {

// One declaration and one line of the list for each folder studies/<name>/.
Study across_events_study();
Study defaults_study();
Study drill_stem_study();
Study energy_drift_study();
Study equilibria_study();
Study exact_arc_study();
Study exact_solutions_study();
Study falling_beam_study();
Study hard_cases_study();
Study joints_study();
Study judge_study();
Study manufactured_study();
Study moving_string_study();
Study quadrature_study();
Study rational_study();
Study ropes_study();
Study rotating_load_study();
Study semicircle_study();
Study slender_study();
Study space_study();
Study suspended_beam_study();
Study thresholds_study();
Study torsion_study();
Study trust_study();
Study weights_study();
Study work_precision_study();

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies = [] {
    std::vector<Study> list = {
        across_events_study(),  defaults_study(),       drill_stem_study(),      energy_drift_study(),
        equilibria_study(),     exact_arc_study(),      exact_solutions_study(), falling_beam_study(),
        hard_cases_study(),     joints_study(),         judge_study(),           manufactured_study(),
        moving_string_study(),  quadrature_study(),     rational_study(),        ropes_study(),
        rotating_load_study(),  semicircle_study(),     slender_study(),         space_study(),
        suspended_beam_study(), thresholds_study(),     torsion_study(),         trust_study(),
        weights_study(),        work_precision_study(),
    };
    std::stable_partition(list.begin(), list.end(), [](const Study& study) { return !study.measures_time; });
    return list;
  }();
  return studies;
}

const Study& find_study(const std::string& name) {
  const auto& studies = all_studies();
  const auto found = std::ranges::find(studies, name, &Study::name);
  if (found != studies.end()) return *found;
  std::string known;
  for (const Study& study : studies) known += (known.empty() ? "\"" : ", \"") + study.name + "\"";
  throw InvalidInput("study", "\"" + name + "\"", known.empty() ? "there are none yet" : "there are: " + known);
}

}  // namespace vlbeam
