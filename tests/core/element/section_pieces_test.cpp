// Elements of a beam whose sections change along it, against energies that this file sums up by itself.
#include "core/element/section_pieces.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "core/element/fixed_element.hpp"
#include "core/element/moving_tangent.hpp"

namespace vlbeam::test {
namespace {

constexpr double jumps_at = 0.37;

template <int D>
class PiecewiseElement {
 public:
  using Coordinates = MovingCoordinates<double, D>;
  using Array = Eigen::Matrix<double, 4 * D + 2, 1>;

  PiecewiseElement(StrainLaw law_, double EI_behind, AxialStrain axial, const Weights<double>& weights)
      : pieces_({{jumps_at, {1, 1, 1}}, {10, {0.4, 2.5, EI_behind}}}),
        weights_{weights, 0, 1},
        table_(beam_rule(7, axial), weights) {
    law_of_.section.rhoA = 1.3;
    law_of_.section.stiffness = {200, 3, law_};
    law_of_.gravity = Vec<double, D>::Unit(1) * -9.81;
    law_of_.pieces = &pieces_;
  }

  const MovingLaw<D>& law() const { return law_of_; }
  const WeightFunction& weights() const { return weights_; }
  const ShapeTabulation& table() const { return table_; }

  static Coordinates coordinates(const Array& q) {
    Coordinates result;
    result.e = {q.template head<D>(), q.template segment<D>(D), q.template segment<D>(2 * D),
                q.template segment<D>(3 * D)};
    result.x_a = q[4 * D];
    result.x_b = q[4 * D + 1];
    return result;
  }

  /// Kinetic energy and potential. Where both pieces bend, the moment is linear along the element, and bends it as much
  /// as what of its curvature is linear; the rest is as stiff as elsewhere.
  double energy(const Array& q, const Array& rate) const {
    const Coordinates at = coordinates(q), v = coordinates(rate);
    const MovingKinematics<double, D> element(at, v, WeightTransport::frozen, weights_);
    double sum = 0;
    Eigen::Matrix2d softness = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 2, 3> bends = Eigen::Matrix<double, 2, 3>::Zero(), stiff_bends = bends;
    Eigen::Matrix2d stiffness = softness;
    for (const auto& [low, high, share] :
         {std::tuple{at.x_a, jumps_at, pieces_.at(0)}, {jumps_at, at.x_b, pieces_.at(1)}}) {
      const BeamSection section = share.of(law_of_.section);
      for (const auto& [xi, w, feels] : table_.rule) {
        const double x = low + xi * (high - low), weight = w * (high - low), u = (x - at.x_a) / (at.x_b - at.x_a);
        const auto point = element.at(u, rational_shape(element.weights(), u));
        const BeamSection felt = section.as_felt(feels);
        sum += weight * felt.rhoA * (0.5 * point.v.squaredNorm() - law_of_.gravity.dot(point.r));
        Stiffness axial = felt.stiffness;
        axial.EI = 0;
        sum += weight * ElasticStress<double, D>(point.r_x, point.r_xx, axial).axial;
        const double EI = felt.stiffness.EI;
        if (EI == 0) continue;
        Vec<double, 3> slope = Vec<double, 3>::Zero(), second = Vec<double, 3>::Zero();
        slope.template head<D>() = point.r_x;
        second.template head<D>() = point.r_xx;
        const Vec<double, 3> curvature =
            slope.cross(second) / std::pow(slope.norm(), section.stiffness.green() ? 3 : 2);
        if (pieces_.at(1).bending == 0) {
          sum += weight * EI / 2 * curvature.squaredNorm();
          continue;
        }
        const Eigen::Vector2d shape(1, x);
        softness += weight / EI * shape * shape.transpose();
        bends += weight * shape * curvature.transpose();
        stiffness += weight * EI * shape * shape.transpose();
        stiff_bends += weight * EI * shape * curvature.transpose();
        sum += weight * EI / 2 * curvature.squaredNorm();  // less what of it is linear, below
      }
    }
    if (pieces_.at(1).bending > 0) {
      sum += 0.5 * (bends.transpose() * softness.inverse() * bends).trace();
      sum -= 0.5 * (stiff_bends.transpose() * stiffness.inverse() * stiff_bends).trace();
    }
    return sum;
  }

 private:
  SectionPieces pieces_;
  MovingLaw<D> law_of_;
  WeightFunction weights_;
  ShapeTabulation table_;
};

template <int D>
typename PiecewiseElement<D>::Array random_array(std::mt19937& random, double size) {
  typename PiecewiseElement<D>::Array q;
  for (double& value : q) value = size * std::uniform_real_distribution(-1.0, 1.0)(random);
  return q;
}

template <int D>
typename PiecewiseElement<D>::Array bent(std::mt19937& random) {
  typename PiecewiseElement<D>::Array q = random_array<D>(random, 0.1);
  q[D] += 1;      // the slope at A
  q[2 * D] += 1;  // B
  q[3 * D] += 1;
  q[4 * D + 1] += 1;
  return q;
}

template <class Check>
void for_each_kind(const Check& check) {
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    for (const double EI : {0.2, 0.0}) {
      for (const AxialStrain axial : {AxialStrain::full, AxialStrain::lobatto}) {
        for (const Weights<double>& weights : {unit_weights, Weights<double>{1, 0.8, 1.1, 0.9}}) {
          check(law, EI, axial, weights);
        }
      }
    }
  }
}

template <int D>
void power_is_the_change_of_energy() {
  std::mt19937 random(7);
  for_each_kind([&](StrainLaw law, double EI, AxialStrain axial, const Weights<double>& weights) {
    const PiecewiseElement<D> element(law, EI, axial, weights);
    const auto q = bent<D>(random), rate = random_array<D>(random, 1), a = random_array<D>(random, 10);
    const auto of = moving_residual<MovingEnds::both, double, D>(element.coordinates(q), element.coordinates(rate),
                                                                 element.coordinates(a), element.weights(),
                                                                 element.table(), element.law());
    double power = of.ends[0] * rate[4 * D] + of.ends[1] * rate[4 * D + 1];
    for (int i = 0; i < 4; ++i) power += of.nodes[static_cast<std::size_t>(i)].dot(rate.template segment<D>(D * i));
    const double h = 1e-5;
    const double change_of_energy =
        (element.energy(q + h * rate, rate + h * a) - element.energy(q - h * rate, rate - h * a)) / (2 * h);
    EXPECT_NEAR(power, change_of_energy, 1e-6 * (1 + std::abs(power)));
  });
}

TEST(SectionPieces, PowerIsTheChangeOfEnergy) {
  power_is_the_change_of_energy<2>();
  power_is_the_change_of_energy<3>();
}

TEST(SectionPieces, MassesAreThoseOfTheEquations) {
  std::mt19937 random(11);
  for_each_kind([&](StrainLaw law, double EI, AxialStrain axial, const Weights<double>& weights) {
    const PiecewiseElement<2> element(law, EI, axial, weights);
    const auto q = element.coordinates(bent<2>(random)), rate = element.coordinates(random_array<2>(random, 1));
    using Element = MovingElement<double, 2, MovingEnds::both>;
    const auto all = Element::equations(q, rate, element.weights(), element.table(), element.law());
    const auto masses = Element::masses(q, element.weights(), element.table(), element.law());
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(masses.mass_a[i], all.mass_a[i]);
      EXPECT_EQ(masses.mass_b[i], all.mass_b[i]);
      for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(masses.mass[i][j], all.mass[i][j]) << i << j;
    }
    EXPECT_EQ(masses.mass_aa, all.mass_aa);
    EXPECT_EQ(masses.mass_ab, all.mass_ab);
    EXPECT_EQ(masses.mass_bb, all.mass_bb);
  });
}

/// Where the section does not change after all, the element is that of one section.
TEST(SectionPieces, AnElementOfOneSectionIsAsWithoutPieces) {
  std::mt19937 random(13);
  const SectionPieces pieces({{jumps_at, {1, 1, 1}}, {10, {1, 1, 1}}});
  for (const StrainLaw strain : {StrainLaw::green, StrainLaw::engineering}) {
    MovingLaw<3> law;
    law.section.rhoA = 1.3;
    law.section.stiffness = {200, 3, strain};
    const ShapeTabulation table(beam_rule(20), unit_weights);
    const auto q = bent<3>(random), rate = random_array<3>(random, 1), a = random_array<3>(random, 10);
    const auto residual = [&] {
      using Element = PiecewiseElement<3>;
      return moving_residual<MovingEnds::both, double, 3>(Element::coordinates(q), Element::coordinates(rate),
                                                          Element::coordinates(a), {unit_weights, 0, 1}, table, law);
    };
    const auto one = residual();
    law.pieces = &pieces;
    const auto two = residual();
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((one.nodes[i] - two.nodes[i]).norm(), 1e-9 * one.nodes[0].norm());
    for (std::size_t e = 0; e < 2; ++e) EXPECT_NEAR(one.ends[e], two.ends[e], 1e-9 * std::abs(one.ends[0]));
  }
}

}  // namespace
}  // namespace vlbeam::test
