#include "studies/harness/provenance.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <string>

#include "studies/harness/subprocess.hpp"

namespace vlbeam {
namespace {

/// HEAD of the source tree, "-dirty" where it has local changes, "unknown" outside git.
std::string commit() {
  const ProcessResult head = run_process({"git", "-C", VLBEAM_SOURCE_DIR, "rev-parse", "HEAD"});
  if (head.exit_code != 0) return "unknown";
  const ProcessResult changes =
      run_process({"git", "-C", VLBEAM_SOURCE_DIR, "status", "--porcelain", "--untracked-files=no"});
  const bool dirty = changes.exit_code != 0 || !changes.output.empty();
  return head.output.substr(0, head.output.find('\n')) + (dirty ? "-dirty" : "");
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace

Json provenance() {
  return {{"program", "vlbeam " VLBEAM_VERSION},
          {"commit", commit()},
          {"compiler", VLBEAM_COMPILER},
          {"flags", VLBEAM_FLAGS},
          {"host", host()},
          {"date", utc_now()}};
}

}  // namespace vlbeam
