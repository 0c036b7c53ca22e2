#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vlbeam {

/// The whole text of a file; "-" is standard input. Throws InvalidInput if it cannot be read.
std::string read_text(const std::filesystem::path& path);

/// Writes a file so that it appears only once it is whole: into a temporary file beside it, then renamed.
/// "-" is standard output. Throws std::runtime_error if it cannot be written, and leaves nothing behind.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace vlbeam
