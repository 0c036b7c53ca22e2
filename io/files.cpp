#include "io/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace vlbeam {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_input = std::size_t{1} << 31;

[[noreturn]] void cannot_write(const fs::path& path, int error) {
  throw std::system_error(error, std::generic_category(), "cannot write " + path.string());
}

/// An open file, closed at the latest where it goes out of scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

bool is_standard_output(const fs::path& path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

/// What is written into rather than replaced: devices and pipes, and whatever is reached through /dev or /proc.
bool is_stream(const fs::path& path, const struct stat& status) {
  const std::string name = path.string();
  return !S_ISREG(status.st_mode) || name.starts_with("/dev/fd/") || name.starts_with("/proc/") ||
         name == "/dev/stderr";
}

/// The file that symbolic links lead to, which need not be there.
fs::path target_of(fs::path path) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void write_all(int descriptor, std::string_view text, const fs::path& path) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      cannot_write(path, errno);
    }
  }
}

/// A file that has no name until it is published, or, on file systems that know no such files, one of its own.
class Unpublished {
 public:
  explicit Unpublished(const fs::path& target)
      : target_(target),
        name_(folder_of(target) /
              (".vlbeam." + std::to_string(::getpid()) + "." + std::to_string(++counter) + ".part")),
        file_(::open(folder_of(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode)) {
    if (!file_) {
      named_.emplace(::open(name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode));
      if (!*named_) cannot_write(target_, errno);
    }
  }
  ~Unpublished() {
    if (named_ || linked_) ::unlink(name_.c_str());
  }
  Unpublished(const Unpublished&) = delete;
  Unpublished& operator=(const Unpublished&) = delete;

  int number() const { return named_ ? named_->number() : file_.number(); }

  /// Gives the file its name, in place of any file of this name, whose owner and permissions it takes.
  void publish(const std::optional<struct stat>& before) {
    constexpr mode_t permissions = 07777;
    if (before && (::fchown(number(), before->st_uid, before->st_gid) == 0 || ::geteuid() != 0)) {
      ::fchmod(number(), before->st_mode & permissions);
    }
    if (::fsync(number()) != 0) cannot_write(target_, errno);
    if (!named_) {
      const std::string open_file = "/proc/self/fd/" + std::to_string(number());
      const auto link_to = [&](const fs::path& name) {
        return ::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
      };
      if (!before && link_to(target_)) return;
      if (!link_to(name_)) cannot_write(target_, errno);
      linked_ = true;
    }
    if (::rename(name_.c_str(), target_.c_str()) != 0) cannot_write(target_, errno);
    named_.reset();
    linked_ = false;
  }

 private:
  static constexpr mode_t mode = 0666;  // less what the user's umask takes
  static inline std::atomic<int> counter{0};

  fs::path target_, name_;
  Descriptor file_;
  std::optional<Descriptor> named_;
  bool linked_ = false;
};

void write_to_standard_output(const std::function<void(const TextSink&)>& content) {
  content([](std::string_view text) {
    std::cout << text;
    if (!std::cout) throw std::runtime_error("cannot write to standard output");
  });
  if (!(std::cout << std::flush)) throw std::runtime_error("cannot write to standard output");
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file;
  std::error_code error;
  if (path != "-") {
    file.open(path, std::ios::binary);
    if (!file || fs::is_directory(path, error)) {
      const char* const found = fs::is_directory(path, error) ? "a folder"
                                : fs::exists(path, error)     ? "a file that may not be read"
                                                              : InvalidInput::missing;
      throw InvalidInput(path.string(), found, "it must be a file that can be read");
    }
  }
  std::istream& in = path == "-" ? std::cin : file;
  std::string text;
  constexpr std::size_t piece = 1 << 16;
  const auto expected = path != "-" ? fs::file_size(path, error) : 0;
  if (!error && expected < longest_input) text.reserve(expected + piece);
  for (std::size_t size = 0; in; size = text.size()) {
    text.resize(size + piece);
    in.read(text.data() + size, piece);
    text.resize(size + static_cast<std::size_t>(in.gcount()));
    if (text.size() > longest_input) {
      throw InvalidInput(path.string(), "a file of more than 2 GiB", "it must be of a size that can be read at once");
    }
  }
  return text;
}

void write_file(const std::filesystem::path& path, const std::function<void(const TextSink&)>& content) {
  if (is_standard_output(path)) return write_to_standard_output(content);
  const auto before = status_of(path);
  if (before && S_ISDIR(before->st_mode)) cannot_write(path, EISDIR);
  if (before && is_stream(path, *before)) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
    if (!file) cannot_write(path, errno);
    content([&](std::string_view text) { write_all(file.number(), text, path); });
    if (!file.close()) cannot_write(path, errno);
    return;
  }
  const fs::path target = target_of(path);
  if (target.has_parent_path()) fs::create_directories(target.parent_path());
  Unpublished file(target);
  content([&](std::string_view text) { write_all(file.number(), text, path); });
  file.publish(before);
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  write_file(path, [text](const TextSink& sink) { sink(text); });
}

void check_writable(const std::string& option, const std::filesystem::path& path) {
  const auto refuse = [&](int error) {
    throw InvalidInput(option, "\"" + path.string() + "\"",
                       "it must be a file that can be written: " + std::generic_category().message(error));
  };
  if (path.empty()) throw InvalidInput(option, "an empty name", "it must name a file, or be - for standard output");
  if (is_standard_output(path)) return;
  const auto before = status_of(path);
  if (before && S_ISDIR(before->st_mode)) refuse(EISDIR);
  if (before && is_stream(path, *before)) {
    if (::access(path.c_str(), W_OK) != 0) refuse(errno);
    return;
  }
  if (!before && errno != ENOENT) refuse(errno);  // a loop of links, a name too long, a file taken for a folder
  const fs::path target = target_of(path);
  if (!target.has_filename()) refuse(EISDIR);
  if (before && !Descriptor(::open(target.c_str(), O_WRONLY | O_CLOEXEC))) refuse(errno);
  fs::path folder = fs::absolute(folder_of(target));
  while (!status_of(folder) && folder.has_relative_path()) folder = folder.parent_path();
  try {
    const Unpublished probe(folder / target.filename());
  } catch (const std::system_error& error) {
    refuse(error.code().value());
  }
}

void check_own(const std::string& option, const fs::path& file, std::string_view mark) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return;
  constexpr std::size_t head = std::size_t{1} << 20;
  std::string text(head, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), head);
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  if (text.find(mark) != std::string::npos) return;
  throw InvalidInput(option, "\"" + file.string() + "\"",
                     "it is there already and was not written by this command: name another folder, or move it away");
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto of_a = status_of(a), of_b = status_of(b);
  if (of_a && of_b && S_ISCHR(of_a->st_mode)) return is_standard_output(a) && is_standard_output(b);
  if (of_a && of_b) return of_a->st_dev == of_b->st_dev && of_a->st_ino == of_b->st_ino;
  if (of_a || of_b) return false;
  std::error_code error;
  const auto place = [&error](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(target_of(path)), error);
  };
  return place(a) == place(b);
}

}  // namespace vlbeam
