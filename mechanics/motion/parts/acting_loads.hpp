#pragma once

#include "core/element/moving_points.hpp"
#include "mechanics/motion/parts/loads.hpp"
#include "mechanics/motion/parts/material_point.hpp"
#include "mechanics/motion/parts/part.hpp"

namespace vlbeam {

/// Conjugate to the slope r_x, what a moment M does: M times the derivative of the slope's angle.
template <class Real>
Vec<Real, 2> turning_force(double moment, const Vec<Real, 2>& r_x) {
  const Real share = Real(moment) / r_x.squaredNorm();
  return {-share * r_x[1], share * r_x[0]};
}

/// Tangent of minus a force on the material point x of element k, whose ends joints may be, by the element's
/// coordinates: of a constant force, and of one that turns with the slope there, by `turning`.
template <int D>
PointMatrix<D> constant_force_tangent(const ChainView<D>& beam, int k, double x, const Vec<double, D>& force,
                                      const Eigen::Matrix<double, D, D>& turning = Eigen::Matrix<double, D, D>::Zero());

/// The concentrated ones as a part of the equations; `loads` must outlive it.
template <int D>
class ActingLoads final : public Part<D> {
 public:
  explicit ActingLoads(const Loads<D>& loads) : loads_(loads) {}
  EnergyBalance add_force(const Motion<D>& motion, double* force) const override {
    return {.loads = loads_.add_forces(motion.beam, motion.t, force)};
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    loads_.add_tangent(motion.beam, motion.t, by,
                       [&](int k, const PointMatrix<D>& matrix) { tangent.add_point(motion.beam, k, matrix); });
  }

 private:
  const Loads<D>& loads_;
};

extern template class ActingLoads<2>;
extern template class ActingLoads<3>;

/// Rate of the integral of r dx over an element [m^2/s], by the points of its table: as they move along the beam, or,
/// for the virtual work, at fixed material points. The power of an even force over the force.
template <int D>
Vec<double, D> swept(const MovingKinematics<double, D>& element, const ShapeTabulation& table, bool reshaped,
                     Formulation formulation);

}  // namespace vlbeam
