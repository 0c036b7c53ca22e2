#include "studies/harness/shapes.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "studies/harness/run_outcome.hpp"

namespace vlbeam {
namespace {

/// Null where there can be none.
std::FILE* open_unnamed() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "vlbeam.XXXXXX").string();
  const int descriptor = error ? -1 : ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  ::unlink(name.c_str());
  std::FILE* const file = ::fdopen(descriptor, "w+b");
  if (file == nullptr) ::close(descriptor);
  return file;
}

bool write_record(std::FILE* file, const std::string& bytes) {
  const std::size_t size = bytes.size();
  return std::fwrite(&size, sizeof size, 1, file) == 1 && std::fwrite(bytes.data(), 1, size, file) == size &&
         std::fflush(file) == 0;
}

std::string read_record(std::FILE* file) {
  std::size_t size = 0;
  std::string bytes;
  if (std::fread(&size, sizeof size, 1, file) == 1) {
    bytes.resize(size);
    if (std::fread(bytes.data(), 1, size, file) == size) return bytes;
  }
  throw std::runtime_error("cannot read back the shapes that were kept in the folder for temporary files");
}

}  // namespace

Shapes shapes_of(const RunResult& result) {
  return [&result](const std::function<void(const Configuration&)>& show) {
    for (const Configuration& shape : result.configurations) show(shape);
  };
}

void ShapeSpool::add(const Configuration& shape) {
  if (!file_ && in_memory_.empty()) file_.reset(open_unnamed());
  if (file_ && in_memory_.empty() && write_record(file_.get(), to_bytes(shape))) {
    ++in_file_;
  } else {
    in_memory_.push_back(shape);
  }
}

Shapes ShapeSpool::shapes() const {
  return [this](const std::function<void(const Configuration&)>& show) { show_all(show); };
}

void ShapeSpool::show_all(const std::function<void(const Configuration&)>& show) const {
  if (file_) std::rewind(file_.get());
  for (std::size_t i = 0; i < in_file_; ++i) show(configuration_from_bytes(read_record(file_.get())));
  for (const Configuration& shape : in_memory_) show(shape);
}

}  // namespace vlbeam
