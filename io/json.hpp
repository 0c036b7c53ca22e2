#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace vlbeam {

/// JSON that keeps the order of its keys, so that reports read well and compare line by line.
using Json = nlohmann::ordered_json;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A number as a report holds it, and as it is read: JSON knows neither infinity nor NaN.
inline Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }
inline double number_or_nan(const Json& value) { return value.is_number() ? value.get<double>() : nan; }

/// Parses a JSON text. Throws InvalidInput where it is not JSON, with line and column, where a key stands twice in one
/// object, with its JSON pointer, and where it is nested too deeply for any file of ours.
Json parse_json(std::string_view text);

/// A key as a segment of a JSON pointer.
std::string escaped(std::string key);

/// Calls a function that understands what stands in a file; what it throws as InvalidInput then names the file.
template <class Function>
auto naming_file(const std::filesystem::path& file, const Function& function) {
  try {
    return function();
  } catch (const InvalidInput& error) {
    throw InvalidInput((file == "-" ? "standard input" : file.string()) + ": " + error.field, error.value,
                       error.allowed);
  }
}

/// Reads and parses a JSON file. Throws InvalidInput naming it.
Json read_json(const std::filesystem::path& file);

/// A value as an error message shows it: compact, and cut where it is long.
std::string excerpt(const Json& value);

/// The text of a report file. Numbers in their shortest form that reads back the same; arrays of plain numbers on one
/// line. Not-a-number and infinity become null.
std::string pretty(const Json& value);
/// Appends the same, without the last line break, as it is indented where `depth` objects or arrays are open.
void append_pretty(const Json& value, std::size_t depth, std::string& text);

}  // namespace vlbeam
