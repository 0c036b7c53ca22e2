#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vlbeam {

/// The known word, of one or more, that takes the fewest letters to insert, remove, replace or swap; of several the
/// first.
std::string nearest_of(std::string_view word, const std::vector<std::string>& known);

/// "a", "b", "c".
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace vlbeam
