#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/folders.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {

/// The program that runs a scene in a process of its own, of the build that is tested.
inline const std::string program_of_runs = test::program();

/// One that `signal` ends where a scene's text holds `what`, and is the same otherwise.
inline std::string crashing_program(const TemporaryFolder& folder, const std::string& what, const std::string& signal) {
  folder.write("crashing", "#!/bin/bash\nscene=$(cat)\n[[ $scene == *'" + what + "'* ]] && kill -" + signal +
                               " $$\nexec '" + program_of_runs + "' \"$@\" <<< \"$scene\"\n");
  const auto file = folder / "crashing";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

}  // namespace vlbeam
