#include "io/number_table.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "io/files.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r' && c != '"') {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) {
    while (!cell.empty() && cell.back() == ' ') cell.pop_back();
    cell.erase(0, std::min(cell.find_first_not_of(' '), cell.size()));
  }
  return cells;
}

}  // namespace

NumberTable read_numbers(const std::filesystem::path& file) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  NumberTable table;
  std::istringstream text(read_text(file));
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line == "\r" || line.front() == '#') continue;
    const auto cells = cells_of(line);
    const std::string where = file.string() + ", line " + std::to_string(number);
    if (table.names.empty()) {
      for (const std::string& cell : cells) {
        const auto bracket = cell.find(" [");
        table.names.push_back(cell.substr(0, bracket));
        table.units.push_back(bracket == std::string::npos ? "" : cell.substr(bracket + 2, cell.size() - bracket - 3));
      }
      continue;
    }
    if (cells.size() != table.names.size()) {
      throw InvalidInput(where, std::to_string(cells.size()) + " cells",
                         "every line must have " + std::to_string(table.names.size()) + ", as the first");
    }
    std::vector<double> row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double value = none;
      const char* end = cells[i].data() + cells[i].size();
      const auto result = std::from_chars(cells[i].data(), end, value);
      const bool number_there = result.ec == std::errc() && result.ptr == end && std::isfinite(value);
      if (!cells[i].empty() && !number_there) {
        throw InvalidInput(where + ", " + table.names[i], "\"" + cells[i] + "\"",
                           "it must be a finite number, or empty where there is none");
      }
      row.push_back(cells[i].empty() ? none : value);
    }
    table.rows.push_back(std::move(row));
    table.lines.push_back(number);
  }
  if (table.rows.empty())
    throw InvalidInput(file.string(), "no numbers", "it must have a line of names and lines of numbers");
  return table;
}

}  // namespace vlbeam
