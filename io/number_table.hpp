#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vlbeam {

/// Numbers of a CSV file below a line of names.
struct NumberTable {
  std::vector<std::string> names, units;  ///< of "name [unit]"; no unit is empty
  std::vector<std::vector<double>> rows;  ///< NaN where a cell is empty
  std::vector<std::size_t> lines;         ///< of the file, from 1
};

/// Throws InvalidInput, naming line and column, for what is no finite number, for lines of another length, and where
/// there is no line of numbers. Lines that begin with # are comments.
NumberTable read_numbers(const std::filesystem::path& file);

}  // namespace vlbeam
