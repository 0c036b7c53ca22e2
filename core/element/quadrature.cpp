#include "core/element/quadrature.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cstddef>
#include <utility>

namespace vlbeam {
namespace {

template <std::size_t Points>
QuadratureRule rule() {
  QuadratureRule points;
  if constexpr (Points == 1) {
    points.push_back({0.5, 1.0});
  } else {
    // rounded once from long double, whose cosine, where Boost computes a rule, has the same digits everywhere
    using Gauss = boost::math::quadrature::gauss<long double, Points>;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      const auto x = static_cast<double>(Gauss::abscissa()[i]), w = static_cast<double>(Gauss::weights()[i]);
      points.push_back({(1 + x) / 2, w / 2});
      if (x != 0) points.push_back({(1 - x) / 2, w / 2});
    }
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
  }
  return points;
}

/// Computed when it is asked for: those of many points take as long as a short run.
template <std::size_t Points>
const QuadratureRule& kept_rule() {
  static const QuadratureRule points = rule<Points>();
  return points;
}

template <std::size_t... I>
constexpr auto all_rules(std::index_sequence<I...> /*points - 1*/) {
  return std::array{&kept_rule<I + 1>...};
}

}  // namespace

const QuadratureRule& gauss_legendre(int points) {
  static constexpr auto rules = all_rules(std::make_index_sequence<max_quadrature_points>{});
  return rules.at(static_cast<std::size_t>(points) - 1)();
}

}  // namespace vlbeam
