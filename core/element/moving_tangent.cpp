#include "core/element/moving_tangent.hpp"

#include "core/element/damping_tangent.hpp"
#include "core/element/elastic_tangent.hpp"
#include "core/element/rest_tangent.hpp"

namespace vlbeam {

template <MovingEnds Ends, int D, int Unknown>
MovingTangent<Ends, D, Unknown> moving_tangent(const MovingCoordinates<double, D>& q,
                                               const MovingCoordinates<double, D>& rate,
                                               const MovingCoordinates<double, D>& a, const TangentWeights& weigh,
                                               const WeightFunction& weights, const PointTables& tables,
                                               const MovingLaw<D>& law) {
  constexpr int X = 4 * D;
  using Vector = Vec<double, D>;
  using Row = Eigen::Vector4d;  // one coefficient a nodal vector
  using Matrix = Eigen::Matrix<double, D, D>;
  MovingTangent<Ends, D, Unknown> tangent = MovingTangent<Ends, D, Unknown>::Zero();

  const auto unit = [](double scale) -> NodalCubic<double, 4> {
    return {scale * Row::Unit(0), scale * Row::Unit(1), scale * Row::Unit(2), scale * Row::Unit(3)};
  };
  const MovingKinematics<double, D, Ends> kinematics(q, rate, law.transport, weights);
  const MovingKinematics<double, 4, Ends> variation({unit(weigh.q), q.x_a, q.x_b}, {unit(weigh.v), rate.x_a, rate.x_b},
                                                    law.transport, weights);
  const bool reshaped = law.transport == WeightTransport::transported && weights.w != unit_weights;
  const bool variational = law.formulation == Formulation::variational;
  const FeltSections sections(law.section);

  struct Motion {
    PointMotion<double, D> at;
    PointMotion<double, 4> by;
  };
  const auto motion_at = [&](double u, const ShapeTable<double>& shape) -> Motion {
    return {kinematics.at(u, shape), variation.at(u, shape)};
  };
  using Rest = RestKinematics<double, D, Ends>;
  const auto at_rest =
      law.rest ? std::optional<Rest>(std::in_place, *law.rest, q.x_a, q.x_b, law.transport, weights, law.section)
               : std::nullopt;
  for_each_point(
      kinematics, tables.one, reshaped, at_rest ? &*at_rest : nullptr, motion_at,
      [&](const auto& point, const Motion& motion, const auto* rest) {
        const auto& [at, by] = motion;
        const BeamSection& section = sections[point.feels];
        const double rhoA = section.rhoA;
        const ElasticStress<double, D> elastic(at.r_x, at.r_xx, section.stiffness);
        const ElasticTangent<double, D> k(at.r_x, at.r_xx, section.stiffness);
        const double wl = point.weight, mu = wl * rhoA;
        const double mu_c = variational ? mu * point.mesh_velocity : 0;
        const double mu_rate = variational ? point.weight_rate * rhoA : 0;

        // the forces conjugate to r, r_x and r_xx of moving_equations, inertia included, and their
        // derivatives: multiples of the identity from inertia, matrices from the stresses
        Vector acceleration = a.e.r_a * at.s[0] + a.e.s_a * at.s[1] + a.e.r_b * at.s[2] + a.e.s_b * at.s[3];
        const Row s = Eigen::Map<const Row>(at.s.data()), s_x = Eigen::Map<const Row>(at.s_x.data());
        Row by_acceleration = weigh.a * s;
        for (int e = 0; e < moving_ends<Ends>; ++e) {
          const bool at_a = is_end_a<Ends>(e);
          acceleration += (at_a ? at.y_a : at.y_b) * (at_a ? a.x_a : a.x_b);
          by_acceleration += (at_a ? a.x_a : a.x_b) * (at_a ? by.y_a : by.y_b);
        }
        acceleration += at.remainder;
        by_acceleration += by.remainder;
        Vector elastic_p = elastic.p, elastic_m = elastic.m;
        Matrix pp = k.pp, pm = k.pm, mm = k.mm;
        using Work = typename RestTangent<D>::Work;
        Work along{Vector::Zero(), Vector::Zero()};  // of the stresses on the rest strains
        std::array<Work, Unknown> on_end;
        on_end.fill(along);
        if (rest != nullptr) {
          const RestTangent<D> from_rest(at.r_x, at.r_xx, *rest, section);
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
        Vector p = elastic_p, m = elastic_m;
        const Row by_f0 = -mu * by_acceleration - mu_rate * by.v - mu_c * by.v_x;
        const Row by_f1 = -mu_c * by.v;
        std::array<Matrix, 4> by_p, by_m, by_elastic_p, by_elastic_m;
        for (int j = 0; j < 4; ++j) {
          const auto i = static_cast<std::size_t>(j);
          by_elastic_p[i] = pp * by.r_x[j] + pm * by.r_xx[j];
          by_elastic_m[i] = pm.transpose() * by.r_x[j] + mm * by.r_xx[j];
          by_p[i] = by_elastic_p[i];
          by_m[i] = by_elastic_m[i];
        }
        if (section.damped()) {
          const DampingTangent<D> viscous(at, section);
          p += viscous.viscous_p;
          m += viscous.viscous_m;
          for (int j = 0; j < 4; ++j) {
            const auto i = static_cast<std::size_t>(j);
            const std::array<double, 4> by_rates{by.r_x[j], by.r_xx[j], by.v_x[j], by.v_xx[j]};
            for (std::size_t n = 0; n < 4; ++n) {
              by_p[i] += viscous.p[n] * by_rates[n];
              by_m[i] += viscous.m[n] * by_rates[n];
            }
          }
        }
        const Vector f0 = (law.gravity - acceleration) * mu - at.v * mu_rate - at.v_x * mu_c;
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
            const Work& from_end = on_end[static_cast<std::size_t>(e)];
            Vector end = y * by_f0[j] + f0 * by_y[j] + y_x * by_f1[j] + f1 * by_y_x[j] + f2 * by_y_xx[j] -
                         wl * (by_p[jj].transpose() * y_x + by_m[jj].transpose() * y_xx) +
                         wl * (from_end.by_slope * by.r_x[j] + from_end.by_second * by.r_xx[j]);
            if (variational) {
              const Vector by_lagrangian =
                  rhoA * (at.v * by.v[j] + law.gravity * by.r[j]) - elastic_p * by.r_x[j] - elastic_m * by.r_xx[j];
              const Vector by_slope = rhoA * (at.v * by.v_x[j] + at.v_x * by.v[j] + law.gravity * by.r_x[j]) -
                                      by_elastic_p[jj].transpose() * at.r_xx - elastic_p * by.r_xx[j] -
                                      by_elastic_m[jj].transpose() * at.r_xxx - elastic_m * by.r_xxx[j] +
                                      along.by_slope * by.r_x[j] + along.by_second * by.r_xx[j];
              end += at_a ? Vector(by_slope * (wl * (1 - point.u)) - by_lagrangian * point.share)
                          : Vector(by_slope * (wl * point.u) + by_lagrangian * point.share);
            }
            tangent.template block<1, D>(X + e, j * D) -= end.transpose();
          }
        }
      });

  for (int e = 0; e < Unknown; ++e) {
    const auto by_end = residual_by_end<Ends, D>(e, q, rate, a, weigh, weights, tables, law);
    for (int i = 0; i < 4; ++i) tangent.template block<D, 1>(i * D, X + e) = by_end.nodes[static_cast<std::size_t>(i)];
    for (int i = 0; i < Unknown; ++i) tangent(X + i, X + e) = by_end.ends[static_cast<std::size_t>(i)];
  }
  return tangent;
}

#define VLBEAM_MOVING_TANGENT(ENDS, D, UNKNOWN)                                                                      \
  template MovingTangent<ENDS, D, UNKNOWN> moving_tangent<ENDS, D, UNKNOWN>(                                         \
      const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, \
      const TangentWeights&, const WeightFunction&, const PointTables&, const MovingLaw<D>&)
VLBEAM_MOVING_TANGENT(MovingEnds::a, 2, 1);
VLBEAM_MOVING_TANGENT(MovingEnds::b, 2, 1);
VLBEAM_MOVING_TANGENT(MovingEnds::both, 2, 2);
VLBEAM_MOVING_TANGENT(MovingEnds::both, 2, 0);
VLBEAM_MOVING_TANGENT(MovingEnds::a, 3, 1);
VLBEAM_MOVING_TANGENT(MovingEnds::b, 3, 1);
VLBEAM_MOVING_TANGENT(MovingEnds::both, 3, 2);
VLBEAM_MOVING_TANGENT(MovingEnds::both, 3, 0);
#undef VLBEAM_MOVING_TANGENT

}  // namespace vlbeam
