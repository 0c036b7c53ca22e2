#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "mechanics/motion/parts/part.hpp"
#include "mechanics/ropes/drag.hpp"

namespace vlbeam {

/// What acts along a beam whose sections change, piece by piece: drag, and what pushes each metre at all times alike.
template <int D>
struct LawAlong {
  double end;    ///< of the piece, a material coordinate; the last goes on to the end of the beam [m]
  Drag<D> drag;  ///< of its points, their number is not looked at
  std::function<Vec<double, D>(double t)> push = {};  ///< [N/m]
};

/// They act on elements by the piece in which the middle is.
template <int D>
std::shared_ptr<const Part<D>> laws_along(std::vector<LawAlong<D>> laws, int quadrature_points);

}  // namespace vlbeam
