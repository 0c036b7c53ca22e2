#pragma once

#include "scene/scene.hpp"

namespace vlbeam::ropes {

/// Two weights on a rope over a guide without friction, half of it on either side, at rest at t = 0:
/// (m1 + m2 + m) s'' = (m1 - m2 + 2 m s/L) g.
struct AtwoodMachine {
  double heavy, light, rope;  ///< masses [kg]
  double length;              ///< of the rope [m]

  double way(double t) const;  ///< s [m]
};

/// Of a rope at its end, magnitudes [N].
struct Pull {
  double along, up;
};

/// Of an elastic rope between two supports of one height (Irvine 1981): with its length L, weight w a length and pull H
/// along, the supports are H L/EA + 2 H/w asinh(w L/(2 H)) apart. EA is that of Hooke's law; strains e are to be small,
/// for Green's law differs by e^2.
Pull hanging_rope(const Scene& scene);

/// Of an elastic rope from an anchor on a smooth, rigid ground to a fairlead (Irvine 1981). The part s that hangs
/// begins along the ground: height (sqrt(H^2 + w^2 s^2) - H)/w + w s^2/(2 EA), reach L - s + H/w asinh(w s/H) + H L/EA.
Pull rope_from_the_ground(const Scene& scene);

}  // namespace vlbeam::ropes
