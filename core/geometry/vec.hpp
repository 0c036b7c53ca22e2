#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace vlbeam {

/// A point, slope or force: `D` components of scalar type `Real`.
template <class Real, int D>
using Vec = Eigen::Matrix<Real, D, 1>;

// Sums and multiples of small matrices are computed at once: as Eigen's expressions each would be a type of its own,
// with hundreds of declarations, which is most of what compiling them takes, and a scalar in one a copy in memory. They
// round alike.

template <class Real, int R, int C>
using Small = std::enable_if_t<R >= 1 && C >= 1 && R * C <= 16, Eigen::Matrix<Real, R, C>>;

template <class Real, int R, int C, class Entry>
[[gnu::always_inline]] inline Small<Real, R, C> by_entry(const Entry& entry) {
  Eigen::Matrix<Real, R, C> result;
  for (int i = 0; i < R * C; ++i) result.data()[i] = entry(i);
  return result;
}
template <class Real, int R, int C>
[[gnu::always_inline]] inline Small<Real, R, C> operator+(const Eigen::Matrix<Real, R, C>& a,
                                                          const Eigen::Matrix<Real, R, C>& b) {
  return by_entry<Real, R, C>([&](int i) { return a.data()[i] + b.data()[i]; });
}
template <class Real, int R, int C>
[[gnu::always_inline]] inline Small<Real, R, C> operator-(const Eigen::Matrix<Real, R, C>& a,
                                                          const Eigen::Matrix<Real, R, C>& b) {
  return by_entry<Real, R, C>([&](int i) { return a.data()[i] - b.data()[i]; });
}
template <class Real, int R, int C>
[[gnu::always_inline]] inline Small<Real, R, C> operator-(const Eigen::Matrix<Real, R, C>& a) {
  return by_entry<Real, R, C>([&](int i) { return -a.data()[i]; });
}
template <class Real, int R, int C, class Scale, std::enable_if_t<std::is_same_v<Real, Scale>, int> = 0>
[[gnu::always_inline]] inline Small<Real, R, C> operator*(const Eigen::Matrix<Real, R, C>& a, const Scale& scale) {
  return by_entry<Real, R, C>([&](int i) { return a.data()[i] * scale; });
}
template <class Real, int R, int C, class Scale, std::enable_if_t<std::is_same_v<Real, Scale>, int> = 0>
[[gnu::always_inline]] inline Small<Real, R, C> operator*(const Scale& scale, const Eigen::Matrix<Real, R, C>& a) {
  return by_entry<Real, R, C>([&](int i) { return a.data()[i] * scale; });
}

/// r x v: in the plane, its component across it is the last.
template <class Real, int D>
Vec<Real, 3> moment_about_origin(const Eigen::Matrix<Real, D, 1>& r, const Eigen::Matrix<Real, D, 1>& v) {
  const Real across = r[0] * v[1] - r[1] * v[0];
  if constexpr (D == 2) return {Real(0), Real(0), across};
  if constexpr (D == 3) return {r[1] * v[2] - r[2] * v[1], r[2] * v[0] - r[0] * v[2], across};
}

}  // namespace vlbeam
