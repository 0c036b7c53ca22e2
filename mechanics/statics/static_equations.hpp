#pragma once

#include "mechanics/motion/joint/kinks.hpp"
#include "mechanics/motion/system/equations.hpp"
#include "mechanics/motion/system/link_constraints.hpp"
#include "mechanics/statics/free_tension.hpp"

namespace vlbeam {

/// The equilibrium of a beam system, r(u, f) = 0 at the load factor f, and its exact tangent.
/// The unknowns u are the coordinates of the system's state and, behind them, one multiplier [N m] for each condition
/// on the slopes of a kinked joint and for each link, whose condition counts over the beam's length. In them r is the
/// derivative of a potential energy, where forces have one, and the tangent symmetric: block tridiagonal in the nodes,
/// with the joints' material coordinates, the slopes behind them and the multipliers as its border. What supports,
/// rings, sleeves or guides hold is eliminated.
template <int D>
class StaticEquations {
 public:
  /// `system` must outlive this object; its events may change it at any time.
  explicit StaticEquations(BeamSystem<D>& system)
      : system_(system), equations_(system), links_(system.links()), length_(system.mesh().length()) {
    tangent_.solve_pivots();
  }

  /// Whether a joint's material coordinate stays what it is; that of one which is guided always does.
  bool holds(std::size_t which) const { return held_ || system_.guides(which); }
  /// Whether joints that may be free are held.
  bool holds_joints() const { return system_.has_joint() && held_; }
  void hold_joints(bool held) { held_ = held; }
  /// Where joints are held on the beam the tension may jump, and with it the stretch: the condition that it does not is
  /// then suspended, unless it is to be kept.
  void keep_conditions(bool keep) { keep_conditions_ = keep; }

  Eigen::Index size() const { return system_.coordinates() + conditions(); }
  /// Where a joint's material coordinate stands among the unknowns.
  Eigen::Index mark(std::size_t which = 0) const { return system_.places()[which].mark; }
  int conditions() const { return kinks().count() + static_cast<int>(links().count()); }
  /// Of links, of the multipliers behind the coordinates in u [N]: see OuterForces.
  Eigen::VectorXd link_forces(const Eigen::VectorXd& multipliers) const {
    return -multipliers.tail(links_.count()) / length_;
  }
  /// What turns where the multipliers of parallel slopes in space change their meaning: starts them again.
  void choose_conditions(Eigen::VectorXd& u);

  /// r in all directions, that of what is held included: it is what holds it.
  void reactions(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const;
  /// The same without what is held.
  void residual(const Eigen::VectorXd& u, double factor, Eigen::VectorXd& r) const;
  /// Factors the tangent, plus `by_a` times the mass matrix; false where it is singular. With `forces` it is that of
  /// the iteration in which they are free.
  bool linearize(const Eigen::VectorXd& u, double factor, double by_a, const FreeTension<D>* forces = nullptr);
  void solve(Eigen::VectorXd& r) const {
    const Eigen::VectorXd gaps = r.tail(links_.count());
    tangent_.solve(r.data());
    r.tail(links_.count()) += stiffening() * gaps;
  }
  /// Of what linearize() factored: the number of directions, within the conditions on the slopes, in which the energy
  /// falls. `zero` is what counts as no fall, over what a coordinate alone does.
  int negative_pivots(double zero) const {
    return tangent_.negative_pivots(zero) - kinks().active() - static_cast<int>(links_.count());
  }

  /// The tangent of the coordinates alone, nothing eliminated, plus `by_a` times the mass matrix.
  Eigen::MatrixXd dense(const Eigen::VectorXd& u, double factor, double by_a);
  /// Columns, orthonormal: the directions in which the coordinates may move.
  Eigen::MatrixXd directions(const Eigen::VectorXd& u) const;

 private:
  static constexpr int B = node_size<D>;
  /// Its multipliers are 0 then.
  bool suspended(std::size_t which) const {
    return holds(which) && !keep_conditions_ && system_.joint(which).law.slopes == JointSlopes::equal_stretch;
  }
  /// The conditions that are not met by what holds slopes, as they are now.
  Kinks<D>& kinks() const;
  /// The links, as they are now.
  const LinkConstraints<D>& links() const {
    refresh();
    return links_;
  }
  void refresh() const;
  /// What holds material points makes the tangent stiff, too [N m]: a beam that nothing else holds would have a
  /// singular one without its multipliers. The equations, and so their solution, are the same.
  double stiffening() const { return system_.model().section.stiffness.EA * length_; }
  void assemble(const Eigen::VectorXd& u, double factor, double by_a);
  void prepare() const { zero_.setZero(size()); }

  BeamSystem<D>& system_;
  Equations<D> equations_;
  bool held_ = true, keep_conditions_ = false;
  mutable std::size_t revision_ = static_cast<std::size_t>(-1);
  mutable Kinks<D> kinks_;
  mutable LinkConstraints<D> links_;
  double length_;  ///< of the beam [m]
  BeamMatrix<D> tangent_;
  mutable Eigen::VectorXd zero_;  ///< nothing moves
};

extern template class StaticEquations<2>;
extern template class StaticEquations<3>;

}  // namespace vlbeam
