// NURBS curves: any numbers are a chain of finite rational cubics, or NurbsError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "core/geometry/nurbs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return -1;
  vlbeam::Nurbs<2> curve;
  curve.degree = 1 + data[0] % 3;
  const std::size_t points = data[1] % 12, knots = points + static_cast<std::size_t>(curve.degree) + 1;
  std::size_t at = 2;
  const auto number = [&] {
    double value = 0;
    if (at + sizeof value <= size) std::memcpy(&value, data + at, sizeof value);
    at += sizeof value;
    return std::isfinite(value) && std::abs(value) < 1e9 ? value : 1.0;  // scenes hold finite numbers only
  };
  for (std::size_t i = 0; i < knots; ++i) curve.knots.push_back(number());
  for (std::size_t i = 0; i < points; ++i) {
    curve.weights.push_back(number());
    const double x = number(), y = number();
    curve.points.emplace_back(x, y);
  }
  try {
    for (const auto& span : vlbeam::rational_spans(curve)) {
      for (const auto& point : span.curve.points) {
        if (!point.allFinite()) std::abort();
      }
    }
  } catch (const vlbeam::NurbsError&) {
  }
  return 0;
}
