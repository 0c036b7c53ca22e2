#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace vlbeam {

/// How much of a text is shown.
enum class Lines { one, several };

/// A text from outside as a terminal may show it: control characters become escapes of JSON, and do nothing. Line
/// breaks stay where the text may have several lines.
std::string printable(std::string_view text, Lines lines = Lines::one);

/// A number to so many digits.
std::string digits(double value, int count = 3);

/// What an exception says, or, where it says only its name, what happened and what to do.
std::string explained(const std::exception& error);

}  // namespace vlbeam
