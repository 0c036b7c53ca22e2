#include "tools/scene_sweep.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "io/scene_json.hpp"

namespace vlbeam {
namespace {

/// Refuses an entry of a list beyond the next one: the list would be filled up to it, and memory with that.
void refuse_gaps(const Json& scene, const Json::json_pointer& pointer) {
  std::vector<std::string> keys;
  for (Json::json_pointer rest = pointer; !rest.empty(); rest.pop_back()) keys.push_back(rest.back());
  std::ranges::reverse(keys);
  const Json nothing;
  const Json* node = &scene;
  for (const std::string& key : keys) {
    constexpr std::size_t digits = 9;  // of no list's size are there more
    const bool is_number =
        !key.empty() && std::ranges::all_of(key, [](unsigned char c) { return std::isdigit(c) != 0; });
    const bool is_list = node->is_array() || node->is_null();  // which a number makes a list
    if (is_list && is_number && (key.size() > digits || std::stoul(key) > node->size())) {
      throw InvalidInput(pointer.to_string(), "entry " + key + " of a list of " + std::to_string(node->size()),
                         "it must be one that is there, or the next one");
    }
    const Json::json_pointer child = Json::json_pointer() / key;
    node = node->contains(child) ? &node->at(child) : &nothing;
  }
}

}  // namespace

void assign_option(Json& scene, const std::string& pointers, const Json& value) {
  std::istringstream words(pointers);
  for (std::string pointer; words >> pointer;) {
    try {
      const Json::json_pointer at(pointer);
      refuse_gaps(scene, at);
      scene[at] = value;
    } catch (const Json::exception&) {
      throw InvalidInput(pointer, "this pointer", "it must lead to an option of the scene, like /beam/elements");
    }
  }
}

std::vector<SceneCase> read_scene_cases(const Json& config) {
  std::vector<SceneCase> cases;
  for (const auto& [name, sweep] : config.at("sweeps").items()) {
    const Json set = sweep.value("set", Json::object());
    const Json over = sweep.value("over", Json::object());
    Json first = config.at("scene");
    for (const auto& [pointers, value] : set.items()) assign_option(first, pointers, value);
    std::vector<Json> scenes{first};
    for (const auto& [pointers, values] : over.items()) {
      std::vector<Json> combined;
      for (const Json& scene : scenes) {
        for (const Json& value : values) {
          combined.push_back(scene);
          assign_option(combined.back(), pointers, value);
        }
      }
      scenes = std::move(combined);
    }
    for (const Json& scene : scenes) {
      try {
        cases.push_back({name, scene_from_json(scene)});
      } catch (const InvalidInput& error) {
        throw InvalidInput("/sweeps/" + name + error.field, error.value, error.allowed);
      }
    }
  }
  return cases;
}

}  // namespace vlbeam
