// Functions of time that a scene prescribes, with their rates and accelerations.
#pragma once

#include <nlohmann/json.hpp>

#include "dual.hpp"

namespace judge {

/// S(t/ramp) (value + rate t + amplitude sin(2 pi frequency t)), S(s) = s^4 (35 - 84 s + 70 s^2 - 20 s^3); zero if it
/// is not given.
struct Given {
  double value = 0, rate = 0, amplitude = 0, frequency = 0, ramp = 0;

  static Given from(const nlohmann::json& scene);

  template <class Real>
  Real at(const Real& t) const {
    using std::sin;
    const Real plain = Real(value) + rate * t + amplitude * sin((2 * 3.14159265358979323846 * frequency) * t);
    return share(t) * plain;
  }
  /// Value, rate, acceleration.
  std::array<double, 3> derivatives(double t) const {
    Dual<Dual<double, 1>, 1> time;
    time.v.v = t;
    time.v.d[0] = time.d[0].v = 1;
    const auto f = at(time);
    return {f.v.v, f.v.d[0], f.d[0].d[0]};
  }

 private:
  static double number(double t) { return t; }
  template <class T>
  static double number(const Dual<T, 1>& t) {
    return number(t.v);
  }
  template <class Real>
  Real share(const Real& t) const {
    if (ramp <= 0 || number(t) >= ramp) return Real(1);
    const Real s = (1 / ramp) * t, s2 = s * s, s4 = s2 * s2;
    return s4 * (Real(35) - 84 * s + s2 * (Real(70) - 20 * s));
  }
};

}  // namespace judge
