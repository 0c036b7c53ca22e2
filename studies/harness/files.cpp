#include "studies/harness/files.hpp"

#include <unistd.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"

namespace vlbeam {

std::string read_text(const std::filesystem::path& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, error)) {
    throw InvalidInput(path.string(), "a file that cannot be read", "it must be there and readable");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  if (path == "-") {
    std::cout << text << std::flush;
    if (!std::cout) throw std::runtime_error("cannot write to standard output");
    return;
  }
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  // The name tells processes apart that write the same file at once.
  std::filesystem::path temporary = path;
  temporary += "." + std::to_string(::getpid()) + ".part";
  bool written = false;
  {
    std::ofstream file(temporary, std::ios::binary);
    file << text << std::flush;
    written = static_cast<bool>(file);
  }
  std::error_code error;
  if (written) std::filesystem::rename(temporary, path, error);
  if (!written || error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error("cannot write " + path.string() + (error ? ": " + error.message() : ""));
  }
}

}  // namespace vlbeam
