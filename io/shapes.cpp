#include "io/shapes.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/run_outcome.hpp"

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

/// How many bytes have been written; none where not all could be.
std::size_t write_record(std::FILE* file, const Configuration& shape) {
  std::size_t size = 0;
  bool whole = true;
  write_bytes(shape, [&](std::string_view bytes) {
    whole = whole && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    size += bytes.size();
  });
  return whole && std::fflush(file) == 0 ? size : 0;
}

std::string read_record(std::FILE* file, std::size_t size) {
  std::string bytes(size, '\0');
  if (std::fread(bytes.data(), 1, size, file) == size) return bytes;
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
  const std::size_t size = file_ && in_memory_.empty() ? write_record(file_.get(), shape) : 0;
  if (size > 0) {
    sizes_.push_back(size);
  } else {
    in_memory_.push_back(shape);
  }
}

Shapes ShapeSpool::shapes() const {
  return [this](const std::function<void(const Configuration&)>& show) { show_all(show); };
}

void ShapeSpool::show_all(const std::function<void(const Configuration&)>& show) const {
  if (file_) std::rewind(file_.get());
  for (const std::size_t size : sizes_) show(configuration_from_bytes(read_record(file_.get(), size)));
  for (const Configuration& shape : in_memory_) show(shape);
}

}  // namespace vlbeam
