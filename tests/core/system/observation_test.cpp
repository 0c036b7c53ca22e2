#include "mechanics/motion/system/observation.hpp"

#include <gtest/gtest.h>

#include "tests/core/support/element_state.hpp"

namespace vlbeam::test {
namespace {

template <int D>
struct NoInertia final : SectionInertia<D> {
  double kinetic(double /*weight*/, const Vec<double, D>& /*v_x*/) const override { return 0; }
};

/// Sums four points at once against those point by point, which a beam takes whose sections have inertia: here none.
template <int D>
void expect_alike(Random& random, const BeamSection& section, AxialStrain axial, bool rational,
                  WeightTransport transport) {
  const auto q = coordinates<double, D>(random_element<D>(random));
  const WeightFunction weights{rational ? random.weights(2) : unit_weights, q.x_a - 0.1, q.x_b + 0.05};
  const SummedElement<D> element{q, coordinates<double, D>(random_rates<D>(random)), transport, weights};
  const SumTables tables(BeamRules(6, 11, axial));
  const Vec<double, D> gravity = random.vector<D>(9.81);
  const NoInertia<D> none;
  const Observer<D> at_once(section, gravity, tables), point_by_point(section, gravity, tables, &none);
  Observation<D> a, b;
  a.extremes.emplace();
  b.extremes.emplace();
  at_once.add(element, nullptr, a);
  point_by_point.add(element, nullptr, b);
  const auto near = [](double x, double y, double size, const char* what) { EXPECT_NEAR(x, y, 1e-13 * size) << what; };
  const double energy = b.energy.kinetic + b.energy.axial + b.energy.bending + std::abs(b.energy.gravity);
  near(a.energy.kinetic, b.energy.kinetic, energy, "kinetic");
  near(a.energy.axial, b.energy.axial, energy, "axial");
  near(a.energy.bending, b.energy.bending, energy, "bending");
  near(a.energy.gravity, b.energy.gravity, energy, "gravity");
  EXPECT_EQ(at_once.energies(element, nullptr).total(), a.energy.total());
  near(a.mass, b.mass, b.mass, "mass");
  near(a.beam_length, b.beam_length, b.beam_length, "length");
  near(a.beam_length_rate, b.beam_length_rate, 10, "its rate");
  EXPECT_LE((a.momentum - b.momentum).norm(), 1e-13 * (1 + b.momentum.norm()));
  EXPECT_LE((a.angular_momentum - b.angular_momentum).norm(), 1e-13 * (1 + b.angular_momentum.norm()));
  EXPECT_LE((a.mass_moment - b.mass_moment).norm(), 1e-13 * (1 + b.mass_moment.norm()));
  near(a.extremes->strain.least, b.extremes->strain.least, 1, "least strain");
  near(a.extremes->strain.largest, b.extremes->strain.largest, 1, "largest strain");
  near(a.extremes->force.least, b.extremes->force.least, 1000, "least force");
  near(a.extremes->force.largest, b.extremes->force.largest, 1000, "largest force");
  near(a.extremes->curvature, b.extremes->curvature, b.extremes->curvature, "curvature");
}

TEST(Observer, SumsFourPointsAtOnceAsOneByOne) {
  Random random(3);
  for (const StrainLaw law : {StrainLaw::green, StrainLaw::engineering}) {
    for (const AxialStrain axial : {AxialStrain::full, AxialStrain::lobatto}) {
      for (const double damping : {0.0, 0.02}) {
        const BeamSection section{
            .rhoA = 1.7, .stiffness = {120, 3, law}, .damping = damping, .curvature_regularization = 0.3};
        for (const bool rational : {false, true}) {
          for (const WeightTransport transport : {WeightTransport::frozen, WeightTransport::transported}) {
            expect_alike<2>(random, section, axial, rational, transport);
            expect_alike<3>(random, section, axial, rational, transport);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace vlbeam::test
