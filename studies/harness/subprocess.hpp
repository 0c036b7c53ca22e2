#pragma once

#include <functional>
#include <string>
#include <vector>

namespace vlbeam {

struct ProcessResult {
  int exit_code = 0;   ///< 127 where the program could not be started, 128 + n where signal n ended it
  int signal = 0;      ///< n
  std::string output;  ///< standard output
  std::string error;   ///< standard error
};

/// Runs a program, no shell in between, and waits for it. Standard input is empty. Once `stop` is true, which is asked
/// several times a second, the program is asked to end, too (SIGTERM).
ProcessResult run_process(const std::vector<std::string>& arguments, const std::function<bool()>& stop = {});

}  // namespace vlbeam
