#pragma once

#include <Eigen/Core>
#include <cmath>

namespace vlbeam {

/// Four doubles treated as one scalar, so that an element law computes four elements at once. Lanes never mix: the
/// digits of an element depend neither on its neighbours in the pack nor on the width of the machine's registers.
class Pack {
 public:
  static constexpr int width = 4;
  // aligned as Eigen aligns its fixed-size arrays in the portable build
  using Lanes __attribute__((vector_size(width * sizeof(double)), aligned(16))) = double;

  Pack() = default;
  Pack(double x) : lanes_{x, x, x, x} {}  // NOLINT(google-explicit-constructor): a number is a pack of equal lanes
  explicit Pack(const Lanes& lanes) : lanes_(lanes) {}
  Pack(double a, double b, double c, double d) : lanes_{a, b, c, d} {}

  double operator[](int i) const { return lanes_[i]; }
  void set(int i, double x) { lanes_[i] = x; }

  Pack& operator+=(const Pack& b) {
    lanes_ += b.lanes_;
    return *this;
  }
  Pack& operator-=(const Pack& b) {
    lanes_ -= b.lanes_;
    return *this;
  }
  Pack& operator*=(const Pack& b) {
    lanes_ *= b.lanes_;
    return *this;
  }
  Pack& operator/=(const Pack& b) {
    lanes_ /= b.lanes_;
    return *this;
  }
  friend Pack operator+(Pack a, const Pack& b) { return a += b; }
  friend Pack operator-(Pack a, const Pack& b) { return a -= b; }
  friend Pack operator*(Pack a, const Pack& b) { return a *= b; }
  friend Pack operator/(Pack a, const Pack& b) { return a /= b; }
  friend Pack operator-(const Pack& a) { return Pack(Lanes(-a.lanes_)); }
  friend Pack sqrt(const Pack& a) { return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }

 private:
  Lanes lanes_;
};

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
