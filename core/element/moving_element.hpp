#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "core/element/piece_bending.hpp"
#include "core/element/section.hpp"

namespace vlbeam {

/// Equations of motion of one element: M q'' = Q with q = (r_A, s_A, r_B, s_B, x_A, x_B).
/// The block of the nodal coordinates is a scalar matrix times the identity.
template <class Real, int D>
struct MovingEquations {
  std::array<std::array<Real, 4>, 4> mass;     ///< both triangles [kg m^k]
  std::array<Vec<Real, D>, 4> mass_a, mass_b;  ///< coupling of the nodal coordinates with x_A and x_B
  Real mass_aa, mass_ab, mass_bb;
  std::array<Vec<Real, D>, 4> force;
  Real force_a, force_b;
  Real dissipation;  ///< power lost to Kelvin-Voigt damping [W]

  void set_zero() {
    for (std::size_t i = 0; i < 4; ++i) {
      mass[i].fill(Real(0));
      mass_a[i].setZero();
      mass_b[i].setZero();
      force[i].setZero();
    }
    mass_aa = mass_ab = mass_bb = force_a = force_b = dissipation = Real(0);
  }
};

/// What the equations of a variable-length element are made of.
template <int D>
struct MovingLaw {
  BeamSection section;
  Formulation formulation = Formulation::variational;
  WeightTransport transport = WeightTransport::frozen;
  Vec<double, D> gravity = Vec<double, D>::Zero();  ///< [m/s^2], at the current time
  const RestElement<D>* rest = nullptr;             ///< of the element, null for a straight, unstrained one
  const SectionPieces* pieces = nullptr;            ///< null for a beam of one section all along
};

/// Of an element from x_a to x_b, whose section changes inside it or else is the one that it has there.
template <int D>
MovingLaw<D> law_between(const MovingLaw<D>& law, double x_a, double x_b) {
  MovingLaw<D> here = law;
  if (law.pieces == nullptr || law.pieces->change_between(x_a, x_b)) return here;
  here.section = law.pieces->at((x_a + x_b) / 2).of(law.section);
  here.pieces = nullptr;
  return here;
}

struct AtAnyAcceleration {};

/// Adds a point's part of the upper triangle of the mass matrix.
template <MovingEnds Ends, class Real, int D>
[[gnu::always_inline]] inline void add_mass(const Real& mu, const PointMotion<Real, D>& at,
                                            MovingEquations<Real, D>& eq) {
  constexpr bool a_moves = Ends != MovingEnds::b, b_moves = Ends != MovingEnds::a;
  for (std::size_t i = 0; i < 4; ++i) {
    const Real mi = mu * at.s[i];
    for (std::size_t j = i; j < 4; ++j) eq.mass[i][j] += mi * at.s[j];
    if constexpr (a_moves) eq.mass_a[i] += at.y_a * mi;
    if constexpr (b_moves) eq.mass_b[i] += at.y_b * mi;
  }
  if constexpr (a_moves) eq.mass_aa += mu * at.y_a.dot(at.y_a);
  if constexpr (b_moves) eq.mass_bb += mu * at.y_b.dot(at.y_b);
  if constexpr (a_moves && b_moves) eq.mass_ab += mu * at.y_a.dot(at.y_b);
}

/// for_each_point(), or that in pieces of an element in which the section changes: see law_between().
template <class Real, int D, MovingEnds Ends, class Rest, class Evaluate, class Visit>
[[gnu::always_inline]] inline void visit_points(const MovingKinematics<Real, D, Ends>& kinematics,
                                                const ShapeTabulation& table, bool reshaped, const MovingLaw<D>& law,
                                                const Rest* rest, const Evaluate& evaluate, const Visit& visit) {
  if constexpr (!in_packs<Real>) {
    if (law.pieces != nullptr) {
      return for_each_point_in_pieces(kinematics, table.rule, law.section, *law.pieces, rest, evaluate, visit);
    }
  }
  for_each_point(kinematics, table, reshaped, rest, evaluate, visit);
}

/// Mass matrix and generalized forces of one variable-length element. Of a law by law_between().
///
/// `virtual_work` is Eq. 17-19 of Ding & Ouyang (2022): everything at fixed material points.
/// `variational` is Lagrange's equations of the discrete Lagrangian sum_g w_g l (rhoA v.v/2 - W + rhoA g.r) with the
/// reference points u_g fixed. A derivative at fixed u is the one at fixed x plus u d/dx (for x_B) or (1 - u) d/dx (for
/// x_A), which adds to the virtual work
///   - sum w rhoA (l' N^T v + l c (N_x^T v + N^T v_x)),  sum w (L + l u L_x) on x_B,  sum w (-L + l (1 - u) L_x) on
///   x_A,
/// L the Lagrangian per length: between events energy is conserved for any number of points. A rest shape moves with
/// the ends, too: its strains' derivatives by x_A and x_B do the work sum w l (N deps_0/dx_A + M dkappa_0/dx_A) on x_A,
/// and so on x_B, N and M the tension and the moment.
///
/// With accelerations `a` their inertia counts among the forces, Q - M a, and no mass matrix is made.
template <class Real, int D, MovingEnds Ends, class Accelerations>
MovingEquations<Real, D> moving_sums(const MovingCoordinates<Real, D>& q, const MovingCoordinates<Real, D>& rate,
                                     [[maybe_unused]] const Accelerations& a, const WeightFunction& weights,
                                     const ShapeTabulation& table, const MovingLaw<D>& law) {
  constexpr bool accelerated = !std::is_same_v<Accelerations, AtAnyAcceleration>;
  using Vector = Vec<Real, D>;
  using Kinematics = MovingKinematics<Real, D, Ends>;
  MovingEquations<Real, D> eq;
  eq.set_zero();
  const Kinematics kinematics(q, rate, law.transport, weights);
  const bool reshaped = law.transport == WeightTransport::transported && weights.w != unit_weights;
  const FeltSections sections(law.section);
  const Vector gravity = law.gravity.template cast<Real>();
  const bool variational = law.formulation == Formulation::variational;

  using Rest = RestKinematics<std::conditional_t<in_packs<Real>, double, Real>, D, Ends>;  // packs have none
  std::optional<Rest> at_rest;
  if constexpr (!in_packs<Real>) {
    if (law.rest) at_rest.emplace(*law.rest, q.x_a, q.x_b, law.transport, weights, law.section);
  }
  const auto motion = [&](const auto& u, const auto& shape) { return kinematics.at(u, shape); };
  std::optional<PieceBending<Real, D>> bending;  // where EI changes inside the element
  if constexpr (!in_packs<Real> && D > 1) {
    if (law.pieces != nullptr && law.rest == nullptr) {
      bending = piece_bending(kinematics, table.rule, law.section, *law.pieces);
    }
  }
  visit_points(kinematics, table, reshaped, law, at_rest ? &*at_rest : nullptr, motion,
               [&](const auto& point, const auto& at, const auto* rest) {
                 const BeamSection& section = point.felt(sections);
                 const double rhoA = section.rhoA;
                 const ElasticStress<Real, D> elastic(at.r_x, at.r_xx, section.stiffness);
                 Vector p = elastic.p, m = elastic.m;
                 [[maybe_unused]] Real piece_growth(0);
                 Real stored = elastic.axial + elastic.bending;  // W, and its derivative along the beam
                 if constexpr (std::is_same_v<std::decay_t<decltype(point)>, PiecePoint<Real>> && D > 1) {
                   if (bending && section.bends()) {
                     const ElasticStress<Real, D> axial(at.r_x, at.r_xx, axial_part(section.stiffness));
                     const auto bent = bending->stress(point.x, at.r_x, at.r_xx, section.stiffness.EI);
                     p = axial.p + bent.p;
                     m = bent.m;
                     stored = axial.axial + bent.stored;
                     piece_growth = bent.stored_x;
                   }
                 }
                 Real stored_x = p.dot(at.r_xx) + m.dot(at.r_xxx);
                 if constexpr (std::is_same_v<std::decay_t<decltype(point)>, PiecePoint<Real>>)
                   stored_x += piece_growth;
                 if (rest != nullptr) {
                   const RestStress<Real, D> from_rest(at.r_x, at.r_xx, *rest, section);
                   p += from_rest.p;
                   m += from_rest.m;
                   stored = from_rest.axial + from_rest.bending;
                   stored_x += from_rest.p.dot(at.r_xx) + from_rest.m.dot(at.r_xxx) - from_rest.work(rest->along);
                   if constexpr (Kinematics::a_moves) eq.force_a += point.weight * from_rest.work(rest->by_a);
                   if constexpr (Kinematics::b_moves) eq.force_b += point.weight * from_rest.work(rest->by_b);
                 }
                 const Real& wl = point.weight;
                 if (section.damped()) {
                   StrainChange<Real> rest_rate;
                   if (rest != nullptr) rest_rate = rest->rate(rate.x_a, rate.x_b);
                   const DampingStress<Real, D> viscous(at.r_x, at.r_xx, at.v_x, at.v_xx, section.stiffness,
                                                        section.damping, section.curvature_regularization,
                                                        rest != nullptr ? &rest_rate : nullptr);
                   p += viscous.p;
                   m += viscous.m;
                   eq.dissipation += wl * viscous.power;
                   if (rest != nullptr) {
                     if constexpr (Kinematics::a_moves) eq.force_a += wl * viscous.work(rest->by_a);
                     if constexpr (Kinematics::b_moves) eq.force_b += wl * viscous.work(rest->by_b);
                   }
                 }

                 const Real mu = wl * Real(rhoA);
                 // one force conjugate to r, one to r_x, one to r_xx: all generalized forces follow from these three
                 Vector f0 = (gravity - at.remainder) * mu, f1 = p * Real(-wl), f2 = m * Real(-wl);
                 if constexpr (accelerated) {
                   Vector acceleration = a.e.r_a * at.s[0] + a.e.s_a * at.s[1] + a.e.r_b * at.s[2] + a.e.s_b * at.s[3];
                   if constexpr (Kinematics::a_moves) acceleration += at.y_a * a.x_a;
                   if constexpr (Kinematics::b_moves) acceleration += at.y_b * a.x_b;
                   f0 -= acceleration * mu;
                 }
                 if (variational) {
                   const Real mu_c = mu * point.mesh_velocity;
                   f0 -= at.v * Real(point.weight_rate * Real(rhoA)) + at.v_x * mu_c;
                   f1 -= at.v * mu_c;
                   const Real lagrangian = Real(0.5 * rhoA) * at.v.dot(at.v) - stored + Real(rhoA) * gravity.dot(at.r);
                   const Real lagrangian_x = wl * (Real(rhoA) * (at.v.dot(at.v_x) + gravity.dot(at.r_x)) - stored_x);
                   if constexpr (Kinematics::a_moves) {
                     eq.force_a += lagrangian_x * Real(point.by_a()) + lagrangian * Real(point.weight_by_a());
                   }
                   if constexpr (Kinematics::b_moves) {
                     eq.force_b += lagrangian_x * Real(point.by_b()) + lagrangian * Real(point.weight_by_b());
                   }
                 }
                 for (std::size_t i = 0; i < 4; ++i) {
                   eq.force[i] += f0 * at.s[i] + f1 * at.s_x[i] + f2 * at.s_xx[i];
                 }
                 if constexpr (Kinematics::a_moves) {
                   eq.force_a += f0.dot(at.y_a) + f1.dot(at.y_a_x) + f2.dot(at.y_a_xx);
                 }
                 if constexpr (Kinematics::b_moves) {
                   eq.force_b += f0.dot(at.y_b) + f1.dot(at.y_b_x) + f2.dot(at.y_b_xx);
                 }
                 if constexpr (!accelerated) add_mass<Ends>(mu, at, eq);
               });
  if constexpr (!accelerated) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) eq.mass[i][j] = eq.mass[j][i];
    }
  }
  return eq;
}

/// The mass matrix alone, without forces: its upper triangle.
template <class Real, int D, MovingEnds Ends>
MovingEquations<Real, D> mass_sums(const MovingCoordinates<Real, D>& q, const WeightFunction& weights,
                                   const ShapeTabulation& table, const MovingLaw<D>& law) {
  using Kinematics = MovingKinematics<Real, D, Ends>;
  MovingEquations<Real, D> eq;
  eq.set_zero();
  const Kinematics kinematics(q, q, law.transport, weights);  // rates do not count
  const bool reshaped = law.transport == WeightTransport::transported && weights.w != unit_weights;
  const FeltSections sections(law.section);
  const auto motion = [&](const auto& u, const auto& shape) { return kinematics.at(u, shape); };
  visit_points(kinematics, table, reshaped, law, static_cast<const RestKinematics<double, D, Ends>*>(nullptr), motion,
               [&](const auto& point, const auto& at, const auto* /*rest*/) {
                 add_mass<Ends>(point.weight * Real(point.felt(sections).rhoA), at, eq);
               });
  return eq;
}

/// What a variable-length element does, without and with given accelerations: point by point.
template <class Real, int D, MovingEnds Ends>
struct MovingElement {
  using Coordinates = MovingCoordinates<Real, D>;

  static MovingEquations<Real, D> equations(const Coordinates& q, const Coordinates& rate,
                                            const WeightFunction& weights, const ShapeTabulation& table,
                                            const MovingLaw<D>& law) {
    return moving_sums<Real, D, Ends>(q, rate, AtAnyAcceleration{}, weights, table, between(q, law));
  }
  static MovingEquations<Real, D> forces(const Coordinates& q, const Coordinates& rate, const Coordinates& a,
                                         const WeightFunction& weights, const ShapeTabulation& table,
                                         const MovingLaw<D>& law) {
    return moving_sums<Real, D, Ends>(q, rate, a, weights, table, between(q, law));
  }

 private:
  static MovingLaw<D> between(const Coordinates& q, const MovingLaw<D>& law) {
    if constexpr (!in_packs<Real>) {
      if (law.pieces != nullptr) return law_between(law, number_of(q.x_a), number_of(q.x_b));
    }
    return law;
  }
};

/// The same, where there is no rest shape four points at once (`element/moving_kernels.cpp`), and the mass matrix
/// alone, which a rest shape does not change. Where the section changes inside the element, point by point.
template <int D, MovingEnds Ends>
struct MovingElement<double, D, Ends> {
  using Coordinates = MovingCoordinates<double, D>;

  static MovingEquations<double, D> equations(const Coordinates& q, const Coordinates& rate,
                                              const WeightFunction& weights, const ShapeTabulation& table,
                                              const MovingLaw<D>& law);
  static MovingEquations<double, D> forces(const Coordinates& q, const Coordinates& rate, const Coordinates& a,
                                           const WeightFunction& weights, const ShapeTabulation& table,
                                           const MovingLaw<D>& law);
  static MovingEquations<double, D> masses(const Coordinates& q, const WeightFunction& weights,
                                           const ShapeTabulation& table, const MovingLaw<D>& law);
};

template <class Real, int D, MovingEnds Ends = MovingEnds::both>
MovingEquations<Real, D> moving_equations(const MovingCoordinates<Real, D>& q, const MovingCoordinates<Real, D>& rate,
                                          const WeightFunction& weights, const ShapeTabulation& table,
                                          const MovingLaw<D>& law) {
  return MovingElement<Real, D, Ends>::equations(q, rate, weights, table, law);
}

}  // namespace vlbeam
