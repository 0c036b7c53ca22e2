#include "studies/harness/source_folder.hpp"

#include <system_error>
#include <vector>

#include "core/error.hpp"

namespace vlbeam {

SourceFolder find_source_folder(const std::string& name, const std::filesystem::path& given,
                                const std::filesystem::path& marker) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<SourceFolder> candidates;
  if (!given.empty()) {
    candidates.push_back({given});
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* beside : {"..", "../share/vlbeam"}) {
      candidates.push_back({(program / beside / name).lexically_normal()});
    }
    candidates.push_back({fs::path(VLBEAM_SOURCE_DIR) / name, true});
  }
  std::string looked_for;
  for (const SourceFolder& candidate : candidates) {
    if (fs::is_regular_file(candidate.path / marker, error)) return candidate;
    looked_for += (looked_for.empty() ? "" : ", ") + (candidate.path / marker).string();
  }
  throw InvalidInput("--" + name, given.empty() ? "no folder of " + name : "\"" + given.string() + "\"",
                     "it must name the folder " + name + "/ of vlbeam's sources; looked for " + looked_for);
}

}  // namespace vlbeam
