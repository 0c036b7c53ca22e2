#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#include "core/geometry/elementary.hpp"

namespace vlbeam {

/// A number with its derivatives by `N` variables: forward automatic differentiation. Operation by operation it rounds
/// as Eigen::AutoDiffScalar does, but is no expression template, which would be another type for each expression.
/// A number without derivatives is a constant. `Value` may be a Pack.
template <int N, class Value = double>
class Active {
 public:
  using Derivatives = Eigen::Matrix<Value, N, 1>;

  Active() = default;
  Active(const Value& value)  // NOLINT(google-explicit-constructor): a number is a constant
      : value_(value), derivatives_(Derivatives::Zero()) {}
  template <class Number>
  requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, Value>) Active(Number value)
      : Active(Value(value)) {}  // NOLINT(google-explicit-constructor)
  /// The variable `which`.
  Active(const Value& value, int which) : Active(value) { derivatives_[which] = Value(1); }

  const Value& value() const { return value_; }
  Value& value() { return value_; }
  const Derivatives& derivatives() const { return derivatives_; }
  Derivatives& derivatives() { return derivatives_; }

  Active& operator+=(const Active& b) { return *this = *this + b; }
  Active& operator-=(const Active& b) { return *this = *this - b; }
  Active& operator*=(const Active& b) { return *this = *this * b; }
  Active& operator/=(const Active& b) { return *this = *this / b; }

  friend Active operator+(const Active& a, const Active& b) {
    return make(a.value_ + b.value_, [&](int i) { return a.by(i) + b.by(i); });
  }
  friend Active operator-(const Active& a, const Active& b) {
    return make(a.value_ - b.value_, [&](int i) { return a.by(i) - b.by(i); });
  }
  friend Active operator*(const Active& a, const Active& b) {
    return make(a.value_ * b.value_, [&](int i) { return a.by(i) * b.value_ + b.by(i) * a.value_; });
  }
  friend Active operator/(const Active& a, const Active& b) {
    const Value scale = Value(1) / (b.value_ * b.value_);
    return make(a.value_ / b.value_, [&](int i) { return (a.by(i) * b.value_ - b.by(i) * a.value_) * scale; });
  }
  friend Active operator-(const Active& a) {
    return make(-a.value_, [&](int i) { return -a.by(i); });
  }

  friend Active operator+(const Active& a, const Value& b) { return a.with(a.value_ + b); }
  friend Active operator+(const Value& a, const Active& b) { return b.with(a + b.value_); }
  friend Active operator-(const Active& a, const Value& b) { return a.with(a.value_ - b); }
  friend Active operator-(const Value& a, const Active& b) {
    return make(a - b.value_, [&](int i) { return -b.by(i); });
  }
  friend Active operator*(const Active& a, const Value& b) { return chain(a.value_ * b, a, b); }
  friend Active operator*(const Value& a, const Active& b) { return chain(b.value_ * a, b, a); }
  friend Active operator/(const Active& a, const Value& b) { return chain(a.value_ / b, a, Value(1) / b); }
  friend Active operator/(const Value& a, const Active& b) {
    return chain(a / b.value_, b, -a / (b.value_ * b.value_));
  }

  friend bool operator<(const Active& a, const Active& b) { return a.value_ < b.value_; }
  friend bool operator>(const Active& a, const Active& b) { return a.value_ > b.value_; }
  friend bool operator==(const Active& a, const Active& b) { return a.value_ == b.value_; }

  friend Active clamped(const Active& a, double low, double high) {
    if constexpr (std::is_same_v<Value, double>) {
      return a.value_ < low ? Active(low) : a.value_ > high ? Active(high) : a;
    } else {
      return make(clamped(a.value_, low, high), [&](int i) { return a.by(i) * inside(a.value_, low, high); });
    }
  }
  friend Active sqrt(const Active& a) {
    using std::sqrt;
    const Value root = sqrt(a.value_);
    return chain(root, a, Value(0.5) / root);
  }
  friend Active exp(const Active& a) {
    const double power = portable::exp(a.value_);
    return chain(power, a, power);
  }
  friend Active tanh(const Active& a) {
    const double value = portable::tanh(a.value_);
    return chain(value, a, 1 - value * value);
  }
  friend Active asin(const Active& a) {
    return chain(portable::asin(a.value_), a, 1 / std::sqrt(1 - a.value_ * a.value_));
  }

 private:
  const Value& by(int i) const { return derivatives_.data()[i]; }

  template <class Function>
  static Active make(const Value& value, const Function& by) {
    Active result;
    result.value_ = value;
    for (int i = 0; i < N; ++i) result.derivatives_.data()[i] = by(i);
    return result;
  }
  /// A function of `a` with the derivative `slope` by it.
  static Active chain(const Value& value, const Active& a, const Value& slope) {
    return make(value, [&](int i) { return a.by(i) * slope; });
  }
  Active with(const Value& value) const {
    Active result = *this;
    result.value_ = value;
    return result;
  }

  Value value_;
  Derivatives derivatives_;
};

}  // namespace vlbeam

/// @cond
template <int N, class Value>
struct Eigen::NumTraits<vlbeam::Active<N, Value>> : Eigen::NumTraits<Value> {
  using Real = vlbeam::Active<N, Value>;
  using NonInteger = vlbeam::Active<N, Value>;
  using Nested = vlbeam::Active<N, Value>;
  using Literal = double;
  enum { RequireInitialization = 1 };
};
template <int N, class Value, class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::Active<N, Value>, Value, Operation> {
  using ReturnType = vlbeam::Active<N, Value>;
};
template <int N, class Value, class Operation>
struct Eigen::ScalarBinaryOpTraits<Value, vlbeam::Active<N, Value>, Operation> {
  using ReturnType = vlbeam::Active<N, Value>;
};
/// @endcond

namespace vlbeam {

/// Values as variables, with derivatives of this size.
template <int N>
Eigen::Matrix<Active<N>, N, 1> varied(const Eigen::Matrix<double, N, 1>& values, double size) {
  Eigen::Matrix<Active<N>, N, 1> result;
  for (int i = 0; i < N; ++i) {
    result[i] = Active<N>(values[i]);
    result[i].derivatives()[i] = size;
  }
  return result;
}

}  // namespace vlbeam
