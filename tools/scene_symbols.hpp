#pragma once

#include <cstddef>
#include <vector>

#include "io/run_file.hpp"
#include "tools/symbol.hpp"

namespace vlbeam {

/// Supports, winches, loads, vehicles and the ground at the times of the shapes, on two axes of space.
std::vector<Symbol> symbols_of(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across,
                               std::size_t up);

/// The wheel that a beam or rope goes over at a place of one of its shapes: on the inside of its bend.
Symbol wheel_at(const Scene& scene, const Configuration& shape, std::array<double, 2> at, std::size_t across,
                std::size_t up, std::size_t frame);

}  // namespace vlbeam
