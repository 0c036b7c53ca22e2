#pragma once

#include "core/element/moving_kinematics.hpp"
#include "core/pack.hpp"

namespace vlbeam {

template <int D>
MovingCoordinates<Pack, D> in_all_lanes(const MovingCoordinates<double, D>& c) {
  const auto packed = [](const Vec<double, D>& from) {
    Vec<Pack, D> to;
    for (int i = 0; i < D; ++i) to[i] = Pack(from[i]);
    return to;
  };
  return {{packed(c.e.r_a), packed(c.e.s_a), packed(c.e.r_b), packed(c.e.s_b)}, Pack(c.x_a), Pack(c.x_b)};
}

inline double total(const Pack& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

template <int D>
Vec<double, D> total(const Vec<Pack, D>& lanes) {
  Vec<double, D> sum;
  for (int i = 0; i < D; ++i) sum[i] = total(lanes[i]);
  return sum;
}

}  // namespace vlbeam
