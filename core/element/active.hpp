#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/elementary.hpp"

namespace vlbeam {

/// A number with its derivatives by `N` variables: forward automatic differentiation. Operation by operation it rounds
/// as Eigen::AutoDiffScalar does, but is no expression template, which would be another type for each expression.
/// A number without derivatives is a constant.
template <int N>
class Active {
 public:
  using Derivatives = Eigen::Matrix<double, N, 1>;

  Active() = default;
  Active(double value)  // NOLINT(google-explicit-constructor): a number is a constant
      : value_(value), derivatives_(Derivatives::Zero()) {}
  /// The variable `which`.
  Active(double value, int which) : Active(value) { derivatives_[which] = 1; }

  double value() const { return value_; }
  double& value() { return value_; }
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
    const double scale = 1 / (b.value_ * b.value_);
    return make(a.value_ / b.value_, [&](int i) { return (a.by(i) * b.value_ - b.by(i) * a.value_) * scale; });
  }
  friend Active operator-(const Active& a) {
    return make(-a.value_, [&](int i) { return -a.by(i); });
  }

  friend Active operator+(const Active& a, double b) { return a.with(a.value_ + b); }
  friend Active operator+(double a, const Active& b) { return b.with(a + b.value_); }
  friend Active operator-(const Active& a, double b) { return a.with(a.value_ - b); }
  friend Active operator-(double a, const Active& b) {
    return make(a - b.value_, [&](int i) { return -b.by(i); });
  }
  friend Active operator*(const Active& a, double b) { return chain(a.value_ * b, a, b); }
  friend Active operator*(double a, const Active& b) { return chain(b.value_ * a, b, a); }
  friend Active operator/(const Active& a, double b) { return chain(a.value_ / b, a, 1 / b); }
  friend Active operator/(double a, const Active& b) { return chain(a / b.value_, b, -a / (b.value_ * b.value_)); }

  friend bool operator<(const Active& a, const Active& b) { return a.value_ < b.value_; }
  friend bool operator>(const Active& a, const Active& b) { return a.value_ > b.value_; }
  friend bool operator==(const Active& a, const Active& b) { return a.value_ == b.value_; }

  friend Active clamped(const Active& a, double low, double high) {
    return a.value_ < low ? Active(low) : a.value_ > high ? Active(high) : a;
  }
  friend Active sqrt(const Active& a) {
    const double root = std::sqrt(a.value_);
    return chain(root, a, 0.5 / root);
  }
  friend Active exp(const Active& a) {
    const double power = portable::exp(a.value_);
    return chain(power, a, power);
  }
  friend Active tanh(const Active& a) {
    const double cosine = portable::cosh(a.value_);
    return chain(portable::tanh(a.value_), a, 1 / (cosine * cosine));
  }
  friend Active asin(const Active& a) {
    return chain(portable::asin(a.value_), a, 1 / std::sqrt(1 - a.value_ * a.value_));
  }

 private:
  double by(int i) const { return derivatives_.data()[i]; }

  template <class Function>
  static Active make(double value, const Function& by) {
    Active result;
    result.value_ = value;
    for (int i = 0; i < N; ++i) result.derivatives_.data()[i] = by(i);
    return result;
  }
  /// A function of `a` with the derivative `slope` by it.
  static Active chain(double value, const Active& a, double slope) {
    return make(value, [&](int i) { return a.by(i) * slope; });
  }
  Active with(double value) const {
    Active result = *this;
    result.value_ = value;
    return result;
  }

  double value_;
  Derivatives derivatives_;
};

}  // namespace vlbeam

/// @cond
template <int N>
struct Eigen::NumTraits<vlbeam::Active<N>> : Eigen::NumTraits<double> {
  using Real = vlbeam::Active<N>;
  using NonInteger = vlbeam::Active<N>;
  using Nested = vlbeam::Active<N>;
  using Literal = double;
  enum { RequireInitialization = 1 };
};
template <int N, class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::Active<N>, double, Operation> {
  using ReturnType = vlbeam::Active<N>;
};
template <int N, class Operation>
struct Eigen::ScalarBinaryOpTraits<double, vlbeam::Active<N>, Operation> {
  using ReturnType = vlbeam::Active<N>;
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
