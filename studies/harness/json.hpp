#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace vlbeam {

/// JSON that keeps the order of its keys, so that reports read well and compare line by line.
using Json = nlohmann::ordered_json;

/// Parses a JSON text. Throws InvalidInput where it is not JSON, or where a key stands twice in one object.
Json parse_json(std::string_view text);

/// A value as an error message shows it: compact, and cut where it is long.
std::string excerpt(const Json& value);

/// The text of a report file. Numbers in their shortest form that reads back the same; arrays of plain numbers on one
/// line. Not-a-number and infinity become null.
std::string pretty(const Json& value);

}  // namespace vlbeam
