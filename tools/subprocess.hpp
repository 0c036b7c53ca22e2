#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vlbeam {

struct ProcessResult {
  int exit_code = 0;   ///< 127 where the program could not be started, 128 + n where signal n ended it
  int signal = 0;      ///< n
  std::string output;  ///< standard output
  std::string error;   ///< standard error
};

/// Runs a program, no shell in between, and waits for it. Its standard input is `input`. Once `stop` is true, which is
/// asked several times a second, the program is asked to end, too (SIGTERM).
ProcessResult run_process(const std::vector<std::string>& arguments, const std::function<bool()>& stop = {},
                          std::string_view input = {});

/// How a process ended that was to end by itself: "ended by signal 11 (Segmentation fault)", or its exit code and the
/// start of what it said on standard error.
std::string how_it_ended(const ProcessResult& process);

/// The program that asks, to run it once more: the same file, even where another one has been built in its place since.
inline constexpr const char* this_program = "/proc/self/exe";

/// Has the system ask this process to stop (SIGTERM) once the thread that started it, and reads what it says, is gone.
void end_with_parent();

}  // namespace vlbeam
