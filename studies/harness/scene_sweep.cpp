#include "studies/harness/scene_sweep.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "studies/harness/scene_json.hpp"

namespace vlbeam {
namespace {

/// Refuses an entry of a list beyond the next one: the lists between would be filled up to it, and memory with them.
void refuse_gaps(const Json& scene, const Json::json_pointer& pointer) {
  std::vector<std::string> keys;
  for (Json::json_pointer rest = pointer; !rest.empty(); rest.pop_back()) keys.push_back(rest.back());
  const Json* node = &scene;  // null where there is nothing yet
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
    const bool is_list = node == nullptr || node->is_null() || node->is_array();
    const std::size_t entries = node != nullptr && node->is_array() ? node->size() : 0;
    const bool is_number =
        !key->empty() && std::all_of(key->begin(), key->end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    constexpr std::size_t digits = 9;  // of no list's size are there more
    if (is_list && is_number && (key->size() > digits || std::stoul(*key) > entries)) {
      throw InvalidInput(pointer.to_string(), "entry " + *key + " of a list of " + std::to_string(entries),
                         "it must be one that is there, or the next one");
    }
    const bool leads_on = node != nullptr && (node->is_array() ? is_number && std::stoul(*key) < entries
                                                               : node->is_object() && node->contains(*key));
    node = !leads_on ? nullptr : node->is_array() ? &node->at(std::stoul(*key)) : &node->at(*key);
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
