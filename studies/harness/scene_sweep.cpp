#include "studies/harness/scene_sweep.hpp"

#include <sstream>

#include "core/error.hpp"
#include "studies/harness/scene_json.hpp"

namespace vlbeam {

void assign_option(Json& scene, const std::string& pointers, const Json& value) {
  std::istringstream words(pointers);
  for (std::string pointer; words >> pointer;) {
    try {
      scene[Json::json_pointer(pointer)] = value;
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
