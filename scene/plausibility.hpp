#pragma once

#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Warns of numbers in a scene, or in its result, that look wrong. Each names the key whose unit or value to check.
std::vector<Warning> implausible(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
