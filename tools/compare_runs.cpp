#include "tools/compare_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "io/messages.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "tools/measures.hpp"

namespace vlbeam {
namespace {

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

}  // namespace vlbeam
