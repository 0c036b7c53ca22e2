#pragma once

#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// What in a scene, or in what came of it, is hardly meant: it names the key whose unit or value to look at.
std::vector<Warning> implausible(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
