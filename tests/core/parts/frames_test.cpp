#include "mechanics/frames/frames.hpp"

#include <gtest/gtest.h>

#include "mechanics/frames/frame_element.hpp"
#include "scene/build.hpp"
#include "tests/core/support/dual.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

constexpr int chain_nodes = 3, unknowns = 7 * chain_nodes;
using Column = Eigen::Matrix<double, unknowns, 1>;

/// A chain of two elements whose sections stand as they like.
struct Chain {
  Mesh mesh{{0, 0.4, 1}, {{unit_weights, 0, 0.4}, {unit_weights, 0.4, 1}}};
  FrameModel model{{3, 5, 2, 0.7, StrainLaw::green, 0.02}};
  Column q, rate, a;
  std::vector<TriadReference> references;
  std::unique_ptr<Frames> frames;

  explicit Chain(unsigned seed) {
    Random random(seed);
    q = random.vector<unknowns>(0.2);
    rate = random.vector<unknowns>(2);
    a = random.vector<unknowns>(3);
    std::vector<SectionState> sections;
    std::vector<double> started(6 * chain_nodes);
    for (int k = 0; k < chain_nodes; ++k) {
      q[6 * k] += mesh.x[static_cast<std::size_t>(k)];
      const Vec<double, 3> t = (Vec<double, 3>::UnitX() + random.vector<3>(0.6)).normalized();
      slope<3>(started.data(), k) = t;
      const Vec<double, 3> d = t.cross(Vec<double, 3>::UnitZ() + random.vector<3>(0.3)).normalized();
      sections.push_back({d});
      references.push_back({t, d});
      q[6 * k + 3] += 1;
    }
    frames = std::make_unique<Frames>(model, mesh, nullptr, sections, started.data(), sections);
  }

  /// Half the sum of the spins' inertia, the spin of a node being how its direction turns about its tangent.
  template <class Real>
  Real kinetic(const Eigen::Matrix<Real, unknowns, 1>& at, const Eigen::Matrix<Real, unknowns, 1>& moving) const {
    using std::sqrt;
    std::vector<Real> spins;
    for (int k = 0; k < chain_nodes; ++k) {
      const auto& from = references[static_cast<std::size_t>(k)];
      const auto time = in_motion<Real, unknowns>(at, moving);
      using Moving = Dual<Real>;
      const Vec<Moving, 3> s = time.template segment<3>(6 * k + 3), t = s / Moving(sqrt(s.dot(s)));
      Vec<Moving, 3> t0, d0;
      for (int c = 0; c < 3; ++c) t0[c] = Moving(from.t[c]), d0[c] = Moving(from.d[c]);
      const Vec<Moving, 3> axis = t0.cross(t);
      const Vec<Moving, 3> d =
          d0 * Moving(t0.dot(t)) + axis.cross(d0) + axis * Moving(axis.dot(d0) / (Moving(1.0) + t0.dot(t)));
      const Vec<Real, 3> now = value_of<Real, 3>(d), turning = rate_of<Real, 3>(d), tangent = value_of<Real, 3>(t);
      spins.push_back(moving[6 * chain_nodes + k] + tangent.dot(now.cross(turning)));
    }
    Real sum(0);
    for (std::size_t k = 0; k + 1 < chain_nodes; ++k) {
      const double share = model.section.rhoIp * (mesh.x[k + 1] - mesh.x[k]) / 6;
      sum += Real(share) * (spins[k] * spins[k] + spins[k] * spins[k + 1] + spins[k + 1] * spins[k + 1]);
    }
    return sum;
  }

  Column inertia() const {
    Column r = Column::Zero();
    frames->add_inertia(q.data(), rate.data(), a.data(), r.data());
    return r;
  }
  Motion<3> motion() const { return {{mesh, {}, q.data(), rate.data()}, a.data(), 0}; }
  /// M a - Q.
  Column residual() const {
    Column force = Column::Zero();
    frames->add_force(motion(), force.data());
    return inertia() - force;
  }
};

struct Kinetic {
  const Chain& chain;
  template <class Real>
  Real operator()(const Eigen::Matrix<Real, unknowns, 1>& q, const Eigen::Matrix<Real, unknowns, 1>& rate) const {
    return chain.kinetic<Real>(q, rate);
  }
};

TEST(Frames, InertiaIsThatOfLagrange) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Chain chain(seed);
    const Column exact = lagrange_residual<unknowns>(Kinetic{chain}, chain.q, chain.rate, chain.a);
    EXPECT_LE((chain.inertia() - exact).norm(), 1e-12 * exact.norm());
    const auto seen = chain.frames->observe(chain.q.data(), chain.rate.data());
    EXPECT_NEAR(seen.kinetic, chain.kinetic<double>(chain.q, chain.rate), 1e-13 * seen.kinetic);
  }
}

TEST(Frames, TangentIsTheDerivativeOfTheResidual) {
  for (const TangentWeights& by :
       {TangentWeights{1, 0, 0}, TangentWeights{0, 1, 0}, TangentWeights{0, 0, 1}, TangentWeights{1, 30, 900}}) {
    Chain chain(4);
    chain.model.torques.points.push_back({.node = 1, .torque = [](double) { return 0.8; }});
    chain.model.torques.line = [](double) { return 0.3; };
    std::vector<SectionState> sections;
    std::vector<double> started(6 * chain_nodes);
    for (int k = 0; k < chain_nodes; ++k) {
      sections.push_back({chain.references[static_cast<std::size_t>(k)].d});
      slope<3>(started.data(), k) = chain.references[static_cast<std::size_t>(k)].t;
    }
    chain.frames = std::make_unique<Frames>(chain.model, chain.mesh, nullptr, sections, started.data(), sections);
    BeamMatrix<3> tangent;
    tangent.start(chain_nodes, {});
    tangent.add_angles();
    chain.frames->add_tangent(chain.motion(), by, tangent);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(unknowns, unknowns);
    tangent.expand(dense);
    const Column direction = Random(9).vector<unknowns>();
    const double h = 1e-6;
    const auto moved = [&](double by_h) {
      Chain other(4);
      other.frames = std::make_unique<Frames>(chain.model, chain.mesh, nullptr, sections, started.data(), sections);
      other.q += by_h * by.q * direction;
      other.rate += by_h * by.v * direction;
      other.a += by_h * by.a * direction;
      return other.residual();
    };
    const Column difference = (moved(h) - moved(-h)) / (2 * h);
    EXPECT_LE((dense * direction - difference).norm(), 3e-8 * difference.norm()) << by.q << by.v << by.a;
  }
}

TEST(Frames, TangentIsSolvedWithItsAngles) {
  const Chain chain(6);
  for (const bool clamped : {false, true}) {
    BeamMatrix<3> tangent;
    tangent.start(chain_nodes, {});
    tangent.add_angles();
    chain.frames->add_tangent(chain.motion(), {1, 20, 400}, tangent);
    for (auto& block : tangent.diagonal) block.diagonal().array() += 1e3;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(unknowns, unknowns);
    tangent.expand(dense);
    Column right = Random(3).vector<unknowns>();
    if (clamped) {  // holds position and slope of the middle node, and its angle
      tangent.hold(1, -1, Support<3>::clamp());
      std::vector<Eigen::Index> held{6 * chain_nodes + 1};
      for (Eigen::Index i = 6; i < 12; ++i) held.push_back(i);
      for (const Eigen::Index i : held) {
        dense.row(i).setZero();
        dense.col(i).setZero();
        dense(i, i) = 1;
        right[i] = 0;
      }
    }
    ASSERT_TRUE(tangent.factor());
    Column solution = right;
    tangent.solve(solution.data());
    EXPECT_LE((dense * solution - right).norm(), 1e-11 * dense.norm() * solution.norm());
  }
}

TEST(Frames, NothingChangesAsWhatAnglesAreCountedFromFollows) {
  Chain chain(5);
  const auto before = chain.frames->observe(chain.q.data(), chain.rate.data());
  const auto sections = chain.frames->sections(chain.q.data(), chain.rate.data());
  chain.frames->follow(chain.q.data(), chain.rate.data());
  const auto after = chain.frames->observe(chain.q.data(), chain.rate.data());
  EXPECT_NEAR(after.kinetic, before.kinetic, 1e-13 * before.kinetic);
  EXPECT_NEAR(after.bending, before.bending, 1e-13 * before.bending);
  EXPECT_NEAR(after.torsion, before.torsion, 1e-13 * before.torsion);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e-13 * before.momentum.norm());
  const auto now = chain.frames->sections(chain.q.data(), chain.rate.data());
  for (std::size_t k = 0; k < chain_nodes; ++k) {
    EXPECT_LE((now[k].direction - sections[k].direction).norm(), 1e-14);
    EXPECT_NEAR(now[k].spin, sections[k].spin, 1e-13);
  }
  EXPECT_LE(chain.frames->turned_away(chain.q.data()), -0.49);
}

}  // namespace
}  // namespace vlbeam::test
