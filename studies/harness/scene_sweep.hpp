#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "studies/harness/json.hpp"

namespace vlbeam {

/// One scene of a study's data, and the sweep it belongs to.
struct SceneCase {
  std::string sweep;
  Scene scene;
};

/// The scenes that a study's data describe: {"scene": {...}, "sweeps": {"name": {"set": {pointer: value}, "over":
/// {pointer: [values]}}}}. Each sweep starts from the scene, sets some options and takes all combinations of others; a
/// key may hold several pointers, separated by spaces, that get the same value. Throws InvalidInput.
std::vector<SceneCase> read_scene_cases(const Json& config);

}  // namespace vlbeam
