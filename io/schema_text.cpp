#include "io/schema_text.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "io/nearest.hpp"

namespace vlbeam {
namespace {

bool is_index(const std::string& segment) {
  return !segment.empty() && segment.find_first_not_of("0123456789N") == std::string::npos;
}

/// What the entries of a list are, where this is one.
const Json& entry_of(const Json& schema) {
  static const Json nothing = Json::object();
  return schema.contains("items") ? schema.at("items") : nothing;
}

std::string limits(const Json& schema) {
  const auto number = [&](const char* key) { return schema.at(key).dump(); };
  std::string text;
  for (const auto& [key, sign] : {std::pair{"exclusiveMinimum", " > "}, std::pair{"minimum", " >= "},
                                  std::pair{"exclusiveMaximum", " < "}, std::pair{"maximum", " <= "}}) {
    if (schema.contains(key)) text += (text.empty() ? "" : ",") + (sign + number(key));
  }
  return text;
}

/// "number > 0", "one of "a", "b"", "list of numbers".
std::string kind_of(const Json& schema) {
  if (schema.contains("$ref")) return schema.value("description", "as elsewhere");
  if (schema.contains("const")) return schema.at("const").dump();
  if (schema.contains("enum")) {
    std::string text;
    for (const Json& choice : schema.at("enum")) text += (text.empty() ? "" : " | ") + choice.dump();
    return text;
  }
  if (!schema.contains("type")) return schema.contains("anyOf") ? "one of several" : "anything";
  if (schema.at("type").is_array()) {
    std::string text;
    for (const Json& type : schema.at("type")) text += (text.empty() ? "" : " or ") + type.get<std::string>();
    return text + limits(schema);
  }
  const std::string type = schema.at("type");
  if (type != "array") return type + limits(schema);
  const Json& entry = entry_of(schema);
  return "list" + (entry.contains("type") ? " of: " + kind_of(entry) : "");
}

void write(const Json& schema, const std::string& at, bool required, std::ostream& out) {
  if (!at.empty()) {
    out << at << "  " << kind_of(schema);
    if (required) out << "  required";
    if (schema.contains("default")) out << "  default " << schema.at("default").dump();
    out << '\n';
    if (schema.contains("description") && !schema.contains("$ref"))
      out << "    " << schema.at("description").get<std::string>() << '\n';
  }
  const auto below = [&out](const Json& object, const std::string& from) {
    if (!object.contains("properties")) return;
    const Json needed = object.value("required", Json::array());
    for (const auto& item : object.at("properties").items()) {
      const bool must = std::find(needed.begin(), needed.end(), item.key()) != needed.end();
      write(item.value(), from + "/" + item.key(), must, out);
    }
  };
  below(schema, at);
  for (const Json& choice : schema.value("anyOf", Json::array())) below(choice, at);
  below(entry_of(schema), at + "/N");
}

/// The schema of a key of an object, or of what it may be instead; null if there is none.
const Json* property(const Json& schema, const std::string& key, std::vector<std::string>& known) {
  const Json* found = nullptr;
  if (schema.contains("properties")) {
    for (const auto& item : schema.at("properties").items()) {
      known.push_back(item.key());
      if (item.key() == key) found = &item.value();
    }
  }
  if (schema.contains("anyOf")) {
    for (const Json& choice : schema.at("anyOf")) {
      if (const Json* const there = property(choice, key, known)) found = there;
    }
  }
  return found;
}

}  // namespace

Json part_of_schema(const Json& schema, const std::string& pointer) {
  if (pointer.empty() || pointer == "/") return schema;
  if (pointer.front() != '/') refuse("part", "\"" + pointer + "\"", "it must begin with /, like /beam/material");
  const Json* part = &schema;
  std::istringstream segments(pointer.substr(1));
  for (std::string segment; std::getline(segments, segment, '/');) {
    if (part->contains("items") && is_index(segment)) {
      part = &part->at("items");
      continue;
    }
    const Json& object =
        part->contains("items") ? part->at("items") : *part;  // the number of the entry may be left out
    std::vector<std::string> known;
    part = property(object, segment, known);
    if (part == nullptr) {
      refuse("part", "\"" + pointer + "\"",
             known.empty() ? "there is nothing below /" + segment
                           : "the nearest to \"" + segment + "\" is \"" + nearest_of(segment, known) + "\"");
    }
  }
  return *part;
}

std::string schema_text(const Json& schema, const std::string& pointer) {
  std::ostringstream out;
  write(schema, pointer == "/" ? "" : pointer, false, out);
  return out.str();
}

}  // namespace vlbeam
