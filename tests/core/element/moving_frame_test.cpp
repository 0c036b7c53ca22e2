#include "mechanics/frames/moving_frame.hpp"

#include <gtest/gtest.h>

#include "core/element/shape_functions.hpp"
#include "mechanics/frames/moving_frame_spin.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

template <class Real>
using Spatial = Vec<Real, 3>;

template <class Real>
Spatial<Real> unit_of(const Spatial<Real>& v) {
  using std::sqrt;
  return v / Real(sqrt(v.dot(v)));
}
/// v turned by the smallest rotation from a to b, by Rodrigues.
template <class Real>
Spatial<Real> by_smallest(const Spatial<Real>& a, const Spatial<Real>& b, const Spatial<Real>& v) {
  const Spatial<Real> axis = a.cross(b);
  return v * Real(a.dot(b)) + axis.cross(v) + axis * Real(axis.dot(v) / (Real(1) + a.dot(b)));
}
template <class Real>
Spatial<Real> turned_about(const Spatial<Real>& t, const Real& angle, const Spatial<Real>& v) {
  using std::cos, std::sin;
  return v * Real(cos(angle)) + t.cross(v) * Real(sin(angle));
}

/// An element whose ends move along a beam that is a helix at rest, as the theory has it.
struct MovingOracle {
  Weights<double> weights{1, 0.9, 0.95, 1};
  FrameSection section{3, 5, 2, 0.7, StrainLaw::green};
  std::array<TriadReference, 2> references;
  Spatial<double> orientation = Spatial<double>::Zero();

  template <class Real>
  static Spatial<Real> rest_place(const Real& x) {
    using std::cos, std::sin;
    return {Real(1.2) * Real(cos(Real(0.7) * x)), Real(1.2) * Real(sin(Real(0.7) * x)), Real(0.54258639865) * x};
  }
  template <class Real>
  static Spatial<Real> rest_slope(const Real& x) {
    using std::cos, std::sin;
    return {Real(-0.84) * Real(sin(Real(0.7) * x)), Real(0.84) * Real(cos(Real(0.7) * x)), Real(0.54258639865)};
  }
  RestTriads triads() const {
    std::vector<TriadReference> at;
    const std::vector<double> x{0, 0.5, 3};
    Spatial<double> d = rest_slope<double>(0).unitOrthogonal(), t = rest_slope<double>(0).normalized();
    for (const double place : x) {
      const Spatial<double> now = rest_slope<double>(place).normalized();
      d = carried<double>(t, now, d);
      t = now;
      at.push_back({t, d});
    }
    return {orientation, x, at};
  }

  template <class Real>
  Spatial<Real> derivative(const std::array<Spatial<Real>, 4>& e, const Real& l, double u, std::size_t n) const {
    const auto f = rational_shape(weights, u);
    Spatial<Real> sum =
        e[0] * Real(f[0][n]) + e[1] * Real(l * Real(f[1][n])) + e[2] * Real(f[2][n]) + e[3] * Real(l * Real(f[3][n]));
    for (std::size_t k = 0; k < n; ++k) sum = sum / l;
    return sum;
  }
  template <class Real>
  Real twist(const std::array<Spatial<Real>, 4>& e, const Spatial<Real>& d_a, const Spatial<Real>& d_b,
             const Real& l) const {
    using std::atan2;
    const Spatial<Real> m = unit_of<Real>(derivative<Real>(e, l, 0.5, 1));
    const Spatial<Real> a = by_smallest<Real>(unit_of<Real>(e[1]), m, d_a),
                        b = by_smallest<Real>(unit_of<Real>(e[3]), m, d_b);
    return atan2(m.dot(a.cross(b)), a.dot(b));
  }
  template <class Real>
  std::array<Real, 6> strains(const std::array<Spatial<Real>, 4>& e, const Spatial<Real>& d_a, const Spatial<Real>& d_b,
                              const Real& l, const Real& inner) const {
    using std::sqrt;
    const Spatial<Real> m = unit_of<Real>(derivative<Real>(e, l, 0.5, 1));
    const Real twists = twist<Real>(e, d_a, d_b, l);
    const Spatial<Real> f_a = by_smallest<Real>(unit_of<Real>(e[1]), m, d_a);
    std::array<Real, 6> result;
    for (std::size_t g = 0; g < 2; ++g) {
      const double u = 0.5 + (g == 0 ? -1 : 1) / (2 * std::sqrt(3.0));
      const Spatial<Real> r_x = derivative<Real>(e, l, u, 1), r_xx = derivative<Real>(e, l, u, 2);
      const Spatial<Real> t = unit_of<Real>(r_x);
      const Real stretch = sqrt(r_x.dot(r_x));
      const Spatial<Real> t_x = r_xx / stretch - t * Real(r_x.dot(r_xx) / (stretch * stretch));
      const Spatial<Real> f_y =
          by_smallest<Real>(m, t, turned_about<Real>(m, Real(u) * twists + Real(4 * u * (1 - u)) * inner, f_a));
      const Real per = section.law == StrainLaw::green ? Real(Real(1) / stretch) : Real(1);
      const Spatial<Real> k = t.cross(t_x) * per;
      const Real own = m.cross(t).dot(t_x) / (Real(1) + m.dot(t));
      result[3 * g] = k.dot(f_y);
      result[3 * g + 1] = k.dot(t.cross(f_y));
      result[3 * g + 2] = (twists / l + Real(4 * (1 - 2 * u)) * inner / l - own) * per;
    }
    return result;
  }
  template <class Real>
  std::array<Spatial<Real>, 4> nodes(const Eigen::Matrix<Real, 17, 1>& q) const {
    return {q.template segment<3>(0), q.template segment<3>(3), q.template segment<3>(7), q.template segment<3>(10)};
  }
  template <class Real>
  Spatial<Real> direction(std::size_t end, const Spatial<Real>& s, const Real& phi) const {
    const auto& from = references[end];
    const Spatial<Real> t = unit_of<Real>(s);
    return turned_about<Real>(t, phi, by_smallest<Real>(from.t.cast<Real>(), t, from.d.cast<Real>()));
  }
  /// With x_A, x_B and the inner angle behind the others.
  template <class Real>
  Real operator()(const Eigen::Matrix<Real, 17, 1>& q) const {
    const auto e = nodes<Real>(q);
    const Real l = q[15] - q[14];
    const auto now = strains<Real>(e, direction<Real>(0, e[1], q[6]), direction<Real>(1, e[3], q[13]), l, Real(q[16]));
    const RestTriads along = triads();
    const std::array<Spatial<Real>, 4> at{rest_place<Real>(q[14]), rest_slope<Real>(q[14]), rest_place<Real>(q[15]),
                                          rest_slope<Real>(q[15])};
    const auto rest =
        strains<Real>(at, along.direction<Real>(x_a, at[1]), along.direction<Real>(x_b, at[3]), l, Real(0));
    Real sum(0);
    for (std::size_t i = 0; i < 6; ++i) {
      const double stiffness = i % 3 == 0 ? section.EI_y : i % 3 == 1 ? section.EI_z : section.GIp;
      sum += Real(0.25 * stiffness) * l * (now[i] - rest[i]) * (now[i] - rest[i]);
    }
    return sum;
  }
  double x_a = 0.3, x_b = 1.1;

  /// Of spins about the tangents at the ends, as directions turn in time.
  template <class Real>
  Real operator()(const Eigen::Matrix<Real, 16, 1>& q, const Eigen::Matrix<Real, 16, 1>& rate) const {
    using Moving = Dual<Real>;
    Eigen::Matrix<Moving, 17, 1> time;
    for (int i = 0; i < 16; ++i) time[i] = {q[i], rate[i]};
    time[16] = Moving(0);
    const auto e = nodes<Moving>(time);
    const Spatial<Moving> d_a = direction<Moving>(0, e[1], time[6]), d_b = direction<Moving>(1, e[3], time[13]);
    const Moving l = time[15] - time[14], tau = twist<Moving>(e, d_a, d_b, l) / l;
    const auto spin = [&](const Spatial<Moving>& d, const Spatial<Moving>& s) {
      const Spatial<Real> now = value_of<Real, 3>(d), turning = rate_of<Real, 3>(d);
      return unit_of<Real>(value_of<Real, 3>(s)).dot(now.cross(turning));
    };
    const Real omega_a = spin(d_a, e[1]) - tau.value * rate[14], omega_b = spin(d_b, e[3]) - tau.value * rate[15];
    return Real(section.rhoIp / 6) * l.value * (omega_a * omega_a + omega_a * omega_b + omega_b * omega_b);
  }

  explicit MovingOracle(unsigned seed) {
    Random random(seed);
    for (TriadReference& from : references) {
      from.t = (Spatial<double>::UnitX() + random.vector<3>(0.5)).normalized();
      from.d = from.t.cross(Spatial<double>::UnitZ() + random.vector<3>(0.3)).normalized();
    }
  }
  FrameRestEnd rest_end(double x) const {
    FrameRestEnd end{x, true, {}, {}};
    const double w = 0.7;
    const auto s = rest_slope<double>(x);
    end.curve = {rest_place<double>(x), s, {-w * s[1], w * s[0], 0}, {-w * w * s[0], -w * w * s[1], 0}};
    return end;
  }
  /// The element at these coordinates.
  template <class Visit>
  auto with(const Eigen::Matrix<double, 16, 1>& q, const Visit& visit) const {
    const FrameTable unit(1, weights);
    const MovingFrameRest rest = moving_frame_rest(unit, section, rest_end(q[14]), rest_end(q[15]), triads());
    const FrameNode a(references[0], q.segment<3>(0), q.segment<3>(3), q[6]),
        b(references[1], q.segment<3>(7), q.segment<3>(10), q[13]);
    return visit(MovingFrame(unit, section, a, b, q[14], q[15], 0, &rest));
  }
};

using MovingColumn = Eigen::Matrix<double, 16, 1>;

MovingColumn some_place(const MovingOracle& oracle, unsigned seed) {
  Random random(seed);
  MovingColumn q = random.vector<16>(0.2);
  q[14] = oracle.x_a;
  q[15] = oracle.x_b;
  q[3] += 1;
  q[10] += 1;
  q[7] += oracle.x_b - oracle.x_a;
  return q;
}

std::vector<MovingOracle> moving_oracles() {
  std::vector<MovingOracle> oracles;
  for (const unsigned seed : {1U, 2U}) {
    for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
      for (const bool oriented : {false, true}) {
        MovingOracle& oracle = oracles.emplace_back(seed);
        oracle.section.law = law;
        if (oriented) oracle.orientation = {0.3, 0.1, 1};
      }
    }
  }
  return oracles;
}

TEST(MovingFrame, ForcesAreTheGradientOfTheEnergy) {
  for (const MovingOracle& oracle : moving_oracles()) {
    const MovingColumn q = some_place(oracle, 7);
    Eigen::Matrix<double, 17, 1> all;
    all << q, 0;
    for (int i = 0; i < 12; ++i) {  // the inner angle of the least energy
      const auto slope = [&](double inner) {
        all[16] = inner;
        return gradient(oracle, all)[16];
      };
      const double at = all[16], h = 1e-5, here = slope(at);
      all[16] = at - here * 2 * h / (slope(at + h) - slope(at - h));
    }
    const auto exact = gradient(oracle, all);
    const MovingColumn force = oracle.with(q, [](const MovingFrame& element) { return element.gradient(); });
    EXPECT_LE((force - exact.head<16>()).norm(), 1e-11 * exact.norm());
    const auto energy = oracle.with(q, [](const MovingFrame& element) { return element.energy(); });
    EXPECT_NEAR(energy[0] + energy[1], oracle(all), 1e-12 * oracle(all));
  }
}

TEST(MovingFrame, TangentIsTheDerivativeOfItsForces) {
  for (const MovingOracle& oracle : moving_oracles()) {
    const MovingColumn q = some_place(oracle, 8);
    const auto tangent = oracle.with(q, [](const MovingFrame& element) { return element.tangent(); });
    const double h = 1e-6;
    for (int i = 0; i < 16; ++i) {
      const auto moved = [&](double by) {
        return oracle.with(q + by * MovingColumn::Unit(i),
                           [](const MovingFrame& element) { return element.gradient(); });
      };
      const MovingColumn difference = (moved(h) - moved(-h)) / (2 * h);
      EXPECT_LE((tangent.col(i) - difference).norm(), 1e-7 * tangent.norm()) << i;
    }
  }
}

/// Wherever its marks are, and however it has been moved as a rigid body.
TEST(MovingFrame, NothingPushesAnElementInItsRestShape) {
  for (MovingOracle& oracle : moving_oracles()) {
    const RestTriads along = oracle.triads();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.3, Spatial<double>(1, 2, -0.5).normalized()).toRotationMatrix();
    for (const double x_a : {0.3, 0.45, 0.6}) {
      MovingColumn q = MovingColumn::Zero();
      q[14] = x_a;
      q[15] = 1.1;
      for (const int end : {0, 1}) {
        const double x = q[14 + end];
        q.segment<3>(7 * end) = turn * oracle.rest_place<double>(x);
        const Spatial<double> s = oracle.rest_slope<double>(x);
        q.segment<3>(7 * end + 3) = turn * s;
        oracle.references[static_cast<std::size_t>(end)] = {turn * s.normalized(),
                                                            turn * along.direction<double>(x, s)};
      }
      const MovingColumn force = oracle.with(q, [](const MovingFrame& element) { return element.gradient(); });
      EXPECT_LE(force.norm(), 1e-13);
    }
  }
}

TEST(MovingFrame, SpinsObeyLagrange) {
  for (const MovingOracle& oracle : moving_oracles()) {
    const MovingColumn q = some_place(oracle, 3);
    Random random(5);
    const MovingColumn rate = random.vector<16>(2), a = random.vector<16>(3);
    const FrameTable unit(1, oracle.weights);
    const MovingFrameInertia inertia{oracle.references[0], oracle.references[1], unit.middle, 0, oracle.section.rhoIp};
    const MovingColumn exact = lagrange_residual<16>(oracle, q, rate, a);
    EXPECT_LE((inertia.residual<double>(q, rate, a) - exact).norm(), 1e-12 * exact.norm());
  }
}

/// The section that new nodes take is the element's own at its ends.
TEST(MovingFrame, AFrameStartsAndEndsAsSectionsStand) {
  for (const MovingOracle& oracle : moving_oracles()) {
    const MovingColumn q = some_place(oracle, 11);
    FrameEnds<double> ends{q.segment<3>(7) - q.segment<3>(0), q.segment<3>(3), q.segment<3>(10), {}, {}, 0};
    ends.d_a = oracle.direction<double>(0, ends.s_a, q[6]);
    ends.d_b = oracle.direction<double>(1, ends.s_b, q[13]);
    const auto angles = oracle.with(q, [](const MovingFrame& element) { return element.angles(); });
    for (const int end : {0, 1}) {
      const TriadReference at = frame_at(end, q[15] - q[14], oracle.weights, ends, angles[0], angles[1]);
      EXPECT_LE((at.t - (end == 0 ? ends.s_a : ends.s_b).normalized()).norm(), 1e-14);
      EXPECT_LE((at.d - (end == 0 ? ends.d_a : ends.d_b)).norm(), 1e-14);
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
