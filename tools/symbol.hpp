#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vlbeam {

/// A sign in a picture of a beam: what holds it, carries it or pulls at it. It is as large on every scale.
struct Symbol {
  enum class Kind {
    pin,     ///< a triangle on hatched ground
    roller,  ///< a triangle on two wheels
    clamp,   ///< a hatched wall
    winch,   ///< a drum
    wheel,   ///< a pulley, or the wheel of a vehicle
    spring,  ///< down to hatched ground
    hanger,  ///< a line to a place of its own, where it is pinned
    force,   ///< an arrow whose head is at the place
    moment,  ///< a round arrow
    floor,   ///< a hatched line through the whole picture
    coil,    ///< a spring to another place
    rod,     ///< a line to another place
    hinge,   ///< a small circle
    block,   ///< a small square
    rail,    ///< a line along the way through the place
  };
  Kind kind = Kind::pin;
  std::array<double, 2> at{};     ///< on the axes of the picture
  std::array<double, 2> way{};    ///< where its ground is, or an arrow points; a unit vector
  std::array<double, 2> other{};  ///< of what leads to another place: that
  std::size_t frame = 0;          ///< which of the times it belongs to

  bool is_small() const { return kind == Kind::hinge || kind == Kind::block; }
  bool leads() const { return kind == Kind::hanger || kind == Kind::coil || kind == Kind::rod; }
};

/// Lines that draw a symbol of `size`, in lengths of both axes, in a picture that reaches from `left` to `right`.
std::vector<std::vector<std::array<double, 2>>> lines_of(const Symbol& symbol, std::array<double, 2> size, double left,
                                                         double right);

}  // namespace vlbeam
