#pragma once

#include <vector>

#include "core/beam/block_tridiagonal.hpp"
#include "core/dynamics/second_order.hpp"
#include "core/system/beam_system.hpp"
#include "core/system/conserving_step.hpp"
#include "core/tangent_weights.hpp"

namespace vlbeam {

/// A beam system as an implicit method sees it: residual M a - Q and its exact tangent. The tangent is block
/// tridiagonal in the nodes with a border; fixed elements contribute the second derivative of their strain energy, the
/// elements at joints the derivative of their whole residual (inertia, velocity terms and configurational force
/// included).
///
/// With eliminated constraints the coordinates are those of BeamSystem's state. With multipliers joints are cut: such a
/// node is there twice, behind each other, tied by 2 D constraints (where the beam is kinked there, by D and the
/// conditions on the slopes); supports are constraints too, and the reactions stand at the end of the coordinates. The
/// border then holds the joints' material coordinates, the positions of masses that have left, and the multipliers.
/// A kinked joint is always cut; with eliminated constraints only residuals, hence forces, are then to be had.
template <int D>
class ImplicitBeam final : public SecondOrderSystem {
 public:
  /// `system` must outlive this object; its events may change it at any time.
  explicit ImplicitBeam(BeamSystem<D>& system)
      : system_(system), conserving_step_(system), standing_{system.model().start, system.model().end} {}

  Eigen::Index coordinates() const override { return layout().coordinates(); }
  Eigen::Index multipliers() const override { return layout().multipliers; }
  std::vector<FieldRun> fields() const override;
  void expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const override;
  void contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const override;
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override;
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override;
  ConstraintResidual constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) const override;
  void constraint_rates(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                        Eigen::VectorXd& rates) const override;
  bool driven() const override { return system_.model().driven() || system_.nut_place(); }
  bool driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const override;
  Tallies tallies() const override { return system_.model().tallies(); }
  Tally supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t) override;
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                 const TangentWeights& by) override;
  void solve(Eigen::VectorXd& r) const override;
  /// Of what linearize() factored, where forces have a potential, without a sliding mass: the number of directions in
  /// which the energy falls. `zero` is what counts as no fall, over what a coordinate alone does.
  int negative_pivots(double zero) const { return tangent_.negative_pivots(zero); }
  void tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
               const TangentWeights& by, Eigen::MatrixXd& dense) override;
  Eigen::Index curved_constraints() const override { return condition_count(); }
  void add_curvature(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const override;
  double multiplier_unit() const override { return reference_mass_; }
  void follow(const SecondOrderSystem& other) override;
  void exchange(Memory& memory) override;
  double conserving_residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                             const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) override;
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;

  /// The tangent of a beam whose nodes travel, with weights `by`, dense and before supports: of position and slope of
  /// the nodes, and of angle and twist of the nodes, empty without spin. They do not couple.
  void travelling_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                          const TangentWeights& by, Eigen::MatrixXd& axis, Eigen::MatrixXd& angles);

  /// By the accelerations that belong to a state y at time t.
  OuterForces<D> forces(const Eigen::VectorXd& y, double t);
  /// Without accelerations.
  OuterForces<D> forces_at_rest(const Eigen::VectorXd& y, double t);

 private:
  static constexpr int B = node_size<D>;
  using Block = Eigen::Matrix<double, B, B>;
  using NodeVector = Eigen::Matrix<double, B, 1>;

  using DrivenPoints = std::vector<DrivenPoint<D>>;  ///< of the supports at start and end, and of the joints

  /// direction . (q of `node` - anchor - what its support prescribes) = 0, or, tied, direction . (q of `node` - q of
  /// the next node) = 0.
  struct Constraint {
    int node;
    NodeVector direction;
    NodeVector anchor;
    int end;  ///< of the beam, 0 or 1, whose support holds it; 2 + i: joint i; -1: nothing
    bool tied = false;
    bool twice = false;  ///< what it holds is there twice
    int slope = -1;      ///< component, in the frame of a support, of the slope that it holds

    double value(const double* q, const DrivenPoints& driven) const;
    double rate(const double* q, const double* v, const DrivenPoints& driven) const;
  };

  using JointSlopeConditions = SlopeConditions<D>;
  using Slopes = typename JointSlopeConditions::Slopes;

  /// What depends on the mesh.
  void refresh() const {
    if (revision_ != system_.revision()) rebuild();
  }
  void rebuild() const;
  /// Calls run(where it stands in the state, where here, how many) for the coordinates that both have, and
  /// second(node in the state, second copy here, slope behind it in the state or -1) for nodes that are there twice.
  template <class Run, class Second>
  void for_each_run(const Run& run, const Second& second) const;
  /// The supports as they stand at time t, and the constraints by them.
  void update_supports(double t) const;
  /// Slopes on the two sides of a joint; with one copy of its node they are the same.
  Slopes joint_slopes(std::size_t which, const double* q) const;
  /// The conditions on the slopes of a kinked joint.
  struct Conditions {
    std::size_t joint;     ///< of those on the beam
    int omitted_axis = 0;  ///< of tangent slopes in space
    JointSlopeConditions of = {};
  };
  /// Those at the coordinates q.
  const std::vector<Conditions>& slope_conditions(const double* q) const;
  /// The constraints of supports and of joints that are cut, and the conditions on slopes.
  void constrain(const std::vector<Conditions>& old_conditions) const;
  int condition_count() const {
    int count = 0;
    for (const Conditions& conditions : slope_conditions_) count += conditions.of.count();
    return count;
  }
  /// Where the multiplier of the first of them stands.
  Eigen::Index first_slope_multiplier() const { return first_contact_multiplier() - condition_count(); }
  /// Calls function(contact, first of two nodes next to each other, where its multiplier stands) for what rests against
  /// each other: a constraint with a multiplier, whatever supports are.
  template <class Function>
  void at_contacts(const Function& function) const {
    refresh();
    Eigen::Index multiplier = first_contact_multiplier();
    for (const auto& contact : contacts_) {
      int node = contact.behind;
      for (const JointPlace& place : places_) node += place.cut && contact.behind >= place.node ? 1 : 0;
      function(contact, node, multiplier++);
    }
  }
  Eigen::Index first_contact_multiplier() const { return coordinates() - static_cast<Eigen::Index>(contacts_.size()); }
  /// From the one to the other.
  Vec<double, D> apart(int node, const double* q) const { return position<D>(q, node + 1) - position<D>(q, node); }
  bool with_multipliers() const { return system_.model().constraints == Constraints::multipliers; }
  /// Where the coordinates of the joints stand here.
  const std::vector<JointPlace>& places() const {
    refresh();
    return places_;
  }
  /// Calls function.operator()<ends>().
  template <class Function>
  static void with_ends(MovingEnds ends, const Function& function) {
    switch (ends) {
      case MovingEnds::a:
        return function.template operator()<MovingEnds::a>();
      case MovingEnds::b:
        return function.template operator()<MovingEnds::b>();
      case MovingEnds::both:
        return function.template operator()<MovingEnds::both>();
    }
  }
  /// Calls function(which) for the joints on the beam whose material coordinate is prescribed: it has no equation.
  template <class Function>
  void at_guides(const Function& function) const {
    for (std::size_t i = 0; i < places().size(); ++i) {
      if (system_.guides(i)) function(i);
    }
  }
  /// Where all stands here: as in the state, but with second copies of nodes in the place of slopes behind joints, and
  /// with multipliers.
  const Layout<D>& layout() const {
    refresh();
    return layout_;
  }
  /// How many joints have their node twice.
  int cuts() const { return nodes() - system_.layout().nodes; }
  int nodes() const { return layout().nodes; }
  /// Where what follows the nodes stands: the joints' material coordinates, the masses that have left.
  Eigen::Index after_nodes() const { return layout().mark(); }
  /// Where the angles of a beam that spins stand.
  Eigen::Index angles() const { return layout().angle(); }
  ChainView<D> view(const double* q, const double* v) const {
    return {system_.mesh(), system_.model().transport, q, v, places(), system_.marks()};
  }
  ChainView<D> view(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const { return view(q.data(), v.data()); }
  /// The first copy of a joint's node.
  int first_copy(std::size_t which) const { return places()[which].node + copies_before(which); }
  /// Of an array like q: what stands at the place of a joint, in all copies of its node.
  Vec<double, D> on_joint_node(std::size_t which, const Eigen::VectorXd& q) const {
    Vec<double, D> sum = position<D>(q.data(), first_copy(which));
    if (places()[which].cut) sum += position<D>(q.data(), first_copy(which) + 1);
    return sum;
  }
  int copies_before(std::size_t which) const {
    int count = 0;
    for (std::size_t i = 0; i < which; ++i) count += places()[i].cut ? 1 : 0;
    return count;
  }
  /// Calls function(span, nodes that are there twice before it) for the runs of fixed elements.
  template <class Function>
  void at_spans(const Function& function) const {
    function(system_.left(), 0);
    function(system_.right(), cuts());
    for (const SpanBetween<D>& span : system_.between()) {
      function(span.span(), copies_before(static_cast<std::size_t>(system_.joints_before(span))));
    }
  }
  /// Residual without constraints.
  double free_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                       Eigen::VectorXd& r) const;
  /// The tangent before constraints and factorization.
  void assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                const TangentWeights& by);
  template <class Matrix>
  void add_element(int node, const Matrix& matrix, const std::array<int, 2>& marks = {-1, -1});
  void add_elements(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                    const TangentWeights& by);
  /// Those of a beam whose nodes travel: the angles couple to nothing else.
  void add_travelling_elements(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                               const TangentWeights& by);
  void add_frictions(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                     const TangentWeights& by);
  /// Sets what supports fix to zero, in their frames.
  void project(double* nodes) const;
  void constrain_tangent();
  /// Rows and columns of the constraints, times `scale`, and what their forces add to the tangent.
  void add_constraints(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double scale);
  void add_contacts(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double scale);
  /// Of a joint at which the beam pulls by `pull` [N]; all that acts on the nodes is in the tangent.
  void add_friction_tangent(std::size_t which, const Vec<double, D>& pull, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const TangentWeights& by);
  /// What the thread does to the angles as it pushes the nut of these coordinates [N].
  Eigen::VectorXd nut_torque(std::size_t which, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double push) const;
  /// Takes the nut's x out of the tangent, with `size` in its place.
  void take_nut(std::size_t which, double size);
  /// Completes it, once all else is factored.
  void factor_nut(std::size_t which, const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                  double t);
  void add_tallies(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy);
  void rhs_difference(const Eigen::VectorXd& y, double t, Eigen::Index k, double size, Eigen::VectorXd& result);
  /// What moving supports change of the Jacobian.
  void add_drive(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt);
  double element_length() const;  ///< mean of the mesh [m]
  double wave_time() const;       ///< of an axial wave through such an element [s]
  template <class Function>
  void at_end_nodes(const Function& function) const;
  const DrivenPoints& driven_points(double t) const;
  /// The nodes at the ends, and those at joints that are held.
  template <class Function>
  void at_held_nodes(const Function& function) const;

  BeamSystem<D>& system_;
  ConservingStep<D> conserving_step_;
  mutable std::size_t revision_ = static_cast<std::size_t>(-1);
  mutable std::array<Support<D>, 2> standing_;  ///< the supports, at the time that was looked at last
  mutable DrivenPoints driven_points_;          ///< of that time
  mutable Layout<D> layout_;
  mutable std::vector<JointPlace> places_;  ///< of the joints in these coordinates
  mutable std::vector<Constraint> constraints_;
  mutable std::vector<Conditions> slope_conditions_;               ///< behind them
  mutable std::vector<typename BeamSystem<D>::Contact> contacts_;  ///< behind those
  mutable double reference_mass_ = 1;                              ///< [kg], makes an acceleration of a multiplier
  double constraint_scale_ = 1;  ///< of the constraints' equations, that of the last tangent
  BorderedBlockTridiagonal<B> tangent_;
  SpinTangent spin_tangent_;
  /// A nut moves by what the angles do, dx = g . dq + off, and what acts on it turns them by g: with all else solved
  /// for, they have a tangent of their own and two dyads.
  struct NutTangent {
    double own = 0;               ///< of the force on x, by x
    Eigen::VectorXd row, column;  ///< of it by all else but the angles; what of that moves against x
    Nut::Thread thread;
    Eigen::VectorXd torque, by_x;  ///< on the angles that are free: g, and what dx makes of it
    Eigen::Matrix<double, Eigen::Dynamic, 2> answer;
    Eigen::Matrix2d inverse;
  };
  NutTangent nut_;
  Eigen::VectorXd y_, dydt_, free_;
  Eigen::VectorXd a_, column_, weightless_;  // of the Jacobian
  Eigen::MatrixXd stiffness_, damping_;
};

extern template class ImplicitBeam<2>;
extern template class ImplicitBeam<3>;

}  // namespace vlbeam
