#include "studies/harness/gates.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "io/json.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

/// Reads an object of a gates file and refuses what it does not know.
class Fields {
 public:
  Fields(const Json& object, std::string at, std::initializer_list<std::string_view> known)
      : object_(object), at_(std::move(at)) {
    if (!object.is_object()) throw InvalidInput(at_, excerpt(object), "it must be an object");
    std::string list;
    for (const std::string_view key : known) list += (list.empty() ? "\"" : ", \"") + std::string(key) + "\"";
    for (const auto& item : object.items()) {
      if (std::ranges::find(known, item.key()) == known.end()) {
        throw InvalidInput(at_ + "/" + item.key(), "an unknown key", "known here: " + list);
      }
    }
  }

  bool has(const char* key) const { return object_.contains(key); }
  const Json& at(const char* key) const {
    if (!has(key)) throw InvalidInput(at_ + "/" + key, InvalidInput::missing, "every gate needs it");
    return object_.at(key);
  }
  std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string() || value.get<std::string>().empty()) {
      throw InvalidInput(at_ + "/" + key, excerpt(value), "it must be a string with something in it");
    }
    return value.get<std::string>();
  }
  double number(const char* key) const {
    const Json& value = at(key);
    if (!value.is_number()) throw InvalidInput(at_ + "/" + key, excerpt(value), "it must be a number");
    return value.get<double>();
  }
  const std::string& where() const { return at_; }

 private:
  const Json& object_;
  std::string at_;
};

/// A number of the report, or NaN where there is none.
double quantity(const Json& report, const std::string& name) {
  if (name.starts_with('/')) {
    const Json::json_pointer at(name);
    return report.contains(at) ? number_or_nan(report.at(at)) : nan;
  }
  return report.contains("measured") ? number_or_nan(report.at("measured").value(name, Json())) : nan;
}

void judge_bounds(const Fields& gate, const Json& report, GateVerdict& verdict) {
  const std::string name = gate.text("quantity");
  verdict.value = quantity(report, name);
  double u = 0;
  if (gate.has("uncertainty")) {
    const Json& given = gate.at("uncertainty");
    u = given.is_string() ? std::abs(quantity(report, given.get<std::string>())) : gate.number("uncertainty");
    verdict.uncertainty = u;
  } else if (verdict.kind == GateKind::self) {
    throw InvalidInput(gate.where() + "/uncertainty", InvalidInput::missing,
                       "self-convergence is judged with its uncertainty");
  }
  bool holds = true;
  const auto bound = [&](const std::string& text, bool kept) {
    verdict.bound += (verdict.bound.empty() ? "" : ", ") + text;
    holds = holds && kept;
  };
  // Comparisons with NaN are false: what is not there fails.
  if (gate.has("max")) bound("<= " + number_text(gate.number("max")), verdict.value + u <= gate.number("max"));
  if (gate.has("min")) bound(">= " + number_text(gate.number("min")), verdict.value - u >= gate.number("min"));
  if (gate.has("equals")) {
    const double tolerance = gate.has("tolerance") ? gate.number("tolerance") : 0;
    bound("= " + number_text(gate.number("equals")) + (tolerance > 0 ? " ± " + number_text(tolerance) : ""),
          std::abs(verdict.value - gate.number("equals")) + u <= tolerance);
  } else if (gate.has("tolerance")) {
    throw InvalidInput(gate.where() + "/tolerance", "a tolerance", "it belongs to \"equals\"");
  }
  if (verdict.bound.empty()) {
    throw InvalidInput(gate.where(), "a quantity without bound", "give \"max\", \"min\" or \"equals\"");
  }
  verdict.passed = holds && std::isfinite(verdict.value);
  if (!std::isfinite(verdict.value)) {
    verdict.failure = "the report holds no number \"" + name + "\"";
  } else if (std::isnan(u)) {
    verdict.failure = "the report holds no number for its uncertainty";
  } else if (!holds) {
    verdict.failure = number_text(verdict.value) + (u > 0 ? " ± " + number_text(u) : "") + " is not " + verdict.bound;
  }
}

void judge_order(const Fields& gate, const Json& report, GateVerdict& verdict) {
  const std::string name = gate.text("fit");
  const Fields order(gate.at("order"), gate.where() + "/order", {"expected", "tolerance", "at_most", "finest_error"});
  const OrderRule rule{.expected = order.number("expected"),
                       .tolerance = order.number("tolerance"),
                       .at_most = order.number("at_most"),
                       .finest_error = order.number("finest_error")};
  verdict.bound = "order in [" + number_text(rule.expected - rule.tolerance) + ", " + number_text(rule.at_most) +
                  "], finest error <= " + number_text(rule.finest_error);
  verdict.value = nan;
  verdict.failure = "the report holds no fit of \"" + name + "\"";
  for (const Json& json : report.value("fits", Json::array())) {
    if (json.value("quantity", "") != name) continue;
    const OrderFit fit = fit_from_json(json);
    verdict.value = fit.slope;
    verdict.uncertainty = fit.slope_uncertainty;
    verdict.failure = broken_order_rule(fit, rule);
    verdict.passed = verdict.failure.empty();
    return;
  }
}

GateKind kind_of(const Fields& gate) {
  const auto kind = from_string<GateKind>(gate.text("kind"));
  if (!kind) {
    throw InvalidInput(gate.where() + "/kind", excerpt(gate.at("kind")),
                       "it must be one of exact, independent, self, regression");
  }
  return *kind;
}

/// Evidence has a reason for its bound; one of kind regression says what it guards.
std::string reason_of(const Fields& gate) {
  const bool regression = kind_of(gate) == GateKind::regression;
  if (gate.has(regression ? "reason" : "guards")) {
    throw InvalidInput(gate.where(), "this gate", "one of kind regression has \"guards\", any other gate \"reason\"");
  }
  return gate.text(regression ? "guards" : "reason");
}

bool applies(const Fields& gate, const Json& report) {
  if (!gate.has("profiles")) return true;
  const Json& profiles = gate.at("profiles");
  const auto known = [](const Json& profile) { return profile == "ci" || profile == "full"; };
  if (!profiles.is_array() || profiles.empty() || !std::ranges::all_of(profiles, known)) {
    throw InvalidInput(gate.where() + "/profiles", excerpt(profiles), "it must be an array of \"ci\" and \"full\"");
  }
  return std::ranges::find(profiles, report.value("profile", Json())) != profiles.end();
}

}  // namespace

std::vector<GateVerdict> evaluate_gates(const Json& gates, const Json& report) {
  const Fields file(gates, "", {"schema", "gates"});
  if (file.text("schema") != "vlbeam.gates/1") {
    throw InvalidInput("/schema", excerpt(gates.at("schema")), "it must be \"vlbeam.gates/1\"");
  }
  const Json& list = file.at("gates");
  if (!list.is_array()) throw InvalidInput("/gates", excerpt(list), "it must be an array of gates");

  std::vector<GateVerdict> verdicts;
  const std::string status = report.value("status", "");
  if (status != "completed") {
    verdicts.push_back({.name = "status",
                        .kind = GateKind::exact,
                        .value = nan,
                        .bound = "completed",
                        .reason = "numbers of a study that did not complete prove nothing",
                        .failure = "the study's status is \"" + status + "\""});
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Fields gate(list[i], "/gates/" + std::to_string(i),
                      {"name", "kind", "reason", "guards", "profiles", "quantity", "max", "min", "equals", "tolerance",
                       "uncertainty", "fit", "order"});
    GateVerdict verdict{.name = gate.text("name"), .kind = kind_of(gate), .reason = reason_of(gate)};
    if (!names.insert(verdict.name).second) {
      throw InvalidInput(gate.where() + "/name", "\"" + verdict.name + "\"", "two gates need two names");
    }
    if (gate.has("quantity") == gate.has("fit")) {
      throw InvalidInput(gate.where(), "this gate", "it must have either \"quantity\" or \"fit\"");
    }
    gate.has("fit") ? judge_order(gate, report, verdict) : judge_bounds(gate, report, verdict);
    if (applies(gate, report)) verdicts.push_back(verdict);
  }
  return verdicts;
}

bool all_passed(const std::vector<GateVerdict>& verdicts) {
  return std::ranges::all_of(verdicts, [](const GateVerdict& verdict) { return verdict.passed; });
}

Json gates_to_json(const std::vector<GateVerdict>& verdicts) {
  Json list = Json::array();
  for (const GateVerdict& verdict : verdicts) {
    Json gate = {{"name", verdict.name},
                 {"kind", to_string(verdict.kind)},
                 {"value", std::isfinite(verdict.value) ? Json(verdict.value) : Json()},
                 {"bound", verdict.bound},
                 {verdict.kind == GateKind::regression ? "guards" : "reason", verdict.reason},
                 {"passed", verdict.passed}};
    if (verdict.uncertainty > 0) gate["uncertainty"] = verdict.uncertainty;
    if (!verdict.passed) gate["failure"] = verdict.failure;
    list.push_back(gate);
  }
  return list;
}

Json kinds_to_json(const std::vector<GateVerdict>& verdicts) {
  Json counts = Json::object();
  for (const auto& kind : names(GateKind{})) {
    counts[std::string(kind.name)] = std::ranges::count(verdicts, kind.value, &GateVerdict::kind);
  }
  return counts;
}

std::string kinds_text(const std::vector<GateVerdict>& verdicts) {
  const auto count = [&](GateKind kind) {
    return std::to_string(std::ranges::count(verdicts, kind, &GateVerdict::kind)) + " ";
  };
  return count(GateKind::exact) + "exact, " + count(GateKind::independent) + "independent, " + count(GateKind::self) +
         "self; " + count(GateKind::regression) + "regression, which are no evidence";
}

std::string gates_text(const std::string& title, const std::vector<GateVerdict>& verdicts) {
  std::ostringstream text;
  text.precision(6);
  text << title << '\n';
  std::size_t width = 0;
  for (const GateVerdict& verdict : verdicts) width = std::max(width, verdict.name.size());
  for (const GateVerdict& verdict : verdicts) {
    text << (verdict.passed ? "  passed  " : "  FAILED  ") << verdict.name
         << std::string(width - verdict.name.size() + 2, ' ') << std::left << std::setw(13) << to_string(verdict.kind);
    if (verdict.passed) {
      text << verdict.value;
      if (verdict.uncertainty > 0) text << " ± " << verdict.uncertainty;
      text << "  (" << verdict.bound << ")\n";
    } else {
      text << verdict.failure << "  (" << verdict.reason << ")\n";
    }
  }
  const auto failed = std::ranges::count_if(verdicts, [](const GateVerdict& verdict) { return !verdict.passed; });
  text << "  " << verdicts.size() << " gates evaluated, " << failed << " failed: " << kinds_text(verdicts) << '\n';
  return text.str();
}

}  // namespace vlbeam
