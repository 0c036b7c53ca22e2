#pragma once

#include <array>

#include "scene/assembly.hpp"
#include "scene/names.hpp"

namespace vlbeam {

constexpr auto names(LinkType) {
  using enum LinkType;
  return std::to_array<Named<LinkType>>(
      {{pin, "pin"}, {clamp, "clamp"}, {slide, "slide"}, {distance, "distance"}, {spring, "spring"}, {rail, "rail"}});
}
constexpr auto names(BodyLoadSpec::Type) {
  using enum BodyLoadSpec::Type;
  return std::to_array<Named<BodyLoadSpec::Type>>({{force, "force"}, {torque, "torque"}});
}

/// Keys beside /beam that belong to one beam of several.
inline constexpr std::array keys_of_one_beam{"supports",     "sliding_mass", "sliding_joints", "blocks", "contact",
                                             "point_masses", "loads",        "places",         "spin",   "vehicles"};
/// Keys beside /beam that each beam may have for itself, in place of those of the whole.
inline constexpr std::array keys_of_whole_or_beam{"drag", "fluid", "ground", "initial_velocity", "length_control"};

}  // namespace vlbeam
