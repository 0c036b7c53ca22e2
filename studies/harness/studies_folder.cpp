#include "studies/harness/studies_folder.hpp"

#include <string>
#include <system_error>
#include <vector>

#include "core/error.hpp"

namespace vlbeam {

StudiesFolder find_studies_folder(const std::filesystem::path& given, const std::filesystem::path& marker) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<StudiesFolder> candidates;
  if (!given.empty()) {
    candidates.push_back({given});
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* beside : {"../studies", "../share/vlbeam/studies"}) {
      candidates.push_back({(program / beside).lexically_normal()});
    }
    candidates.push_back({fs::path(VLBEAM_SOURCE_DIR) / "studies", true});
  }
  std::string looked_for;
  for (const StudiesFolder& candidate : candidates) {
    if (fs::is_regular_file(candidate.path / marker, error)) return candidate;
    looked_for += (looked_for.empty() ? "" : ", ") + (candidate.path / marker).string();
  }
  throw InvalidInput("--studies", given.empty() ? "no folder of studies" : "\"" + given.string() + "\"",
                     "it must name the folder studies/ of vlbeam's sources; looked for " + looked_for);
}

}  // namespace vlbeam
