#pragma once

#include <string>
#include <vector>

namespace vlbeam {

struct ProcessResult {
  int exit_code = 0;   ///< 127 where the program could not be started
  std::string output;  ///< standard output
  std::string error;   ///< standard error
};

/// Runs a program, no shell in between, and waits for it. Standard input is empty.
ProcessResult run_process(const std::vector<std::string>& arguments);

}  // namespace vlbeam
