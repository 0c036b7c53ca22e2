#pragma once

#include <array>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/system/accelerations.hpp"
#include "mechanics/motion/system/equations.hpp"
#include "mechanics/motion/system/kink_constraints.hpp"
#include "mechanics/motion/system/link_constraints.hpp"
#include "mechanics/motion/system/observation.hpp"
#include "mechanics/motion/system/support_constraints.hpp"
#include "mechanics/motion/system/turning.hpp"
#include "mechanics/time/assign.hpp"
#include "mechanics/time/constrained_system.hpp"

namespace vlbeam {

/// A beam as an implicit method sees it: residual M a - Q and its exact tangent. The tangent is block
/// tridiagonal in the nodes with a border; fixed elements contribute the second derivative of their strain energy, the
/// elements at joints the derivative of their whole residual (inertia, velocity terms and configurational force
/// included).
///
/// Its coordinates are those of CurrentBeam's state, and behind them multipliers: with Constraints::multipliers those
/// of supports, whose reactions they are; always those of conditions on the slopes of kinked joints, and of links:
/// blocks, and what rests against each other. The border of the tangent holds the joints' material coordinates, the
/// slopes behind kinks, the positions of masses that have left, and the multipliers.
template <int D>
class ImplicitBeam final : public ConstrainedSystem {
 public:
  /// `of` must outlive this object; events may change the beam at any time.
  explicit ImplicitBeam(Accelerations<D>& of);

  Accelerations<D>& accelerations() const { return accelerations_; }
  Eigen::Index coordinates() const override { return dofs().coordinates(); }
  Eigen::Index multipliers() const override { return dofs().multipliers; }
  std::vector<FieldRun> fields() const override;
  void expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const override;
  void contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const override {
    const Eigen::Index own = beam_.coordinates();
    assign_both_to(y.head(own), q.head(own), y.segment(own, own), v.head(own));
  }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override {
    find_acceleration(q, v, t, a);
  }
  bool carry(const Eigen::VectorXd& before, double t, Eigen::VectorXd& a, Eigen::VectorXd& memory) const override;
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override;
  /// Of a beam without frames, and whose joints are tied to nothing, at the time of the last residual.
  bool inertia(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double t, Eigen::VectorXd& r) override;
  ConstraintResidual constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) const override;
  void constraint_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                        Eigen::VectorXd& rates) const override;
  bool driven() const override { return beam_.model().driven() || tied(); }
  bool driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const override;
  double turning(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const override {
    return turning_of(beam_, q.data(), v.data());
  }
  BalanceEntries balance() const override { return beam_.model().balance(); }
  EnergyBalance supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                               double t) override;
  std::optional<double> power_lost_between(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                           const Eigen::VectorXd& a0, const Eigen::VectorXd& a1, double h,
                                           double t) override;
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                 const TangentWeights& by) override;
  void solve(Eigen::VectorXd& r) const override;
  void tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
               const TangentWeights& by, Eigen::MatrixXd& dense) override;
  void add_curvature(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const override;
  double multiplier_unit() const override { return reference_mass_; }
  void follow(const SecondOrderSystem& other) override;
  void exchange(Archive& memory) override;
  /// Ode::jacobian().
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt);

  /// The tangent with weights `by`, dense and before supports: of position and slope of the nodes, and of Unknowns that
  /// do not couple with them, empty without.
  void tangents_apart(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                      const TangentWeights& by, Eigen::MatrixXd& axis, Eigen::MatrixXd& angles);

  /// By the accelerations that belong to a state y at time t.
  OuterForces<D> forces(const Eigen::VectorXd& y, double t);
  /// Without accelerations, with the forces of its links.
  OuterForces<D> forces_at_rest(const Eigen::VectorXd& y, double t, const Eigen::VectorXd& of_links);

 private:
  static constexpr int B = node_size<D>;
  using Block = Eigen::Matrix<double, B, B>;
  /// What depends on the mesh.
  void refresh() const {
    if (revision_ != beam_.revision()) rebuild();
  }
  void rebuild() const;
  /// All constraints, in the order of their multipliers.
  std::array<ConstraintSet<D>*, 3> constraints() const { return {&supports_, &kinks_, &links_}; }
  /// Calls function(set, where its multipliers begin) for each set that has any constraints.
  template <class Function>
  void at_constraints(const Function& function) const {
    Eigen::Index first = dofs().multiplier();
    for (ConstraintSet<D>* set : constraints()) {
      if (set->count() > 0) function(*set, first);
      first += set->count();
    }
  }
  Eigen::Index first_link_multiplier() const { return coordinates() - links_.count(); }
  /// A joint's material coordinate follows from other unknowns.
  bool tied() const { return of_unknowns_ && of_unknowns_->ties(); }
  bool with_multipliers() const { return beam_.model().constraints == Constraints::multipliers; }
  const std::vector<JointPlace>& places() const { return beam_.places(); }
  const Supports<D>& supports() const { return beam_.supports(); }
  /// Calls function(which) for the joints on the beam whose material coordinate is prescribed: it has no equation.
  template <class Function>
  void at_guides(const Function& function) const {
    for (std::size_t i = 0; i < places().size(); ++i) {
      if (beam_.guides(i)) function(i);
    }
  }
  /// That of the state, with multipliers.
  const DofMap<D>& dofs() const {
    refresh();
    return dofs_;
  }
  int nodes() const { return dofs().nodes; }
  /// Where what follows the nodes stands: the joints' material coordinates, the masses that have left.
  Eigen::Index after_nodes() const { return dofs().mark(); }
  /// Where Unknowns, or the angles of frames, stand.
  Eigen::Index angles() const { return dofs().angle(); }
  /// acceleration(), of parts of a state, too.
  void find_acceleration(const ConstVector& q, const ConstVector& v, double t, Eigen::VectorXd& a);
  /// Residual without constraints.
  double free_residual(const ConstVector& q, const ConstVector& v, const ConstVector& a, double t, Eigen::VectorXd& r,
                       typename Equations<D>::Extent extent = Equations<D>::Extent::whole) const;
  void add_constraints(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double t, double scale);
  void add_tallies(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy);
  void rhs_difference(const Eigen::VectorXd& y, double t, Eigen::Index k, double size, Eigen::VectorXd& result);
  /// What moving supports change of the Jacobian.
  void add_drive(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt);
  double element_length() const;  ///< mean of the mesh [m]
  double wave_time() const;       ///< of an axial wave through such an element [s]
  Accelerations<D>& accelerations_;
  CurrentBeam<D>& beam_;
  Equations<D> equations_;
  mutable std::size_t revision_ = static_cast<std::size_t>(-1);
  mutable DofMap<D> dofs_;
  mutable SupportConstraints<D> supports_;
  mutable KinkConstraints<D> kinks_;
  mutable LinkConstraints<D> links_;
  std::unique_ptr<UnknownsTangent<D>> of_unknowns_;
  mutable Eigen::VectorXd values_;     ///< of constraints
  mutable double reference_mass_ = 1;  ///< [kg], makes an acceleration of a multiplier
  double constraint_scale_ = 1;        ///< of the constraints' equations, that of the last tangent
  BeamMatrix<D> tangent_;
  Eigen::VectorXd middle_q_, middle_v_;  ///< of power_lost_between()
  Eigen::VectorXd free_;
  typename CurrentBeam<D>::JointElements elements_;  ///< of inertia()
  Eigen::VectorXd a_, column_, weightless_;          // of the Jacobian; the first of power_lost_between(), too
  Eigen::MatrixXd stiffness_, damping_;
};

extern template class ImplicitBeam<2>;
extern template class ImplicitBeam<3>;

}  // namespace vlbeam
