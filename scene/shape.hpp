#pragma once

#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// What there is at a material point of the beam; strains from the rest shape, as the strain law measures them.
struct ShapePoint {
  std::size_t element = 0;
  double x = 0;          ///< material coordinate [m]
  Point r{};             ///< position [m]
  Point r_x{};           ///< slope [-]
  Point v{};             ///< velocity of the material point [m/s]
  double strain = 0;     ///< axial [-]
  double tension = 0;    ///< axial force, damping included [N]
  double curvature = 0;  ///< magnitude [1/m]
  SectionForce force;    ///< as samples have it: better than what the element says of one of its points
};

/// The axis of a beam in one of its configurations: `per_element` + 1 points on each element, equally spaced between
/// its ends and both among them, so that what jumps at a node stands there twice. Throws std::invalid_argument unless
/// per_element is at least 1 and the configuration has one entry a node or element.
std::vector<ShapePoint> points_along(const Scene& scene, const Configuration& shape, int per_element);

}  // namespace vlbeam
