#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/files.hpp"
#include "scene/result.hpp"

namespace vlbeam {

/// The files that a run of a scene writes.
class RunOutputs {
 public:
  /// An option of the command line and the name it gives, empty where there is to be no such file.
  using Named = std::pair<std::string, std::string>;

  /// `reads` are what the command reads: "the scene" and the name of its file, which none of the files may replace.
  /// With `force` files replace whatever else stands there. Throws InvalidInput where one cannot be written, or is
  /// another one or one of those read.
  RunOutputs(const std::vector<Named>& reads, const std::vector<Named>& files, bool force);

  /// Writes one of them, given its name, empty for none. That of a run that did not end well replaces no earlier file,
  /// but a report that says the same of itself: it then stands beside it, as NAME.failed.json. What cannot be written
  /// is said, and does not keep the other from being written.
  void write(const std::string& name, RunStatus status, const std::function<void(const TextSink&)>& content);

  /// The same of what writes a file by its name.
  void write_with(const std::string& name, RunStatus status,
                  const std::function<void(const std::filesystem::path&)>& write);
  /// Writes what is no file of its own, like a folder of them.
  void attempt(const std::string& name, const std::function<void()>& write);

  bool all_written() const { return problems_.empty(); }
  /// What became of them, a line each.
  const std::vector<std::string>& written() const { return written_; }
  const std::vector<std::string>& problems() const { return problems_; }
  /// Says that on standard error.
  void tell() const;

 private:
  bool force_;
  std::vector<std::string> written_, problems_;
};

}  // namespace vlbeam
