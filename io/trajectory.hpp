#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/run_file.hpp"

namespace vlbeam {

/// How far two runs are apart, over the samples that both have. Throws InvalidInput where they have none in common.
Json compare_runs(const RunFile& a, const RunFile& b, double tolerance);

/// The same, for a reader.
std::string comparison_text(const Json& comparison);

/// A case whose trajectory is known: reference/cases/NAME.json, made by reference/cases.py.
struct CertifiedCase {
  struct Column {
    std::string name, unit;
    std::vector<double> values, uncertainties;  ///< one a time; NaN where there is none
  };
  std::string name, title, source;
  std::vector<double> t;  ///< [s]
  std::vector<Column> columns;
};

/// Throws InvalidInput naming the nearest.
CertifiedCase read_case(const std::filesystem::path& folder, const std::string& name);
std::vector<std::string> case_names(const std::filesystem::path& folder);

/// The errors of another code's trajectory, a CSV file with columns t and any of the case's, units in brackets or none,
/// at any of the case's times; what comes after these is left out, and counted. `renamed` gives the names of its
/// columns that are called otherwise, "ours=theirs". Throws InvalidInput, naming line and column, for what is no
/// number, for times that do not grow or are not the case's, and for other units.
Json score_trajectory(const CertifiedCase& known, const std::filesystem::path& csv,
                      const std::vector<std::string>& renamed);
std::string score_text(const Json& score);

}  // namespace vlbeam
