#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files.hpp"
#include "scene/result.hpp"

namespace vlbeam {

/// What running a scene has come to.
struct RunOutcome {
  RunResult result;
  std::vector<std::string> thrown;  ///< what an exception says: field, value and allowed of InvalidInput, else one text

  /// Keeps what `run` gives or throws.
  static RunOutcome of(const std::function<RunResult()>& run);
  /// The result, or the exception: InvalidInput, or std::runtime_error with the text that `explained` gives.
  RunResult get() &&;
};

/// All of an outcome as bytes, for a process of the same program: every number with its bits.
std::string to_bytes(const RunOutcome& outcome);
/// Throws std::out_of_range where they are not whole.
RunOutcome outcome_from_bytes(std::string_view bytes);

/// The same of one shape, whose bytes are written piece by piece.
void write_bytes(const Configuration& shape, const TextSink& sink);
Configuration configuration_from_bytes(std::string_view bytes);

}  // namespace vlbeam
