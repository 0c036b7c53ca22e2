#pragma once

#include "mechanics/motion/system/velocity_transfer.hpp"

namespace vlbeam {

/// Gives the velocities in `y` around the only joint of a long beam the momenta that they lack (rigid_modes of them:
/// linear, then angular about the origin), and takes the energy that they have `gained`, by scaling their fluctuation:
/// what they are apart from a rigid motion, and less towards the ends of `part`, whose nodes stay as they are. The
/// joint must be free to move. As VelocityProjection::restore() does it to the whole beam, as far as the fluctuation
/// has energy, and at most doubled.
template <int D>
void restore_beside_joint(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part,
                          const Eigen::VectorXd& lacking, const typename VelocityProjection<D>::EnergyGained& gained,
                          Eigen::VectorXd& y, double t);

/// 1/2 v . M v of a part of a beam [J].
template <int D>
double kinetic_energy(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part,
                      const Eigen::VectorXd& y, double t);

}  // namespace vlbeam
