#include "studies/app/registry.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace vlbeam {

// The studies that CMake has built, from studies/CMakeLists.txt.
#define VLBEAM_STUDY(name) Study name##_study();
#include "vlbeam_studies.inc"
#undef VLBEAM_STUDY

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies = [] {
    std::vector<Study> list = {
#define VLBEAM_STUDY(name) name##_study(),
#include "vlbeam_studies.inc"
#undef VLBEAM_STUDY
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
