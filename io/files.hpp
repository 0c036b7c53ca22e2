#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace vlbeam {

/// The whole text of a file; "-" is standard input. Throws InvalidInput if it cannot be read, or is beyond any size a
/// scene or a report has.
std::string read_text(const std::filesystem::path& path);

/// Takes a text piece by piece. Throws std::runtime_error where it cannot be written.
using TextSink = std::function<void(std::string_view)>;

/// Writes a file from what `content` sends to its sink. The file appears, or changes, only once it is whole; a failure
/// leaves nothing behind. Follows symbolic links. Writes into devices and pipes; "-" is standard output. Throws
/// std::runtime_error with the system's reason.
void write_file(const std::filesystem::path& path, const std::function<void(const TextSink&)>& content);
void write_text(const std::filesystem::path& path, std::string_view text);

/// Throws InvalidInput, naming the `option`, if write_file() could not write this file. Changes nothing.
void check_writable(const std::string& option, const std::filesystem::path& path);

/// Throws InvalidInput, naming the `option`, if something stands there that is no file of this program: it must hold
/// `mark` in its first megabyte.
void check_own(const std::string& option, const std::filesystem::path& file, std::string_view mark);

/// Whether two names, of files that need not be there, lead to the same place. Devices without memory, like /dev/null,
/// are never the same.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace vlbeam
