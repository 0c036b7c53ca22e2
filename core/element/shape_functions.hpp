#pragma once

#include <array>

#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

/// Shape functions of a cubic element as functions of u alone, f[i][n] the n-th u-derivative of the i-th:
/// r = f_0 r_A + l f_1 s_A + f_2 r_B + l f_3 s_B, l the element's length (Ding & Ouyang 2022, Eq. 9).
template <class Real>
using ShapeTable = std::array<std::array<Real, 4>, 4>;

/// Cubic Hermite functions: the shape functions of equal weights (Eq. 10).
template <class Real>
ShapeTable<Real> hermite_shape(const Real& u) {
  const auto b = RationalCubic<Real, 1>::bernstein(u);
  ShapeTable<Real> f;
  for (int n = 0; n < 4; ++n) {
    f[0][n] = b[0][n] + b[1][n];
    f[1][n] = b[1][n] / Real(3);
    f[2][n] = b[2][n] + b[3][n];
    f[3][n] = -b[2][n] / Real(3);
  }
  return f;
}

/// Rational shape functions of the weights `w` (Eq. 9), derivatives by the quotient recursion
/// f^(n) = (numerator^(n) - sum_k C(n,k) W^(k) f^(n-k)) / W.
template <class Real>
ShapeTable<Real> rational_shape(const Weights<Real>& w, const Real& u) {
  const auto b = RationalCubic<Real, 1>::bernstein(u);
  ShapeTable<Real> f;
  std::array<Real, 4> W;
  for (int n = 0; n < 4; ++n) {
    const Real c0 = w[0] * b[0][n], c1 = w[1] * b[1][n], c2 = w[2] * b[2][n], c3 = w[3] * b[3][n];
    W[n] = c0 + c1 + c2 + c3;
    f[0][n] = c0 + c1;
    f[1][n] = w[0] * b[1][n] / Real(3);
    f[2][n] = c2 + c3;
    f[3][n] = -w[3] * b[2][n] / Real(3);
  }
  const Real inverse = Real(1) / W[0];
  for (auto& fi : f) {
    fi[0] = fi[0] * inverse;
    fi[1] = (fi[1] - W[1] * fi[0]) * inverse;
    fi[2] = (fi[2] - Real(2) * W[1] * fi[1] - W[2] * fi[0]) * inverse;
    fi[3] = (fi[3] - Real(3) * W[1] * fi[2] - Real(3) * W[2] * fi[1] - W[3] * fi[0]) * inverse;
  }
  return f;
}

}  // namespace vlbeam
