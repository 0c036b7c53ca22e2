#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "tools/gnuplot.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {

/// One run of a study: what was asked and what came out. A case with a failure makes the study fail; a breakdown that
/// is itself the finding belongs into the results.
struct StudyCase {
  Json options;
  Json results;
  std::string failure = {};
};

/// A table, written as a CSV file with one line of column names. A cell is a number, a string or null (empty).
struct Table {
  std::string name;
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<Json>> rows = {};
  bool curve = false;   ///< long data of a figure: a CSV file only, its rows are not repeated in the report
  bool timing = false;  ///< made of wall times: a *.timing.csv file, not part of the committed report
};

/// A figure, drawn by a gnuplot script of the study's folder once the tables are written. The script finds `output`
/// set, and `data` such that data.'energy.csv' is the table "energy".
struct Figure {
  std::string name;
  std::string caption;
  std::string script;               ///< file name in the study's folder
  GnuplotVariables variables = {};  ///< further variables of the script
  bool timing = false;              ///< drawn from wall times: a *.timing.svg file, not part of the committed report
};

/// What a study found. Everything but `timing` must be the same whenever and wherever it is computed.
struct StudyReport {
  std::vector<StudyCase> cases;
  std::map<std::string, double> measured;  ///< the numbers gates look at, by name
  std::vector<OrderFit> fits;
  std::vector<GridConvergence> grid_convergence;  ///< limits of what is published, and their uncertainties
  std::vector<Table> tables;
  std::vector<Figure> figures;
  Json timing = Json::object();  ///< wall times
};

/// Text of a table's CSV file.
std::string table_csv(const Table& table);

/// Where the files of a study go: OUT/NAME.json, OUT/NAME_TABLE.csv, OUT/figures/NAME_FIGURE.svg, and
/// OUT/NAME.timing.json, OUT/NAME_TABLE.timing.csv, OUT/figures/NAME_FIGURE.timing.svg for what wall times enter.
struct ReportFiles {
  std::filesystem::path out;
  std::string study;

  std::filesystem::path report() const;
  std::filesystem::path timing() const;
  std::filesystem::path table(const Table& table) const;
  std::filesystem::path figure(const Figure& figure) const;
};

/// The committed report without its gates.
Json report_to_json(const StudyReport& report, const ReportFiles& files, const std::string& profile,
                    const std::string& status, const std::string& failure);

}  // namespace vlbeam
