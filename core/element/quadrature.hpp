#pragma once

#include <vector>

namespace vlbeam {

/// One point of a quadrature rule on [0, 1].
struct QuadraturePoint {
  double u;
  double weight;
};

using QuadratureRule = std::vector<QuadraturePoint>;

inline constexpr int max_quadrature_points = 25;

/// Gauss-Legendre rule with `points` in 1..25 points on [0, 1], in increasing u.
/// Throws std::out_of_range for any other number.
const QuadratureRule& gauss_legendre(int points);

}  // namespace vlbeam
