#pragma once

#include <string>
#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam::ropes {

/// An elastic rope of weight w = 9.81 N/m that hangs in a plane (Irvine 1981), by the pull at its end: H [N] along, V
/// [N] up.
struct Catenary {
  double EA, length, H, V;

  double vertical(double s) const;  ///< part of the pull at the material point s [N]
  double tension(double s) const;   ///< [N]
  Point place(double s) const;      ///< from its start [m]
};

/// How a rope of unit length hangs.
enum class Hanging {
  held,  ///< between two pins
  free,  ///< from one pin; drawn askew
  ring,  ///< between two pins, through a ring without friction, in which it has to find its place
};
inline const std::vector<std::string> hangings{"held", "free", "ring"};

/// How far the shape of a run is from the catenary, over the length, and its tension, over the largest tension.
struct CatenaryError {
  double shape, tension;
};

/// A rope that is drawn unstrained beside where it will hang.
class HangingRope {
 public:
  HangingRope(Hanging hanging, double EA_over_weight, int elements);

  const Scene& scene() const { return scene_; }
  CatenaryError error_of(const RunResult& run) const;

 private:
  void hold(SupportSpec& support, const Point& drawn, const Point& there) const;
  void draw_held(double EA);
  void draw_ring(double EA);

  Hanging hanging_;
  Scene scene_;
  std::vector<Catenary> parts_ = {};  ///< one behind the other; the second one starts at the origin
  Point start_{};                     ///< of the first one
};

}  // namespace vlbeam::ropes
