#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace vlbeam {

enum class Lines { one, several };

/// A text from outside as a terminal may show it: control characters become \u001b and the like, and do nothing. Line
/// breaks stay where the text may have several lines.
std::string printable(std::string_view text, Lines lines = Lines::one);

/// What an exception says, or, where it says only its name, what happened and what to do.
std::string explained(const std::exception& error);

}  // namespace vlbeam
