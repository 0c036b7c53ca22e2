#include "mechanics/frames/frame_packs.hpp"

#include <gtest/gtest.h>

#include "mechanics/frames/frame_damping.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

/// A chain of seven elements, unlike each other; one of them is twisted by more than a turn.
struct PackedChain {
  static constexpr int elements = 7, nodes = elements + 1;
  FrameSection section{3, 5, 2, 0, StrainLaw::green};
  std::vector<FrameTable> tables;
  std::vector<TriadReference> references;
  std::vector<FrameNode> ends;
  std::vector<double> turned, angles;

  explicit PackedChain(StrainLaw law) {
    section.law = law;
    Random random(12);
    Vec<double, 3> r = Vec<double, 3>::Zero();
    for (int k = 0; k < nodes; ++k) {
      const Vec<double, 3> t = (Vec<double, 3>::UnitX() + random.vector<3>(0.5)).normalized();
      references.push_back({t, t.cross(Vec<double, 3>::UnitZ() + random.vector<3>(0.3)).normalized()});
    }
    for (int k = 0; k < nodes; ++k) {
      angles.push_back(random.uniform(-0.3, 0.3) + (k > 3 ? 8 : 0));
      ends.emplace_back(references[static_cast<std::size_t>(k)], r, Vec<double, 3>::UnitX() + random.vector<3>(0.2),
                        angles.back());
      if (k == elements) break;
      const double length = random.uniform(0.3, 0.8);
      FrameTable table(length, k % 2 == 0 ? unit_weights : random.weights(1.5));
      for (auto& point : table.points) point.rest = {random.uniform(-1, 1), random.uniform(-1, 1), 0.2};
      tables.push_back(table);
      r += length * (Vec<double, 3>::UnitX() + random.vector<3>(0.1));
    }
    for (std::size_t k = 0; k < elements; ++k) turned.push_back(angles[k + 1] - angles[k]);
  }

  FramePacks packs(int first, int last) const {
    FramePacks result;
    for (int k = first; k <= last; ++k) result.add(k, tables[static_cast<std::size_t>(k)]);
    return result;
  }
  Eigen::VectorXd force(const FramePacks& of) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(7 * nodes);
    of.add_forces(section, ends, turned, result.data(), result.data() + 6 * nodes);
    return result;
  }
  Eigen::MatrixXd tangent(const FramePacks& of, double by) const {
    BeamMatrix<3> matrix;
    matrix.start(nodes, {});
    matrix.add_angles();
    of.add_tangents(section, ends, turned, by, matrix);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(7 * nodes, 7 * nodes);
    matrix.expand(dense);
    return dense;
  }
};

TEST(FramePacks, AreTheirElements) {
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    const PackedChain chain(law);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(7 * PackedChain::nodes);
    Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(force.size(), force.size());
    for (int k = 0; k < PackedChain::elements; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const auto at = [&](int row) {
        return row % 7 == 6 ? 6 * PackedChain::nodes + k + row / 7 : 6 * (k + row / 7) + row % 7;
      };
      const auto &a = chain.ends[i], &b = chain.ends[i + 1];
      const FrameVector f = frame_gradient(chain.tables[i], chain.section, a, b, chain.turned[i]);
      const FrameMatrix K = frame_tangent(chain.tables[i], chain.section, a, b, chain.turned[i]);
      for (int row = 0; row < 14; ++row) {
        force[at(row)] -= f[row];
        for (int column = 0; column < 14; ++column) tangent(at(row), at(column)) += 0.3 * K(row, column);
      }
    }
    const FramePacks packs = chain.packs(0, PackedChain::elements - 1);
    EXPECT_LE((chain.force(packs) - force).norm(), 1e-13 * force.norm());
    EXPECT_LE((chain.tangent(packs, 0.3) - tangent).norm(), 1e-13 * tangent.norm());
  }
}

TEST(FramePacks, AreDampedAsTheirElementsAre) {
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    PackedChain chain(law);
    chain.section.damping = 0.03;
    constexpr int nodes = PackedChain::nodes;
    Random random(4);
    const Eigen::VectorXd rate = Eigen::VectorXd::NullaryExpr(7 * nodes, [&] { return random.uniform(-1, 1); });
    std::vector<double> spins;
    for (int k = 0; k < nodes; ++k) {
      const FrameNode& node = chain.ends[static_cast<std::size_t>(k)];
      spins.push_back(rate[6 * nodes + k] + node.spin_by_slope.dot(rate.segment<3>(6 * k + 3)));
    }
    const FramePacks packs = chain.packs(0, PackedChain::elements - 1);
    Eigen::VectorXd force = chain.force(packs), damped = Eigen::VectorXd::Zero(7 * nodes);
    double lost = 0;
    for (int k = 0; k < PackedChain::elements; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const FrameDamping damping{chain.references[i], chain.references[i + 1], chain.tables[i],
                                 chain.section,       chain.turned[i],         {}};
      FrameVector q, v;
      for (int e = 0; e < 2; ++e) {
        const std::size_t end = i + static_cast<std::size_t>(e);
        q.segment<7>(7 * e) << chain.ends[end].r, chain.ends[end].s, chain.angles[end];
        v.segment<7>(7 * e) << rate.segment<6>(6 * (k + e)), rate[6 * nodes + k + e];
      }
      const auto answer = damping.at<double, 14>(q, v);
      lost += answer.power;
      for (int e = 0; e < 2; ++e) {
        force.segment<6>(6 * (k + e)) -= answer.force.segment<6>(7 * e);
        force[6 * nodes + k + e] -= answer.force[7 * e + 6];
      }
    }
    const double power = packs.add_damped_forces(chain.section, chain.ends, chain.turned, rate.data(), spins,
                                                 damped.data(), damped.data() + 6 * nodes);
    EXPECT_GT(lost, 1e-3);
    EXPECT_NEAR(power, lost, 1e-13 * lost);
    EXPECT_LE((damped - force).norm(), 1e-13 * force.norm());
    EXPECT_GE((force - chain.force(packs)).norm(), 1e-3 * force.norm());
  }
}

TEST(FramePacks, DigitsOfAnElementAreItsOwn) {
  const PackedChain chain(StrainLaw::green);
  FramePacks ends;  // the first and the last element of a pack, with others between them
  for (const int k : {0, 2, 3, 5}) ends.add(k, chain.tables[static_cast<std::size_t>(k)]);
  const Eigen::VectorXd together = chain.force(ends), first = chain.force(chain.packs(0, 0)),
                        last = chain.force(chain.packs(5, 5));
  const Eigen::MatrixXd all = chain.tangent(ends, 1), own = chain.tangent(chain.packs(0, 0), 1);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(together[i], first[i]);
    EXPECT_EQ(together[30 + i], last[30 + i]);
    for (int j = 0; j < 12; ++j) EXPECT_EQ(all(i, j), own(i, j));
  }
}

}  // namespace
}  // namespace vlbeam::test
