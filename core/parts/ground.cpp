#include "core/parts/ground.hpp"

namespace vlbeam {

template <int D>
Tally Ground<D>::add_force(const Motion<D>& motion, double* force) const {
  Tally power;
  add_line_force<D>(motion.beam, points_, law_, force,
                    [&](int /*element*/, const PointMotion<double, D>& at, const Vec<double, D>& f, double weight) {
                      const double given = law_.spring().push(law_.level - law_.up.dot(at.r)) * law_.up.dot(at.v);
                      power.loads += weight * given;
                      power.dissipated += weight * (given - f.dot(at.v));
                    });
  return power;
}

template <int D>
void Ground<D>::add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  for (int k = 0; k < motion.beam.mesh.elements(); ++k) {
    tangent.add_point(motion.beam, k, line_tangent<D>(motion.beam, k, points_, law_, by));
  }
}

template class Ground<2>;
template class Ground<3>;

}  // namespace vlbeam
