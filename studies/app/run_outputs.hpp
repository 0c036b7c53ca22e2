#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/result.hpp"
#include "studies/harness/files.hpp"

namespace vlbeam {

/// The files that a run of a scene writes.
class RunOutputs {
 public:
  /// `report` and `csv` are empty where there is to be none. With `force` they replace whatever stands there. Throws
  /// InvalidInput where one cannot be written, or is the other or the scene.
  RunOutputs(const std::string& scene, const std::string& report, const std::string& csv, bool force);

  /// Writes one of them, given its name, empty for none. That of a run that did not end well replaces no earlier file,
  /// but a report that says the same of itself: it then stands beside it, as NAME.failed.json. What cannot be written
  /// is said, and does not keep the other from being written.
  void write(const std::string& name, RunStatus status, const std::function<void(const TextSink&)>& content);

  bool all_written() const { return problems_.empty(); }
  /// What became of them, a line each.
  const std::vector<std::string>& written() const { return written_; }
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  bool force_;
  std::vector<std::string> written_, problems_;
};

}  // namespace vlbeam
