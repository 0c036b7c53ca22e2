#include <gtest/gtest.h>

#include <cstring>

#include "core/beam/block_kernels.hpp"
#include "core/beam/span_kernels.hpp"
#include "core/element/element_sums.hpp"
#include "core/element/moving_kernels.hpp"
#include "mechanics/time/step_kernels.hpp"
#include "tests/core/support/element_state.hpp"

namespace vlbeam::test {
namespace {

void expect_same_bits(const double* a, const double* b, std::size_t count) {
  EXPECT_EQ(std::memcmp(a, b, count * sizeof(double)), 0);
}

template <MovingEnds Ends, int D>
void expect_same_bits(Random& random, const BeamSection& section, AxialStrain axial, WeightTransport transport) {
  const auto q = coordinates<double, D>(random_element<D>(random));
  const auto rate = coordinates<double, D>(random_rates<D>(random)),
             a = coordinates<double, D>(random_rates<D>(random));
  const WeightFunction weights{random.weights(3), q.x_a - 0.1, q.x_b + 0.05};
  const ShapeTabulation table(beam_rule(5, axial), weights.w);
  MovingLaw<D> law;
  law.section = section;
  law.transport = transport;
  law.gravity = random.vector<D>(9.81);
  const TangentWeights by{0.7, 30, 900};
  const auto of = [&](InstructionSet set) {
    const auto kernels = moving_kernels<D, Ends>(set);
    std::vector<double> all;
    const auto keep = [&](const Vec<double, D>& v) { all.insert(all.end(), v.begin(), v.end()); };
    for (const auto& eq :
         {kernels.equations(q, rate, weights, table, law), kernels.forces(q, rate, a, weights, table, law)}) {
      for (const auto& force : eq.force) keep(force);
      all.insert(all.end(), {eq.force_a, eq.force_b, eq.dissipation});
    }
    const auto eq = kernels.equations(q, rate, weights, table, law);
    for (const auto& row : eq.mass) all.insert(all.end(), row.begin(), row.end());
    for (std::size_t i = 0; i < 4; ++i) keep(eq.mass_a[i]), keep(eq.mass_b[i]);
    all.insert(all.end(), {eq.mass_aa, eq.mass_ab, eq.mass_bb});
    const auto alone = kernels.masses(q, weights, table, law);
    EXPECT_EQ(alone.mass, eq.mass);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(alone.mass_a[i], eq.mass_a[i]);
      EXPECT_EQ(alone.mass_b[i], eq.mass_b[i]);
    }
    EXPECT_EQ((std::array{alone.mass_aa, alone.mass_ab, alone.mass_bb}),
              (std::array{eq.mass_aa, eq.mass_ab, eq.mass_bb}));
    if (!section.damped()) {
      const auto keep_all = [&](const auto& tangent) {
        all.insert(all.end(), tangent.data(), tangent.data() + tangent.size());
      };
      if constexpr (Ends == MovingEnds::both) {
        keep_all(kernels.driven_tangent(q, rate, a, by, weights, table, law));
      } else {
        keep_all(kernels.tangent(q, rate, a, by, weights, table, law));
      }
    }
    return all;
  };
  const auto portable = of(InstructionSet::portable), avx2 = of(InstructionSet::avx2);
  expect_same_bits(portable.data(), avx2.data(), portable.size());
}

template <int D>
void expect_same_sums(Random& random, const BeamSection& section, AxialStrain axial, WeightTransport transport) {
  const auto q = coordinates<double, D>(random_element<D>(random));
  const WeightFunction weights{random.weights(3), q.x_a - 0.1, q.x_b + 0.05};
  const SummedElement<D> element{q, coordinates<double, D>(random_rates<D>(random)), transport, weights};
  const ShapeTabulation table(beam_rule(25, axial), unit_weights);
  const Vec<double, D> gravity = random.vector<D>(9.81);
  const auto of = [&](InstructionSet set) {
    const auto kernels = sum_kernels<D>(set);
    StrainExtremes seen;
    std::vector<double> all;
    for (const auto& sums : {kernels.all(element, table, FeltSections(section), gravity, &seen),
                             kernels.energies(element, table, FeltSections(section), gravity, nullptr)}) {
      all.insert(all.end(),
                 {sums.axial, sums.bending, sums.kinetic, sums.gravity, sums.mass, sums.length, sums.length_rate});
      all.insert(all.end(), sums.momentum.begin(), sums.momentum.end());
      all.insert(all.end(), sums.mass_moment.begin(), sums.mass_moment.end());
      all.insert(all.end(), sums.angular_momentum.begin(), sums.angular_momentum.end());
    }
    all.insert(all.end(),
               {seen.strain.least, seen.strain.largest, seen.force.least, seen.force.largest, seen.curvature});
    return all;
  };
  const auto portable = of(InstructionSet::portable), avx2 = of(InstructionSet::avx2);
  expect_same_bits(portable.data(), avx2.data(), portable.size());
}

/// Elements of a random chain, a pack and a part of one.
template <int D>
void expect_same_spans(Random& random, const BeamSection& section, AxialStrain axial) {
  constexpr int elements = 7, size = node_size<D> * (elements + 1);
  std::vector<PackOfElements> packs;
  for (int first = 0; first < elements; first += Pack::width) {
    auto tables = std::make_shared<PackTables>();
    for (int lane = 0; lane < Pack::width; ++lane) {
      const auto rule = beam_rule(5, axial);
      const auto basis = fixed_basis(random.uniform(0.5, 1.5), random.weights(3), rule);
      FixedInertia inertia;
      for (auto& row : inertia.mass) {
        for (double& entry : row) entry = random.uniform(0, 1);
      }
      for (double& entry : inertia.load) entry = random.uniform(0, 1);
      tables->set_inertia(lane, inertia);
      tables->basis.points.resize(basis.points.size());
      tables->basis.stretch.resize(basis.stretch.size());
      tables->rest.resize(basis.size());
      for (std::size_t g = 0; g < basis.size(); ++g) {
        auto& to = g < basis.points.size() ? tables->basis.points[g] : tables->basis.stretch[g - basis.points.size()];
        to.weight.set(lane, basis[g].weight);
        for (std::size_t c = 0; c < 3; ++c) {
          to.s_x[c].set(lane, basis[g].s_x[c]);
          to.s_xx[c].set(lane, basis[g].s_xx[c]);
        }
        tables->rest[g].axial.set(lane, random.uniform(-0.1, 0.1));
        tables->rest[g].curvature.set(lane, random.uniform(-1, 1));
      }
    }
    packs.push_back({first, std::min(Pack::width, elements - first), tables});
  }
  Eigen::VectorXd q(size), rate(size), a(size);
  for (auto* vector : {&q, &rate, &a}) {
    for (double& entry : *vector) entry = random.uniform(-1, 1);
  }
  const Vec<double, D> gravity = random.vector<D>(9.81);
  const TangentWeights by{0.7, 30, 900};
  const auto of = [&](InstructionSet set) {
    const auto kernels = span_kernels<D>(set);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(size);
    std::vector<double> all{kernels.forces(packs, section, q.data(), rate.data(), gravity, force.data())};
    kernels.rest_forces(packs, section, q.data(), 0.7, force.data());
    all.insert(all.end(), force.begin(), force.end());
    all.push_back(kernels.residual(packs, section, q.data(), rate.data(), a.data(), gravity, force.data()));
    kernels.inertia(packs, a.data(), force.data());
    all.insert(all.end(), force.begin(), force.end());
    const std::vector<NodeTangent<D>> zero(elements + 1, NodeTangent<D>::Zero());
    auto diagonal = zero, upper = zero, lower = zero;
    kernels.tangents(packs, section, q.data(), rate.data(), by, diagonal.data(), upper.data(), lower.data());
    kernels.rest_tangents(packs, section, q.data(), 0.7, diagonal.data(), upper.data(), lower.data());
    for (const auto* blocks : {&diagonal, &upper, &lower}) {
      for (const auto& block : *blocks) all.insert(all.end(), block.data(), block.data() + block.size());
    }
    return all;
  };
  const auto portable = of(InstructionSet::portable), avx2 = of(InstructionSet::avx2);
  expect_same_bits(portable.data(), avx2.data(), portable.size());
}

TEST(InstructionSets, GiveTheSameBits) {
  if (!available(InstructionSet::avx2)) GTEST_SKIP() << "this machine or this build has the portable set alone";
  Random random(1);
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    for (const AxialStrain axial : {AxialStrain::full, AxialStrain::lobatto}) {
      for (const double EI : {0.0, 3.0}) {
        for (const double damping : {0.0, 0.02}) {
          const BeamSection section{
              .rhoA = 1.7, .stiffness = {120, EI, law}, .damping = damping, .curvature_regularization = 0.3};
          for (const WeightTransport transport : {WeightTransport::frozen, WeightTransport::transported}) {
            expect_same_bits<MovingEnds::a, 2>(random, section, axial, transport);
            expect_same_bits<MovingEnds::b, 2>(random, section, axial, transport);
            expect_same_bits<MovingEnds::both, 2>(random, section, axial, transport);
            expect_same_bits<MovingEnds::a, 3>(random, section, axial, transport);
            expect_same_bits<MovingEnds::b, 3>(random, section, axial, transport);
            expect_same_bits<MovingEnds::both, 3>(random, section, axial, transport);
            expect_same_sums<2>(random, section, axial, transport);
            expect_same_sums<3>(random, section, axial, transport);
          }
          expect_same_spans<2>(random, section, axial);
          expect_same_spans<3>(random, section, axial);
        }
      }
    }
  }
}

TEST(InstructionSets, GiveBlocksOfANodeTheSameBits) {
  if (!available(InstructionSet::avx2)) GTEST_SKIP() << "this machine has one only";
  Random random(17);
  constexpr int nodes = 9, block = 16;
  const Eigen::VectorXd start =
      Eigen::VectorXd::NullaryExpr((3 * block + 4) * nodes, [&] { return random.uniform(-1, 1); });
  const auto of = [&](InstructionSet set) {
    const BlockKernels kernels = block_kernels(set);
    Eigen::VectorXd numbers = start;
    double *const up = numbers.data(), *const down = up + block * nodes, *const inverse = down + block * nodes,
                  *const x = inverse + block * nodes;
    kernels.eliminate(inverse, up, down + block, inverse + block);
    kernels.subtract({up, 1, 1, 4}, {down, 7, -1, 2}, x);
    kernels.finish({down, 4, -1, 5}, {up, 6, 1, 3}, inverse, x);
    return numbers;
  };
  const Eigen::VectorXd portable = of(InstructionSet::portable), avx2 = of(InstructionSet::avx2);
  expect_same_bits(portable.data(), avx2.data(), static_cast<std::size_t>(portable.size()));
  EXPECT_NE(portable, start);
}

TEST(InstructionSets, GiveTheEndOfAStepTheSameBits) {
  if (!available(InstructionSet::avx2)) GTEST_SKIP() << "this machine has one only";
  Random random(18);
  constexpr int count = 23;
  const Eigen::VectorXd start = Eigen::VectorXd::NullaryExpr(9 * count, [&] { return random.uniform(-1, 1); });
  const auto of = [&](InstructionSet set) {
    Eigen::VectorXd numbers = start;
    const auto array = [&](int which) { return numbers.data() + which * count; };
    const StepKernels::Arrays step{array(1), array(2), array(3), array(4), array(5), array(6), array(7), array(8)};
    const StepKernels kernels = step_kernels(set);
    kernels.complete(count, {0.1, -0.4, 0.6, 0.3, 0.45, 7, 300}, array(0), step);
    Eigen::VectorXd all(2 * numbers.size());
    all.head(numbers.size()) = numbers;
    kernels.complete(count, {0.2, -0.4, 0.6, 0.3, 0.45, 7, 300}, nullptr, step);
    all.tail(numbers.size()) = numbers;
    std::array<double, 4> largest;
    kernels.largest(count, start.data(), largest);
    for (int i = 0; i < 4; ++i) {
      const auto of_each = Eigen::Map<const Eigen::Matrix4Xd>(start.data(), 4, count).row(i);
      EXPECT_EQ(largest[static_cast<std::size_t>(i)], of_each.cwiseAbs().maxCoeff());
    }
    const Eigen::ArrayXd sizes = start.array().abs();
    for (const int some : {1, 3, 4, count}) {
      const auto ratios = sizes.head(some) / (0.5 * sizes.segment(count, some) +
                                              0.1 * sizes.segment(2 * count, some).max(sizes.segment(3 * count, some)));
      const double* const at = start.data();
      const Eigen::VectorXd allowed = sizes.segment(count, count);
      EXPECT_EQ(kernels.error_ratio(some, at, allowed.data(), at + 2 * count, at + 3 * count, 0.5, 0.1),
                ratios.maxCoeff())
          << some;
    }
    return all;
  };
  const Eigen::VectorXd portable = of(InstructionSet::portable), avx2 = of(InstructionSet::avx2);
  expect_same_bits(portable.data(), avx2.data(), static_cast<std::size_t>(portable.size()));
  const auto corrected = portable.segment(5 * count, count);
  EXPECT_EQ((corrected - (start.segment(5 * count, count) - start.head(count))).norm(), 0);
  const auto part = [&](int which) { return portable.segment(which * count, count); };
  const Eigen::VectorXd a0 = part(3), next = -0.4 * a0;  // the method's own acceleration, and that at the end
  EXPECT_LE((part(6) - (part(1) + 0.1 * part(2) + corrected)).norm(), 1e-14);
  EXPECT_LE((part(7) - (part(2) + 0.1 * (0.4 * a0 + 0.6 * next) + 7 * corrected)).norm(), 1e-13);
  EXPECT_LE(((1 - 0.45) * (part(8) - 300 * corrected) + 0.45 * part(4) - (1 - 0.3) * next - 0.3 * a0).norm(), 1e-12);
}

}  // namespace
}  // namespace vlbeam::test
