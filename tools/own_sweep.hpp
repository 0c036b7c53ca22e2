#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

/// One case of a user's sweep.
struct SweepCase {
  Json options;  ///< what it sets: pointers and values
  Json scene;
};

/// A sweep file (`vlbeam schema sweep`), understood: every case can be modelled.
struct SweepPlan {
  Json file;  ///< as given, with the scene itself where it named a file
  std::vector<SweepCase> cases;
  std::vector<std::string> quantities;
};

/// Reads a sweep file. Throws InvalidInput, naming the file, for what is not understood, for scenes that cannot be
/// modelled, and for more than a million cases.
SweepPlan read_sweep(const std::filesystem::path& file);
/// The same of what such a file holds; a scene that it names is looked for in `folder`.
SweepPlan sweep_from_json(const Json& json, const std::filesystem::path& folder);

/// Runs a case in this process. What it gave: {"case", "options", "status", "failure", "t", "values", "events",
/// "rhs_evaluations"}; null where it was interrupted.
Json run_sweep_case(const SweepPlan& plan, std::size_t i);

/// The folder of a sweep: what its cases gave, one file each, and what they are of.
class SweepFolder {
 public:
  /// Makes it, or finds it begun. Throws InvalidInput where it holds another sweep, unless `force` starts anew.
  SweepFolder(std::filesystem::path folder, const SweepPlan& plan, bool force);

  bool has(std::size_t i) const;
  /// Runs a case in this process and keeps what it gave; false where it did not end well. An interruption keeps
  /// nothing.
  bool run(std::size_t i) const;
  /// Keeps that a case ended without saying how.
  void note_crash(std::size_t i, const std::string& how) const;
  /// Numbers of the cases that are not there yet.
  std::vector<std::size_t> missing() const;
  /// Joins all cases into sweep.csv and sweep.json, whatever the order they were run in. Returns how many did not end
  /// well. Throws std::runtime_error where one is missing.
  std::size_t collect() const;

 private:
  std::filesystem::path file_of(std::size_t i) const;

  std::filesystem::path folder_;
  const SweepPlan& plan_;
};

}  // namespace vlbeam
