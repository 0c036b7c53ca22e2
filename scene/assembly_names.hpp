#pragma once

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

}  // namespace vlbeam
