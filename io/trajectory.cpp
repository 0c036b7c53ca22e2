#include "io/trajectory.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/nearest.hpp"
#include "io/scene_json.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

constexpr double same_time = 1e-9;  // [s], relative to 1 s or more

bool at_same_time(double a, double b) { return std::abs(a - b) <= same_time * std::max(1.0, std::abs(a)); }

std::string digits(double value, int count = 3) {
  std::ostringstream text;
  text.precision(count);
  text << value;
  return text.str();
}

/// Pairs of samples of the same time.
std::vector<std::array<std::size_t, 2>> common_times(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    if (at_same_time(a[i], b[k])) {
      pairs.push_back({i++, k++});
    } else {
      ++(a[i] < b[k] ? i : k);
    }
  }
  return pairs;
}

Json option_differences(const Json& a, const Json& b) {
  Json list = Json::array();
  const Json left = a.flatten(), right = b.flatten();
  const auto value = [](const Json& flat, const std::string& key) {
    return flat.contains(key) ? flat.at(key) : Json();
  };
  for (const auto& item : left.items()) {
    if (value(right, item.key()) != item.value()) {
      list.push_back({{"option", item.key()}, {"a", item.value()}, {"b", value(right, item.key())}});
    }
  }
  for (const auto& item : right.items()) {
    if (!left.contains(item.key())) list.push_back({{"option", item.key()}, {"a", Json()}, {"b", item.value()}});
  }
  return list;
}

/// Events of one type in both, the first with the first, and how far apart in time.
Json match_events(const Json& a, const Json& b) {
  const auto by_type = [](const Json& events) {
    std::map<std::string, std::vector<double>> times;
    for (const Json& event : events) times[event.at("type")].push_back(event.at("t"));
    return times;
  };
  auto left = by_type(a), right = by_type(b);
  for (const auto& [type, times] : left) right[type];
  Json list = Json::array();
  for (const auto& [type, theirs] : right) {
    const auto& ours = left[type];
    double apart = 0;
    for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
      apart = std::max(apart, std::abs(ours[i] - theirs[i]));
    }
    list.push_back({{"type", type}, {"a", ours.size()}, {"b", theirs.size()}, {"furthest_apart", apart}});
  }
  return list;
}

struct Columns {
  std::vector<std::string> names, units;
  std::vector<std::vector<double>> rows;  ///< NaN where a cell is empty
  std::vector<std::size_t> lines;         ///< of the file, from 1
};

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

Columns read_table(const std::filesystem::path& file) {
  Columns table;
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
      double value = nan;
      const char* end = cells[i].data() + cells[i].size();
      const auto result = std::from_chars(cells[i].data(), end, value);
      const bool number_there = result.ec == std::errc() && result.ptr == end && std::isfinite(value);
      if (!cells[i].empty() && !number_there) {
        throw InvalidInput(where + ", " + table.names[i], "\"" + cells[i] + "\"",
                           "it must be a finite number, or empty where there is none");
      }
      row.push_back(cells[i].empty() ? nan : value);
    }
    table.rows.push_back(std::move(row));
    table.lines.push_back(number);
  }
  if (table.rows.empty())
    throw InvalidInput(file.string(), "no numbers", "it must have a line of names and lines of numbers");
  return table;
}

}  // namespace

Json compare_runs(const RunFile& a, const RunFile& b, double tolerance) {
  const auto pairs = common_times(a.t, b.t);
  if (pairs.empty()) {
    throw InvalidInput(b.path.string() + ": /samples/t", "these times", "none of them is a time of " + a.path.string());
  }
  Json json = {{"schema_version", "vlbeam.compare/1"},
               {"a", a.path.filename().string()},
               {"b", b.path.filename().string()},
               {"status", {a.status(), b.status()}},
               {"options", option_differences(scene_to_json(a.scene), scene_to_json(b.scene))},
               {"common_samples", pairs.size()},
               {"common_until", a.t[pairs.back()[0]]},
               {"samples", {a.t.size(), b.t.size()}}};
  Json& list = json["quantities"] = Json::array();
  double largest = 0, apart_from = nan;
  const std::vector<Quantity> others = quantities(b.scene);
  for (const Quantity& quantity : quantities(a.scene)) {
    const auto other = std::ranges::find(others, quantity.name, &Quantity::name);
    if (other == others.end()) continue;
    const auto left = a.column(quantity), right = b.column(*other);
    double most = 0, at = a.t[pairs.front()[0]];
    std::size_t only_one = 0;
    const bool is_place = quantity.name == "joint_position" || quantity.name.starts_with("end.") ||
                          quantity.name.starts_with("mass_position.");
    for (const auto& [i, k] : pairs) {
      const double gap = std::abs(left[i] - right[k]);
      if (std::isnan(left[i]) != std::isnan(right[k])) ++only_one;
      if (!(gap > most)) continue;
      most = gap;
      at = a.t[i];
    }
    if (is_place) {
      largest = std::max(largest, only_one > 0 ? std::numeric_limits<double>::infinity() : most);
      for (const auto& [i, k] : pairs) {
        const bool beyond = std::abs(left[i] - right[k]) > tolerance || std::isnan(left[i]) != std::isnan(right[k]);
        if (!beyond) continue;
        apart_from = std::isnan(apart_from) ? a.t[i] : std::min(apart_from, a.t[i]);
        break;
      }
    }
    list.push_back({{"quantity", quantity.name},
                    {"unit", quantity.unit},
                    {"largest", most},
                    {"at", at},
                    {"only_in_one", only_one}});
  }
  json["events"] = match_events(a.json.at("events"), b.json.at("events"));
  json["largest_distance"] = std::isfinite(largest) ? Json(largest) : Json();
  json["tolerance"] = std::isfinite(tolerance) ? Json(tolerance) : Json();
  json["within"] = largest <= tolerance && a.status() == b.status();
  json["apart_from"] = std::isfinite(tolerance) && !std::isnan(apart_from) ? Json(apart_from) : Json();
  return json;
}

std::string comparison_text(const Json& comparison) {
  std::ostringstream text;
  text << "options that differ: " << comparison.at("options").size() << '\n';
  for (const Json& option : comparison.at("options")) {
    text << "  " << option.at("option").get<std::string>() << ": " << excerpt(option.at("a")) << " | "
         << excerpt(option.at("b")) << '\n';
  }
  text << "samples: " << comparison.at("common_samples") << " in common, of " << comparison.at("samples")[0] << " | "
       << comparison.at("samples")[1] << ", up to t = " << digits(comparison.at("common_until"), 6)
       << " s; the largest difference of each quantity\n";
  for (const Json& row : comparison.at("quantities")) {
    text << "  " << row.at("quantity").get<std::string>() << ": " << digits(row.at("largest"))
         << (row.at("unit") == "-" ? "" : " " + row.at("unit").get<std::string>())
         << " at t = " << digits(row.at("at"), 6) << " s";
    if (row.at("only_in_one") > 0) text << "; in one run only at " << row.at("only_in_one") << " samples";
    text << '\n';
  }
  for (const Json& row : comparison.at("events")) {
    text << "events " << row.at("type").get<std::string>() << ": " << row.at("a") << " | " << row.at("b")
         << ", at most " << digits(row.at("furthest_apart")) << " s apart\n";
  }
  const Json& status = comparison.at("status");
  if (status[0] != status[1]) {
    text << "status: " << status[0].get<std::string>() << " | " << status[1].get<std::string>()
         << ", so the runs are not the same\n";
  }
  if (comparison.at("tolerance").is_number()) {
    text << "positions are " << (comparison.at("within") ? "" : "NOT ") << "within "
         << digits(comparison.at("tolerance")) << " m";
    if (comparison.at("apart_from").is_number())
      text << ", from t = " << digits(comparison.at("apart_from"), 6) << " s on";
    text << '\n';
  }
  return text.str();
}

std::vector<std::string> case_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

CertifiedCase read_case(const std::filesystem::path& folder, const std::string& name) {
  const auto names = case_names(folder);
  if (std::ranges::find(names, name) == names.end()) {
    throw InvalidInput("case", "\"" + name + "\"",
                       "the nearest is \"" + nearest_of(name, names) + "\" (there are: " + quoted_list(names) + ")");
  }
  const Json json = read_json(folder / (name + ".json"));
  const auto numbers = [](const Json& list) {
    std::vector<double> values;
    for (const Json& value : list) values.push_back(value.is_number() ? value.get<double>() : nan);
    return values;
  };
  CertifiedCase known{name, json.at("title"), json.at("source"), numbers(json.at("t")), {}};
  for (const auto& item : json.at("columns").items()) {
    known.columns.push_back({item.key(), item.value().at("unit"), numbers(item.value().at("values")),
                             numbers(item.value().at("uncertainties"))});
  }
  return known;
}

Json score_trajectory(const CertifiedCase& known, const std::filesystem::path& csv,
                      const std::vector<std::string>& renamed) {
  Columns table = read_table(csv);
  for (const std::string& pair : renamed) {
    const auto equals = pair.find('=');
    const std::string theirs = equals == std::string::npos ? "" : pair.substr(equals + 1);
    const auto found = std::ranges::find(table.names, theirs);
    if (found == table.names.end()) {
      throw InvalidInput("--column", "\"" + pair + "\"",
                         "it must be ours=theirs, theirs a column of the file: " + quoted_list(table.names));
    }
    *found = pair.substr(0, equals);
  }
  const auto index_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(table.names, name) - table.names.begin());
  };
  const std::size_t time = index_of("t");
  if (time == table.names.size())
    throw InvalidInput(csv.string(), "a table without a column t", "it must have the times [s]");
  if (const std::string& unit = table.units[time]; !unit.empty() && unit != "s") {
    throw InvalidInput(csv.string() + ", t", "the unit \"" + unit + "\"", "it must be s");
  }

  // What comes after the case's end is none of its errors.
  const auto ends = std::ranges::find_if(table.rows, [&](const auto& row) {
    return row[time] > known.t.back() && !at_same_time(row[time], known.t.back());
  });
  const auto beyond = static_cast<std::size_t>(table.rows.end() - ends);
  table.rows.erase(ends, table.rows.end());
  std::vector<std::size_t> at;  // of each row, the case's time
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double t = table.rows[row][time];
    const std::string where = csv.string() + ", line " + std::to_string(table.lines[row]) + ", t";
    if (std::isnan(t)) throw InvalidInput(where, "an empty cell", "every line must have its time");
    const auto found = std::ranges::find_if(known.t, [t](double other) { return at_same_time(t, other); });
    if (found == known.t.end()) {
      throw InvalidInput(where, number_text(t),
                         "the case is known at " + number_text(known.t.front()) + ", " + number_text(known.t[1]) +
                             ", ... " + number_text(known.t.back()) +
                             " s, and nothing is interpolated: give a subset of these times");
    }
    at.push_back(static_cast<std::size_t>(found - known.t.begin()));
    if (row > 0 && at[row] <= at[row - 1])
      throw InvalidInput(where, number_text(t), "times must grow from line to line");
  }

  Json json = {{"schema_version", "vlbeam.score/1"},
               {"case", known.name},
               {"trajectory", csv.filename().string()},
               {"rows", table.rows.size()},
               {"rows_beyond_the_case", beyond}};
  Json& columns = json["columns"] = Json::array();
  for (const auto& column : known.columns) {
    const std::size_t c = index_of(column.name);
    if (c == table.names.size()) continue;
    if (const std::string& unit = table.units[c]; !unit.empty() && unit != column.unit) {
      throw InvalidInput(csv.string() + ", " + column.name, "the unit \"" + unit + "\"", "it must be " + column.unit);
    }
    double sum = 0, most = 0, at_time = 0, most_uncertainty = 0;
    std::size_t count = 0, gaps = 0, within = 0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const double value = table.rows[row][c], exact = column.values[at[row]],
                   uncertainty = column.uncertainties[at[row]];
      if (std::isnan(value) || std::isnan(exact)) {
        ++gaps;
        continue;
      }
      const double error = std::abs(value - exact);
      ++count;
      sum += error * error;
      within += error <= uncertainty ? 1 : 0;
      most_uncertainty = std::max(most_uncertainty, uncertainty);
      if (error > most) {
        most = error;
        at_time = known.t[at[row]];
      }
    }
    columns.push_back({{"column", column.name},
                       {"unit", column.unit},
                       {"compared", count},
                       {"gaps", gaps},
                       {"largest_error", count > 0 ? Json(most) : Json()},
                       {"at", at_time},
                       {"rms_error", count > 0 ? Json(std::sqrt(sum / static_cast<double>(count))) : Json()},
                       {"within_uncertainty", within},
                       {"largest_uncertainty", most_uncertainty}});
  }
  if (columns.empty()) {
    std::vector<std::string> names;
    for (const auto& column : known.columns) names.push_back(column.name);
    throw InvalidInput(csv.string(), "columns " + quoted_list(table.names),
                       "at least one must be of the case: " + quoted_list(names) + " (--column ours=theirs renames)");
  }
  return json;
}

std::string score_text(const Json& score) {
  std::ostringstream text;
  text << score.at("case").get<std::string>() << ", " << score.at("rows") << " rows of "
       << score.at("trajectory").get<std::string>();
  if (score.at("rows_beyond_the_case") > 0)
    text << "; " << score.at("rows_beyond_the_case") << " more are beyond its end";
  text << '\n';
  for (const Json& row : score.at("columns")) {
    text << "  " << row.at("column").get<std::string>() << ": ";
    if (row.at("compared") == 0) {
      text << "nothing to compare\n";
      continue;
    }
    const std::string unit = " " + row.at("unit").get<std::string>();
    text << "largest error " << digits(row.at("largest_error")) << unit << " at t = " << digits(row.at("at"), 6)
         << " s, rms " << digits(row.at("rms_error")) << unit << "; the answer is known to "
         << digits(row.at("largest_uncertainty")) << unit << "; " << row.at("within_uncertainty") << " of "
         << row.at("compared") << " within that";
    if (row.at("gaps") > 0) text << "; " << row.at("gaps") << " gaps";
    text << '\n';
  }
  return text.str();
}

}  // namespace vlbeam
