// Numbers that carry derivatives: forward automatic differentiation. All forces of the judge come from these.
#pragma once

#include <array>
#include <cmath>

namespace judge {

/// A value and its N first derivatives. T may itself be a Dual: then derivatives of derivatives come along.
template <class T, int N>
struct Dual {
  T v{};
  std::array<T, N> d{};

  Dual() = default;
  Dual(double value) : v(value) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  friend Dual operator+(Dual a, const Dual& b) {
    a.v = a.v + b.v;
    for (int i = 0; i < N; ++i) a.d[i] = a.d[i] + b.d[i];
    return a;
  }
  friend Dual operator-(Dual a, const Dual& b) {
    a.v = a.v - b.v;
    for (int i = 0; i < N; ++i) a.d[i] = a.d[i] - b.d[i];
    return a;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual c;
    c.v = a.v * b.v;
    for (int i = 0; i < N; ++i) c.d[i] = a.d[i] * b.v + a.v * b.d[i];
    return c;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual c;
    const T inverse = 1.0 / b.v;
    c.v = a.v * inverse;
    for (int i = 0; i < N; ++i) c.d[i] = (a.d[i] - c.v * b.d[i]) * inverse;
    return c;
  }
  friend Dual operator*(double a, Dual b) {
    b.v = a * b.v;
    for (int i = 0; i < N; ++i) b.d[i] = a * b.d[i];
    return b;
  }
  friend Dual operator/(double a, const Dual& b) { return Dual(a) / b; }
  friend Dual operator-(Dual a, double b) {
    a.v = a.v - b;
    return a;
  }
};

template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& a) {
  using std::sqrt;
  Dual<T, N> c;
  c.v = sqrt(a.v);
  const T slope = 0.5 / c.v;
  for (int i = 0; i < N; ++i) c.d[i] = slope * a.d[i];
  return c;
}

/// sin, for functions of time.
template <class T, int N>
Dual<T, N> sin(const Dual<T, N>& a);
template <class T, int N>
Dual<T, N> cos(const Dual<T, N>& a) {
  using std::cos, std::sin;
  Dual<T, N> c;
  c.v = cos(a.v);
  const T slope = -1.0 * sin(a.v);
  for (int i = 0; i < N; ++i) c.d[i] = slope * a.d[i];
  return c;
}
template <class T, int N>
Dual<T, N> sin(const Dual<T, N>& a) {
  using std::cos, std::sin;
  Dual<T, N> c;
  c.v = sin(a.v);
  const T slope = cos(a.v);
  for (int i = 0; i < N; ++i) c.d[i] = slope * a.d[i];
  return c;
}

}  // namespace judge
