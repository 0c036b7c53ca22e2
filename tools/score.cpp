#include "tools/score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "io/nearest.hpp"
#include "io/number_table.hpp"
#include "io/run_file.hpp"
#include "scene/options.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> case_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> column_names(const CertifiedCase& known) {
  std::vector<std::string> names;
  for (const auto& column : known.columns) names.push_back(column.name);
  return names;
}

void rename(NumberTable& table, const std::vector<std::string>& renamed) {
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
}

/// A name with a mistake in it would be a column that nobody looks at.
void check_names(const std::string& file, const NumberTable& table, const CertifiedCase& known) {
  const auto ours = column_names(known);
  const auto is_there = [&](const std::string& name) {
    return std::ranges::find(table.names, name) != table.names.end();
  };
  for (const std::string& name : table.names) {
    const std::string nearest = nearest_of(name, ours);
    if (name == "t" || name == nearest || is_there(nearest) || letters_apart(name, nearest) > 2) continue;
    throw InvalidInput(file, "a column \"" + name + "\"",
                       "is \"" + nearest + "\" meant? (--column " + nearest + "=" + name + " renames)");
  }
}

/// Rows of a table at times of the case: which row, which time.
struct Matched {
  std::vector<std::array<std::size_t, 2>> pairs;
  std::size_t beyond = 0, between = 0;  ///< rows after its last time, and at others
};

Matched match(const std::string& file, const NumberTable& table, std::size_t time, const CertifiedCase& known) {
  Matched matched;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double t = table.rows[row][time];
    const std::string where = file + ", line " + std::to_string(table.lines[row]) + ", t";
    if (std::isnan(t)) throw InvalidInput(where, "an empty cell", "every line must have its time");
    if (row > 0 && t <= table.rows[row - 1][time]) {
      throw InvalidInput(where, number_text(t), "times must grow from line to line");
    }
    const auto found = std::ranges::find_if(known.t, [t](double other) { return at_same_time(t, other); });
    if (found != known.t.end()) {
      matched.pairs.push_back({row, static_cast<std::size_t>(found - known.t.begin())});
    } else {
      ++(t > known.t.back() ? matched.beyond : matched.between);
    }
  }
  if (matched.pairs.empty()) {
    throw InvalidInput(
        file, "these times",
        "none is one at which the case is known, and nothing is interpolated: " + number_text(known.t.front()) + ", " +
            number_text(known.t[1]) + ", ... " + number_text(known.t.back()) + " s");
  }
  return matched;
}

/// The error of one column in words. Of several meshes `order` is that of all their errors, or why there is none.
std::string verdict(const Json& column, const std::string& order = "") {
  if (column.at("compared") == 0) return "nothing to compare";
  const std::string unit = column.at("unit") == "-" ? "" : " " + column.at("unit").get<std::string>();
  if (column.at("largest_seen").is_null()) {
    return "no error seen: below what is known (" + digits(column.at("largest_uncertainty"), 2) + unit + ")";
  }
  return "an error of " + digits(column.at("largest_seen"), 2) + unit + (order.empty() ? "" : ", " + order);
}

Json errors_of(const NumberTable& table, std::size_t c, const CertifiedCase::Column& known, const Matched& matched,
               const std::vector<double>& times) {
  double sum = 0, most = 0, seen = 0, at_time = 0, its_uncertainty = 0, most_uncertainty = 0;
  std::size_t count = 0, gaps = 0, within = 0;
  for (const auto& [row, at] : matched.pairs) {
    const double value = table.rows[row][c], exact = known.values[at], uncertainty = known.uncertainties[at];
    if (std::isnan(value) || std::isnan(exact)) {
      ++gaps;
      continue;
    }
    const double error = std::abs(value - exact);
    ++count;
    sum += error * error;
    within += error <= uncertainty ? 1 : 0;
    if (error > uncertainty) seen = std::max(seen, error);
    most_uncertainty = std::max(most_uncertainty, uncertainty);
    if (error > most) {
      most = error;
      at_time = times[at];
      its_uncertainty = uncertainty;
    }
  }
  Json column = {{"column", known.name},
                 {"unit", known.unit},
                 {"compared", count},
                 {"gaps", gaps},
                 {"largest_error", count > 0 ? Json(most) : Json()},
                 {"at", at_time},
                 {"uncertainty", its_uncertainty},
                 {"rms_error", count > 0 ? Json(std::sqrt(sum / static_cast<double>(count))) : Json()},
                 {"largest_seen", seen > 0 ? Json(seen) : Json()},  // of those above their uncertainty
                 {"within_uncertainty", within},
                 {"largest_uncertainty", most_uncertainty}};
  column["verdict"] = verdict(column);
  return column;
}

/// A trajectory of a folder by its name.
struct Entry {
  fs::path file;
  std::string name, method;  ///< of the case; empty where the name says none
  std::optional<int> elements;
};

Entry entry_of(const fs::path& file, const std::vector<std::string>& names) {
  const std::string stem = file.stem().string();
  Entry entry{file, "", "", {}};
  for (const std::string& name : names) {
    const bool fits = stem == name || stem.starts_with(name + "_");
    if (fits && name.size() > entry.name.size()) entry.name = name;
  }
  if (entry.name.empty()) {
    throw InvalidInput(file.string(), "this name", "it must begin with a case: " + quoted_list(names));
  }
  static const std::regex form("(?:_(.*?))?(?:_?N(\\d{1,9}))?");
  std::smatch parts;
  const std::string rest = stem.substr(entry.name.size());
  if (std::regex_match(rest, parts, form)) {
    entry.method = parts[1];
    if (parts[2].matched) entry.elements = std::stoi(parts[2]);
  }
  return entry;
}

/// What the errors of several meshes say of one column.
Json over_meshes(const std::vector<const Json*>& scores, const std::string& name) {
  std::vector<int> elements;
  std::vector<double> errors;
  const Json* finest = nullptr;
  double known_to = 0;
  for (const Json* score : scores) {
    for (const Json& column : score->at("columns")) {
      if (column.at("column") != name || column.at("compared") == 0) continue;
      elements.push_back(score->at("elements"));
      errors.push_back(column.at("largest_error"));
      known_to = std::max(known_to, column.at("uncertainty").get<double>());
      finest = &column;
    }
  }
  if (elements.size() < 2) return {};
  const OrderFit fit = fit_order(name, {elements.begin(), elements.end()}, errors, {.floor = known_to});
  const bool asymptotic = fit.refusal.empty() && std::isfinite(fit.slope);
  std::string order = "no order";
  if (asymptotic) {
    order = "of order " + digits(fit.slope, 2);
  } else if (fit.pairwise_orders.size() > 1) {
    const auto [least, most] = std::ranges::minmax(fit.pairwise_orders);
    order = "no order: pairs show " + digits(least, 2) + " to " + digits(most, 2);
  }
  return {{"column", name},
          {"unit", finest->at("unit")},
          {"elements", elements},
          {"errors", errors},
          {"known_to", known_to},
          {"order", asymptotic ? Json(fit.slope) : Json()},
          {"verdict", verdict(*finest, order)}};
}

}  // namespace

CertifiedCase read_case(const fs::path& folder, const std::string& name) {
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

std::string cases_text(const fs::path& folder) {
  std::ostringstream text;
  for (const std::string& name : case_names(folder)) {
    const CertifiedCase known = read_case(folder, name);
    double place = 0;
    for (const auto& column : known.columns) {
      if (column.unit == "m") place = std::max(place, *std::ranges::max_element(column.uncertainties));
    }
    text << name << ": " << known.title << "\n  by " << known.source << "; t = " << number_text(known.t.front()) << ", "
         << number_text(known.t[1]) << ", ... " << number_text(known.t.back()) << " s; places known to "
         << digits(place, 2) << " m\n  columns:";
    for (const std::string& column : column_names(known)) text << ' ' << column;
    text << '\n';
  }
  return text.str();
}

void write_kit(const fs::path& cases, const fs::path& folder) {
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder))) {
    throw InvalidInput("--kit", "\"" + folder.string() + "\"", "it must be a new folder or an empty one");
  }
  fs::create_directories(folder);
  const auto cell = [](double value) { return "," + (std::isnan(value) ? "" : number_text(value)); };
  for (const std::string& name : case_names(cases)) {
    const CertifiedCase known = read_case(cases, name);
    std::string table = "t [s]";
    for (const auto& column : known.columns) {
      table += "," + column.name + " [" + column.unit + "],uncertainty of " + column.name + " [" + column.unit + "]";
    }
    for (std::size_t i = 0; i < known.t.size(); ++i) {
      table += "\n" + number_text(known.t[i]);
      for (const auto& column : known.columns) {
        table += cell(column.values[i]) + cell(column.uncertainties[i]);
      }
    }
    write_text(folder / (name + ".csv"), table + "\n");
    write_text(folder / (name + ".json"), pretty(read_json(cases / (name + ".json")).at("scene")));
  }
}

Json score_trajectory(const CertifiedCase& known, const fs::path& csv, const std::vector<std::string>& renamed) {
  NumberTable table = read_numbers(csv);
  rename(table, renamed);
  check_names(csv.string(), table, known);
  const auto index_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(table.names, name) - table.names.begin());
  };
  const std::size_t time = index_of("t");
  if (time == table.names.size())
    throw InvalidInput(csv.string(), "a table without a column t", "it must have the times [s]");
  if (const std::string& unit = table.units[time]; !unit.empty() && unit != "s") {
    throw InvalidInput(csv.string() + ", t", "the unit \"" + unit + "\"", "it must be s");
  }
  const Matched matched = match(csv.string(), table, time, known);
  Json json = {
      {"schema_version", "vlbeam.score/1"},    {"case", known.name},           {"known_by", known.source},
      {"trajectory", csv.filename().string()}, {"rows", matched.pairs.size()}, {"rows_at_other_times", matched.between},
      {"rows_beyond_the_case", matched.beyond}};
  Json& columns = json["columns"] = Json::array();
  for (const auto& column : known.columns) {
    const std::size_t c = index_of(column.name);
    if (c == table.names.size()) continue;
    if (const std::string& unit = table.units[c]; !unit.empty() && unit != column.unit) {
      throw InvalidInput(csv.string() + ", " + column.name, "the unit \"" + unit + "\"", "it must be " + column.unit);
    }
    columns.push_back(errors_of(table, c, column, matched, known.t));
  }
  if (columns.empty()) {
    throw InvalidInput(
        csv.string(), "columns " + quoted_list(table.names),
        "at least one must be of the case: " + quoted_list(column_names(known)) + " (--column ours=theirs renames)");
  }
  return json;
}

std::string score_text(const Json& score) {
  std::ostringstream text;
  text << score.at("case").get<std::string>() << ", " << score.at("rows") << " rows of "
       << score.at("trajectory").get<std::string>();
  if (score.at("rows_at_other_times") > 0)
    text << "; " << score.at("rows_at_other_times") << " more are at times at which it is not known";
  if (score.at("rows_beyond_the_case") > 0)
    text << "; " << score.at("rows_beyond_the_case") << " more are beyond its end";
  text << "; known by " << score.at("known_by").get<std::string>() << '\n';
  for (const Json& row : score.at("columns")) {
    text << "  " << row.at("column").get<std::string>() << ": " << row.at("verdict").get<std::string>();
    if (row.at("compared") > 0) {
      const std::string unit = " " + row.at("unit").get<std::string>();
      text << "; largest " << digits(row.at("largest_error")) << unit << " at t = " << digits(row.at("at"), 6)
           << " s, where the answer is known to " << digits(row.at("uncertainty"), 2) << unit << "; rms "
           << digits(row.at("rms_error")) << unit << "; " << row.at("within_uncertainty") << " of "
           << row.at("compared") << " within what is known";
    }
    if (row.at("gaps") > 0) text << "; " << row.at("gaps") << " gaps";
    text << '\n';
  }
  return text.str();
}

Json score_folder(const fs::path& cases, const fs::path& folder, const std::vector<std::string>& renamed) {
  const auto names = case_names(cases);
  std::vector<Entry> entries;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") entries.push_back(entry_of(entry.path(), names));
  }
  if (entries.empty()) {
    throw InvalidInput(folder.string(), "no trajectory in it",
                       "it must hold CASE.csv, CASE_N40.csv or CASE_METHOD_N40.csv");
  }
  std::ranges::sort(entries, {},
                    [](const Entry& entry) { return std::tuple(entry.name, entry.method, entry.elements); });
  Json json = {{"schema_version", "vlbeam.scores/1"}, {"trajectories", Json::array()}, {"meshes", Json::array()}};
  for (const Entry& entry : entries) {
    Json score = score_trajectory(read_case(cases, entry.name), entry.file, renamed);
    score["method"] = entry.method;
    score["elements"] = entry.elements ? Json(*entry.elements) : Json();
    json["trajectories"].push_back(std::move(score));
  }
  std::map<std::pair<std::string, std::string>, std::vector<const Json*>> together;
  for (const Json& score : json.at("trajectories")) {
    if (score.at("elements").is_number()) together[{score.at("case"), score.at("method")}].push_back(&score);
  }
  for (const auto& [which, scores] : together) {
    for (const Json& column : scores.back()->at("columns")) {
      Json meshes = over_meshes(scores, column.at("column"));
      if (meshes.is_null()) continue;
      meshes["case"] = which.first;
      meshes["method"] = which.second;
      json["meshes"].push_back(std::move(meshes));
    }
  }
  return json;
}

std::string score_table(const Json& scores) {
  std::ostringstream text;
  std::string last;
  const auto heading = [&](const Json& row) {
    std::string head = row.at("case");
    if (const std::string method = row.at("method"); !method.empty()) head += ", " + method;
    if (head == last) return;
    text << head << '\n';
    last = std::move(head);
  };
  const auto& meshes = scores.at("meshes");
  for (const Json& score : scores.at("trajectories")) {
    const bool among_meshes = std::ranges::any_of(meshes, [&](const Json& row) {
      return row.at("case") == score.at("case") && row.at("method") == score.at("method");
    });
    if (among_meshes && !score.at("elements").is_null()) continue;
    heading(score);
    for (const Json& row : score.at("columns")) {
      text << "  " << row.at("column").get<std::string>() << ": " << row.at("verdict").get<std::string>() << '\n';
    }
  }
  for (const Json& row : meshes) {
    heading(row);
    text << "  " << row.at("column").get<std::string>() << ": ";
    for (std::size_t i = 0; i < row.at("errors").size(); ++i) {
      text << (i == 0 ? "" : ", ") << digits(row.at("errors")[i], 2) << " (N = " << row.at("elements")[i] << ")";
    }
    text << ' ' << row.at("unit").get<std::string>() << "; known to " << digits(row.at("known_to"), 2) << "; "
         << row.at("verdict").get<std::string>() << '\n';
  }
  return text.str();
}

}  // namespace vlbeam
