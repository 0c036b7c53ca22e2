#include "core/element/fixed_element.hpp"

#include <cmath>

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

/// The points of a rule on each piece of an element, those of the axial strain behind all others, with the shares of
/// the section there.
struct PiecewiseRule {
  BeamRule rule;
  std::vector<SectionShare> shares;

  PiecewiseRule(double a, double b, const BeamRule& on_each, const SectionPieces& pieces) {
    for (const bool stretch : {false, true}) {
      pieces.visit(a, b, [&](const SectionPieces::Stretch& piece) {
        const double from = (piece.low - a) / (b - a), size = (piece.high - piece.low) / (b - a);
        for (const auto& [u, weight, feels] : on_each) {
          if ((feels == Feels::stretch) != stretch) continue;
          rule.push_back({from + u * size, weight * size, feels});
          shares.push_back(*piece.share);
        }
      });
    }
  }
};

}  // namespace

FixedBasis<double> fixed_basis(double a, double b, const Weights<double>& w, const BeamRule& rule,
                               const SectionPieces& pieces) {
  if (pieces.empty()) return fixed_basis(b - a, w, rule);
  const PiecewiseRule piecewise(a, b, rule, pieces);
  FixedBasis<double> basis = fixed_basis(b - a, w, piecewise.rule);
  const auto scale = [](FixedBasis<double>::Point& point, const SectionShare& share) {
    point.weight *= share.axial;
    for (double& s_xx : point.s_xx) s_xx *= std::sqrt(share.bending / share.axial);
  };
  auto share = piecewise.shares.begin();
  for (auto& point : basis.points) scale(point, *share++);
  for (auto& point : basis.stretch) scale(point, *share++);
  return basis;
}

FixedInertia fixed_inertia(double a, double b, const Weights<double>& w, const BeamRule& rule,
                           const SectionPieces& pieces) {
  if (pieces.empty()) return fixed_inertia(b - a, w, rule);
  PiecewiseRule piecewise(a, b, rule, pieces);
  for (std::size_t g = 0; g < piecewise.rule.size(); ++g) piecewise.rule[g].weight *= piecewise.shares[g].mass;
  return fixed_inertia(b - a, w, piecewise.rule);
}

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
