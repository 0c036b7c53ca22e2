#pragma once

#include <cmath>

#include "core/element/fixed_element.hpp"
#include "core/element/pack.hpp"

// Registers twice as wide as those of the portable build, for kernels that look at the machine they are on. No fused
// operations: each lane rounds as a Pack's does, so that digits are equal on all machines.
#if defined(__x86_64__) && !defined(__AVX__) && (defined(__GNUC__) || defined(__clang__))
#define VLBEAM_WIDE_LANES [[gnu::target("avx2")]]

namespace vlbeam {

inline bool has_wide_lanes() { return __builtin_cpu_supports("avx2") != 0; }

/// A Pack in one register. Its operations are compiled for machines that have it: call them from functions that are,
/// too, and flattened. A copy is made by one of them, lest the compiler pass it in a register that others lack.
class WidePack {
 public:
  WidePack() = default;
  VLBEAM_WIDE_LANES WidePack(double x) : lanes_{x, x, x, x} {}  // NOLINT(google-explicit-constructor)
  VLBEAM_WIDE_LANES WidePack(double a, double b, double c, double d) : lanes_{a, b, c, d} {}
  VLBEAM_WIDE_LANES WidePack(const Pack& x)  // NOLINT(google-explicit-constructor)
      : lanes_(*reinterpret_cast<const Lanes*>(&x)) {}
  VLBEAM_WIDE_LANES WidePack(const WidePack& from) : lanes_(from.lanes_) {}
  VLBEAM_WIDE_LANES WidePack& operator=(const WidePack& from) {
    lanes_ = from.lanes_;
    return *this;
  }

  VLBEAM_WIDE_LANES double operator[](int i) const { return lanes_[i]; }
  VLBEAM_WIDE_LANES double sum() const { return (lanes_[0] + lanes_[1]) + (lanes_[2] + lanes_[3]); }

  VLBEAM_WIDE_LANES WidePack& operator+=(const WidePack& b) {
    lanes_ += b.lanes_;
    return *this;
  }
  VLBEAM_WIDE_LANES WidePack& operator-=(const WidePack& b) {
    lanes_ -= b.lanes_;
    return *this;
  }
  VLBEAM_WIDE_LANES WidePack& operator*=(const WidePack& b) {
    lanes_ *= b.lanes_;
    return *this;
  }
  VLBEAM_WIDE_LANES WidePack& operator/=(const WidePack& b) {
    lanes_ /= b.lanes_;
    return *this;
  }
  VLBEAM_WIDE_LANES friend WidePack operator+(WidePack a, const WidePack& b) { return a += b; }
  VLBEAM_WIDE_LANES friend WidePack operator-(WidePack a, const WidePack& b) { return a -= b; }
  VLBEAM_WIDE_LANES friend WidePack operator*(WidePack a, const WidePack& b) { return a *= b; }
  VLBEAM_WIDE_LANES friend WidePack operator/(WidePack a, const WidePack& b) { return a /= b; }
  VLBEAM_WIDE_LANES friend WidePack operator-(WidePack a) {
    a.lanes_ = -a.lanes_;
    return a;
  }
  VLBEAM_WIDE_LANES friend WidePack sqrt(WidePack a) {
    for (int i = 0; i < Pack::width; ++i) a.lanes_[i] = std::sqrt(a.lanes_[i]);
    return a;
  }

 private:
  using Lanes __attribute__((vector_size(Pack::width * sizeof(double)), aligned(16), may_alias)) = double;

  Lanes lanes_;
};

template <>
inline constexpr bool in_lanes<WidePack> = true;

/// Tables are those of packs, whatever machine they were made on.
template <>
struct FixedBasis<WidePack> : FixedBasis<Pack> {};

}  // namespace vlbeam

/// @cond
template <>
struct Eigen::NumTraits<vlbeam::WidePack> : Eigen::NumTraits<vlbeam::Pack> {
  using Real = vlbeam::WidePack;
  using NonInteger = vlbeam::WidePack;
  using Nested = vlbeam::WidePack;
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::WidePack, vlbeam::Pack, Operation> {
  using ReturnType = vlbeam::WidePack;
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::Pack, vlbeam::WidePack, Operation> {
  using ReturnType = vlbeam::WidePack;
};
/// @endcond
#endif
