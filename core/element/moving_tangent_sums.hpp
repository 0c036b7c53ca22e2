#pragma once

#include "core/element/active.hpp"
#include "core/element/damping_tangent.hpp"
#include "core/element/elastic_tangent.hpp"
#include "core/element/moving_tangent.hpp"
#include "core/element/rest_tangent.hpp"

namespace vlbeam {

template <int N>
inline constexpr bool in_packs<Active<N, Pack>> = true;

template <class Real, MovingEnds Ends, int D, int Unknown>
using TangentOf = Eigen::Matrix<Real, 4 * D + Unknown, 4 * D + Unknown>;

/// moving_tangent() for numbers of type `Real`: packs, of a straight beam without damping, or double.
template <MovingEnds Ends, int D, int Unknown, class Real>
TangentOf<Real, Ends, D, Unknown> tangent_sums(const MovingCoordinates<Real, D>& q,
                                               const MovingCoordinates<Real, D>& rate,
                                               const MovingCoordinates<Real, D>& a, const TangentWeights& weigh,
                                               const WeightFunction& weights, const ShapeTabulation& table,
                                               const MovingLaw<D>& law) {
  constexpr bool plain = !std::is_same_v<Real, double>;
  constexpr int X = 4 * D;
  using Vector = Vec<Real, D>;
  using Row = Vec<Real, 4>;  // one coefficient a nodal vector
  using Matrix = Eigen::Matrix<Real, D, D>;
  using Parameter = PointParameter<Real>;
  TangentOf<Real, Ends, D, Unknown> tangent = TangentOf<Real, Ends, D, Unknown>::Zero();

  const auto unit = [](double scale) {
    NodalCubic<Real, 4> rows{Row::Zero(), Row::Zero(), Row::Zero(), Row::Zero()};
    rows.r_a[0] = rows.s_a[1] = rows.r_b[2] = rows.s_b[3] = Real(scale);
    return rows;
  };
  const MovingKinematics<Real, D, Ends> kinematics(q, rate, law.transport, weights);
  const MovingKinematics<Real, 4, Ends> variation({unit(weigh.q), q.x_a, q.x_b}, {unit(weigh.v), rate.x_a, rate.x_b},
                                                  law.transport, weights);
  const bool reshaped = law.transport == WeightTransport::transported && weights.w != unit_weights;
  const bool variational = law.formulation == Formulation::variational;
  const FeltSections sections(law.section);

  struct Motion {
    PointMotion<Real, D> at;
    PointMotion<Real, 4> by;
  };
  const auto motion_at = [&](const Parameter& u, const auto& shape) -> Motion {
    return {kinematics.at(u, shape), variation.at(u, shape)};
  };
  const Vector gravity = law.gravity.template cast<Real>();
  using Rest = RestKinematics<double, D, Ends>;
  std::optional<Rest> at_rest;
  if constexpr (!plain) {
    if (law.rest) at_rest.emplace(*law.rest, q.x_a, q.x_b, law.transport, weights, law.section);
  }
  for_each_point(
      kinematics, table, reshaped, at_rest ? &*at_rest : nullptr, motion_at,
      [&](const auto& point, const Motion& motion, const auto* rest) {
        const auto& [at, by] = motion;
        const BeamSection& section = sections[point.feels];
        const double rhoA = section.rhoA;
        const ElasticStress<Real, D> elastic(at.r_x, at.r_xx, section.stiffness);
        const ElasticTangent<Real, D> k(at.r_x, at.r_xx, section.stiffness);
        const Real wl = point.weight, mu = wl * Real(rhoA);
        const Real mu_c = variational ? Real(mu * point.mesh_velocity) : Real(0);
        const Real mu_rate = variational ? Real(point.weight_rate * Real(rhoA)) : Real(0);

        // the forces conjugate to r, r_x and r_xx of moving_equations, inertia included, and their
        // derivatives: multiples of the identity from inertia, matrices from the stresses
        Vector acceleration = a.e.r_a * at.s[0] + a.e.s_a * at.s[1] + a.e.r_b * at.s[2] + a.e.s_b * at.s[3];
        const Row s = Eigen::Map<const Row>(at.s.data()), s_x = Eigen::Map<const Row>(at.s_x.data());
        Row by_acceleration = s * Real(weigh.a);
        for (int e = 0; e < moving_ends<Ends>; ++e) {
          const bool at_a = is_end_a<Ends>(e);
          acceleration += (at_a ? at.y_a : at.y_b) * (at_a ? a.x_a : a.x_b);
          by_acceleration += (at_a ? a.x_a : a.x_b) * (at_a ? by.y_a : by.y_b);
        }
        acceleration += at.remainder;
        by_acceleration += by.remainder;
        Vector elastic_p = elastic.p, elastic_m = elastic.m;
        Matrix pp = k.pp, pm = k.pm, mm = k.mm;
        using Work = typename RestTangent<double, D>::Work;
        [[maybe_unused]] Work along{Vec<double, D>::Zero(), Vec<double, D>::Zero()};  // of the stresses on rest strains
        std::array<Work, Unknown> on_end;
        on_end.fill(along);
        // of the viscous ones, by the nodal vectors
        [[maybe_unused]] std::array<std::array<Vector, 4>, Unknown> viscous_on_end;
        if constexpr (!plain) {
          if (rest != nullptr) {
            const RestTangent<double, D> from_rest(at.r_x, at.r_xx, *rest, section);
            elastic_p += from_rest.p;
            elastic_m += from_rest.m;
            pp += from_rest.pp;
            pm += from_rest.pm;
            mm += from_rest.mm;
            along = from_rest.work(rest->along);
            for (int e = 0; e < Unknown; ++e) {
              on_end[static_cast<std::size_t>(e)] = from_rest.work(is_end_a<Ends>(e) ? rest->by_a : rest->by_b);
            }
          }
        }
        // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): damping adds to them
        Vector p = elastic_p, m = elastic_m;
        const Row by_f0 = by_acceleration * Real(-mu) - by.v * mu_rate - by.v_x * mu_c;
        const Row by_f1 = by.v * Real(-mu_c);
        std::array<Matrix, 4> by_p, by_m, by_elastic_p, by_elastic_m;
        for (int j = 0; j < 4; ++j) {
          const auto i = static_cast<std::size_t>(j);
          by_elastic_p[i] = pp * by.r_x[j] + pm * by.r_xx[j];
          by_elastic_m[i] = pm.transpose() * by.r_x[j] + mm * by.r_xx[j];
          by_p[i] = by_elastic_p[i];
          by_m[i] = by_elastic_m[i];
        }
        if constexpr (!plain) {
          if (section.damped()) {
            StrainChange<double> rest_rate;
            if (rest != nullptr) rest_rate = rest->rate(rate.x_a, rate.x_b);
            const DampingTangent<D> viscous(at, section, rest != nullptr ? &rest_rate : nullptr);
            p += viscous.viscous_p;
            m += viscous.viscous_m;
            for (int j = 0; j < 4; ++j) {
              const auto i = static_cast<std::size_t>(j);
              const std::array<double, 4> by_rates{by.r_x[j], by.r_xx[j], by.v_x[j], by.v_xx[j]};
              for (std::size_t n = 0; n < 4; ++n) {
                by_p[i] += viscous.p[n] * by_rates[n];
                by_m[i] += viscous.m[n] * by_rates[n];
              }
              for (int e = 0; e < Unknown; ++e) {
                Vector& of_end = viscous_on_end[static_cast<std::size_t>(e)][i];
                of_end.setZero();
                for (std::size_t n = 0; rest != nullptr && n < 4; ++n) {
                  of_end += viscous.work(is_end_a<Ends>(e) ? rest->by_a : rest->by_b, n) * by_rates[n];
                }
              }
            }
          }
        }
        const Vector f0 = (gravity - acceleration) * mu - at.v * mu_rate - at.v_x * mu_c;
        const Vector f1 = p * -wl - at.v * mu_c, f2 = m * -wl;

        for (int j = 0; j < 4; ++j) {
          const auto jj = static_cast<std::size_t>(j);
          for (int i = 0; i < 4; ++i) {
            auto block = tangent.template block<D, D>(i * D, j * D);
            block += (wl * s_x[i]) * by_p[jj];
            if (section.bends()) block += (wl * at.s_xx[static_cast<std::size_t>(i)]) * by_m[jj];
            block.diagonal().array() -= s[i] * by_f0[j] + s_x[i] * by_f1[j];
          }
          for (int e = 0; e < Unknown; ++e) {
            const bool at_a = is_end_a<Ends>(e);
            const Vector &y = at_a ? at.y_a : at.y_b, &y_x = at_a ? at.y_a_x : at.y_b_x,
                         &y_xx = at_a ? at.y_a_xx : at.y_b_xx;
            const Row &by_y = at_a ? by.y_a : by.y_b, &by_y_x = at_a ? by.y_a_x : by.y_b_x,
                      &by_y_xx = at_a ? by.y_a_xx : by.y_b_xx;
            Vector end = y * by_f0[j] + f0 * by_y[j] + y_x * by_f1[j] + f1 * by_y_x[j] + f2 * by_y_xx[j] -
                         wl * (by_p[jj].transpose() * y_x + by_m[jj].transpose() * y_xx);
            if constexpr (!plain) {
              const Work& from_end = on_end[static_cast<std::size_t>(e)];
              end += wl * (from_end.by_slope * by.r_x[j] + from_end.by_second * by.r_xx[j]);
              if (section.damped()) end += wl * viscous_on_end[static_cast<std::size_t>(e)][jj];
            }
            if (variational) {
              const Vector by_lagrangian =
                  Real(rhoA) * (at.v * by.v[j] + gravity * by.r[j]) - elastic_p * by.r_x[j] - elastic_m * by.r_xx[j];
              Vector by_slope = Real(rhoA) * (at.v * by.v_x[j] + at.v_x * by.v[j] + gravity * by.r_x[j]) -
                                by_elastic_p[jj].transpose() * at.r_xx - elastic_p * by.r_xx[j] -
                                by_elastic_m[jj].transpose() * at.r_xxx - elastic_m * by.r_xxx[j];
              if constexpr (!plain) by_slope += along.by_slope * by.r_x[j] + along.by_second * by.r_xx[j];
              if (at_a) {
                end += by_slope * Real(wl * (1 - point.u)) - by_lagrangian * point.share;
              } else {
                end += by_slope * Real(wl * point.u) + by_lagrangian * point.share;
              }
            }
            tangent.template block<1, D>(X + e, j * D) -= end.transpose();
          }
        }
      });

  using Along = Active<1, Real>;
  for (int e = 0; e < Unknown; ++e) {
    const auto along_end = [&](const MovingCoordinates<Real, D>& from, double scale) {
      MovingCoordinates<Along, D> result;
      result.e = {from.e.r_a.template cast<Along>(), from.e.s_a.template cast<Along>(),
                  from.e.r_b.template cast<Along>(), from.e.s_b.template cast<Along>()};
      result.x_a = Along(from.x_a);
      result.x_b = Along(from.x_b);
      (is_end_a<Ends>(e) ? result.x_a : result.x_b).derivatives()[0] = Real(scale);
      return result;
    };
    const auto by_end = moving_residual<Ends, Along, D>(along_end(q, weigh.q), along_end(rate, weigh.v),
                                                        along_end(a, weigh.a), weights, table, law);
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < D; ++c) {
        tangent(i * D + c, X + e) = by_end.nodes[static_cast<std::size_t>(i)][c].derivatives()[0];
      }
    }
    for (int i = 0; i < Unknown; ++i) {
      tangent(X + i, X + e) = by_end.ends[static_cast<std::size_t>(i)].derivatives()[0];
    }
  }
  return tangent;
}

}  // namespace vlbeam
