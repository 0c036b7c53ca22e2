#pragma once

#include "core/element/moving_points.hpp"
#include "core/element/strain_extremes.hpp"
#include "core/instruction_set.hpp"

namespace vlbeam {

/// Integrals over an element's axis at one instant.
template <class Real, int D>
struct ElementSums {
  Real axial = Real(0), bending = Real(0), kinetic = Real(0), gravity = Real(0);  ///< energies [J]
  Real mass = Real(0);                                                            ///< [kg]
  Real length = Real(0), length_rate = Real(0);  ///< [m], and by stretching and by its ends' motion [m/s]
  Vec<Real, D> momentum = Vec<Real, D>::Zero(), mass_moment = Vec<Real, D>::Zero();  ///< [kg m/s], [kg m]
  Vec<Real, 3> angular_momentum = Vec<Real, 3>::Zero();                              ///< about the origin [kg m^2/s]

  /// Adds what matter at a point has; `energies_alone` leaves out the rest.
  template <bool energies_alone, class Point>
  [[gnu::always_inline]] void add_motion(const Point& point, const PointMotion<Real, D>& at, double rhoA,
                                         const Vec<Real, D>& g) {
    using std::sqrt;
    const Real& wl = point.weight;
    const Real m = wl * Real(rhoA);
    kinetic += Real(0.5) * m * at.v.dot(at.v);
    gravity -= m * g.dot(at.r);
    if constexpr (energies_alone) return;
    mass += m;
    momentum += at.v * m;
    angular_momentum += moment_about_origin(at.r, at.v) * m;
    mass_moment += at.r * m;
    const Real stretch = sqrt(at.r_x.dot(at.r_x));
    length += wl * stretch;
    // at a fixed reference point, which moves along the beam
    const Vec<Real, D> growth = at.v_x + at.r_xx * point.mesh_velocity;
    length_rate += wl * at.r_x.dot(growth) / stretch + point.weight_rate * stretch;
  }
};

/// Both rules, with shape functions of unit weights: those of rational elements depend on their weights, and are made
/// where they are needed.
struct SumTables {
  ShapeTabulation polynomial, rational;

  explicit SumTables(const BeamRules& rules)
      : polynomial(rules.polynomial, unit_weights), rational(rules.rational, unit_weights) {}
  const ShapeTabulation& of(const Weights<double>& weights) const {
    return nearly_unit(weights) ? polynomial : rational;
  }
};

/// An element whose sums are asked for.
template <int D>
struct SummedElement {
  MovingCoordinates<double, D> q, rate;
  WeightTransport transport;
  const WeightFunction& weights;

  bool is_rational() const { return weights.w != unit_weights; }
  MovingKinematics<double, D> kinematics() const { return {q, rate, transport, weights}; }
};

/// Sums of an element without rest shape and rotary inertia, four points at once, compiled for one instruction set.
/// `table` is that of unit weights. Extremes are looked for where `extremes` is not null, at the ends, too.
template <int D>
struct SumKernels {
  using Sum = ElementSums<double, D>(const SummedElement<D>& element, const ShapeTabulation& table,
                                     const FeltSections& sections, const Vec<double, D>& gravity,
                                     StrainExtremes* extremes);
  Sum *all, *energies;
};

/// Those for an instruction set that is available().
template <int D>
SumKernels<D> sum_kernels(InstructionSet set);

/// The fastest ones.
template <int D>
const SumKernels<D>& fastest_sum_kernels();

namespace portable {
template <int D>
SumKernels<D> sum_kernels();
}  // namespace portable
namespace avx2 {
template <int D>
SumKernels<D> sum_kernels();
}  // namespace avx2

}  // namespace vlbeam
