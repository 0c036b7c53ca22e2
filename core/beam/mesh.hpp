#pragma once

#include <algorithm>
#include <vector>

#include "core/element/moving_element.hpp"

namespace vlbeam {

inline constexpr double smallest_weight = 1e-3;  // of the largest of the same element

/// How far the weights of an element are below the smallest share of each other that is allowed; positive is too far.
inline double lost_weight(const Weights<double>& w) {
  return smallest_weight - *std::min_element(w.begin(), w.end()) / *std::max_element(w.begin(), w.end());
}

/// A part of a beam: all of its nodes but so many before it, and so many behind it.
struct BeamPart {
  int before = 0, behind = 0;
};

/// A chain of elements: n + 1 nodes at increasing material coordinates, and the weights of the n elements between
/// them. Neighbours share a node's position and slope. Where a node moves, its entry of `x` is only the last known one.
struct Mesh {
  std::vector<double> x;                ///< material coordinates [m]
  std::vector<WeightFunction> weights;  ///< one an element

  int elements() const { return static_cast<int>(weights.size()); }
  int last() const { return elements(); }  ///< index of the last node
  /// Length of the shortest element [m].
  double shortest() const {
    double length = x.back() - x.front();
    for (std::size_t k = 1; k < x.size(); ++k) length = std::min(length, x[k] - x[k - 1]);
    return length;
  }
  double length() const { return x.back() - x.front(); }
  /// Index of the element that holds `at`; of the first or the last one beyond the ends.
  int element_at(double at) const {
    return static_cast<int>(std::upper_bound(x.begin() + 1, x.end() - 1, at) - x.begin()) - 1;
  }
};

}  // namespace vlbeam
