#pragma once

#include <vector>

#include "core/element/moving_element.hpp"

namespace vlbeam {

/// A chain of elements: n + 1 nodes at increasing material coordinates, and the weights of the n elements between
/// them. Neighbours share a node's position and slope. Where a node moves, its entry of `x` is only the last known one.
struct Mesh {
  std::vector<double> x;                ///< material coordinates [m]
  std::vector<WeightFunction> weights;  ///< one an element

  int elements() const { return static_cast<int>(weights.size()); }
  int last() const { return elements(); }  ///< index of the last node
  double length() const { return x.back() - x.front(); }
};

}  // namespace vlbeam
