#pragma once

#include <array>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace vlbeam {

/// Where a field of the model stands in a scene, as a JSON pointer.
inline std::string pointer_to(const std::string& field) {
  constexpr std::array<std::pair<const char*, const char*>, 14> places{{
      {"mesh motion", "/flow/nodes"},
      {"weights", "/beam/weights"},
      {"supports", "/supports"},
      {"rotary inertia", "/beam/rotary_inertia"},
      {"tension", "/flow/tension"},
      {"drives", "/spin/drives"},
      {"loads", "/loads"},
      {"integrator", "/integrator/type"},
      {"velocities at events", "/length_control/velocities"},
      {"radius", "/beam/section/radius"},
      {"density", "/beam/material/density"},
      {"youngs_modulus", "/beam/material/youngs_modulus"},
      {"poisson_ratio", "/beam/material/poisson_ratio"},
      {"damping", "/beam/material/damping"},
  }};
  for (const auto& [name, pointer] : places) {
    if (field == name) return pointer;
  }
  return field;
}

/// Calls `function`, which works on a scene. If the core finds fault with the model, the error names the scene's key.
template <class Function>
auto of_scene(const Function& function) {
  try {
    return function();
  } catch (const ModelError& error) {
    throw InvalidInput(pointer_to(error.field), error.value, error.allowed);
  }
}

}  // namespace vlbeam
