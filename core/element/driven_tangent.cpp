#include "core/element/driven_tangent.hpp"

#include "core/element/damping_tangent.hpp"
#include "core/element/elastic_tangent.hpp"
#include "core/element/rest_tangent.hpp"

namespace vlbeam {

template <int D>
Eigen::Matrix<double, 4 * D, 4 * D> driven_tangent(const MovingCoordinates<double, D>& q,
                                                   const MovingCoordinates<double, D>& rate,
                                                   const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                                   const WeightFunction& weights, const ShapeTabulation& table,
                                                   const MovingLaw<D>& law) {
  using Row = Eigen::Vector4d;  // one coefficient a nodal vector
  using Matrix = Eigen::Matrix<double, D, D>;
  Eigen::Matrix<double, 4 * D, 4 * D> tangent = Eigen::Matrix<double, 4 * D, 4 * D>::Zero();

  auto unit = [](double scale) -> NodalCubic<double, 4> {
    return {scale * Row::Unit(0), scale * Row::Unit(1), scale * Row::Unit(2), scale * Row::Unit(3)};
  };
  const MovingKinematics<double, D> kinematics(q, rate, law.transport, weights);
  const MovingKinematics<double, 4> variation({unit(by.q), q.x_a, q.x_b}, {unit(by.v), rate.x_a, rate.x_b},
                                              law.transport, weights);
  const bool reshaped = law.transport == WeightTransport::transported && weights.w != unit_weights;
  const bool variational = law.formulation == Formulation::variational;
  using Rest = RestKinematics<double, D, MovingEnds::both>;
  const auto at_rest =
      law.rest ? std::optional<Rest>(std::in_place, *law.rest, q.x_a, q.x_b, law.transport, weights, law.section)
               : std::nullopt;
  const FeltSections sections(law.section);
  const double l = kinematics.length();
  const double l_rate = variational ? kinematics.length_rate() : 0;

  for (std::size_t g = 0; g < table.rule.size(); ++g) {
    const auto [u, w, feels] = table.rule[g];
    const BeamSection& section = sections[feels];
    const double rhoA = section.rhoA;
    const ShapeTable<double> shape = reshaped ? rational_shape(kinematics.weights(), u) : table.shape[g];
    const PointMotion<double, D> at = kinematics.at(u, shape);
    const PointMotion<double, 4> varied = variation.at(u, shape);
    const ElasticTangent<double, D> k(at.r_x, at.r_xx, section.stiffness);
    Matrix pp = k.pp, pm = k.pm, mm = k.mm;
    if (at_rest) {
      const RestTangent<D> from_rest(at.r_x, at.r_xx, at_rest->at(u, shape), section);
      pp += from_rest.pp;
      pm += from_rest.pm;
      mm += from_rest.mm;
    }
    const double wl = w * l, mu = wl * rhoA;
    const double c = variational ? kinematics.mesh_velocity(u) : 0;

    // of the forces conjugate to r and to r_x in moving_equations: multiples of the identity from inertia
    const Row s = Eigen::Map<const Row>(at.s.data()), s_x = Eigen::Map<const Row>(at.s_x.data());
    const Row acceleration = by.a * s + a.x_a * varied.y_a + a.x_b * varied.y_b + varied.remainder;
    const Row by_f0 = -mu * acceleration - w * rhoA * (l_rate * varied.v + l * c * varied.v_x);
    const Row by_f1 = -mu * c * varied.v;
    const Eigen::Matrix4d inertia = s * by_f0.transpose() + s_x * by_f1.transpose();

    std::array<Matrix, 4> by_p, by_m;
    for (int j = 0; j < 4; ++j) {
      const auto i = static_cast<std::size_t>(j);
      by_p[i] = pp * varied.r_x[j] + pm * varied.r_xx[j];
      by_m[i] = pm.transpose() * varied.r_x[j] + mm * varied.r_xx[j];
    }
    if (section.damped()) {
      const DampingTangent<D> viscous(at, section);
      for (int j = 0; j < 4; ++j) {
        const std::array<double, 4> rates{varied.r_x[j], varied.r_xx[j], varied.v_x[j], varied.v_xx[j]};
        for (std::size_t n = 0; n < 4; ++n) {
          by_p[static_cast<std::size_t>(j)] += viscous.p[n] * rates[n];
          by_m[static_cast<std::size_t>(j)] += viscous.m[n] * rates[n];
        }
      }
    }
    for (int j = 0; j < 4; ++j) {
      const auto jj = static_cast<std::size_t>(j);
      for (int i = 0; i < 4; ++i) {
        auto block = tangent.template block<D, D>(i * D, j * D);
        block += (wl * s_x[i]) * by_p[jj];
        if (section.bends()) block += (wl * at.s_xx[static_cast<std::size_t>(i)]) * by_m[jj];
        block.diagonal().array() -= inertia(i, j);
      }
    }
  }
  return tangent;
}

template Eigen::Matrix<double, 4 * 2, 4 * 2> driven_tangent(const MovingCoordinates<double, 2>&,
                                                            const MovingCoordinates<double, 2>&,
                                                            const MovingCoordinates<double, 2>&, const TangentWeights&,
                                                            const WeightFunction&, const ShapeTabulation&,
                                                            const MovingLaw<2>&);
template Eigen::Matrix<double, 4 * 3, 4 * 3> driven_tangent(const MovingCoordinates<double, 3>&,
                                                            const MovingCoordinates<double, 3>&,
                                                            const MovingCoordinates<double, 3>&, const TangentWeights&,
                                                            const WeightFunction&, const ShapeTabulation&,
                                                            const MovingLaw<3>&);

}  // namespace vlbeam
