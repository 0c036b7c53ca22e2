#pragma once

#include <optional>
#include <vector>

#include "mechanics/motion/system/beam_links.hpp"
#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/motion/system/prescribed_motion.hpp"

namespace vlbeam {

/// M of a beam: solves M a = f for accelerations, friction at joints included, or M v = p for velocities, and
/// multiplies by it. Elements at joints are those of CurrentBeam::fill_elements(), or fill_masses() where forces do not
/// count, at the coordinates `q`.
template <int D>
class BeamMass {
 public:
  using Vector = Vec<double, D>;
  using JointElements = typename CurrentBeam<D>::JointElements;

  /// Both must outlive this object.
  BeamMass(CurrentBeam<D>& beam, const BeamLinks<D>& links) : beam_(beam), links_(links) {}

  /// After each change of the beam.
  void adopt();

  /// What supports do that move: takes the inertia of the accelerations that they give from the forces. Nothing where
  /// none does.
  std::optional<PrescribedMotion<D>> prescribed(const JointElements& elements, const double* q, const double* rate,
                                                double* force, double t) const {
    if (!beam_.model().driven()) return std::nullopt;
    return std::make_optional<PrescribedMotion<D>>(beam_, end_inertia_, elements, q, rate, force, t);
  }
  JointMotion<D> joint_motion(std::size_t which, const double* q, const double* rate, double t) const;
  /// Solves M a = f in place, links apart; nothing is returned where there is no solution. `motions` holds an entry a
  /// joint.
  std::optional<JointPower> solve_joints(const JointElements& elements, const std::vector<JointMotion<D>>& motions,
                                         double* force);
  /// The same of the nodes of a beam without a joint; what moving supports do is in what it returns.
  std::optional<PrescribedMotion<D>> solve_without_joints(const double* q, const double* rate, double t,
                                                          double* force) const;

  /// Solves M v = p in place for the velocities v that a momentum p means at the coordinates `q`; false where the mass
  /// matrix is singular. Of a beam with a joint and without links, nodes outside `part` may be left out: p acts on none
  /// of them, and v is too small to count there.
  bool solve(const JointElements& elements, const double* q, double* p, const BeamPart& part = {});
  /// Adds what forces (or momenta) of links do to the accelerations (or velocities) `a` of a beam without them, so that
  /// dC/dq . a is as `wanted` of each link, or of a mass that is carried with its force as it is. Returns them,
  /// positive where they push nodes apart; nothing where the mass matrix is singular.
  std::optional<Eigen::VectorXd> press(const std::vector<BeamLink<D>>& links, const JointElements& elements,
                                       const double* q, const Eigen::VectorXd& wanted, double* a);
  /// Of what prescribes parts of the state: what it does as such forces change accelerations (or momenta velocities) by
  /// `change`.
  double work_of_prescribed(const std::vector<BeamLink<D>>& links, const Eigen::VectorXd& forces,
                            const JointElements& elements, const double* q, const double* rate,
                            const Eigen::VectorXd& change) const;
  /// Writes M times the velocities `rate`; of the nodes of a part, as if the beam ended there, `before` and `behind` of
  /// which are multiples of Pack::width.
  void multiply(const JointElements& elements, const double* q, const double* rate, double* out,
                const BeamPart& part = {}) const;

 private:
  /// Joints are tied to each other.
  bool couples() const { return beam_.unknowns() != nullptr && beam_.unknowns()->couples_joints(); }
  /// The joints are solved for as a chain.
  bool chained() const;
  std::optional<JointPower> solve_chain(const JointElements& elements, const std::vector<JointMotion<D>>& motions,
                                        double* force, const BeamPart& part = {});
  /// As if nothing rested against anything.
  bool solve_apart(const JointElements& elements, const double* q, double* p, const BeamPart& part = {});

  CurrentBeam<D>& beam_;
  const BeamLinks<D>& links_;
  JointChain<D> joint_chain_;                               ///< of several joints, or one that is guided
  typename PrescribedMotion<D>::EndInertia end_inertia_{};  ///< where supports move
  Eigen::VectorXd round_forces_;                            ///< of solve_joints(), with frames
  std::vector<double> round_marks_;                         ///< the same
};

extern template class BeamMass<2>;
extern template class BeamMass<3>;

}  // namespace vlbeam
