#include "tools/scene_library.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "io/files.hpp"
#include "io/nearest.hpp"

namespace vlbeam {

std::vector<LibraryScene> library_scenes(const std::filesystem::path& folder) {
  std::vector<LibraryScene> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    scenes.push_back({entry.path().stem().string(), read_json(entry.path()).value("title", "")});
  }
  std::ranges::sort(scenes, {}, &LibraryScene::name);
  return scenes;
}

std::string library_scene_text(const std::filesystem::path& folder, const std::string& name) {
  std::vector<std::string> names;
  for (const LibraryScene& scene : library_scenes(folder)) names.push_back(scene.name);
  if (std::ranges::find(names, name) == names.end()) {
    throw InvalidInput("scene", "\"" + name + "\"",
                       "the nearest is \"" + nearest_of(name, names) + "\" (there are: " + quoted_list(names) + ")");
  }
  return read_text(folder / (name + ".json"));
}

std::vector<SceneAnswer> scene_answers(const std::filesystem::path& file) {
  std::vector<SceneAnswer> answers;
  const Json table = read_json(file);
  for (const Json& json : table.at("answers")) {
    answers.push_back({json.at("scene"), json.at("quantity"), json.at("t"), json.at("value"), json.at("uncertainty"),
                       json.at("kind"), json.at("source")});
  }
  return answers;
}

}  // namespace vlbeam
