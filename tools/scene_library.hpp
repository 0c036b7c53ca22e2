#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

/// A scene of the folder scenes/.
struct LibraryScene {
  std::string name;   ///< of the file, without .json
  std::string title;  ///< of the scene
};

/// Those of a folder, by name. Throws InvalidInput where one cannot be read.
std::vector<LibraryScene> library_scenes(const std::filesystem::path& folder);

/// The text of one of them. Throws InvalidInput naming the nearest.
std::string library_scene_text(const std::filesystem::path& folder, const std::string& name);

/// What a number of a scene should be: of reference/scenes.json.
struct SceneAnswer {
  std::string scene;
  std::string quantity;
  double t = 0;            ///< [s]
  double value = 0;        ///< in the quantity's unit
  double uncertainty = 0;  ///< of the value
  std::string kind;        ///< exact, independent or self-convergence
  std::string source;
};

/// Reads them. Throws InvalidInput.
std::vector<SceneAnswer> scene_answers(const std::filesystem::path& file);

}  // namespace vlbeam
