#include "studies/app/registry.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace vlbeam {

// One declaration and one line of the list for each folder studies/<name>/.
Study energy_drift_study();
Study falling_beam_study();
Study suspended_beam_study();
Study weights_study();
Study work_precision_study();

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies = [] {
    std::vector<Study> list = {
        energy_drift_study(),
        falling_beam_study(),
        suspended_beam_study(),
        weights_study(),
        work_precision_study(),
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
