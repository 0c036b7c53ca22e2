#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vlbeam {

/// Letters to insert, remove, replace or swap until one word becomes the other.
std::size_t letters_apart(std::string_view a, std::string_view b);

/// The known word, of one or more, that takes the fewest of these; of several the first.
std::string nearest_of(std::string_view word, const std::vector<std::string>& known);

/// "a", "b", "c".
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace vlbeam
