#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/json.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Reads a scene and checks it. Throws InvalidInput naming the key by JSON pointer, its value and what is allowed;
/// an unknown key comes with the nearest known one.
Scene scene_from_json(Json json);
Scene parse_scene(std::string_view text);
/// Of a file, which its errors name; "-" is standard input.
Scene read_scene(const std::filesystem::path& file);

/// Keys that the object under a top-level key of a scene may have.
std::vector<std::string> known_keys(const std::string& part);

/// The scene as understood, every default filled in. Reads back as the same scene.
Json scene_to_json(const Scene& scene);

/// A scene on which every option of the table is visited.
Scene scene_with_every_part();

}  // namespace vlbeam
