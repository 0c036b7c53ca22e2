#include "core/element/fixed_element.hpp"

namespace vlbeam {
namespace {

ShapeTable<double> shape_of(const Weights<double>& w, double u) {
  return w == unit_weights ? hermite_shape(u) : rational_shape(w, u);
}

template <class Rule>
FixedInertia inertia_by(const Rule& rule, double l, const Weights<double>& w) {
  FixedInertia inertia{};
  for (const auto& point : rule) {
    const auto f = shape_of(w, point.u);
    const std::array<double, 4> s{f[0][0], l * f[1][0], f[2][0], l * f[3][0]};
    for (std::size_t i = 0; i < 4; ++i) {
      inertia.load[i] += point.weight * l * s[i];
      for (std::size_t j = 0; j < 4; ++j) inertia.mass[i][j] += point.weight * l * s[i] * s[j];
    }
  }
  return inertia;
}

}  // namespace

FixedBasis<double> fixed_basis(double l, const Weights<double>& w, const BeamRule& rule) {
  FixedBasis<double> basis;
  for (const auto& [u, weight, feels] : rule) {
    const auto f = shape_of(w, u);
    (feels == Feels::stretch ? basis.stretch : basis.points)
        .push_back({weight * l, {f[2][1] / l, f[1][1], f[3][1]}, {f[2][2] / (l * l), f[1][2] / l, f[3][2] / l}});
  }
  return basis;
}

FixedInertia fixed_inertia(double l, const Weights<double>& w, const BeamRule& rule) {
  return inertia_by(with_mass(rule), l, w);
}

FixedInertia fixed_inertia(double l, const Weights<double>& w, const QuadratureRule& rule) {
  return inertia_by(rule, l, w);
}

}  // namespace vlbeam
