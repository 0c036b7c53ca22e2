#include "mechanics/frames/frame_damping.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "core/element/shape_functions.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

using Coordinates = Eigen::Matrix<double, 16, 1>;

/// A bent and twisted element between two marks, and how its nodes move.
struct Damped {
  TriadReference a, b;
  FrameSection section{3, 5, 2, 0, StrainLaw::green, 0.3};
  FrameTable unit{1, unit_weights};
  Coordinates q, rate;

  explicit Damped(unsigned seed, StrainLaw law) {
    Random random(seed);
    section.law = law;
    q << 0, 0, 0, Vec<double, 3>(1, 0, 0) + random.vector<3>(0.3), random.uniform(-1, 1),
        Vec<double, 3>(0.7, 0.05, -0.1), Vec<double, 3>(1, 0, 0) + random.vector<3>(0.3), random.uniform(-1, 1), 0.2,
        0.9;
    rate = random.vector<16>(2);
    for (TriadReference* from : {&a, &b}) {
      from->t = (Vec<double, 3>::UnitX() + random.vector<3>(0.4)).normalized();
      from->d = from->t.cross(Vec<double, 3>::UnitZ() + random.vector<3>(0.3)).normalized();
    }
  }
  FrameDamping damping() const {
    FrameDamping result{a, b, unit, section, 0, {}};
    for (std::size_t e = 0; e < 2; ++e) {
      const auto f = rational_shape(unit_weights, static_cast<double>(e));
      result.bends[e] = {f[2][2], f[1][2], f[3][2]};
    }
    return result;
  }
  FrameNode node(int e) const { return {e == 0 ? a : b, q.segment<3>(7 * e), q.segment<3>(7 * e + 3), q[7 * e + 6]}; }
  FrameElement<double> element() const {
    FrameEnds<double> ends = frame_ends(node(0), node(1), 0);
    ends.s_a *= length();
    ends.s_b *= length();
    return {unit, section, ends};
  }
  double length() const { return q[15] - q[14]; }
  /// Of a strain with these derivatives, while marks rest.
  double strain_rate(const FrameForce<double>& by) const {
    const auto spin = [&](int e) { return rate[7 * e + 6] + node(e).spin_by_slope.dot(rate.segment<3>(7 * e + 3)); };
    return by.chord.dot(rate.segment<3>(7) - rate.segment<3>(0)) +
           length() * (by.s_a.dot(rate.segment<3>(3)) + by.s_b.dot(rate.segment<3>(10))) + by.spin_a * spin(0) +
           by.spin_b * spin(1);
  }
  auto answer() const { return damping().at<double, 16>(q, rate); }
};

template <class Check>
void for_each(const Check& check) {
  for (unsigned seed = 1; seed <= 6; ++seed)
    check(Damped(seed, seed % 2 == 0 ? StrainLaw::green : StrainLaw::engineering));
}

TEST(FrameDamping, StrainsChangeByTheirDerivatives) {
  for_each([](const Damped& at) {
    const FrameElement<double> now = at.element();
    constexpr double h = 1e-6;
    const auto strains = [&](double time) {
      Damped moved = at;
      moved.q.head<14>() += time * at.rate.head<14>();
      const FrameElement<double> element = moved.element();
      Eigen::Matrix<double, 6, 1> result;
      for (std::size_t g = 0; g < 2; ++g) {
        const auto strain = element.strain(g, 0.2);
        result.segment<3>(3 * static_cast<Eigen::Index>(g)) << strain.y, strain.z, strain.torsion;
      }
      return result;
    };
    const Eigen::Matrix<double, 6, 1> difference = (strains(h) - strains(-h)) / (2 * h);
    for (std::size_t i = 0; i < 6; ++i) {
      const double rate = at.strain_rate(now.derivative(i, 0.2));
      EXPECT_NEAR(rate, difference[static_cast<Eigen::Index>(i)], 1e-7 * (1 + std::abs(rate)));
    }
  });
}

TEST(FrameDamping, TakesThePowerThatItsForceLoses) {
  for_each([](const Damped& at) {
    const auto answer = at.answer();
    EXPECT_GT(answer.power, 0);
    EXPECT_NEAR(answer.force.dot(at.rate), answer.power, 1e-12 * answer.power);
  });
}

TEST(FrameDamping, IsAsSymmetricAsAQuadraticForm) {
  for_each([](const Damped& at) {
    Damped other = at;
    other.rate = Random(9).vector<16>(1);
    EXPECT_NEAR(at.answer().force.dot(other.rate), other.answer().force.dot(at.rate), 1e-12 * at.answer().power);
  });
}

/// Neither a motion as a rigid body nor a mark that runs along a beam at rest changes a strain.
TEST(FrameDamping, FeelsNoRigidMotionAndNoMark) {
  for_each([](Damped at) {
    const double size = at.answer().force.norm();
    Random random(4);
    const Vec<double, 3> turn = random.vector<3>(), moves = random.vector<3>();
    const double tau = at.element().twist() / at.length();
    const Vec<double, 3> chord = at.q.segment<3>(7) - at.q.segment<3>(0);
    for (int e = 0; e < 2; ++e) {
      const FrameNode node = at.node(e);
      const auto f = rational_shape(unit_weights, static_cast<double>(e));
      const Vec<double, 3> bent =
          (chord * f[2][2] + at.length() * (at.q.segment<3>(3) * f[1][2] + at.q.segment<3>(10) * f[3][2])) /
          (at.length() * at.length());
      const double x_rate = at.rate[14 + e];
      const Vec<double, 3> s_rate = turn.cross(node.s) + bent * x_rate;
      at.rate.segment<3>(7 * e) = moves + turn.cross(node.r) + node.s * x_rate;
      at.rate.segment<3>(7 * e + 3) = s_rate;
      const double spin = turn.dot(node.s.normalized()) + tau * x_rate;
      at.rate[7 * e + 6] = spin - node.spin_by_slope.dot(s_rate);
    }
    const auto answer = at.answer();
    EXPECT_LE(answer.force.norm(), 1e-12 * size);
  });
}

/// Least squares find the rate of the inner angle, too.
TEST(FrameDamping, LosesTheLeastThatTheInnerAngleAllows) {
  for_each([](Damped at) {
    at.rate.tail<2>().setZero();
    const FrameElement<double> element = at.element();
    Eigen::Matrix<double, 6, 1> rates, inner;
    const double scale = at.section.law == StrainLaw::green ? at.length() : 1 / at.length();
    for (int i = 0; i < 6; ++i) {
      const auto by = element.derivative(static_cast<std::size_t>(i), 0);
      const double stiffness = i % 3 == 0 ? at.section.EI_y : i % 3 == 1 ? at.section.EI_z : at.section.GIp;
      const double size = std::sqrt(scale * 0.5 * at.section.damping * stiffness);  // both points weigh a half
      rates[i] = size * at.strain_rate(by);
      inner[i] = size * by.inner;
    }
    const Eigen::VectorXd turns = inner.colPivHouseholderQr().solve(-rates);
    const double least = (rates + inner * turns[0]).squaredNorm();
    EXPECT_LT(least, (1 - 1e-6) * rates.squaredNorm());
    EXPECT_NEAR(at.answer().power, least, 1e-12 * least);
  });
}

/// What a rod resists as it is twisted evenly, and bent evenly: as a solid does.
TEST(FrameDamping, IsThatOfTheSectionInEvenMotions) {
  Damped at(1, StrainLaw::engineering);
  const double l = at.length();
  for (TriadReference* from : {&at.a, &at.b}) *from = {Vec<double, 3>::UnitX(), Vec<double, 3>::UnitY()};
  at.q << 0, 0, 0, 1, 0, 0, 0, l, 0, 0, 1, 0, 0, 0, at.q[14], at.q[15];
  at.rate.setZero();
  at.rate[13] = 0.7;
  EXPECT_NEAR(at.answer().power, at.section.damping * at.section.GIp * 0.7 * 0.7 / l, 1e-12);
  at.section.GIp = 1e9;  // torsion that cannot give way takes nothing from bending
  at.rate[13] = 0;
  at.rate[5] = 0.5;
  at.rate[12] = -0.5;
  EXPECT_NEAR(at.answer().power, at.section.damping * at.section.EI_y / l, 1e-12);
}

}  // namespace
}  // namespace vlbeam::test
