#include "core/beam/span.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/pieces.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {
namespace {

constexpr int D = 2;

struct Beam {
  Mesh mesh;
  BeamSection section{.rhoA = 1.5, .stiffness = {100, 2}};
  BeamRules rules{5, 10, AxialStrain::full};
  std::vector<PointMass> masses{{0.3, 1.1}};

  Span<D> span(int outer, int open, Span<D>* before = nullptr, int unchanged = 0) const {
    return Span<D>(mesh, outer, open, Support<D>::pin(), section, rules, nullptr, masses, before, unchanged);
  }
};

/// Nodes at quarters, weights that are not equal at the start.
Beam beam(int elements) {
  Beam beam;
  for (int i = 0; i <= elements; ++i) beam.mesh.x.push_back(0.25 * i);
  beam.mesh.weights.resize(static_cast<std::size_t>(elements));
  for (std::size_t k = 0; k < 5; ++k) beam.mesh.weights[k].w = {1, 1.1 + 0.01 * static_cast<double>(k), 0.9, 1};
  return beam;
}

/// Whether both do the same to the last bit.
void expect_alike(const Span<D>& a, const Span<D>& b, int nodes) {
  Random random(1);
  Eigen::VectorXd q(node_size<D> * nodes);
  for (double& entry : q) entry = random.uniform(-1, 1);
  const auto answers = [&](const Span<D>& span) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(q.size());
    span.add_forces(q.data(), q.data(), {0, -9.81}, force.data());
    span.add_inertia(q.data(), force.data());
    span.reduce(force.data());
    span.substitute(force.data());
    return force;
  };
  EXPECT_EQ(answers(a), answers(b));
  EXPECT_EQ(a.first_moment(q.data()), b.first_moment(q.data()));
  EXPECT_TRUE((a.open_mass().rr == b.open_mass().rr).all() && (a.open_mass().ss == b.open_mass().ss).all());
}

TEST(Span, GoesOnFromOneOnAnotherMesh) {
  const Beam old = beam(19);
  Beam cut = old;  // a node more in the tenth element
  cut.mesh.x.insert(cut.mesh.x.begin() + 10, 0.5 * (cut.mesh.x[9] + cut.mesh.x[10]));
  cut.mesh.weights.insert(cut.mesh.weights.begin() + 9, cut.mesh.weights[9]);
  for (const int open : {0, 1, 3, 7, 8, 9, 10, 11, 13, 20}) {
    for (const int was : {0, 2, 7, 9, 11, 19}) {
      Span<D> left = old.span(0, was), right = old.span(19, was);
      expect_alike(cut.span(0, open, &left, 9), cut.span(0, open), 21);
      expect_alike(cut.span(20, open, &right, 9), cut.span(20, open), 21);
    }
  }
}

/// Where equal elements let elimination repeat itself, and where others follow on them.
TEST(Span, SolvesItsMassMatrix) {
  constexpr int elements = 300;
  Beam mixed = beam(elements);
  for (std::size_t k = 201; k <= elements; ++k) mixed.mesh.x[k] += 0.1 * static_cast<double>(k - 200);
  Random random(1);
  for (const bool from_end : {false, true}) {
    const int outer = from_end ? elements : 0, open = elements - outer;
    const Span<D> span = mixed.span(outer, open);
    Eigen::VectorXd force(node_size<D> * (elements + 1));
    for (double& entry : force) entry = random.uniform(-1, 1);
    Eigen::VectorXd a = force, back = Eigen::VectorXd::Zero(force.size());
    span.reduce(a.data());
    const NodeBlock<D> inverse = span.open_mass().inverse(span.open_free_position(), span.open_free_slope());
    const Vec<double, D> on_r = position<D>(a.data(), open), on_s = slope<D>(a.data(), open);
    position<D>(a.data(), open) = inverse.rr * on_r.array() + inverse.rs * on_s.array();
    slope<D>(a.data(), open) = inverse.rs * on_r.array() + inverse.ss * on_s.array();
    span.substitute(a.data());
    span.add_inertia(a.data(), back.data());
    position<D>(back.data(), outer) = position<D>(force.data(), outer);  // a pin takes what acts there
    EXPECT_LE((back - force).cwiseAbs().maxCoeff(), 1e-11);
  }
}

/// Whatever its neighbours in a pack are: of the first nine elements, five are rational.
TEST(Span, AnElementTakesTheRuleOfItsWeights) {
  Beam mixed = beam(9);
  mixed.mesh.weights[7].w[1] += 1e-14;  // rounding, as merges leave it
  Random random(1);
  Eigen::VectorXd q(node_size<D> * 10);
  for (double& entry : q) entry = random.uniform(-1, 1);
  struct Sums {
    Eigen::VectorXd force;
    std::vector<NodeTangent<D>> diagonal, upper, lower;
  };
  const auto of = [&](const Beam& beam) {
    const std::vector<NodeTangent<D>> none(10, NodeTangent<D>::Zero());
    Sums sums{Eigen::VectorXd::Zero(q.size()), none, none, none};
    const Span<D> whole = beam.span(0, 9);
    whole.add_forces(q.data(), q.data(), {0, 0}, sums.force.data());
    whole.add_tangent(q.data(), q.data(), {1, 0, 0}, sums.diagonal.data(), sums.upper.data(), sums.lower.data());
    return sums;
  };
  const auto row = [](const Sums& sums, int node) -> Eigen::Matrix<double, node_size<D>, 1> {
    return sums.force.segment<node_size<D>>(Eigen::Index{node_size<D>} * node);
  };
  Beam by_five = mixed, by_ten = mixed;
  by_five.rules = beam_rule(5);
  by_ten.rules = beam_rule(10);
  const Sums sums = of(mixed), five = of(by_five), ten = of(by_ten);
  for (int node = 0; node <= 9; ++node) {
    const auto k = static_cast<std::size_t>(node);
    if (node <= 4) {
      EXPECT_EQ(row(sums, node), row(ten, node)) << node;
      EXPECT_EQ(sums.upper[k], ten.upper[k]) << node;
      EXPECT_NE(sums.upper[k], five.upper[k]) << node;
    }
    if (node >= 6) {
      EXPECT_EQ(row(sums, node), row(five, node)) << node;
    }
    if (node >= 5 && node < 9) {
      EXPECT_EQ(sums.upper[k], five.upper[k]) << node;
      EXPECT_NE(sums.upper[k], ten.upper[k]) << node;
    }
  }
}

/// What is computed in pieces is what short spans add up to.
TEST(Span, ALongOneIsTheSumOfShortOnes) {
  constexpr int count = 5, elements = count * 1003;
  const Beam all = beam(elements);
  const Span<D> whole = all.span(0, elements);
  Random random(1);
  Eigen::VectorXd q(node_size<D> * (elements + 1));
  for (double& entry : q) entry = random.uniform(-1, 1);
  const TangentWeights by{1, 0.3, 0.7};
  struct Sums {
    Eigen::VectorXd force, inertia;
    std::vector<NodeTangent<D>> diagonal, upper, lower;
  };
  const auto zero = [&] {
    const std::vector<NodeTangent<D>> none(elements + 1, NodeTangent<D>::Zero());
    return Sums{Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(q.size()), none, none, none};
  };
  const auto add = [&](const Span<D>& span, Sums& to) {
    span.add_forces(q.data(), q.data(), {0, -9.81}, to.force.data());
    span.add_inertia(q.data(), to.inertia.data());
    span.add_tangent(q.data(), q.data(), by, to.diagonal.data(), to.upper.data(), to.lower.data());
  };
  Sums parts = zero();
  for (int i = 0; i < count; ++i) add(all.span(i * elements / count, (i + 1) * elements / count), parts);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    Sums long_one = zero();
    add(whole, long_one);
    EXPECT_LE((long_one.force - parts.force).cwiseAbs().maxCoeff(), 1e-14 * parts.force.cwiseAbs().maxCoeff());
    EXPECT_LE((long_one.inertia - parts.inertia).cwiseAbs().maxCoeff(), 1e-14 * parts.inertia.cwiseAbs().maxCoeff());
    for (std::size_t k = 0; k <= elements; ++k) {
      const double size = parts.diagonal[k].cwiseAbs().maxCoeff();
      ASSERT_LE((long_one.diagonal[k] - parts.diagonal[k]).cwiseAbs().maxCoeff(), 1e-14 * size) << k;
      ASSERT_LE((long_one.upper[k] - parts.upper[k]).cwiseAbs().maxCoeff(), 1e-14 * size) << k;
      ASSERT_LE((long_one.lower[k] - parts.lower[k]).cwiseAbs().maxCoeff(), 1e-14 * size) << k;
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
