#pragma once

#include <array>
#include <functional>
#include <optional>

#include "mechanics/motion/system/beam_mass.hpp"

namespace vlbeam {

/// Velocities of a new mesh from the field of the old one, and momenta and energy as they were before.
template <int D>
class VelocityProjection {
 public:
  using Vector = Vec<double, D>;
  using JointElements = typename CurrentBeam<D>::JointElements;
  using EnergyGained = std::function<double()>;  ///< by what was written to y last [J]

  /// Rigid motions: translations, then rotations.
  static constexpr int rigid_modes = D == 2 ? 3 : 6;
  /// The axes in whose plane mode `mode` turns, the first towards the second.
  static std::array<int, 2> axes_of(int mode) {
    const int a = (mode - D + (D == 2 ? 0 : 1)) % D;
    return {a, (a + 1) % D};
  }

  /// Both must outlive this object.
  VelocityProjection(const CurrentBeam<D>& beam, BeamMass<D>& mass) : beam_(beam), mass_(mass) {}

  /// Replaces the rates in `y`, the state of the chain `after` that was made from `before`, by the projection of the
  /// old velocity field, which differs on its elements `first` to `last`: those of the nodes that the chain holds.
  void project(const ChainState<D>& before, const ChainState<D>& after, int first, int last, Eigen::VectorXd& y,
               double t);
  /// Linear and angular momentum of beam and mass, by the model's own points; of a part of it, as of
  /// BeamMass::multiply().
  Eigen::VectorXd momenta(const Eigen::VectorXd& y, double t, const BeamPart& part = {});
  /// Gives the rates in `y` these momenta, by the least change, and takes the energy that they have `gained`, by
  /// scaling the velocity fluctuation, which carries no momentum: as far as it has energy, and at most doubled.
  void conserve(const Eigen::VectorXd& momenta, const EnergyGained& gained, Eigen::VectorXd& y, double t);

 private:
  /// Writes the momentum by which the velocity field of `before` exceeds that of `after`, on elements `first` to
  /// `last`.
  void find_excess_momentum(const ChainState<D>& before, const ChainState<D>& after, int first, int last);
  /// Rates of the rigid motion `mode` at the positions `y`: translations, then rotations about the origin.
  void rigid_rates(int mode, const Eigen::VectorXd& y, Eigen::VectorXd& rigid) const;
  /// M phi of the rigid motions phi.
  Eigen::MatrixXd rigid_momenta(const JointElements& elements, const Eigen::VectorXd& y) const;
  /// Angular momentum beside that of points [kg m^2/s].
  Vec<double, 3> own_momentum(const Eigen::VectorXd& y) const {
    if (beam_.unknowns() == nullptr) return Vec<double, 3>::Zero();
    return beam_.unknowns()->momentum(y.data(), y.data() + beam_.coordinates());
  }
  /// conserve(), once, of the motion of the axis.
  void conserve_axis(const Eigen::VectorXd& momenta, const EnergyGained& gained, Eigen::VectorXd& y, double t);

  const CurrentBeam<D>& beam_;
  BeamMass<D>& mass_;
  Eigen::VectorXd momentum_;  ///< an array like q'
};

/// The same of a long beam with one joint that is free to move, by the velocities around it alone: momenta are what
/// they lack, and kinetic_energy() is that of a part, 1/2 v . M v [J]. Nothing where no room does it (rooms.cpp).
template <int D>
struct LocalConservation {
  using EnergyGained = typename VelocityProjection<D>::EnergyGained;
  double (*kinetic_energy)(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part,
                           const Eigen::VectorXd& y, double t);
  void (*conserve)(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part,
                   const Eigen::VectorXd& lacking, const EnergyGained& gained, Eigen::VectorXd& y, double t);
};
template <int D>
std::optional<LocalConservation<D>> local_conservation_of_rooms();

extern template class VelocityProjection<2>;
extern template class VelocityProjection<3>;

}  // namespace vlbeam
