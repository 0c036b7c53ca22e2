#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace vlbeam {

/// A point, slope or force: `D` components of scalar type `Real`.
template <class Real, int D>
using Vec = Eigen::Matrix<Real, D, 1>;

#ifdef __AVX__
inline namespace in_one_register {
#else
inline namespace in_two_registers {
#endif
class Pack;
}  // namespace

// Sums and multiples of small matrices are computed at once: as Eigen's expressions each would be a type of its own,
// with hundreds of declarations, which is most of what compiling them takes. They round alike. Not those of packs,
// which are wider than registers: what is stored in between costs them a twentieth more.

template <class Real, int R, int C>
using Small =
    std::enable_if_t<R >= 1 && C >= 1 && R * C <= 16 && !std::is_same_v<Real, Pack>, Eigen::Matrix<Real, R, C>>;

template <class Real, int R, int C>
Small<Real, R, C> operator+(const Eigen::Matrix<Real, R, C>& a, const Eigen::Matrix<Real, R, C>& b) {
  Eigen::Matrix<Real, R, C> sum = a;
  sum += b;
  return sum;
}
template <class Real, int R, int C>
Small<Real, R, C> operator-(const Eigen::Matrix<Real, R, C>& a, const Eigen::Matrix<Real, R, C>& b) {
  Eigen::Matrix<Real, R, C> difference = a;
  difference -= b;
  return difference;
}
template <class Real, int R, int C>
Small<Real, R, C> operator-(const Eigen::Matrix<Real, R, C>& a) {
  return a.operator-();
}
template <class Real, int R, int C, class Scale, std::enable_if_t<std::is_same_v<Real, Scale>, int> = 0>
Small<Real, R, C> operator*(const Eigen::Matrix<Real, R, C>& a, const Scale& scale) {
  Eigen::Matrix<Real, R, C> product = a;
  product *= scale;
  return product;
}
template <class Real, int R, int C, class Scale, std::enable_if_t<std::is_same_v<Real, Scale>, int> = 0>
Small<Real, R, C> operator*(const Scale& scale, const Eigen::Matrix<Real, R, C>& a) {
  Eigen::Matrix<Real, R, C> product = a;
  product *= scale;
  return product;
}

/// r x v: in the plane, its component across it is the last.
template <class Real, int D>
Vec<Real, 3> moment_about_origin(const Eigen::Matrix<Real, D, 1>& r, const Eigen::Matrix<Real, D, 1>& v) {
  const Real across = r[0] * v[1] - r[1] * v[0];
  if constexpr (D == 2) return {Real(0), Real(0), across};
  if constexpr (D == 3) return {r[1] * v[2] - r[2] * v[1], r[2] * v[0] - r[0] * v[2], across};
}

}  // namespace vlbeam
