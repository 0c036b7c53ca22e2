#include "tools/own_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/messages.hpp"
#include "io/nearest.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/simulate.hpp"
#include "tools/interrupt.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace {

namespace fs = std::filesystem;

constexpr double most_cases = 1e6;

void check_keys(const Json& json, const std::string& where, const std::vector<std::string>& known) {
  if (!json.is_object())
    throw InvalidInput(where.empty() ? "the top level" : where, excerpt(json), "it must be an object");
  for (const auto& item : json.items()) {
    if (std::ranges::find(known, item.key()) != known.end()) continue;
    throw InvalidInput(
        where + "/" + escaped(item.key()), "an unknown key",
        "the nearest known key is \"" + nearest_of(item.key(), known) + "\" (known here: " + quoted_list(known) + ")");
  }
}

double rounded(double value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return std::stod(text.str());
}

/// The values of one entry of /over: a list, or {"from", "to", "count", "spacing"}.
std::vector<Json> values_of(const Json& json, const std::string& where) {
  if (json.is_array() && !json.empty()) return {json.begin(), json.end()};
  if (!json.is_object()) throw InvalidInput(where, excerpt(json), "it must be a list of values or a range of them");
  check_keys(json, where, {"from", "to", "count", "spacing"});
  const auto number = [&](const char* key) {
    const Json value = json.value(key, Json());
    if (!value.is_number()) throw InvalidInput(where + "/" + key, excerpt(value), "it must be a number");
    return value.get<double>();
  };
  const double from = number("from"), to = number("to"), count = number("count");
  if (!(count >= 2) || count != std::trunc(count) || count > most_cases) {
    throw InvalidInput(where + "/count", number_text(count), "it must be a whole number from 2 to 1000000");
  }
  const std::string spacing = json.value("spacing", "linear");
  const bool logarithmic = spacing == "logarithmic";
  if (!logarithmic && spacing != "linear") {
    throw InvalidInput(where + "/spacing", "\"" + spacing + "\"", "it must be one of \"linear\", \"logarithmic\"");
  }
  if (logarithmic && !(from > 0 && to > 0)) {
    throw InvalidInput(where, excerpt(json), "a logarithmic range lies between numbers > 0");
  }
  std::vector<Json> values;
  const bool whole = !logarithmic && from == std::trunc(from) && std::fmod(to - from, count - 1) == 0;
  for (double i = 0; i < count; ++i) {
    const double share = i / (count - 1);
    const double value = i + 1 == count ? to
                         : logarithmic  ? from * portable::pow(to / from, share)
                                        : from + share * (to - from);
    // To 15 digits, which is what was asked for: 1e-8, not 9.999999999999999e-9.
    values.emplace_back(whole ? Json(static_cast<long>(std::round(value))) : Json(rounded(value)));
  }
  return values;
}

std::string case_number(std::size_t i) {
  const std::string digits = std::to_string(i);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

std::vector<std::string> default_quantities(const Scene& scene) {
  std::vector<std::string> names;
  if (sliding_joint(scene)) names.emplace_back("joint_position");
  for (int i = 0; i < scene.dimension; ++i) names.push_back(std::string("end.") + "xyz"[i]);
  names.emplace_back("energy.total");
  return names;
}

SweepPlan plan_from(Json file, const fs::path& folder) {
  check_keys(file, "", {"schema", "title", "scene", "combine", "over", "quantities"});
  if (file.value("schema", Json()) != "vlbeam.sweep/1") {
    throw InvalidInput("/schema", excerpt(file.value("schema", Json())), "it must be \"vlbeam.sweep/1\"");
  }
  if (!file.contains("scene"))
    throw InvalidInput("/scene", InvalidInput::missing, "it must be a scene, or the name of its file");
  if (file.at("scene").is_string()) file["scene"] = read_json(folder / file.at("scene").get<std::string>());
  const std::string combine = file.value("combine", "product");
  if (combine != "product" && combine != "zip") {
    throw InvalidInput("/combine", "\"" + combine + "\"", "it must be one of \"product\", \"zip\"");
  }
  if (!file.contains("over"))
    throw InvalidInput("/over", InvalidInput::missing, "it must be an object of options and their values");
  check_keys(file.at("over"), "/over", [&] {
    std::vector<std::string> keys;
    if (file.at("over").is_object()) {
      for (const auto& item : file.at("over").items()) keys.push_back(item.key());
    }
    return keys;
  }());

  std::vector<std::pair<std::string, std::vector<Json>>> options;
  double count = combine == "zip" && !file.at("over").empty() ? 0 : 1;
  for (const auto& [pointers, values] : file.at("over").items()) {
    options.emplace_back(pointers, values_of(values, "/over/" + escaped(pointers)));
    const auto size = static_cast<double>(options.back().second.size());
    if (combine == "product") {
      count *= size;
    } else if (options.size() == 1) {
      count = size;
    } else if (count != size) {
      throw InvalidInput("/over/" + escaped(pointers), std::to_string(options.back().second.size()) + " values",
                         "a zip has as many of each option: " + number_text(count));
    }
  }
  if (count > most_cases) {
    throw InvalidInput("/over", number_text(count) + " cases",
                       "a sweep has at most a million: take fewer values, or several sweeps");
  }

  SweepPlan plan{std::move(file), {}, {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    SweepCase item{Json::object(), plan.file.at("scene")};
    std::size_t rest = i;
    std::vector<std::size_t> picks(options.size(), i);
    if (combine == "product") {  // the last option runs fastest
      for (std::size_t k = options.size(); k-- > 0;) {
        picks[k] = rest % options[k].second.size();
        rest /= options[k].second.size();
      }
    }
    for (std::size_t k = 0; k < options.size(); ++k) {
      const Json& value = options[k].second[picks[k]];
      item.options[options[k].first] = value;
      assign_option(item.scene, options[k].first, value);
    }
    Scene scene;
    try {
      scene = scene_from_json(item.scene);
    } catch (const InvalidInput& error) {
      throw InvalidInput("case " + std::to_string(i) + " " + excerpt(item.options) + ", " + error.field, error.value,
                         error.allowed);
    }
    if (i == 0) {
      plan.quantities = plan.file.value("quantities", default_quantities(scene));
    }
    for (const std::string& name : plan.quantities) find_quantity(keeping(scene, name), name, "/quantities");
    plan.cases.push_back(std::move(item));
  }
  return plan;
}

/// Removes what cases gave, and nothing else that somebody keeps there.
void remove_cases(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> cases;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    const std::string stem = name.stem().string();
    const bool numbered = stem.size() >= 6 && stem.find_first_not_of("0123456789") == std::string::npos;
    if (numbered && name.extension() == ".json") cases.push_back(entry.path());
  }
  for (const fs::path& file : cases) fs::remove(file);
}

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

SweepPlan sweep_from_json(const Json& json, const fs::path& folder) {
  try {
    return plan_from(json, folder);
  } catch (const Json::exception& error) {
    throw InvalidInput("the sweep", excerpt(json),
                       std::string("it must be as vlbeam schema sweep says: ") + error.what());
  }
}

SweepPlan read_sweep(const fs::path& file) {
  const Json json = read_json(file);
  return naming_file(file, [&] { return sweep_from_json(json, file.parent_path()); });
}

SweepFolder::SweepFolder(fs::path folder, const SweepPlan& plan, bool force) : folder_(std::move(folder)), plan_(plan) {
  const fs::path begun = folder_ / "plan.json";
  const std::string text = pretty(plan.file);
  check_own("--out", begun, "\"vlbeam.sweep/1\"");
  check_own("--out", folder_ / "sweep.json", "\"vlbeam.sweep_report/1\"");
  check_own("--out", folder_ / "sweep.csv", "case,");
  if (fs::exists(begun) && read_text(begun) != text) {
    if (!force) {
      throw InvalidInput(
          "--out", "\"" + folder_.string() + "\"",
          "what was begun there is another sweep, or its scene has changed since: name another folder, or "
          "start anew with --force");
    }
    remove_cases(folder_ / "cases");
    for (const char* name : {"sweep.csv", "sweep.json"}) fs::remove(folder_ / name);
  }
  fs::create_directories(folder_ / "cases");
  if (!fs::exists(begun) || read_text(begun) != text) write_text(begun, text);
}

fs::path SweepFolder::file_of(std::size_t i) const { return folder_ / "cases" / (case_number(i) + ".json"); }

bool SweepFolder::has(std::size_t i) const { return fs::exists(file_of(i)); }

Json run_sweep_case(const SweepPlan& plan, std::size_t i) {
  const SweepCase& item = plan.cases.at(i);
  Json json = {{"case", i}, {"options", item.options}};
  try {
    Scene scene = scene_from_json(item.scene);
    for (const std::string& name : plan.quantities) scene = keeping(scene, name);
    const RunResult result = simulate(scene, [](double) { return !interrupted(); });
    if (result.status == RunStatus::interrupted) return {};
    json["status"] = to_string(result.status);
    json["failure"] = result.status == RunStatus::failed ? Json(result.failure) : Json();
    json["t"] = result.samples.empty() ? Json() : Json(result.samples.back().t);
    Json& values = json["values"] = Json::object();
    for (const std::string& name : plan.quantities) {
      values[name] =
          result.samples.empty() ? Json() : number_or_null(find_quantity(scene, name).of(result.samples.back()));
    }
    json["events"] = result.events.size();
    json["rhs_evaluations"] = result.solver.rhs_evaluations;
  } catch (const std::exception& error) {
    json = Json{{"case", i}, {"options", item.options}, {"status", "failed"}, {"failure", explained(error)}};
  }
  return json;
}

bool SweepFolder::run(std::size_t i) const {
  const Json json = run_sweep_case(plan_, i);
  if (json.is_null()) return false;
  write_text(file_of(i), pretty(json));
  return json.at("status") != "failed";
}

void SweepFolder::note_crash(std::size_t i, const std::string& how) const {
  const Json json = {{"case", i}, {"options", plan_.cases.at(i).options}, {"status", "crashed"}, {"failure", how}};
  write_text(file_of(i), pretty(json));
}

std::vector<std::size_t> SweepFolder::missing() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
    if (!has(i)) list.push_back(i);
  }
  return list;
}

std::size_t SweepFolder::collect() const {
  if (const auto list = missing(); !list.empty()) {
    throw std::runtime_error(std::to_string(list.size()) + " of " + std::to_string(plan_.cases.size()) +
                             " cases are missing, the first is " + std::to_string(list.front()) + ": run them first");
  }
  Json json = {{"schema_version", "vlbeam.sweep_report/1"}, {"sweep", plan_.file}};
  Json& cases = json["cases"] = Json::array();
  std::string table = "case";
  const Scene first = scene_from_json(plan_.cases.front().scene);
  for (const auto& item : plan_.cases.front().options.items()) table += "," + cell(item.key());
  table += ",status,t [s]";
  for (const std::string& name : plan_.quantities)
    table += "," + name + " [" + find_quantity(keeping(first, name), name).unit + "]";
  table += ",events,rhs_evaluations\n";
  std::size_t unwell = 0;
  for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
    const Json item = read_json(file_of(i));
    const std::string status = item.at("status");
    unwell += status == "completed" || status == "separated" ? 0 : 1;
    table += std::to_string(i);
    for (const auto& option : item.at("options").items()) table += "," + cell(option.value());
    table += "," + status + "," + cell(item.value("t", Json()));
    for (const std::string& name : plan_.quantities)
      table += "," + cell(item.value("values", Json::object()).value(name, Json()));
    table += "," + cell(item.value("events", Json())) + "," + cell(item.value("rhs_evaluations", Json())) + "\n";
    cases.push_back(item);
  }
  write_text(folder_ / "sweep.csv", table);
  write_text(folder_ / "sweep.json", pretty(json));
  return unwell;
}

}  // namespace vlbeam
