#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// Checks a scene before a model is built of it: every option within its range, and the rules that bind several.
/// Throws InvalidInput naming the first option that is not allowed.
void validate(const Scene& scene);

}  // namespace vlbeam
