#pragma once

#include "mechanics/assembly/link.hpp"

namespace vlbeam {

/// A spring at one instant.
template <int D>
struct SpringNow {
  Vec<double, D> along;  ///< from the first point to the second, of length 1
  double length, stretch, rate, tension;
  bool bears;

  SpringNow(const LinkSpring& spring, const LinkVector& h, const LinkVector& v) {
    const Vec<double, D> apart = h.segment<D>(D) - h.segment<D>(0), moving = v.segment<D>(D) - v.segment<D>(0);
    length = apart.norm();
    along = length > 0 ? Vec<double, D>(apart / length) : Vec<double, D>::Unit(0);
    stretch = length - spring.length;
    rate = along.dot(moving);
    tension = spring.stiffness * stretch + spring.damping * rate;
    bears = !spring.tension_only || (stretch > 0 && tension > 0);
    if (!bears) tension = 0;
  }
};

}  // namespace vlbeam
