#pragma once

#include "core/element/pack.hpp"

namespace vlbeam {

/// Four numbers, each with its derivative by one variable of its own: forward automatic differentiation in lanes. A
/// Pack is constant.
class ActivePack {
 public:
  ActivePack() = default;
  ActivePack(double x) : value_(x), by_(0.0) {}       // NOLINT(google-explicit-constructor)
  ActivePack(const Pack& x) : value_(x), by_(0.0) {}  // NOLINT(google-explicit-constructor)
  ActivePack(const Pack& value, const Pack& by) : value_(value), by_(by) {}

  const Pack& value() const { return value_; }
  const Pack& by() const { return by_; }

  ActivePack& operator+=(const ActivePack& b) {
    value_ += b.value_;
    by_ += b.by_;
    return *this;
  }
  ActivePack& operator-=(const ActivePack& b) {
    value_ -= b.value_;
    by_ -= b.by_;
    return *this;
  }
  ActivePack& operator*=(const ActivePack& b) { return *this = *this * b; }
  ActivePack& operator/=(const ActivePack& b) { return *this = *this / b; }

  friend ActivePack operator+(ActivePack a, const ActivePack& b) { return a += b; }
  friend ActivePack operator-(ActivePack a, const ActivePack& b) { return a -= b; }
  friend ActivePack operator-(const ActivePack& a) { return {-a.value_, -a.by_}; }
  friend ActivePack operator*(const ActivePack& a, const ActivePack& b) {
    return {a.value_ * b.value_, a.by_ * b.value_ + a.value_ * b.by_};
  }
  friend ActivePack operator/(const ActivePack& a, const ActivePack& b) {
    const Pack inverse = Pack(1.0) / b.value_, quotient = a.value_ * inverse;
    return {quotient, (a.by_ - quotient * b.by_) * inverse};
  }

  friend ActivePack operator+(const ActivePack& a, const Pack& b) { return {a.value_ + b, a.by_}; }
  friend ActivePack operator+(const Pack& a, const ActivePack& b) { return {a + b.value_, b.by_}; }
  friend ActivePack operator-(const ActivePack& a, const Pack& b) { return {a.value_ - b, a.by_}; }
  friend ActivePack operator-(const Pack& a, const ActivePack& b) { return {a - b.value_, -b.by_}; }
  friend ActivePack operator*(const ActivePack& a, const Pack& b) { return {a.value_ * b, a.by_ * b}; }
  friend ActivePack operator*(const Pack& a, const ActivePack& b) { return {a * b.value_, a * b.by_}; }

  friend ActivePack operator+(const ActivePack& a, double b) { return a + Pack(b); }
  friend ActivePack operator+(double a, const ActivePack& b) { return Pack(a) + b; }
  friend ActivePack operator-(const ActivePack& a, double b) { return a - Pack(b); }
  friend ActivePack operator-(double a, const ActivePack& b) { return Pack(a) - b; }
  friend ActivePack operator*(const ActivePack& a, double b) { return a * Pack(b); }
  friend ActivePack operator*(double a, const ActivePack& b) { return Pack(a) * b; }

  friend ActivePack clamped(const ActivePack& a, double low, double high) {
    ActivePack result = a;
    for (int i = 0; i < Pack::width; ++i) {
      if (a.value_[i] >= low && a.value_[i] <= high) continue;
      result.value_.set(i, a.value_[i] < low ? low : high);
      result.by_.set(i, 0);
    }
    return result;
  }
  friend ActivePack sqrt(const ActivePack& a) {
    const Pack root = sqrt(a.value_);
    return {root, a.by_ * (Pack(0.5) / root)};
  }

 private:
  Pack value_, by_;
};

}  // namespace vlbeam

/// @cond
template <>
struct Eigen::NumTraits<vlbeam::ActivePack> : Eigen::NumTraits<vlbeam::Pack> {
  using Real = vlbeam::ActivePack;
  using NonInteger = vlbeam::ActivePack;
  using Nested = vlbeam::ActivePack;
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::ActivePack, vlbeam::Pack, Operation> {
  using ReturnType = vlbeam::ActivePack;
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::Pack, vlbeam::ActivePack, Operation> {
  using ReturnType = vlbeam::ActivePack;
};
/// @endcond
