#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace vlbeam {

// Units for other instruction sets have another class, so that no function of it is shared with them by the linker.
#ifdef __AVX__
inline namespace in_one_register {
#else
inline namespace in_two_registers {
#endif

/// Four doubles treated as one scalar, so that an element law computes four elements at once. Lanes never mix: the
/// digits of an element depend neither on its neighbours in the pack nor on the width of the machine's registers.
class Pack {
 public:
  static constexpr int width = 4;

  Pack() = default;
  Pack(double x) : Pack(x, x, x, x) {}  // NOLINT(google-explicit-constructor): a number is a pack of equal lanes
#ifdef __AVX__
  Pack(double a, double b, double c, double d) : parts_{{a, b, c, d}} {}
#else
  Pack(double a, double b, double c, double d) : parts_{{a, b}, {c, d}} {}
#endif

  double operator[](int i) const { return parts_[i / in_part][i % in_part]; }
  void set(int i, double x) { parts_[i / in_part][i % in_part] = x; }

  Pack& operator+=(const Pack& b) {
    parts_[0] += b.parts_[0];
    if constexpr (last > 0) parts_[last] += b.parts_[last];
    return *this;
  }
  Pack& operator-=(const Pack& b) {
    parts_[0] -= b.parts_[0];
    if constexpr (last > 0) parts_[last] -= b.parts_[last];
    return *this;
  }
  Pack& operator*=(const Pack& b) {
    parts_[0] *= b.parts_[0];
    if constexpr (last > 0) parts_[last] *= b.parts_[last];
    return *this;
  }
  Pack& operator/=(const Pack& b) {
    parts_[0] /= b.parts_[0];
    if constexpr (last > 0) parts_[last] /= b.parts_[last];
    return *this;
  }
  friend Pack operator+(Pack a, const Pack& b) { return a += b; }
  friend Pack operator-(Pack a, const Pack& b) { return a -= b; }
  friend Pack operator*(Pack a, const Pack& b) { return a *= b; }
  friend Pack operator/(Pack a, const Pack& b) { return a /= b; }
  friend Pack operator-(Pack a) {
    a.parts_[0] = -a.parts_[0];
    if constexpr (last > 0) a.parts_[last] = -a.parts_[last];
    return a;
  }
  friend Pack clamped(const Pack& a, double low, double high) {
    return {std::clamp(a[0], low, high), std::clamp(a[1], low, high), std::clamp(a[2], low, high),
            std::clamp(a[3], low, high)};
  }
  /// 1 where it is between the bounds, or at one, else 0: the derivative of clamped().
  friend Pack inside(const Pack& a, double low, double high) {
    const auto lane = [&](int i) { return a[i] < low || a[i] > high ? 0.0 : 1.0; };
    return {lane(0), lane(1), lane(2), lane(3)};
  }
  /// Lane i of pack j becomes lane j of pack i.
  static void transpose(Pack& a, Pack& b, Pack& c, Pack& d) {
#ifdef __AVX__
    const Lanes even = __builtin_shufflevector(a.parts_[0], b.parts_[0], 0, 4, 2, 6),
                odd = __builtin_shufflevector(a.parts_[0], b.parts_[0], 1, 5, 3, 7),
                more_even = __builtin_shufflevector(c.parts_[0], d.parts_[0], 0, 4, 2, 6),
                more_odd = __builtin_shufflevector(c.parts_[0], d.parts_[0], 1, 5, 3, 7);
    a.parts_[0] = __builtin_shufflevector(even, more_even, 0, 1, 4, 5);
    b.parts_[0] = __builtin_shufflevector(odd, more_odd, 0, 1, 4, 5);
    c.parts_[0] = __builtin_shufflevector(even, more_even, 2, 3, 6, 7);
    d.parts_[0] = __builtin_shufflevector(odd, more_odd, 2, 3, 6, 7);
#else
    const auto turn = [](const Lanes& x, const Lanes& y, Lanes& first, Lanes& second) {
      const Lanes low = __builtin_shufflevector(x, y, 0, 2), high = __builtin_shufflevector(x, y, 1, 3);
      first = low;
      second = high;
    };
    const Pack a0 = a, b0 = b, c0 = c, d0 = d;
    turn(a0.parts_[0], b0.parts_[0], a.parts_[0], b.parts_[0]);
    turn(c0.parts_[0], d0.parts_[0], a.parts_[1], b.parts_[1]);
    turn(a0.parts_[1], b0.parts_[1], c.parts_[0], d.parts_[0]);
    turn(c0.parts_[1], d0.parts_[1], c.parts_[1], d.parts_[1]);
#endif
  }
  /// Four numbers that stand one behind the other.
  static Pack load(const double* from) {
    Pack result;
    result.parts_[0] = reinterpret_cast<const InMemory*>(from)[0];
    if constexpr (last > 0) result.parts_[last] = reinterpret_cast<const InMemory*>(from)[last];
    return result;
  }
  void store(double* to) const {
    reinterpret_cast<InMemory*>(to)[0] = parts_[0];
    if constexpr (last > 0) reinterpret_cast<InMemory*>(to)[last] = parts_[last];
  }

  /// The larger of `largest` and the magnitude of `a`, of finite numbers.
  friend Pack larger(const Pack& largest, const Pack& a) {
    Pack result;
    for (int i = 0; i < parts; ++i) {
      const Lanes minus = -a.parts_[i], size = a.parts_[i] > minus ? a.parts_[i] : minus;
      result.parts_[i] = size > largest.parts_[i] ? size : largest.parts_[i];
    }
    return result;
  }
  friend Pack sqrt(const Pack& a) { return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }

 private:
  // A vector wider than the machine's registers lives in memory.
#ifdef __AVX__
  static constexpr int parts = 1;
#else
  static constexpr int parts = 2;
#endif
  static constexpr int in_part = width / parts;
  static constexpr int last = parts - 1;  // no loops over parts: the compiler would take twice as long over kernels
  // aligned as Eigen aligns its fixed-size arrays in the portable build
  using Lanes __attribute__((vector_size(in_part * sizeof(double)), aligned(16))) = double;

  using InMemory __attribute__((vector_size(in_part * sizeof(double)), aligned(sizeof(double)), may_alias)) = double;

  Lanes parts_[parts];
};

}  // namespace
}  // namespace vlbeam

/// @cond
template <>
struct Eigen::NumTraits<vlbeam::Pack> : Eigen::GenericNumTraits<vlbeam::Pack> {
  using Real = vlbeam::Pack;
  using NonInteger = vlbeam::Pack;
  using Nested = vlbeam::Pack;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
/// @endcond
