#include "scene/time_function.hpp"

#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

/// Integral of S from 0 to t/duration, times duration: the way that a rate of 1 has gone that grows as S.
Prescribed ramped_way(double t, double duration) {
  const Prescribed rate = smooth_ramp(t, duration);
  if (t <= 0) return {0, 0, 0};
  if (t >= duration) return {t - duration / 2, 1, 0};
  const double s = t / duration;
  const double way = s * s * s * s * s * (7 + s * (-14 + s * (10 - 2.5 * s)));
  return {duration * way, rate.value, rate.rate};
}

double slope_between(const Point& a, const Point& b) { return (b[1] - a[1]) / (b[0] - a[0]); }

/// The rates at the entries of a table: those of a cubic between each two that does not overshoot (Fritsch and Butland
/// 1984), and 0 at the ends, before and after which it rests.
std::vector<double> rates_of(const std::vector<Point>& table) {
  std::vector<double> rates(table.size(), 0);
  for (std::size_t i = 1; i + 1 < table.size(); ++i) {
    const double before = slope_between(table[i - 1], table[i]), after = slope_between(table[i], table[i + 1]);
    if (!(before * after > 0)) continue;
    const double h_before = table[i][0] - table[i - 1][0], h_after = table[i + 1][0] - table[i][0];
    const double a = 2 * h_after + h_before, b = h_after + 2 * h_before;
    rates[i] = (a + b) / (a / before + b / after);
  }
  return rates;
}

/// Those of the spline with the second derivatives going on, of each piece between two rests: at its ends it rests.
/// Where the table says the same twice it rests in between.
std::vector<double> spline_rates(const std::vector<Point>& table) {
  const std::size_t last = table.size() - 1;
  std::vector<double> rates(table.size(), 0), above(table.size(), 0);
  const auto rests = [&](std::size_t i) {
    const bool stays_before = i > 0 && table[i - 1][1] == table[i][1],
               stays_behind = i < last && table[i][1] == table[i + 1][1];
    return i == 0 || i == last || stays_before || stays_behind;
  };
  for (std::size_t i = 1; i < last; ++i) {  // elimination of the tridiagonal system, forwards
    if (rests(i)) continue;
    const double before = 1 / (table[i][0] - table[i - 1][0]), behind = 1 / (table[i + 1][0] - table[i][0]);
    const double right =
        3 * (before * slope_between(table[i - 1], table[i]) + behind * slope_between(table[i], table[i + 1]));
    const double pivot = 2 * (before + behind) - before * above[i - 1];
    above[i] = behind / pivot;
    rates[i] = (right - before * rates[i - 1]) / pivot;
  }
  for (std::size_t i = last; i-- > 1;) {
    if (!rests(i)) rates[i] -= above[i] * rates[i + 1];
  }
  return rates;
}

TimeFunction tabulated(const std::vector<Point>& table, bool smooth) {
  return [table, rates = smooth ? spline_rates(table) : rates_of(table)](double t) -> Prescribed {
    if (t <= table.front()[0]) return {table.front()[1], 0, 0};
    if (t >= table.back()[0]) return {table.back()[1], 0, 0};
    const auto after = std::ranges::upper_bound(table, t, {}, [](const Point& entry) { return entry[0]; });
    const auto i = static_cast<std::size_t>(after - table.begin()) - 1;
    const double h = table[i + 1][0] - table[i][0], u = (t - table[i][0]) / h,
                 steep = slope_between(table[i], table[i + 1]);
    const double c2 = 3 * steep - 2 * rates[i] - rates[i + 1], c3 = rates[i] + rates[i + 1] - 2 * steep;
    return {table[i][1] + h * u * (rates[i] + u * (c2 + u * c3)), rates[i] + u * (2 * c2 + 3 * u * c3),
            (2 * c2 + 6 * u * c3) / h};
  };
}

/// The same function, which remembers its value at t = 0, from which motions count, and its last one: all iterations of
/// a step, and all that is held there, ask for the same time. A copy of it is for one thread.
TimeFunction remembering(TimeFunction function) {
  const Prescribed start = function(0);
  return [function = std::move(function), start, last = 0.0, value = start](double t) mutable {
    if (t == 0) return start;
    if (t != last) {
      value = function(t);
      last = t;
    }
    return value;
  };
}

TimeFunction analytic(const TimeSpec& spec) {
  const auto function = [spec](double t) -> Prescribed {
    const double omega = 2 * std::numbers::pi * spec.frequency;
    const double angle = omega * t + spec.phase_degrees * (std::numbers::pi / 180);
    const bool swings = spec.amplitude != 0;
    const double sine = swings ? spec.amplitude * portable::sin(angle) : 0,
                 cosine = swings ? spec.amplitude * portable::cos(angle) : 0;
    const double acceleration = spec.acceleration - omega * omega * sine;
    if (spec.rate_ramp > 0) {
      const Prescribed way = ramped_way(t, spec.rate_ramp);
      return {spec.value + spec.rate * way.value + t * t * spec.acceleration / 2 + sine,
              spec.rate * way.rate + t * spec.acceleration + omega * cosine,
              spec.rate * way.acceleration + acceleration};
    }
    const double value = spec.value + t * (spec.rate + t * spec.acceleration / 2) + sine;
    const double rate = spec.rate + t * spec.acceleration + omega * cosine;
    const Prescribed share = smooth_ramp(t, spec.ramp);
    return {share.value * value, share.rate * value + share.value * rate,
            share.acceleration * value + 2 * share.rate * rate + share.value * acceleration};
  };
  if (!spec.until) return function;
  return [function, until = *spec.until](double t) -> Prescribed {
    if (t < until) return function(t);
    const Prescribed then = function(until);
    return {then.value + then.rate * (t - until), then.rate, 0};
  };
}

}  // namespace

TimeFunction time_function(const TimeSpec& spec) {
  return remembering(spec.table.empty() ? analytic(spec) : tabulated(spec.table, spec.smooth.value_or(false)));
}

double steepest(const TimeSpec& f) {
  double rate = 0;
  for (std::size_t i = 1; i < f.table.size(); ++i) {
    rate = std::max(rate, std::abs(slope_between(f.table[i - 1], f.table[i])));
  }
  return rate;
}

void check_time_function(const std::string& at, const TimeSpec& spec) {
  if (spec.ramp > 0 && spec.rate_ramp > 0) {
    refuse(at + "/rate_ramp", number_text(spec.rate_ramp), "it does not go together with \"ramp\": take one of them");
  }
  if (spec.table.empty()) {
    if (spec.smooth)
      refuse(at + "/smooth", *spec.smooth ? "true" : "false", "it says how a table is read: give one, or leave it out");
    return;
  }
  const std::string key = at + "/table";
  if (spec.value != 0 || spec.rate != 0 || spec.acceleration != 0 || spec.amplitude != 0 || spec.ramp > 0 ||
      spec.rate_ramp > 0 || spec.until) {
    refuse(key, "this key", "a table stands alone: leave out the keys beside it");
  }
  if (spec.table.size() < 2) {
    refuse(key, std::to_string(spec.table.size()) + " entries",
           "there must be at least two pairs of a time and a value");
  }
  for (std::size_t i = 1; i < spec.table.size(); ++i) {
    if (spec.table[i][0] > spec.table[i - 1][0]) continue;
    refuse(key + "/" + std::to_string(i) + "/0", number_text(spec.table[i][0]),
           "times must grow: it must be more than " + number_text(spec.table[i - 1][0]) + " [s], the one before");
  }
}

}  // namespace vlbeam
