#include "mechanics/ropes/ground.hpp"

namespace vlbeam {

template <int D>
EnergyBalance Ground<D>::add_force(const Motion<D>& motion, double* force) const {
  EnergyBalance power;
  const auto book = [&](int /*element*/, const PointMotion<double, D>& at, const Vec<double, D>& f, double weight) {
    const double given = law_.spring().push(law_.level - law_.up.dot(at.r)) * law_.up.dot(at.v);
    power.loads += weight * given;
    power.dissipated += weight * (given - f.dot(at.v));
  };
  add_line_force<D>(motion.beam, points_, law_, force, book);
  for (std::size_t i = 0; i < masses_.points.size(); ++i) {
    const int k = masses_.element_of(motion.beam, i);
    const PointMotion<double, D> at = point_at<double, D>(motion.beam.kinematics(k), masses_.points[i].x);
    if (!law_.acts(at.r)) continue;
    const Vec<double, D> f = law_.force(LinePoint<double, D>{at.r, at.r_x, at.v});
    add_point_force<D>(motion.beam, k, at, {as_length(i) * f, Vec<double, D>::Zero()}, force);
    book(k, at, f, as_length(i));
  }
  return power;
}

template <int D>
void Ground<D>::add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  for (int k = 0; k < motion.beam.mesh.elements(); ++k) {
    tangent.add_point(motion.beam, k, line_tangent<D>(motion.beam, k, points_, law_, by));
  }
  for (std::size_t i = 0; i < masses_.points.size(); ++i) {
    using Real = ElementReal<D>;
    const int k = masses_.element_of(motion.beam, i);
    const PointMotion<Real, D> at = point_at<Real, D>(active_element(motion.beam, k, by), masses_.points[i].x);
    Vec<double, D> place;
    for (int c = 0; c < D; ++c) place[c] = at.r[c].value();
    if (!law_.acts(place)) continue;
    PointForce<Real, D> f;
    f.on_r = law_.force(LinePoint<Real, D>{at.r, at.r_x, at.v}) * Real(as_length(i));
    PointMatrix<D> matrix = PointMatrix<D>::Zero();
    add_point_tangent(motion.beam, k, at, f, matrix);
    tangent.add_point(motion.beam, k, matrix);
  }
}

template class Ground<2>;
template class Ground<3>;

}  // namespace vlbeam
