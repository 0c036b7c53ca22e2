// Compiled once for each instruction set, with VLBEAM_KERNELS its name. What is not inlined here would be a function
// that the linker shares with units for other machines: a test looks for it.
#include "core/element/moving_kernels.hpp"
#include "core/element/pack_lanes.hpp"
#include "core/element/twist_law.hpp"

namespace vlbeam::VLBEAM_KERNELS {
namespace {

template <int D>
void add_force(const MovingEquations<Pack, D>& lanes, MovingEquations<double, D>& eq) {
  for (std::size_t i = 0; i < 4; ++i) eq.force[i] = total<D>(lanes.force[i]);
  eq.force_a = total(lanes.force_a);
  eq.force_b = total(lanes.force_b);
  eq.dissipation = total(lanes.dissipation);
}

template <int D>
void add_mass(const MovingEquations<Pack, D>& lanes, MovingEquations<double, D>& eq) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) eq.mass[i][j] = eq.mass[j][i] = total(lanes.mass[i][j]);
    eq.mass_a[i] = total<D>(lanes.mass_a[i]);
    eq.mass_b[i] = total<D>(lanes.mass_b[i]);
  }
  eq.mass_aa = total(lanes.mass_aa);
  eq.mass_ab = total(lanes.mass_ab);
  eq.mass_bb = total(lanes.mass_bb);
}

template <int D, MovingEnds Ends>
[[gnu::flatten]] MovingEquations<double, D> equations(const MovingCoordinates<double, D>& q,
                                                      const MovingCoordinates<double, D>& rate,
                                                      const WeightFunction& weights, const ShapeTabulation& table,
                                                      const MovingLaw<D>& law) {
  const auto lanes =
      moving_sums<Pack, D, Ends>(in_all_lanes<D>(q), in_all_lanes<D>(rate), AtAnyAcceleration{}, weights, table, law);
  MovingEquations<double, D> eq;
  add_mass<D>(lanes, eq);
  add_force<D>(lanes, eq);
  return eq;
}

template <int D, MovingEnds Ends>
[[gnu::flatten]] MovingEquations<double, D> masses(const MovingCoordinates<double, D>& q, const WeightFunction& weights,
                                                   const ShapeTabulation& table, const MovingLaw<D>& law) {
  MovingEquations<double, D> eq;
  eq.set_zero();
  add_mass<D>(mass_sums<Pack, D, Ends>(in_all_lanes<D>(q), weights, table, law), eq);
  return eq;
}

template <int D, MovingEnds Ends>
[[gnu::flatten]] MovingEquations<double, D> forces(const MovingCoordinates<double, D>& q,
                                                   const MovingCoordinates<double, D>& rate,
                                                   const MovingCoordinates<double, D>& a, const WeightFunction& weights,
                                                   const ShapeTabulation& table, const MovingLaw<D>& law) {
  MovingEquations<double, D> eq;
  const auto lanes =
      moving_sums<Pack, D, Ends>(in_all_lanes<D>(q), in_all_lanes<D>(rate), in_all_lanes<D>(a), weights, table, law);
  add_force<D>(lanes, eq);
  return eq;
}

}  // namespace

template <int D, MovingEnds Ends>
MovingKernels<D, Ends> moving_kernels() {
  if constexpr (D == 1) {
    return {&equations<D, Ends>, &forces<D, Ends>, &masses<D, Ends>, nullptr, nullptr};
  } else if constexpr (Ends == MovingEnds::both) {
    return {&equations<D, Ends>, &forces<D, Ends>, &masses<D, Ends>, nullptr, &moving_tangent<D, Ends, 0>};
  } else {
    return {&equations<D, Ends>, &forces<D, Ends>, &masses<D, Ends>, &moving_tangent<D, Ends, 1>, nullptr};
  }
}
template MovingKernels<1, MovingEnds::both> moving_kernels();
template MovingKernels<2, MovingEnds::a> moving_kernels();
template MovingKernels<2, MovingEnds::b> moving_kernels();
template MovingKernels<2, MovingEnds::both> moving_kernels();
template MovingKernels<3, MovingEnds::a> moving_kernels();
template MovingKernels<3, MovingEnds::b> moving_kernels();
template MovingKernels<3, MovingEnds::both> moving_kernels();

}  // namespace vlbeam::VLBEAM_KERNELS
