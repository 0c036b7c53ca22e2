#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "io/quantity.hpp"
#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Whether two times [s] of files are one: to 1e-9 s, or of themselves.
bool at_same_time(double a, double b);

/// The report of a run, read back.
struct RunFile {
  std::filesystem::path path;
  Scene scene;
  Json json;
  std::vector<double> t;  ///< of the samples [s]

  std::string status() const { return json.value("status", ""); }
  /// One value a sample, NaN where it is not there. Throws InvalidInput.
  std::vector<double> column(const Quantity& quantity) const;
  /// Throws InvalidInput.
  std::vector<Configuration> configurations() const;
};

/// Throws InvalidInput, naming the file, where it is not the report of a run.
RunFile read_run_file(const std::filesystem::path& path);

}  // namespace vlbeam
