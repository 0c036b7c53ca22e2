#pragma once

#include "io/json.hpp"
#include "scene/assembly.hpp"

namespace vlbeam {

/// Whether a scene file has several beams and bodies.
bool is_assembly(const Json& json);

/// Reads such a scene and checks it; throws as scene_from_json().
Scene assembly_from_json(Json json);

/// The scene as understood, every default filled in. Reads back as the same scene.
Json assembly_to_json(const Scene& whole);

/// Adds to the schema of a scene of one beam what `beams`, `bodies` and `links` may be.
void add_assembly_schema(Json& scene);

}  // namespace vlbeam
