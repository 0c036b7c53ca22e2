#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>

namespace vlbeam::test {

/// Forward automatic differentiation along one direction: a value and its rate. Nests to any depth, which
/// Eigen::AutoDiffScalar does not: Dual<Dual<double>> has second derivatives in rate.rate.
template <class Real>
struct Dual {
  Real value{0}, rate{0};

  Dual() = default;
  Dual(double x) : value(x) {}  // NOLINT(google-explicit-constructor): a number is a constant
  Dual(const Real& x) requires(!std::same_as<Real, double>)  // NOLINT(google-explicit-constructor)
      : value(x) {}
  Dual(const Real& x, const Real& x_rate) : value(x), rate(x_rate) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.rate + b.rate}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.rate - b.rate}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Real quotient = a.value / b.value;
    return {quotient, (a.rate - quotient * b.rate) / b.value};
  }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.rate}; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend Dual clamped(const Dual& a, double low, double high) {
    return a.value < low ? Dual(low) : Real(high) < a.value ? Dual(high) : a;
  }
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const Real root = sqrt(a.value);
    return {root, a.rate / (Real(2) * root)};
  }
  friend Dual sin(const Dual& a) {
    using std::cos, std::sin;
    return {sin(a.value), a.rate * cos(a.value)};
  }
  friend Dual cos(const Dual& a) {
    using std::cos, std::sin;
    return {cos(a.value), -(a.rate * sin(a.value))};
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    return {atan2(y.value, x.value), (y.rate * x.value - x.rate * y.value) / (x.value * x.value + y.value * y.value)};
  }
};

/// q + q' t as a function of time, at t = 0.
template <class Real, int N>
Eigen::Matrix<Dual<Real>, N, 1> in_motion(const Eigen::Matrix<Real, N, 1>& q, const Eigen::Matrix<Real, N, 1>& rate) {
  Eigen::Matrix<Dual<Real>, N, 1> moving(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) moving[i] = {q[i], rate[i]};
  return moving;
}

template <class Real, int N>
Eigen::Matrix<Real, N, 1> value_of(const Eigen::Matrix<Dual<Real>, N, 1>& q) {
  return q.unaryExpr([](const Dual<Real>& x) { return x.value; });
}
template <class Real, int N>
Eigen::Matrix<Real, N, 1> rate_of(const Eigen::Matrix<Dual<Real>, N, 1>& q) {
  return q.unaryExpr([](const Dual<Real>& x) { return x.rate; });
}

/// Gradient of the scalar function `f` at q.
template <class Function, int N>
Eigen::Matrix<double, N, 1> gradient(const Function& f, const Eigen::Matrix<double, N, 1>& q) {
  Eigen::Matrix<double, N, 1> result(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Eigen::Matrix<double, N, 1> unit = Eigen::Matrix<double, N, 1>::Unit(q.size(), i);
    result[i] = f(in_motion(q, unit)).rate;
  }
  return result;
}

/// Lagrange's equations d/dt dL/dq' - dL/dq at (q, q', q''), by automatic differentiation of
/// `lagrangian.operator()<Real>(q, q')`.
template <int N, class Lagrangian>
Eigen::Matrix<double, N, 1> lagrange_residual(const Lagrangian& lagrangian, const Eigen::Matrix<double, N, 1>& q,
                                              const Eigen::Matrix<double, N, 1>& rate,
                                              const Eigen::Matrix<double, N, 1>& a) {
  using First = Dual<double>;
  using Second = Dual<First>;
  using Column = Eigen::Matrix<double, N, 1>;
  auto second = [&](const Column& v1, const Column& q2, const Column& v2) {
    Eigen::Matrix<Second, N, 1> at, moving;
    for (int i = 0; i < N; ++i) {
      at[i] = {First(q[i], 0), First(q2[i])};
      moving[i] = {First(rate[i], v1[i]), First(v2[i])};
    }
    return lagrangian.template operator()<Second>(at, moving).rate.rate;
  };
  const Eigen::Matrix<First, N, 1> still = rate.template cast<First>();
  Column result = -gradient(
      [&](const Eigen::Matrix<First, N, 1>& at) { return lagrangian.template operator()<First>(at, still); }, q);
  for (int i = 0; i < N; ++i) result[i] += second(Column::Unit(i), rate, a);
  return result;
}

}  // namespace vlbeam::test

template <class Real>
struct Eigen::NumTraits<vlbeam::test::Dual<Real>> : Eigen::GenericNumTraits<vlbeam::test::Dual<Real>> {
  using Self = vlbeam::test::Dual<Real>;
  using NonInteger = Self;
  using Nested = Self;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 2,
    MulCost = 3
  };
};

template <class Real, class Operation>
struct Eigen::ScalarBinaryOpTraits<vlbeam::test::Dual<Real>, double, Operation> {
  using ReturnType = vlbeam::test::Dual<Real>;
};
template <class Real, class Operation>
struct Eigen::ScalarBinaryOpTraits<double, vlbeam::test::Dual<Real>, Operation> {
  using ReturnType = vlbeam::test::Dual<Real>;
};
