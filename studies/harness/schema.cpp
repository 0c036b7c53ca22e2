#include "studies/harness/schema.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/options.hpp"
#include "studies/harness/scene_json.hpp"

namespace vlbeam {
namespace {

constexpr const char* draft = "https://json-schema.org/draft/2020-12/schema";

std::vector<std::string> segments(std::string_view pointer) {
  std::vector<std::string> list;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const auto end = std::min(pointer.find('/'), pointer.size());
    list.emplace_back(pointer.substr(0, end));
    pointer.remove_prefix(end);
  }
  return list;
}

Json array_of(const Json& items) { return {{"type", "array"}, {"items", items}}; }
Json empty_object() { return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}}; }

/// Where a condition holds: the option it names has the value it names. `given` asks for the key itself, which a
/// default may stand in for.
Json where(const std::vector<std::string>& path, std::size_t from, const Json& leaf, bool given) {
  if (from == path.size()) return leaf;
  Json schema = {{"properties", {{path[from], where(path, from + 1, leaf, given)}}}};
  if (given) schema["required"] = {path[from]};
  return schema;
}

/// Collects the schema of a scene, option by option.
class SceneSchemaBuilder {
 public:
  template <class T>
  void operator()(const Option& option, const T& member) {
    const auto path = segments(option.pointer);
    Json& parent = object(path, path.size() - 1);
    Json& schema = parent["properties"][path.back()];
    schema = type<T>(option);
    schema["description"] = description(option);
    if constexpr (NamedEnum<T>) {
      schema["default"] = to_string(member);
    } else if constexpr (std::same_as<T, Point>) {
      schema["default"] = Json::array();
      for (int i = 0; i < option.components; ++i) schema["default"].push_back(member[static_cast<std::size_t>(i)]);
    } else if constexpr (!std::same_as<T, std::optional<double>>) {
      if (!option.required) schema["default"] = member;
    }
    if (!option.when.pointer.empty()) {
      conditional(option, path);
    } else if (option.required) {
      Json& required = parent["required"];
      if (std::find(required.begin(), required.end(), path.back()) == required.end()) required.push_back(path.back());
    }
    if constexpr (NamedEnum<T>) defaults_[std::string(option.pointer)] = to_string(member);
  }

  template <class T>
  bool present(const Option& option, const std::optional<T>&) {
    const auto path = segments(option.pointer);
    object(path, path.size())["description"] = option.description;
    return true;
  }

  template <class T>
  void list(const Option& option, const std::vector<T>&) {
    const auto path = segments(option.pointer);
    Json& parent = object(path, path.size() - 1);
    parent["properties"][path.back()] = {
        {"type", "array"}, {"items", empty_object()}, {"description", option.description}};
  }

  Json schema() const { return root_; }

 private:
  static std::string description(const Option& option) {
    std::string text(option.description);
    if (!option.unit.empty() && option.unit != "-") text += " [" + std::string(option.unit) + "]";
    if (!option.source.empty()) text += " (" + std::string(option.source) + ")";
    return text;
  }

  static Json number(const char* type, const Range& range) {
    Json schema = {{"type", type}};
    if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
    return schema;
  }

  template <class T>
  static Json type(const Option& option) {
    if constexpr (NamedEnum<T>) {
      Json choices = Json::array();
      for (const auto& entry : names(T{})) choices.push_back(entry.name);
      return {{"enum", choices}};
    } else if constexpr (std::same_as<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::same_as<T, std::string>) {
      return {{"type", "string"}};
    } else if constexpr (std::same_as<T, int>) {
      return number("integer", option.range);
    } else if constexpr (std::same_as<T, Point>) {
      return {{"type", "array"}, {"items", number("number", option.range)}, {"minItems", 2}, {"maxItems", 3}};
    } else if constexpr (std::same_as<T, std::array<double, 4>>) {
      return {{"type", "array"}, {"items", number("number", option.range)}, {"minItems", 4}, {"maxItems", 4}};
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      return {{"type", "array"}, {"items", number("number", option.range)}};
    } else if constexpr (std::same_as<T, std::vector<Point>>) {
      return array_of({{"type", "array"}, {"items", number("number", option.range)}, {"minItems", 2}, {"maxItems", 3}});
    } else {
      return number("number", option.range);
    }
  }

  /// Whether a segment, "at=start" or "0", is an entry of a list.
  static bool in_list(const std::string& segment) {
    return segment.find('=') != std::string::npos || segment.find_first_not_of("0123456789") == std::string::npos;
  }

  /// The object schema that the first `depth` segments of a path lead to. A segment "at=start" or "0" leads to the
  /// items of a list; its entries are alike, so that one schema serves them all.
  Json& object(const std::vector<std::string>& path, std::size_t depth) {
    Json* node = &root_;
    for (std::size_t i = 0; i < depth; ++i) {
      if (const auto equals = path[i].find('='); equals != std::string::npos) {
        node = &entry_of_list(*node, path[i].substr(0, equals), path[i].substr(equals + 1));
        continue;
      }
      if (in_list(path[i])) {
        node = &(*node)["items"];
        continue;
      }
      const bool list = i + 1 < path.size() && in_list(path[i + 1]);
      Json& child = (*node)["properties"][path[i]];
      if (child.is_null()) child = list ? Json{{"type", "array"}, {"items", empty_object()}} : empty_object();
      node = &child;
    }
    return *node;
  }

  static Json& entry_of_list(Json& list, const std::string& key, const std::string& value) {
    Json& items = list["items"];
    Json& choices = items["properties"][key]["enum"];
    if (std::find(choices.begin(), choices.end(), value) == choices.end()) choices.push_back(value);
    if (!items.contains("required")) items["required"] = {key};
    return items;
  }

  /// Where the condition of an option does not hold the option must not stand; where it holds, a required one must.
  void conditional(const Option& option, const std::vector<std::string>& path) {
    auto condition = segments(option.when.pointer);
    auto target = path;
    Json* scope = &root_;
    if (const auto depth = list_depth(path)) {  // conditions of a list's entries stay within the entry
      scope = &object(path, depth);
      condition.erase(condition.begin(), condition.begin() + static_cast<std::ptrdiff_t>(depth));
      target.erase(target.begin(), target.begin() + static_cast<std::ptrdiff_t>(depth));
    }
    const auto standard = defaults_.find(std::string(option.when.pointer));
    const auto& values = option.when.values;
    const bool by_default = standard != defaults_.end() && std::ranges::find(values, standard->second) != values.end();
    const Json is = values.size() == 1 ? Json{{"const", values.front()}} : Json{{"enum", values}};
    Json rule = {{"if", where(condition, 0, is, !by_default)}};
    if (option.required) rule["then"] = where(target, 0, true, true);
    rule["else"] = where(target, 0, false, false);
    Json& rules = (*scope)["allOf"];
    if (std::find(rules.begin(), rules.end(), rule) == rules.end()) rules.push_back(rule);
  }

  /// Segments up to and including the entry of a list, 0 outside lists.
  static std::size_t list_depth(const std::vector<std::string>& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (in_list(path[i])) return i + 1;
    }
    return 0;
  }

  Json root_ = empty_object();
  std::map<std::string, std::string> defaults_;
};

Json record(const Json& properties, const std::vector<std::string>& optional = {}) {
  Json required = Json::array();
  for (const auto& item : properties.items()) {
    if (std::find(optional.begin(), optional.end(), item.key()) == optional.end()) required.push_back(item.key());
  }
  return {{"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
}

Json with_head(const char* title, const Json& schema) {
  Json result = {{"$schema", draft}, {"title", title}};
  result.update(schema);
  return result;
}

const Json number = {{"type", "number"}};
const Json number_or_null = {{"type", {"number", "null"}}};
const Json text = {{"type", "string"}};
const Json whole = {{"type", "integer"}, {"minimum", 0}};
const Json point = {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 3}};
const Json point_or_null = {
    {"type", {"array", "null"}}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 3}};
const Json any_object = {{"type", "object"}};

Json choice(const std::vector<std::string>& values) { return {{"enum", values}}; }

template <NamedEnum E>
Json choice_of() {
  std::vector<std::string> values;
  for (const auto& entry : names(E{})) values.emplace_back(entry.name);
  return choice(values);
}

}  // namespace

Json scene_schema() {
  SceneSchemaBuilder builder;
  const Scene scene = scene_with_every_part();
  visit_options(builder, scene);
  return with_head("vlbeam scene", builder.schema());
}

Json run_schema() {
  const Json numbers = array_of(number_or_null);
  const Json energy = record({{"kinetic", numbers},
                              {"axial", numbers},
                              {"bending", numbers},
                              {"torsion", numbers},
                              {"gravity", numbers},
                              {"dissipated", numbers},
                              {"supplied", numbers},
                              {"total", numbers},
                              {"discrete_total", numbers}},
                             {"supplied"});
  const Json reaction = record({{"position", array_of(point)}, {"slope", array_of(point)}});
  const Json flow =
      record({{"mass", numbers},
              {"end_angles", array_of(array_of(number))},
              {"spin_momentum", numbers},
              {"loads", array_of(array_of(point))},
              {"ledger", record({{"mass", numbers}, {"ends", numbers}, {"loads", numbers}, {"mesh", numbers}})}},
             {"end_angles", "spin_momentum", "loads", "ledger"});
  const Json samples = record({{"t", array_of(number)},
                               {"joint_position", numbers},
                               {"mass_position", array_of(point_or_null)},
                               {"end", array_of(point)},
                               {"beam_length", numbers},
                               {"beam_length_rate", numbers},
                               {"energy", energy},
                               {"momentum", array_of(point)},
                               {"reactions", record({{"start", reaction}, {"end", reaction}}, {"start", "end"})},
                               {"flow", flow}},
                              {"flow"});
  const Json configuration = record({{"t", number},
                                     {"x", array_of(number)},
                                     {"r", array_of(point)},
                                     {"r_x", array_of(point)},
                                     {"weights", array_of(array_of(number))},
                                     {"angles", array_of(number)},
                                     {"kink", record({{"node", whole}, {"r_x", point}})}},
                                    {"kink", "angles"});
  const Json event = record({{"t", number},
                             {"type", choice_of<EventType>()},
                             {"joint_position", number},
                             {"weights", array_of(number)},
                             {"unit_fallback", {{"type", "boolean"}}},
                             {"energy_jumps", record({{"kinetic", number_or_null},
                                                      {"axial", number_or_null},
                                                      {"bending", number_or_null},
                                                      {"gravity", number_or_null},
                                                      {"discrete_total", number_or_null}})},
                             {"momentum_jumps", array_of(number)}});
  const Json solver = record({{"steps", whole},
                              {"rejected", whole},
                              {"rhs_evaluations", whole},
                              {"smallest_step", number_or_null},
                              {"newton_iterations", whole},
                              {"tangents", whole},
                              {"longest_newton_iteration", array_of(number)},
                              {"constraint_residual", record({{"position", number}, {"velocity", number}})},
                              {"slope_residual", record({{"position", number}, {"velocity", number}})},
                              {"largest_kinetic_energy", number_or_null},
                              {"largest_energy_drift", number_or_null}});
  Json scene = scene_schema();
  scene.erase("$schema");
  return with_head("vlbeam run report", record({{"schema_version", {{"const", "vlbeam.run/1"}}},
                                                {"status", choice_of<RunStatus>()},
                                                {"failure", record({{"message", text}, {"t", number}})},
                                                {"scene", scene},
                                                {"samples", samples},
                                                {"configurations", array_of(configuration)},
                                                {"events", array_of(event)},
                                                {"solver", solver},
                                                {"provenance", any_object},
                                                {"timing", any_object}},
                                               {"failure"}));
}

Json study_schema() {
  const Json profile = choice({"ci", "full"});
  const Json cell = {{"type", {"number", "string", "boolean", "null"}}};
  const Json study_case =
      record({{"options", Json::object()}, {"results", Json::object()}, {"failure", text}}, {"failure"});
  const Json fit = record({{"quantity", text},
                           {"levels", array_of(number)},
                           {"errors", array_of(number_or_null)},
                           {"pairwise_orders", array_of(number_or_null)},
                           {"slope", number_or_null},
                           {"used", whole},
                           {"fitted", whole}});
  const Json gate = record({{"name", text},
                            {"value", number_or_null},
                            {"bound", text},
                            {"reason", text},
                            {"passed", {{"type", "boolean"}}},
                            {"failure", text}},
                           {"failure"});
  const Json table = record({{"name", text},
                             {"caption", text},
                             {"file", text},
                             {"columns", array_of(text)},
                             {"rows", array_of(array_of(cell))}},
                            {"rows"});
  const Json figure = record({{"name", text}, {"caption", text}, {"file", text}});
  return with_head("vlbeam study report",
                   record({{"schema_version", {{"const", "vlbeam.study/1"}}},
                           {"study", text},
                           {"profile", profile},
                           {"status", choice({"completed", "failed", "interrupted"})},
                           {"failure", text},
                           {"measured", {{"type", "object"}, {"additionalProperties", number_or_null}}},
                           {"cases", array_of(study_case)},
                           {"fits", array_of(fit)},
                           {"gates", array_of(gate)},
                           {"tables", array_of(table)},
                           {"figures", array_of(figure)}},
                          {"failure"}));
}

Json gates_schema() {
  const Json nonempty = {{"type", "string"}, {"minLength", 1}};
  const Json order =
      record({{"expected", number}, {"tolerance", number}, {"at_most", number}, {"finest_error", number}});
  Json gate = record({{"name", nonempty},
                      {"reason", nonempty},
                      {"profiles", {{"type", "array"}, {"items", choice({"ci", "full"})}, {"minItems", 1}}},
                      {"quantity", nonempty},
                      {"max", number},
                      {"min", number},
                      {"equals", number},
                      {"tolerance", {{"type", "number"}, {"minimum", 0}}},
                      {"fit", nonempty},
                      {"order", order}},
                     {"profiles", "quantity", "max", "min", "equals", "tolerance", "fit", "order"});
  const auto needs = [](const char* key) { return Json{{"required", {key}}}; };
  gate["oneOf"] = Json::array({needs("quantity"), needs("fit")});
  gate["dependentSchemas"] = {{"quantity", {{"anyOf", Json::array({needs("max"), needs("min"), needs("equals")})}}},
                              {"fit", needs("order")},
                              {"tolerance", needs("equals")}};
  return with_head("vlbeam gates", record({{"schema", {{"const", "vlbeam.gates/1"}}}, {"gates", array_of(gate)}}));
}

}  // namespace vlbeam
