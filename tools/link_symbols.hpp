#pragma once

#include <cstddef>
#include <vector>

#include "io/run_file.hpp"
#include "tools/symbol.hpp"

namespace vlbeam {

/// Links of an assembly, and the arms of its bodies from their centers to their points, at those times of the shapes
/// at which there are samples, on two axes of space.
std::vector<Symbol> link_symbols(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across,
                                 std::size_t up);

}  // namespace vlbeam
