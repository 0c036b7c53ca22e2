#include "studies/harness/report.hpp"

#include <cmath>

#include "scene/options.hpp"

namespace vlbeam {
namespace {

std::string csv_cell(const Json& cell) {
  if (cell.is_null()) return "";
  if (cell.is_number_float()) return std::isfinite(cell.get<double>()) ? number_text(cell.get<double>()) : "";
  if (!cell.is_string()) return cell.dump();
  const auto& text = cell.get_ref<const std::string&>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string table_csv(const Table& table) {
  std::string text;
  const auto line = [&text](const auto& cells, const auto& write) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + write(cells[i]);
    text += '\n';
  };
  line(table.columns, [](const std::string& column) { return csv_cell(column); });
  for (const auto& row : table.rows) line(row, csv_cell);
  return text;
}

std::filesystem::path ReportFiles::report() const { return out / (study + ".json"); }
std::filesystem::path ReportFiles::timing() const { return out / (study + ".timing.json"); }
std::filesystem::path ReportFiles::table(const Table& table) const {
  return out / (study + "_" + table.name + (table.timing ? ".timing.csv" : ".csv"));
}
std::filesystem::path ReportFiles::figure(const Figure& figure) const {
  return out / "figures" / (study + "_" + figure.name + (figure.timing ? ".timing.svg" : ".svg"));
}

Json report_to_json(const StudyReport& report, const ReportFiles& files, const std::string& profile,
                    const std::string& status, const std::string& failure) {
  Json cases = Json::array();
  for (const StudyCase& item : report.cases) {
    Json entry = {{"options", item.options}, {"results", item.results}};
    if (!item.failure.empty()) entry["failure"] = item.failure;
    cases.push_back(entry);
  }
  Json fits = Json::array();
  for (const OrderFit& fit : report.fits) fits.push_back(fit_to_json(fit));
  Json convergence = Json::array();
  for (const GridConvergence& found : report.grid_convergence) convergence.push_back(grid_convergence_to_json(found));
  Json tables = Json::array();
  for (const Table& table : report.tables) {
    if (table.timing) continue;
    Json entry = {{"name", table.name},
                  {"caption", table.caption},
                  {"file", files.table(table).filename().string()},
                  {"columns", table.columns}};
    if (!table.curve) entry["rows"] = table.rows;
    tables.push_back(entry);
  }
  Json figures = Json::array();
  for (const Figure& figure : report.figures) {
    if (figure.timing) continue;
    figures.push_back({{"name", figure.name},
                       {"caption", figure.caption},
                       {"file", files.figure(figure).lexically_relative(files.out).string()}});
  }

  Json json = {{"schema_version", "vlbeam.study/1"}, {"study", files.study}, {"profile", profile}, {"status", status}};
  if (!failure.empty()) json["failure"] = failure;
  json["measured"] = report.measured;
  json["cases"] = cases;
  json["fits"] = fits;
  if (!convergence.empty()) json["grid_convergence"] = convergence;
  json["gate_kinds"] = Json::object();
  json["gates"] = Json::array();
  json["tables"] = tables;
  json["figures"] = figures;
  return json;
}

}  // namespace vlbeam
