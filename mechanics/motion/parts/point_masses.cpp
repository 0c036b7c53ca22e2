#include "mechanics/motion/parts/acting_point_masses.hpp"

#include "core/beam/lumped_mass.hpp"

namespace vlbeam {

template <int D>
void PointMasses<D>::add_weight(const ChainView<D>& beam, const Vector& gravity, double* force) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointMass& point = points[i];
    const int k = element_of(beam, i);
    if (beam.at_joint(k)) continue;
    const MovingKinematics<double, D> element = beam.kinematics(k);
    const double l = element.length(), u = (point.x - element.coordinates().x_a) / l;
    const std::array<double, 4> shares = shares_at(element.weights(), l, u);
    const Vector weight = point.mass * gravity;
    for (int n = 0; n < 4; ++n) {
      Eigen::Map<Vector>(force + beam.vector(k, n)) += shares[static_cast<std::size_t>(n)] * weight;
    }
  }
}

template <int D>
void PointMasses<D>::add_to(const ChainView<D>& beam, int k, const Vector& gravity,
                            MovingEquations<double, D>& equations) const {
  for (std::size_t n = 0; n < points.size(); ++n) {
    const PointMass& point = points[n];
    if (element_of(beam, n) != k) continue;
    const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), point.x);
    const double m = point.mass;
    const Vector force = m * (gravity - at.remainder);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) equations.mass[i][j] += m * at.s[i] * at.s[j];
      equations.mass_a[i] += m * at.s[i] * at.y_a;
      equations.mass_b[i] += m * at.s[i] * at.y_b;
      equations.force[i] += at.s[i] * force;
    }
    equations.mass_aa += m * at.y_a.squaredNorm();
    equations.mass_ab += m * at.y_a.dot(at.y_b);
    equations.mass_bb += m * at.y_b.squaredNorm();
    equations.force_a += force.dot(at.y_a);
    equations.force_b += force.dot(at.y_b);
  }
}

template <int D>
void PointMasses<D>::add_residual(const ChainView<D>& beam, const double* a, const Vector& gravity,
                                  double* residual) const {
  ChainView<D> accelerations = beam;
  accelerations.rate = a;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointMass& point = points[i];
    const int k = element_of(beam, i);
    if (!beam.at_joint(k)) continue;
    const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), point.x);
    const auto second = accelerations.rates(k);
    const Vector acceleration = at.remainder + second.e.r_a * at.s[0] + second.e.s_a * at.s[1] +
                                second.e.r_b * at.s[2] + second.e.s_b * at.s[3] + at.y_a * second.x_a +
                                at.y_b * second.x_b;
    add_point_force<D>(beam, k, at, {point.mass * (acceleration - gravity), Vector::Zero()}, residual);
  }
}

template <int D>
PointMatrix<D> PointMasses<D>::tangent(const PointMass& point, const ChainView<D>& beam, int k, const double* a,
                                       const Vector& gravity, const TangentWeights& by) {
  return point_tangent<D>(beam, k, point.x, a, by, [&](const auto& /*at*/, const auto& acceleration) {
    using Real = typename std::decay_t<decltype(acceleration)>::Scalar;
    PointForce<Real, D> force;
    for (int c = 0; c < D; ++c) force.on_r[c] = (gravity[c] - acceleration[c]) * point.mass;
    return force;
  });
}

template struct PointMasses<2>;
template struct PointMasses<3>;
template class ActingPointMasses<2>;
template class ActingPointMasses<3>;

}  // namespace vlbeam
