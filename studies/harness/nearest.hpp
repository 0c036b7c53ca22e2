#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vlbeam {

/// Of the known words, of which there is at least one, that which takes the fewest letters to insert, remove, replace
/// or swap; the first of several.
std::string nearest_of(std::string_view word, const std::vector<std::string>& known);

/// "a", "b", "c".
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace vlbeam
