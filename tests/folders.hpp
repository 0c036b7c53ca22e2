#pragma once

#include <filesystem>

namespace vlbeam::test {

/// The folder of the project, whose scenes, references and documents tests read.
std::filesystem::path source_folder();

/// The program vlbeam of the build that is tested.
std::filesystem::path program();

}  // namespace vlbeam::test
