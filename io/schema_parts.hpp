#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

/// The keys of a JSON pointer.
inline std::vector<std::string> segments(std::string_view pointer) {
  std::vector<std::string> list;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const auto end = std::min(pointer.find('/'), pointer.size());
    list.emplace_back(pointer.substr(0, end));
    pointer.remove_prefix(end);
  }
  return list;
}

inline Json array_of(const Json& items) { return {{"type", "array"}, {"items", items}}; }

inline Json with_head(const char* title, const Json& schema) {
  Json result = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  result.update(schema);
  return result;
}

}  // namespace vlbeam
