#pragma once

#include <optional>
#include <vector>

#include "core/geometry/const_vector.hpp"
#include "mechanics/motion/system/beam_mass.hpp"
#include "mechanics/motion/system/event_map.hpp"

namespace vlbeam {

/// The equations of motion of a beam between two events in minimal coordinates, as explicit methods take them:
/// y' = f(t, y), with M a = Q solved for the accelerations.
template <int D>
class Accelerations {
 public:
  using Vector = Vec<double, D>;
  using JointElements = typename CurrentBeam<D>::JointElements;

  /// All must outlive this object.
  Accelerations(CurrentBeam<D>& beam, const BeamLinks<D>& links, BeamMass<D>& mass)
      : beam_(beam), links_(links), mass_(mass) {
    if (beam.prescribed_mesh() != nullptr) of_mesh_ = beam.prescribed_mesh()->new_equations(beam);
  }

  CurrentBeam<D>& beam() const { return beam_; }
  const BeamLinks<D>& links() const { return links_; }
  const BeamMass<D>& mass() const { return mass_; }
  /// The beam before its last event.
  EventMap<D>& last_event() { return last_event_; }

  /// Writes y' at (y, t); not a number where the mass matrix is singular or nodes tangle.
  void rates(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t);
  /// Writes the accelerations at q and v, of each as many as the beam has coordinates, at the start of `a`, which has
  /// its size; where there are none all of it becomes not a number.
  void accelerations(const ConstVector& q, const ConstVector& v, double t, Eigen::VectorXd& a);
  /// Forces along links, as evaluated last: positive where they push [N].
  const Eigen::VectorXd& link_forces() const { return link_forces_; }
  /// Those of the masses that the beam carries, along their directions [N].
  const Eigen::VectorXd& carried_forces() const { return carried_forces_; }
  /// The same at a state.
  Eigen::VectorXd forces_of_links(const Eigen::VectorXd& y, double t) const;
  /// Generalized force of the support that holds a loose mass, on its coordinate [N].
  double contact_force(const Eigen::VectorXd& y, double t) const;

  /// Evaluations of the equations, as accelerations or as a residual.
  std::size_t evaluations() const { return evaluations_; }
  void count_evaluation() { ++evaluations_; }
  void set_evaluations(std::size_t count) { evaluations_ = count; }
  /// After each change of the beam.
  void adopt();

 private:
  /// Imposes what is prescribed at time t on what imposed_ holds.
  void impose(double t);
  /// Writes the accelerations; returns powers, nothing where there is no solution.
  std::optional<EnergyBalance> solve(const double* q, const double* rate, double t, double* a);
  // Forces in `a` become accelerations; `pull` is what moving supports do.
  bool solve_prescribed(const double* q, const double* rate, double t, double* a,
                        std::optional<PrescribedMotion<D>>& pull);
  bool solve_at_joints(const double* q, const double* rate, double t, double* a,
                       std::optional<PrescribedMotion<D>>& pull, EnergyBalance& power);
  bool solve_without_joints(const double* q, const double* rate, double t, double* a,
                            std::optional<PrescribedMotion<D>>& pull, EnergyBalance& power);
  /// What links do to the accelerations.
  bool press(const double* q, const double* rate, double* a, EnergyBalance& power);
  /// What acts on the coordinates but for Unknowns, and its power but for what accelerations tell.
  EnergyBalance add_forces(const double* q, const double* rate, double t, double* force, JointElements& elements) const;

  CurrentBeam<D>& beam_;
  const BeamLinks<D>& links_;
  BeamMass<D>& mass_;
  EventMap<D> last_event_;
  std::unique_ptr<MeshEquations<D>> of_mesh_;
  JointElements elements_;               ///< of rates()
  std::vector<JointMotion<D>> motions_;  ///< the same
  Eigen::VectorXd imposed_;              ///< coordinates and velocities
  Eigen::VectorXd link_forces_, carried_forces_;
  std::vector<BeamLink<D>> pressing_;
  std::size_t evaluations_ = 0;
};

extern template class Accelerations<2>;
extern template class Accelerations<3>;

}  // namespace vlbeam
