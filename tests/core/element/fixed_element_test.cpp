#include "core/element/fixed_element.hpp"

#include <gtest/gtest.h>

#include "core/pack.hpp"
#include "tests/core/support/element_under_test.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class FixedElement : public ElementUnderTest<Dimension> {
 protected:
  using Base = ElementUnderTest<Dimension>;
  using Base::dim;
  using typename Base::Column;

  NodalCubic<double, dim> nodes() const { return coordinates<double, dim>(this->q_).e; }
  NodalCubic<double, dim> node_rates() const { return coordinates<double, dim>(this->rate_).e; }

  /// A new random state; a fixed-length element stands on the interval its weights are stored for.
  void draw_fixed(const ElementKindUnderTest& kind) {
    this->draw(kind);
    fix_ends();
  }
  void fix_ends() {
    this->rate_.template tail<2>().setZero();
    this->oracle_.stored.x_a = this->q_[4 * dim];
    this->oracle_.stored.x_b = this->q_[4 * dim + 1];
    this->oracle_.section.damping = 0.6;
    this->oracle_.section.curvature_regularization = dim == 3 ? 0.1 : 0.0;
  }

  FixedBasis<double> basis() const { return fixed_basis(this->length(), this->oracle_.stored.w, this->oracle_.rule); }

  /// Force on the element's column of coordinates, nothing on x_A and x_B.
  Column force(bool damped) const {
    auto section = this->oracle_.section;
    if (!damped) section.damping = 0;
    const auto f = fixed_force<double, dim>(basis(), nodes(), node_rates(), section);
    Column result;
    result << -f.r_b, f.s_a, f.r_b, f.s_b, 0, 0;
    return result;
  }

  static Column without_ends(Column force) {
    force.template tail<2>().setZero();
    return force;
  }
};
TYPED_TEST_SUITE(FixedElement, Dimensions, DimensionNames);

using Kind = ElementKindUnderTest;

TYPED_TEST(FixedElement, ForceIsMinusTheGradientOfTheEnergy) {
  this->for_each_element(4, [this](const Kind&) {
    this->fix_ends();
    const auto exact = this->without_ends(this->oracle_.elastic_force(this->q_));
    EXPECT_LE(relative_difference(this->force(false), exact), rounding);
  });
}

TYPED_TEST(FixedElement, DampingForceIsTheGradientOfTheDissipationFunction) {
  this->for_each_element(4, [this](const Kind&) {
    this->fix_ends();
    const auto exact = this->without_ends(this->oracle_.viscous_force(this->q_, this->rate_));
    EXPECT_LE(relative_difference(this->force(true) - this->force(false), exact), rounding);
  });
}

TYPED_TEST(FixedElement, MassAndLoadAreIntegralsOfTheShapeFunctions) {
  this->for_each_element(1, [this](const Kind& kind) {
    const double l = this->length();
    const auto inertia = fixed_inertia(l, this->oracle_.stored.w, beam_rule(25));
    const auto& m = inertia.mass;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) EXPECT_DOUBLE_EQ(m[i][j], m[j][i]);
    }
    EXPECT_NEAR(m[0][0] + m[0][2] + m[2][0] + m[2][2], l, rounding);
    EXPECT_NEAR(inertia.load[0] + inertia.load[2], l, rounding);
    if (kind.rational) return;
    // consistent mass of the cubic Hermite beam: l/420 times the textbook's integers
    const double exact[4][4] = {{156, 22 * l, 54, -13 * l},
                                {22 * l, 4 * l * l, 13 * l, -3 * l * l},
                                {54, 13 * l, 156, -22 * l},
                                {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(m[i][j], l / 420 * exact[i][j], 1e-15);
    }
  });
}

template <int D>
struct Element {
  FixedBasis<double> basis;
  NodalCubic<double, D> e, rate;
};

/// Force column and dissipation of one lane of a pack of elements.
template <int D>
Vec<double, 3 * D + 1> force_in_pack(const std::array<Element<D>, Pack::width>& elements, int lane,
                                     const BeamSection& section) {
  FixedBasis<Pack> basis;
  NodalCubic<Pack, D> e, rate;
  auto set_nodes = [](NodalCubic<Pack, D>& lanes, int i, const NodalCubic<double, D>& nodes) {
    for (int c = 0; c < D; ++c) {
      lanes.r_a[c].set(i, nodes.r_a[c]);
      lanes.s_a[c].set(i, nodes.s_a[c]);
      lanes.r_b[c].set(i, nodes.r_b[c]);
      lanes.s_b[c].set(i, nodes.s_b[c]);
    }
  };
  for (int i = 0; i < Pack::width; ++i) {
    const auto& element = elements[static_cast<std::size_t>(i)];
    const auto fill = [i](std::vector<FixedBasis<Pack>::Point>& to,
                          const std::vector<FixedBasis<double>::Point>& from) {
      to.resize(from.size());
      for (std::size_t g = 0; g < from.size(); ++g) {
        to[g].weight.set(i, from[g].weight);
        for (std::size_t k = 0; k < 3; ++k) {
          to[g].s_x[k].set(i, from[g].s_x[k]);
          to[g].s_xx[k].set(i, from[g].s_xx[k]);
        }
      }
    };
    fill(basis.points, element.basis.points);
    fill(basis.stretch, element.basis.stretch);
    set_nodes(e, i, element.e);
    set_nodes(rate, i, element.rate);
  }
  const auto f = fixed_force<Pack, D>(basis, e, rate, section);
  auto get = [&](const Vec<Pack, D>& v) -> Vec<double, D> {
    return v.unaryExpr([&](const Pack& p) { return p[lane]; });
  };
  Vec<double, 3 * D + 1> result;
  result << get(f.r_b), get(f.s_a), get(f.s_b), f.dissipation[lane];
  return result;
}

TYPED_TEST(FixedElement, ItsDigitsInAPackDependOnNeitherLaneNorNeighbours) {
  constexpr int D = TypeParam::value;
  ElementKindUnderTest kind{true, WeightTransport::frozen, StrainLaw::green};
  auto random_one = [&]() -> Element<D> {
    this->draw_fixed(kind);
    return {this->basis(), this->nodes(), this->node_rates()};
  };
  for (const AxialStrain axial : {AxialStrain::full, AxialStrain::lobatto}) {
    kind.axial = axial;
    const Element<D> one = random_one();
    const BeamSection section = this->oracle_.section;
    std::array<Element<D>, Pack::width> pack;
    pack.fill(one);
    const auto among_its_like = force_in_pack<D>(pack, 0, section);
    for (std::size_t lane = 0; lane < pack.size(); ++lane) {
      for (auto& element : pack) element = random_one();
      pack[lane] = one;
      EXPECT_EQ(force_in_pack<D>(pack, static_cast<int>(lane), section), among_its_like);
    }
    // Eigen sums a dot product of three doubles in another order, so this holds to roundoff only
    const auto f = fixed_force<double, D>(one.basis, one.e, one.rate, section);
    Vec<double, 3 * D + 1> single;
    single << f.r_b, f.s_a, f.s_b, f.dissipation;
    EXPECT_LE(relative_difference(among_its_like, single), 1e-14);
  }
}

}  // namespace
}  // namespace vlbeam::test
