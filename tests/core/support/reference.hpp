#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tests/folders.hpp"

namespace vlbeam::test {

/// A file of the folder reference/; each names its source.
inline nlohmann::json reference(const std::string& name) {
  std::ifstream file(source_folder() / "reference" / name);
  if (!file) throw std::runtime_error("no reference/" + name);
  return nlohmann::json::parse(file);
}

}  // namespace vlbeam::test
