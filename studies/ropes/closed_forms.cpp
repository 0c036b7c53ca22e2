#include "studies/ropes/closed_forms.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "core/geometry/elementary.hpp"
#include "scene/derived.hpp"

namespace vlbeam::ropes {
namespace {

constexpr double gravity = 9.81;

/// In water, of a length [N/m].
double weight_of(const Scene& scene) {
  double mass = scene.beam.section.rhoA;
  if (scene.fluid) mass -= scene.fluid->density * scene.fluid->area.value_or(0);
  return gravity * mass;
}

template <class Function>
double root_of(const Function& f, double low, double high) {
  std::uintmax_t most = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(50), most);
  return (a + b) / 2;
}

}  // namespace

double AtwoodMachine::way(double t) const {
  const double mass = heavy + light + rope, grows = 2 * rope / length * gravity / mass;
  const double from_rest = (heavy - light) * gravity / mass;
  return from_rest / grows * (portable::cosh(std::sqrt(grows) * t) - 1);
}

Pull hanging_rope(const Scene& scene) {
  const double L = beam_length(scene), EA = scene.beam.section.EA, w = weight_of(scene);
  const Point &a = scene.beam.curve.points.front(), &b = scene.beam.curve.points.back();
  const double apart = portable::hypot(b[0] - a[0], b[1] - a[1]);
  const double H = root_of([&](double h) { return h * L / EA + 2 * h / w * portable::asinh(w * L / (2 * h)) - apart; },
                           1e-6 * w * L, 1e6 * w * L);
  return {H, w * L / 2};
}

Pull rope_from_the_ground(const Scene& scene) {
  const double L = beam_length(scene), EA = scene.beam.section.EA, w = weight_of(scene);
  const Point &anchor = scene.beam.curve.points.front(), &fairlead = scene.beam.curve.points.back();
  const double reach = fairlead[0] - anchor[0], height = fairlead[1] - anchor[1];
  const auto pull_of = [&](double s) {  // the height alone says it
    const auto excess = [&](double h) {
      return (std::sqrt(h * h + w * w * s * s) - h) / w + w * s * s / (2 * EA) - height;
    };
    return root_of(excess, 1e-9 * w * L, 1e6 * w * L);
  };
  const auto lacks = [&](double s) {
    const double h = pull_of(s);
    return L - s + h / w * portable::asinh(w * s / h) + h * L / EA - reach;
  };
  const double s = root_of(lacks, 1.001 * height, L);
  return {pull_of(s), w * s};
}

}  // namespace vlbeam::ropes
