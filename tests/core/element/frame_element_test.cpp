#include "mechanics/frames/frame_element.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/element/shape_functions.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

template <class Real>
using Vec3 = Vec<Real, 3>;

/// v turned by the smallest rotation from a to b, by Rodrigues.
template <class Real>
Vec3<Real> smallest_rotation(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& v) {
  const Vec3<Real> axis = a.cross(b);
  const Real along = a.dot(b);
  return v * along + axis.cross(v) + axis * Real(axis.dot(v) / (Real(1) + along));
}

template <class Real>
Vec3<Real> about(const Vec3<Real>& t, const Real& angle, const Vec3<Real>& v) {
  using std::cos, std::sin;
  return v * Real(cos(angle)) + t.cross(v) * Real(sin(angle));
}

/// An element as the theory has it, in its unknowns r_A, s_A, phi_A, r_B, s_B, phi_B and the inner angle.
struct Oracle {
  double l = 0.7;
  Weights<double> weights = unit_weights;
  FrameSection section{3, 5, 2, 0, StrainLaw::green};
  std::array<TriadReference, 2> references;
  std::array<FrameStrain<double>, 2> rest{};

  template <class Real>
  Real energy(const Eigen::Matrix<Real, 15, 1>& q) const {
    using std::atan2, std::sqrt;
    const auto part = [&](int first) -> Vec3<Real> { return q.template segment<3>(first); };
    const Vec3<Real> s_a = part(3), s_b = part(10);
    const auto derivative = [&](double u, std::size_t n) -> Vec3<Real> {
      const auto f = rational_shape(weights, u);
      Vec3<Real> sum =
          part(0) * Real(f[0][n]) + s_a * Real(l * f[1][n]) + part(7) * Real(f[2][n]) + s_b * Real(l * f[3][n]);
      for (std::size_t k = 0; k < n; ++k) sum = sum / Real(l);
      return sum;
    };
    const auto unit = [](const Vec3<Real>& v) -> Vec3<Real> { return v / Real(sqrt(v.dot(v))); };
    const Vec3<Real> t_m = unit(derivative(0.5, 1));
    const auto in_middle = [&](std::size_t end, const Vec3<Real>& s, const Real& phi) {
      const TriadReference& from = references[end];
      const Vec3<Real> t = unit(s), t_0 = from.t.template cast<Real>(), d_0 = from.d.template cast<Real>();
      return smallest_rotation<Real>(t, t_m, about<Real>(t, phi, smallest_rotation<Real>(t_0, t, d_0)));
    };
    const Vec3<Real> d_a = in_middle(0, s_a, q[6]), d_b = in_middle(1, s_b, q[13]);
    const Real twist = atan2(t_m.dot(d_a.cross(d_b)), d_a.dot(d_b));
    const Vec3<Real> f_m = about<Real>(t_m, twist / Real(2), d_a);
    Real sum(0);
    for (std::size_t g = 0; g < 2; ++g) {
      const double u = 0.5 + (g == 0 ? -1 : 1) / (2 * std::sqrt(3.0));
      const Vec3<Real> r_x = derivative(u, 1), r_xx = derivative(u, 2), t = unit(r_x);
      const Real stretch = sqrt(r_x.dot(r_x));
      const Vec3<Real> t_x = r_xx / stretch - t * Real(r_x.dot(r_xx) / (stretch * stretch));
      const Vec3<Real> f_y =
          about<Real>(t, Real(u - 0.5) * twist + Real(4 * u * (1 - u)) * q[14], smallest_rotation<Real>(t_m, t, f_m));
      const Real per = section.law == StrainLaw::green ? Real(Real(1) / stretch) : Real(1);
      const Vec3<Real> k = t.cross(t_x) * per;
      const Real own = t_m.cross(t).dot(t_x) / (Real(1) + t_m.dot(t));
      const Real y = k.dot(f_y) - Real(rest[g].y), z = k.dot(t.cross(f_y)) - Real(rest[g].z);
      const Real torsion = (twist / Real(l) + Real(4 * (1 - 2 * u) / l) * q[14] - own) * per - Real(rest[g].torsion);
      sum += Real(0.25 * l) *
             (Real(section.EI_y) * y * y + Real(section.EI_z) * z * z + Real(section.GIp) * torsion * torsion);
    }
    return sum;
  }

  FrameTable table() const {
    FrameTable table(l, weights);
    for (std::size_t g = 0; g < 2; ++g) table.points[g].rest = rest[g];
    return table;
  }
  std::array<FrameNode, 2> nodes(const FrameVector& q) const {
    return {FrameNode{references[0], q.segment<3>(0), q.segment<3>(3), q[6]},
            FrameNode{references[1], q.segment<3>(7), q.segment<3>(10), q[13]}};
  }
  double inner(const FrameVector& q) const {
    const auto ends = nodes(q);
    const FrameTable of = table();
    return FrameElement<double>(of, section, frame_ends(ends[0], ends[1], 0)).inner();
  }
};

TriadReference reference(Random& random) {
  TriadReference result;
  result.t = random.vector<3>().normalized();
  result.d = result.t.cross(random.vector<3>()).normalized();
  return result;
}

/// A bent and twisted element near its rest length, its references up to a right angle away.
FrameVector random_state(Random& random, Oracle& oracle) {
  const Vec<double, 3> t = random.vector<3>().normalized();
  FrameVector q;
  q << random.vector<3>(), 1.05 * t + random.vector<3>(0.3), random.uniform(-1, 1), random.vector<3>(),
      1.02 * t + random.vector<3>(0.3), random.uniform(-1, 1);
  q.segment<3>(7) = q.segment<3>(0) + oracle.l * (t + random.vector<3>(0.2));
  for (std::size_t end = 0; end < 2; ++end) {
    auto& at = oracle.references[end];
    do at = reference(random);
    while (at.t.dot(t) < 0.1);
    at.d = at.t.cross(Vec<double, 3>::UnitX() + 0.2 * random.vector<3>()).normalized();
  }
  for (auto& rest : oracle.rest) rest = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  return q;
}

template <class Check>
void for_each_element(const Check& check) {
  Random random(8);
  for (int i = 0; i < 12; ++i) {
    Oracle oracle;
    oracle.section.law = i % 2 == 0 ? StrainLaw::green : StrainLaw::engineering;
    if (i % 4 > 1) oracle.weights = random.weights(1.6);
    if (i % 3 == 0) oracle.section.EI_z = oracle.section.EI_y;
    if (i % 5 == 0) oracle.section.GIp = 1e4;
    const FrameVector q = random_state(random, oracle);
    check(oracle, q);
  }
}

template <class Real>
Eigen::Matrix<Real, 15, 1> with_inner(const Eigen::Matrix<Real, 14, 1>& q, double inner) {
  Eigen::Matrix<Real, 15, 1> all;
  all << q, Real(inner);
  return all;
}

TEST(FrameElement, HasTheEnergyOfTheTheory) {
  for_each_element([](const Oracle& oracle, const FrameVector& q) {
    const FrameTable table = oracle.table();
    const auto ends = oracle.nodes(q);
    const FrameElement<double> element(table, oracle.section, frame_ends(ends[0], ends[1], 0));
    const auto energy = element.energy(0.3);
    const double expected = oracle.energy(with_inner<double>(q, 0.3));
    EXPECT_NEAR(energy[0] + energy[1], expected, 1e-13 * expected);
  });
}

TEST(FrameElement, ForceIsTheGradientOfTheLeastEnergy) {
  for_each_element([](const Oracle& oracle, const FrameVector& q) {
    const double inner = oracle.inner(q);
    const auto at = [&](const auto& all) { return oracle.energy(all); };
    const Eigen::Matrix<double, 15, 1> exact = gradient(at, with_inner<double>(q, inner));
    const auto ends = oracle.nodes(q);
    const FrameVector force = frame_gradient(oracle.table(), oracle.section, ends[0], ends[1], 0);
    EXPECT_LE((force - exact.head<14>()).norm(), 1e-12 * exact.norm());
    EXPECT_LE(std::abs(exact[14]), 1e-12 * exact.norm());
  });
}

TEST(FrameElement, TangentIsTheSecondDerivative) {
  for_each_element([](const Oracle& oracle, const FrameVector& q) {
    using Twice = Dual<Dual<double>>;
    const double inner = oracle.inner(q);
    Eigen::Matrix<double, 15, 15> exact;
    for (int i = 0; i < 15; ++i) {
      for (int j = 0; j <= i; ++j) {
        Eigen::Matrix<Twice, 15, 1> at;
        const auto all = with_inner<double>(q, inner);
        for (int k = 0; k < 15; ++k) {
          at[k] = {Dual<double>(all[k], k == j ? 1 : 0), Dual<double>(k == i ? 1 : 0, 0)};
        }
        exact(i, j) = exact(j, i) = oracle.energy(at).rate.rate;
      }
    }
    const FrameMatrix condensed =
        exact.topLeftCorner<14, 14>() - exact.topRightCorner<14, 1>() * exact.bottomLeftCorner<1, 14>() / exact(14, 14);
    const auto ends = oracle.nodes(q);
    const FrameMatrix tangent = frame_tangent(oracle.table(), oracle.section, ends[0], ends[1], 0);
    EXPECT_LE((tangent - condensed).norm(), 1e-11 * condensed.norm());
    EXPECT_LE((tangent - tangent.transpose()).norm(), 1e-12 * condensed.norm());
  });
}

TEST(FrameElement, IsAtRestWhereverItIsMoved) {
  for_each_element([](Oracle oracle, const FrameVector& q) {
    const auto built = oracle.nodes(q);
    FrameTable table = oracle.table();
    const FrameElement<double> element(table, oracle.section, frame_ends(built[0], built[1], 0));
    for (std::size_t g = 0; g < 2; ++g) table.points[g].rest = element.strain(g, 0);
    Random random(3);
    for (int i = 0; i < 5; ++i) {
      const Eigen::Matrix3d turn = random.rotation<3>();
      FrameEnds<double> ends = frame_ends(built[0], built[1], 0);
      for (auto* vector : {&ends.chord, &ends.s_a, &ends.s_b, &ends.d_a, &ends.d_b}) *vector = turn * *vector;
      const FrameElement<double> moved(table, oracle.section, ends);
      const double inner = moved.inner();
      const auto energy = moved.energy(inner);
      EXPECT_LE(energy[0] + energy[1], 1e-24 * (oracle.section.GIp + 5));
    }
  });
}

TEST(FrameElement, TurnsWithItsForce) {
  for_each_element([](const Oracle& oracle, const FrameVector& q) {
    const auto built = oracle.nodes(q);
    const FrameTable table = oracle.table();
    const FrameEnds<double> ends = frame_ends(built[0], built[1], 0);
    FrameEnds<double> turned = ends;
    const Eigen::Matrix3d turn = Random(5).rotation<3>();
    for (auto* vector : {&turned.chord, &turned.s_a, &turned.s_b, &turned.d_a, &turned.d_b}) *vector = turn * *vector;
    const FrameElement<double> before(table, oracle.section, ends), after(table, oracle.section, turned);
    const auto f = before.force(before.inner()), g = after.force(after.inner());
    const double size = f.chord.norm() + std::abs(f.spin_a);
    EXPECT_LE((g.chord - turn * f.chord).norm(), 1e-12 * size);
    EXPECT_LE((g.s_a - turn * f.s_a).norm(), 1e-12 * size);
    EXPECT_NEAR(g.spin_a, f.spin_a, 1e-12 * size);
    // no force but what the ends are held by: the moments are in balance
    const auto moment = [](const FrameEnds<double>& at, const FrameForce<double>& of) -> Vec<double, 3> {
      return at.chord.cross(of.chord) + at.s_a.cross(of.s_a) + at.s_b.cross(of.s_b) + of.spin_a * at.s_a.normalized() +
             of.spin_b * at.s_b.normalized();
    };
    EXPECT_LE(moment(ends, f).norm(), 1e-12 * size);
  });
}

TEST(FrameElement, KnowsNothingOfItsReferences) {
  for_each_element([](const Oracle& oracle, const FrameVector& q) {
    const auto built = oracle.nodes(q);
    Random random(4);
    const auto seen_from = [&](const FrameNode& node, const TriadReference& other) {
      const Vec<double, 3> t = node.s.normalized(), d = node.direction, from = other.direction(node.s, 0.0);
      return std::atan2(t.dot(from.cross(d)), from.dot(d));
    };
    std::array<TriadReference, 2> others;
    for (std::size_t end = 0; end < 2; ++end) {
      do others[end] = reference(random);
      while (others[end].t.dot(built[end].s) < 0.1);
    }
    const FrameNode a{others[0], built[0].r, built[0].s, seen_from(built[0], others[0])};
    const FrameNode b{others[1], built[1].r, built[1].s, seen_from(built[1], others[1])};
    const FrameTable table = oracle.table();
    const FrameElement<double> one(table, oracle.section, frame_ends(built[0], built[1], 0));
    const FrameElement<double> other(table, oracle.section, frame_ends(a, b, 0));
    const double inner = one.inner();
    EXPECT_NEAR(one.energy(inner)[0], other.energy(inner)[0], 1e-12 * one.energy(inner)[0]);
    EXPECT_NEAR(one.energy(inner)[1], other.energy(inner)[1], 1e-12 * one.energy(inner)[1]);
  });
}

TEST(FrameElement, TwistsByMoreThanATurn) {
  Oracle oracle;
  FrameVector q = FrameVector::Zero();
  q[3] = q[10] = 1;
  q[7] = oracle.l;
  for (auto& at : oracle.references) at = {Vec<double, 3>::UnitX(), Vec<double, 3>::UnitY()};
  const FrameTable table = oracle.table();
  for (const double angle : {3.0, 4.0, -20.0, 100.0}) {
    q[13] = angle;
    const auto ends = oracle.nodes(q);
    const FrameElement<double> element(table, oracle.section, frame_ends(ends[0], ends[1], angle));
    EXPECT_NEAR(element.twist(), angle, 1e-12);
    EXPECT_NEAR(element.force(0).spin_b, oracle.section.GIp * angle / oracle.l, 1e-9);
  }
}

TEST(TriadReference, SpinIsWhatASlopeTurnsItBy) {
  Random random(2);
  for (int i = 0; i < 10; ++i) {
    const TriadReference from = reference(random);
    Vec<double, 3> s = from.t + random.vector<3>(0.8);
    const Vec<double, 3> rate = random.vector<3>();
    // the spin of the direction about the tangent
    const auto moving = in_motion(s, rate);
    const Vec<Dual<double>, 3> t = moving / Dual<double>(sqrt(moving.dot(moving)));
    const Vec<Dual<double>, 3> d =
        smallest_rotation<Dual<double>>(from.t.cast<Dual<double>>(), t, from.d.cast<Dual<double>>());
    const Vec<double, 3> now = value_of(d), turning = rate_of(d);
    EXPECT_LE((now - from.direction(s, 0.0)).norm(), 1e-14);
    EXPECT_NEAR(from.spin_by_slope<double>(s).dot(rate), value_of(t).cross(now).dot(turning), 1e-13);
    const Eigen::Matrix3d by = from.spin_by_slope_gradient<double>(s);
    const double h = 1e-6;
    const Vec<double, 3> difference =
        (from.spin_by_slope<double>(s + h * rate) - from.spin_by_slope<double>(s - h * rate)) / (2 * h);
    EXPECT_LE((by * rate - difference).norm(), 1e-8 * by.norm());
    const Vec<double, 3> curl(by(2, 1) - by(1, 2), by(0, 2) - by(2, 0), by(1, 0) - by(0, 1));
    EXPECT_LE((curl + spin_curl(s)).norm(), 1e-12 * curl.norm());
    const TriadReference later = from.at(s);
    EXPECT_LE((later.direction(s, 0.4) - from.direction(s, 0.4)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace vlbeam::test
