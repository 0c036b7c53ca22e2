#include "io/schema.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/assembly_json.hpp"
#include "io/scene_json.hpp"
#include "io/schema_parts.hpp"
#include "scene/build.hpp"
#include "scene/options.hpp"
#include "scene/sample_quantities.hpp"
#include "scene/scene_options.hpp"

namespace vlbeam {
namespace {

Json empty_object() { return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}}; }

/// Where a condition holds: the option it names has the value it names. `given` asks for the key itself, which a
/// default may stand in for.
Json where(const std::vector<std::string>& path, std::size_t from, const Json& leaf, bool given) {
  if (from == path.size()) return leaf;
  Json schema = {{"properties", {{path[from], where(path, from + 1, leaf, given)}}}};
  if (given) schema["required"] = {path[from]};
  return schema;
}

/// The choice or the number that a scene holds for an option; null where it leaves it open, and for what no setting
/// decides.
template <class T>
Json value_of(const T& member) {
  if constexpr (NamedEnum<T>) {
    return to_string(member);
  } else if constexpr (OptionalEnum<T>) {
    return member ? Json(to_string(*member)) : Json();
  } else if constexpr (OptionalNumber<T>) {
    return member ? Json(*member) : Json();
  } else {
    return {};
  }
}

/// What the paper's setting decides: values by pointer.
class PaperValues {
 public:
  PaperValues() { visit_options(*this, scene_); }

  template <class T>
  void operator()(const Option& option, const T& member) {
    values_[std::string(option.pointer)] = value_of(member);
  }
  template <class T>
  bool present(const Option&, const std::optional<T>& part) {
    return part.has_value();
  }
  template <class T>
  bool number_or(const Option&, double, const std::optional<T>& part) {
    return part.has_value();
  }
  template <class T>
  void list(const Option&, const std::vector<T>&) {}
  void section(const Option&) {}

  /// What a description adds where the setting has another value than `usual`.
  std::string text(const Option& option, const Json& usual) const {
    const auto found = values_.find(std::string(option.pointer));
    if (found == values_.end() || found->second.is_null() || found->second == usual) return "";
    return "; in the setting " + std::string(to_string(scene_.setting)) + " " + found->second.dump();
  }

 private:
  const Scene scene_ = scene_in(SceneSetting::ding_ouyang_2022);
  std::map<std::string, Json> values_;
};

/// Collects the schema of a scene, option by option.
class SceneSchemaBuilder {
 public:
  template <class T>
  void operator()(const Option& option, const T& member) {
    const auto path = segments(option.pointer);
    Json& parent = object(path, path.size() - 1);
    Json& schema = parent["properties"][path.back()];
    schema = type<T>(option);
    const bool setting = option.pointer == "/setting";
    schema["description"] = description(option) + (setting ? "" : paper_.text(option, value_of(member)));
    if constexpr (NamedEnum<T>) {
      if (!option.required) schema["default"] = option.standard.empty() ? to_string(member) : option.standard;
    } else if constexpr (std::same_as<T, Point>) {
      schema["default"] = Json::array();
      for (int i = 0; i < option.components; ++i) schema["default"].push_back(member[static_cast<std::size_t>(i)]);
    } else if constexpr (!OptionalNumber<T> && !OptionalEnum<T>) {
      if (!option.required) schema["default"] = member;
    }
    if (!option.when.pointer.empty()) {
      conditional(option, path);
    } else if (!option.instead.empty()) {
      const auto needs = [](const std::string& key) { return Json{{"required", Json::array({key})}}; };
      Json& any = parent["anyOf"] = Json::array({needs(path.back())});
      std::istringstream others{std::string(option.instead)};
      for (std::string key; others >> key;) any.push_back(needs(key));
    } else if (option.required) {
      Json& required = parent["required"];
      if (std::find(required.begin(), required.end(), path.back()) == required.end()) required.push_back(path.back());
    }
    if constexpr (NamedEnum<T>) defaults_[std::string(option.pointer)] = to_string(member);
  }

  template <class T>
  bool present(const Option& option, const std::optional<T>& part) {
    if (!part) throw std::logic_error("scene_with_every_part() lacks " + std::string(option.pointer));
    const auto path = segments(option.pointer);
    object(path, path.size())["description"] = option.description;
    return true;
  }

  template <class T>
  bool number_or(const Option& option, double standard, const std::optional<T>& part) {
    if (!part) throw std::logic_error("scene_with_every_part() lacks " + std::string(option.pointer));
    const auto path = segments(option.pointer);
    Json& schema = object(path, path.size());  // what is said of objects does not hold for numbers, and the reverse
    schema.update(number("number", option.range));
    schema["type"] = Json::array({"number", "object"});
    schema["description"] = description(option);
    if (!option.required) {
      schema["default"] = standard;
      return true;
    }
    Json& required = object(path, path.size() - 1)["required"];
    if (std::find(required.begin(), required.end(), path.back()) == required.end()) required.push_back(path.back());
    return true;
  }

  template <class T>
  void list(const Option& option, const std::vector<T>&) {
    const auto path = segments(option.pointer);
    Json& parent = object(path, path.size() - 1);
    parent["properties"][path.back()] = {
        {"type", "array"}, {"items", empty_object()}, {"description", option.description}};
  }

  void section(const Option& option) {
    const auto path = segments(option.pointer);
    Json& description = object(path, path.size())["description"];
    if (description.is_null()) description = option.description;
    if (option.required) object(path, path.size() - 1)["required"].push_back(path.back());
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
      for (const auto& entry : names(T{})) {
        if (option.allows(entry.name)) choices.push_back(entry.name);
      }
      return {{"enum", choices}};
    } else if constexpr (OptionalEnum<T> || OptionalNumber<T>) {
      return type<typename T::value_type>(option);
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
    } else if constexpr (std::same_as<T, std::vector<int>>) {
      return array_of(number("integer", option.range));
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
    Json& entry = items["properties"][key];
    entry["description"] = "which of them this is";
    Json& choices = entry["enum"];
    if (std::find(choices.begin(), choices.end(), value) == choices.end()) choices.push_back(value);
    if (!items.contains("required")) items["required"] = {key};
    return items;
  }

  /// Where the condition of an option does not hold the option must not stand; where it holds, a required one must.
  void conditional(const Option& option, const std::vector<std::string>& path) {
    const std::size_t depth = list_depth(path);
    auto target = path;
    Json* scope = &root_;
    if (depth > 0) {  // conditions of a list's entries stay within the entry
      scope = &object(path, depth);
      target.erase(target.begin(), target.begin() + static_cast<std::ptrdiff_t>(depth));
    }
    Json condition = holds(option.when, depth);
    if (!option.when.or_else.empty()) {
      condition = {{"anyOf", Json::array({condition})}};
      for (const Condition& other : option.when.or_else) condition["anyOf"].push_back(holds(other, depth));
    }
    Json rule = {{"if", condition}};
    if (option.required) rule["then"] = where(target, 0, true, true);
    rule["else"] = where(target, 0, false, false);
    Json& rules = (*scope)["allOf"];
    if (std::find(rules.begin(), rules.end(), rule) == rules.end()) rules.push_back(rule);
  }

  /// The schema of where a condition holds by itself, from the given depth on.
  Json holds(const Condition& when, std::size_t depth) const {
    const auto standard = defaults_.find(std::string(when.pointer));
    const auto& values = when.values;
    const bool by_default = standard != defaults_.end() && std::ranges::find(values, standard->second) != values.end();
    const Json is = values.size() == 1 ? Json{{"const", values.front()}} : Json{{"enum", values}};
    return where(segments(when.pointer), depth, is, !by_default);
  }

  /// Segments up to and including the entry of a list, 0 outside lists.
  static std::size_t list_depth(const std::vector<std::string>& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (in_list(path[i])) return i + 1;
    }
    return 0;
  }

  const PaperValues paper_;
  Json root_ = empty_object();
  std::map<std::string, std::string> defaults_;
};

/// A file has supports of points between the ends in /supports, too: an entry is of the one kind or the other, by what
/// its place is.
void put_among_supports(Json& properties) {
  const Json between = properties.at("bearings").at("items");
  properties.erase("bearings");
  Json& items = properties.at("supports").at("items");
  const auto keys_of = [](const Json& entry) {
    Json keys = Json::array();
    for (const auto& [key, value] : entry.at("properties").items()) keys.push_back(key);
    return keys;
  };
  const auto rules_of = [&](const Json& entry) {
    Json rules = {{"propertyNames", {{"enum", keys_of(entry)}}},
                  {"properties", {{"type", {{"enum", entry.at("properties").at("type").at("enum")}}}}},
                  {"required", entry.at("required")}};
    if (entry.contains("allOf")) rules["allOf"] = entry.at("allOf");
    if (entry.contains("anyOf")) rules["anyOf"] = entry.at("anyOf");
    return rules;
  };
  const Json of_ends = rules_of(items), of_others = rules_of(between);
  Json both = items;
  both.erase("allOf");
  both.erase("anyOf");
  both["required"] = Json::array({"at", "type"});
  for (const auto& [key, value] : between.at("properties").items()) {
    if (!both["properties"].contains(key)) both["properties"][key] = value;
  }
  Json place = between.at("properties").at("at");
  const Json end = items.at("properties").at("at");
  place["required"] = Json::array({"x"});
  both["properties"]["at"] = {{"description", "an end of the beam, or a point between them"},
                              {"anyOf", Json::array({{{"enum", end.at("enum")}}, place})}};
  Json& types = both["properties"]["type"];
  for (const Json& type : between.at("properties").at("type").at("enum")) {
    if (std::ranges::find(types["enum"], type) == types["enum"].end()) types["enum"].push_back(type);
  }
  types["description"] = types.at("description").get<std::string>() + "; between the ends: " +
                         between.at("properties").at("type").at("description").get<std::string>();
  both["if"] = {{"properties", {{"at", {{"type", "object"}}}}}};
  both["then"] = of_others;
  both["else"] = of_ends;
  items = both;
}

}  // namespace

Json scene_schema() {
  SceneSchemaBuilder builder;
  const Scene scene = scene_with_every_part();
  visit_options(builder, scene);
  Json schema = builder.schema();
  put_among_supports(schema["properties"]);
  Json& integrator = schema["properties"]["integrator"];
  const Json automatic = {
      {"const", "auto"},
      {"description",
       "generalized-alpha or dopri5, which takes less work for an accuracy of 1e-4; the same as {\"accuracy\": 1e-4}"}};
  integrator = {{"description", integrator.at("description")},
                {"default", automatic.at("const")},
                {"anyOf", {automatic, integrator}}};
  add_assembly_schema(schema);
  schema["$id"] = "https://vlbeam.example/scene";  // what it refers to is in it, wherever it stands
  return with_head("vlbeam scene", schema);
}

}  // namespace vlbeam
