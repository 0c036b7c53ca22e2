#pragma once

#include <string_view>

namespace vlbeam {

/// Whether this library was built with that room, a folder of mechanics/ (VLBEAM_ROOMS of CMake). Code that uses a room
/// stands in `if constexpr (has_room("flow"))`: without the room it is discarded, and nothing of the room is linked.
consteval bool has_room([[maybe_unused]] std::string_view room) {
#ifdef VLBEAM_ROOMS
  return std::string_view(VLBEAM_ROOMS).find(room) != std::string_view::npos;  // no name is a part of another
#else
  return true;
#endif
}

}  // namespace vlbeam
