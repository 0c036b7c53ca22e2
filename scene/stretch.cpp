#include "scene/stretch.hpp"

#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace vlbeam {

double stretch_under(double force, double EA, StrainLaw law) {
  const bool green = law == StrainLaw::green;
  if (!(force > (green ? -EA / (3 * std::numbers::sqrt3) : -EA))) {
    std::ostringstream text;
    text << force;
    throw ModelError("tension", text.str(),
                     green ? "a force above -EA/(3 sqrt 3) [N]: below, a beam of the green law collapses"
                           : "a force above -EA [N]: below, nothing of the beam's length is left");
  }
  if (!green) return 1 + force / EA;
  constexpr int iterations = 50;
  double stretch = 1;
  for (int i = 0; i < iterations; ++i) {
    stretch -= ((stretch * stretch - 1) * stretch / 2 - force / EA) / (1.5 * stretch * stretch - 0.5);
  }
  return stretch;
}

}  // namespace vlbeam
