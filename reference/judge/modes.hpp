// The functions that a stretch of beam is made of, and the points at which its energy is summed.
#pragma once

#include <Eigen/Core>

namespace judge {

/// Polynomials of a degree on [-1, 1]. Columns 0 to 3: value at -1, slope at -1, value at 1, slope at 1 (the other
/// three vanish, and all of them are orthogonal to the bubbles). Columns from 4 on: bubbles (1 - xi^2)^2 P_j(xi), P_j
/// Jacobi's polynomials (4, 4), which are orthonormal. Rows are Gauss points.
struct Modes {
  int degree = 0;
  Eigen::VectorXd xi, weight;
  Eigen::MatrixXd value, slope, bend;  ///< and first and second derivatives
  Eigen::Matrix4d ends_gram;           ///< integrals of products of the first four
  int bubbles() const { return degree - 3; }
};

Modes make_modes(int degree, int points);

/// Values of all columns at one place.
Eigen::RowVectorXd mode_values(int degree, double xi);

}  // namespace judge
