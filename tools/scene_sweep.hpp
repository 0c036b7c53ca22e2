#pragma once

#include <string>
#include <vector>

#include "io/json.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// One scene of a study's data, and the sweep it belongs to.
struct SceneCase {
  std::string sweep;
  Scene scene;
};

/// Sets the options of a scene that `pointers` names by JSON pointers, separated by spaces. Throws InvalidInput where
/// they lead nowhere.
void assign_option(Json& scene, const std::string& pointers, const Json& value);

/// The scenes that a study's data describe: {"scene": {...}, "sweeps": {"name": {"set": {pointer: value}, "over":
/// {pointer: [values]}}}}. Each sweep starts from the scene, sets some options and takes all combinations of others; a
/// key may hold several pointers, separated by spaces, that get the same value. Throws InvalidInput.
std::vector<SceneCase> read_scene_cases(const Json& config);

}  // namespace vlbeam
