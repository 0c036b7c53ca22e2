#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

/// A case whose motion is known at some times: reference/cases/NAME.json, made by reference/cases.py.
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

/// What there is to score: cases, their columns, and to what these are known.
std::string cases_text(const std::filesystem::path& folder);

/// Writes the scene of each case, NAME.json, and its answers, NAME.csv: t, columns, and the uncertainty of each.
/// Throws InvalidInput where the folder holds something.
void write_kit(const std::filesystem::path& cases, const std::filesystem::path& folder);

/// The errors of another code's trajectory, a CSV file with columns t and any of the case's, units in brackets or none.
/// Rows at other times than the case's are left out, and counted. `renamed` gives the names of its columns that are
/// called otherwise, "ours=theirs". Throws InvalidInput, naming line and column, for what is no number, for times that
/// do not grow, for other units, and for a column whose name is a letter or two off one that is missing.
Json score_trajectory(const CertifiedCase& known, const std::filesystem::path& csv,
                      const std::vector<std::string>& renamed);
std::string score_text(const Json& score);

/// The errors of all trajectories CASE.csv, CASE_N40.csv or CASE_METHOD_N40.csv of a folder: N is the number of
/// elements, and several of them show an order. Throws InvalidInput where there is none, or one of no case.
Json score_folder(const std::filesystem::path& cases, const std::filesystem::path& folder,
                  const std::vector<std::string>& renamed);
std::string score_table(const Json& scores);

}  // namespace vlbeam
