#pragma once

#include <string>

#include "io/run_file.hpp"

namespace vlbeam {

/// How far two runs are apart, over the samples that both have. Throws InvalidInput where they have none in common.
Json compare_runs(const RunFile& a, const RunFile& b, double tolerance);

/// The same, for a reader.
std::string comparison_text(const Json& comparison);

}  // namespace vlbeam
