#include "mechanics/bearings/point_springs.hpp"

namespace vlbeam {

template <int D>
EnergyBalance PointSprings<D>::add_force(const Motion<D>& motion, double* force) const {
  EnergyBalance power;
  for (const PointSpring<D>& spring : springs_) {
    const int k = motion.beam.element_at(spring.x);
    const PointMotion<double, D> at = point_at<double, D>(motion.beam.kinematics(k), spring.x);
    const Vec<double, D> f = spring.template force<double>(at.r, at.v);
    add_point_force<D>(motion.beam, k, at, {f, Vec<double, D>::Zero()}, force);
    const double given = spring.elastic(at.r).dot(at.v);
    power.loads += given;
    power.dissipated += given - f.dot(at.v);
  }
  return power;
}

template <int D>
void PointSprings<D>::add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  using Real = ElementReal<D>;
  for (const PointSpring<D>& spring : springs_) {
    const int k = motion.beam.element_at(spring.x);
    const PointMotion<Real, D> at = point_at<Real, D>(active_element(motion.beam, k, by), spring.x);
    PointForce<Real, D> f;
    f.on_r = spring.template force<Real>(at.r, at.v);
    PointMatrix<D> matrix = PointMatrix<D>::Zero();
    add_point_tangent(motion.beam, k, at, f, matrix);
    tangent.add_point(motion.beam, k, matrix);
  }
}

template class PointSprings<2>;
template class PointSprings<3>;

}  // namespace vlbeam
