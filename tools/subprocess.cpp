#include "tools/subprocess.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

extern char** environ;

// By the system's own calls. Boost.Process of Debian 12 (1.74) makes pipes that processes of other threads inherit, so
// that their ends are seen too late, and it takes the signal SIGCHLD of the whole program to wait for a limited time.
namespace vlbeam {
namespace {

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    // Closed on exec, so that a process started by another thread does not hold it open.
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot create a pipe");
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    ::close(read);
    close_write();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void close_write() {
    if (write >= 0) ::close(write);
    write = -1;
  }

  int read = -1;
  int write = -1;
};

/// A text that a process reads as a file, which has no name and no place on a disk.
class Input {
 public:
  explicit Input(std::string_view text) : number_(::memfd_create("input", MFD_CLOEXEC)) {
    if (number_ < 0) throw std::runtime_error("cannot create the input of a process");
    while (!text.empty()) {
      const ssize_t count = ::write(number_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        ::close(number_);
        throw std::runtime_error("cannot write the input of a process");
      }
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    ::lseek(number_, 0, SEEK_SET);
  }
  ~Input() { ::close(number_); }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

/// Reads both pipes to their ends; ends the child once `stop` says so.
void drain(const Pipe& out, const Pipe& err, pid_t child, const std::function<bool()>& stop, ProcessResult& result) {
  constexpr int between_questions = 100;  // ms
  bool stopped = false;
  std::array<pollfd, 2> sources{{{out.read, POLLIN, 0}, {err.read, POLLIN, 0}}};
  const std::array<std::string*, 2> sinks{&result.output, &result.error};
  std::array<char, 1 << 16> buffer{};
  for (int open = 2; open > 0;) {
    if (::poll(sources.data(), sources.size(), stop ? between_questions : -1) < 0) {
      if (errno != EINTR) return;
      continue;
    }
    if (stop && !stopped && stop()) {
      stopped = true;
      ::kill(child, SIGTERM);
    }
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].fd < 0 || sources[i].revents == 0) continue;
      const ssize_t count = ::read(sources[i].fd, buffer.data(), buffer.size());
      if (count > 0) {
        sinks[i]->append(buffer.data(), static_cast<std::size_t>(count));
      } else if (count == 0 || errno != EINTR) {
        sources[i].fd = -1;
        --open;
      }
    }
  }
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments, const std::function<bool()>& stop,
                          std::string_view input) {
  std::vector<std::string> owned = arguments;
  std::vector<char*> argv;
  argv.reserve(owned.size() + 1);
  for (std::string& argument : owned) argv.push_back(argument.data());
  argv.push_back(nullptr);

  const Input in(input);
  Pipe out;
  Pipe err;
  posix_spawn_file_actions_t actions{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, in.number(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, out.write, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, err.write, STDERR_FILENO);
  pid_t child = 0;
  const int spawned = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (spawned != 0) return {.exit_code = 127, .signal = 0, .output = "", .error = "cannot start " + arguments.front()};

  out.close_write();
  err.close_write();
  ProcessResult result;
  drain(out, err, child, stop, result);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::string how_it_ended(const ProcessResult& process) {
  constexpr std::size_t longest = 500;  // of what it said
  if (process.signal != 0) {
    const std::string cause = process.signal == SIGKILL ? "killed, as by the system where memory runs out"
                                                        : std::string(::strsignal(process.signal));
    return "ended by signal " + std::to_string(process.signal) + " (" + cause + ")";
  }
  return "ended with exit code " + std::to_string(process.exit_code) + ": " + process.error.substr(0, longest);
}

void end_with_parent() {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  pollfd answer{STDOUT_FILENO, 0, 0};
  if (::poll(&answer, 1, 0) > 0 && (answer.revents & POLLERR) != 0) ::raise(SIGTERM);  // it was gone before
}

}  // namespace vlbeam
