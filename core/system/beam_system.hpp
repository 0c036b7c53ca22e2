#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/beam/support_motion.hpp"
#include "core/dynamics/integrate.hpp"
#include "core/dynamics/tallies.hpp"
#include "core/geometry/axis.hpp"
#include "core/joint/at_support.hpp"
#include "core/joint/rider.hpp"
#include "core/length_control/event_type.hpp"
#include "core/length_control/length_control.hpp"
#include "core/parts/loads.hpp"
#include "core/parts/point_masses.hpp"
#include "core/parts/spin.hpp"
#include "core/system/constraints.hpp"
#include "core/system/observation.hpp"
#include "core/system/ramp_work.hpp"

namespace vlbeam {

/// What a beam system is made of and which choices its equations follow.
template <int D>
struct BeamModel {
  BeamSection section;
  Formulation formulation = Formulation::variational;
  WeightTransport transport = WeightTransport::frozen;
  int quadrature_points = 5;
  Vec<double, D> gravity = Vec<double, D>::Zero();  ///< [m/s^2]
  double gravity_ramp = 0;                          ///< T_r [s], 0 for gravity that is there from the start
  bool time_is_load_factor = false;                 ///< gravity is t times what it says, as loads may be: statics
  Support<D> start, end;
  SupportMotion<D> start_motion, end_motion;
  bool start_releases = false, end_releases = false;  ///< the sliding mass may leave the beam there
  Loads<D> loads;
  std::optional<SpinModel> spin;  ///< without it there is no angle at all; goes with no sliding mass
  PointMasses<D> masses;
  std::optional<SlidingJoint> joint;
  /// What holds the place of the joint's node in space: of a ring, a pin; of a sleeve, a clamp of the direction.
  std::optional<Support<D>> joint_support;
  double separation_distance = 0;  ///< [m]
  Impact at_support;               ///< where the mass may not leave
  LengthControl length_control;
  Constraints constraints = Constraints::eliminated;
  /// What a moving node follows in the rest shape, by arc length, where the chain's `rest` has the nodes; null for a
  /// straight, unstrained rest shape.
  std::shared_ptr<const Axis<D>> rest;

  /// Whether energy is lost.
  bool dissipates() const {
    return section.damped() || (joint && joint->friction) || (spin && spin->section.damping != 0);
  }
  /// Whether supports move, and so do work.
  bool driven() const { return start_motion || end_motion; }
  /// The energies that the state counts.
  Tallies tallies() const {
    return {dissipates(), loads.present() || (spin && spin->torques.present()), spin && !spin->drives.empty(),
            driven()};
  }
};

/// What happened to a beam system at an event.
template <int D>
struct EventRecord {
  double t;
  EventType type;
  double joint_position;
  MergedWeights merged;
  Energy jump;           ///< by a 25-point rule
  double discrete_jump;  ///< of the total, by the model's own rule
  bool restored;         ///< false: energy and momenta were to be as before, and the energy is not
  Eigen::VectorXd
      momentum_jump;  ///< linear, then angular about the origin, by the model's own rule; not of a separation
  ChainState<D> before, after;
  double seconds;  ///< wall time spent
};

template <int D>
class ImplicitBeam;

/// One beam with, possibly, a mass that slides on it and may leave it: the equations of motion in minimal coordinates.
/// State y = (q, q', tallies): q holds the nodes (position and slope each) and then the angles of a section that spins,
/// or x_i of the joint and, where the joint is kinked, the slope behind it, or x of a mass that rides inside an end
/// element, or the free mass's position once it has left; the tallies are those of BeamModel::tallies(). What a support
/// drives stands in the state too, but is read from its motion, wherever it counts.
template <int D>
class BeamSystem final : public EventedOde {
 public:
  using Vector = Vec<double, D>;

  /// `chain` is the initial state, but for the velocity of driven supports; its joint must be an interior node where
  /// the model has a sliding mass. Throws InvalidInput for moving supports with conservative velocities at events.
  BeamSystem(const BeamModel<D>& model, const ChainState<D>& chain);
  ~BeamSystem() override;

  Eigen::Index size() const override { return 2 * coordinates_ + model_.tallies().count(); }
  std::vector<FieldRun> fields() const override;
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override;
  Guards guards(const Eigen::VectorXd& y, double t) const override;
  void handle_event(int index, Eigen::VectorXd& y, double t) override;
  void sample(const Eigen::VectorXd& y, double t) override;
  bool proceed(const Eigen::VectorXd& y, double t) override {
    if (ramp_.due(t)) ramp_.advance(t, moment(y, t));
    return !on_step || on_step(t);
  }

  std::function<void(const Eigen::VectorXd& y, double t)> on_sample;
  std::function<void(const EventRecord<D>&)> on_event;
  std::function<bool(double t)> on_step;

  const BeamModel<D>& model() const { return model_; }
  /// Gravity at time t [m/s^2].
  Vector gravity(double t) const {
    return model_.gravity * (model_.time_is_load_factor ? t : smooth_ramp(t, model_.gravity_ramp).value);
  }
  /// What acts on the beam's mass as gravity does: that, and the load along the beam [m/s^2].
  Vector beam_gravity(double t) const {
    Vector sum = gravity(t);
    if (model_.loads.line_force) sum += model_.loads.line_force(t) / model_.section.rhoA;
    return sum;
  }
  /// The beam with coordinates q and their rates, arrays like those of the state.
  ChainView<D> view(const double* q, const double* rate) const {
    return {mesh_, model_.transport, q, rate, joint_, nodal_, kinked() ? behind_ : -1};
  }
  /// Power of the load along the beam [W].
  double line_power(const ChainView<D>& beam, double t) const;
  Eigen::VectorXd initial_state() const { return initial_; }
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override {
    second_order()->jacobian(y, t, dfdy, dfdt);
  }
  /// A view of the equations for whoever needs one for a moment: another call may factor another matrix in it.
  SecondOrderSystem* second_order();
  std::unique_ptr<SecondOrderSystem> new_second_order() override;
  /// By the accelerations that belong to the state.
  OuterForces<D> forces(const Eigen::VectorXd& y, double t);
  /// Without accelerations, at a state at rest.
  OuterForces<D> forces_at_rest(const Eigen::VectorXd& y, double t);
  /// Evaluations of the equations, as accelerations or as a residual.
  std::size_t rhs_evaluations() const { return rhs_evaluations_; }
  void count_evaluation() { ++rhs_evaluations_; }

  /// Mesh and motion at state y.
  ChainState<D> chain(const Eigen::VectorXd& y) const;
  bool has_joint() const { return joint_ != no_joint; }
  /// A mass inside the first or the last element.
  struct Riding {
    int element;
    bool held;
    double end;  ///< material coordinate of the beam's end there [m]
    RiderElement curve;
    RiderMass<D> mass;

    bool at_end() const { return element > 0; }
  };
  /// Empty unless the mass rides inside an element.
  const std::optional<Riding>& rider() const { return rider_; }
  /// What holds the joint's node, or null.
  const Support<D>* held_joint() const {
    return has_joint() && model_.joint_support ? &*model_.joint_support : nullptr;
  }
  /// The mass has left the beam, and is in the state.
  bool has_free_mass() const { return free_mass_; }
  /// The mass is on the beam.
  bool mass_on_beam() const { return has_joint() || rider_; }
  /// Motion of the rider, of arrays like q and q' with x behind the nodes.
  RiderMotion<double, D> rider_motion(const double* q, const double* rate) const {
    const bool held = rider_->held;
    return vlbeam::rider_motion<double, D>(rider_->curve, element_nodes<D>(q, rider_->element),
                                           element_nodes<D>(rate, rider_->element), held ? rider_->end : q[nodal_],
                                           held ? 0 : rate[nodal_]);
  }
  int joint() const { return joint_; }
  /// How the section turns; null if it does not. Its angles stand behind the nodes.
  Spin* spin() { return spin_ ? &*spin_ : nullptr; }
  const Spin* spin() const { return spin_ ? &*spin_ : nullptr; }
  /// Where the angle of a node stands among the coordinates.
  Eigen::Index angle(int node) const { return nodal_ + spin_->angle(node); }
  /// Where the concentrated loads are.
  std::vector<Vector> load_places(const Eigen::VectorXd& y, double t) const {
    return model_.loads.places(view(y.data(), y.data() + coordinates_), t);
  }
  /// The beam has two slopes at the joint.
  bool kinked() const { return has_joint() && model_.joint->kinked(); }
  /// Slopes at the joint, before and behind it, of an array of coordinates or rates.
  Eigen::Matrix<double, 2 * D, 1> joint_slopes(const double* q) const {
    Eigen::Matrix<double, 2 * D, 1> slopes;
    slopes << slope<D>(q, joint_), Eigen::Map<const Vector>(q + behind_);
    return slopes;
  }
  /// How far the slopes at the joint are from their conditions [-], [1/s].
  ConstraintResidual slope_residual(const Eigen::VectorXd& y) const;
  const Mesh& mesh() const { return mesh_; }
  Eigen::Index coordinates() const { return coordinates_; }
  /// Counts the meshes there have been.
  std::size_t revision() const { return revision_; }
  /// Shape functions of the two elements at the joint.
  const ShapeTabulation& left_table() const { return left_table_; }
  const ShapeTabulation& right_table() const { return right_table_; }
  MovingLaw<D> moving_law(double t) const {
    return {model_.section, model_.formulation, model_.transport, beam_gravity(t)};
  }
  /// The rest shape of the two elements at the joint, which is at x; nothing if it is straight.
  struct JointRest {
    RestElement<D> left, right;
  };
  std::optional<JointRest> joint_rest(double x) const;
  /// The fixed elements before and behind the joint, or the middle of the beam.
  const Span<D>& left() const { return *left_; }
  const Span<D>& right() const { return *right_; }
  /// What the supports hold: position and slope of the first and of the last node at the start.
  const std::array<Eigen::Matrix<double, node_size<D>, 1>, 2>& anchors() const { return anchors_; }
  /// Where the joint's node was at the start: what a ring or a sleeve holds.
  const Eigen::Matrix<double, node_size<D>, 1>& joint_anchor() const { return joint_anchor_; }
  /// What the supports at start and end prescribe at time t.
  std::array<DrivenPoint<D>, 2> driven_points(double t) const {
    return {model_.start_motion.at(model_.start, t), model_.end_motion.at(model_.end, t)};
  }
  /// Puts what the supports drive where it is at time t.
  void impose(Eigen::VectorXd& y, double t) const;
  /// Where the sliding mass is, on the beam or off it, and how it moves.
  struct MassMotion {
    Vector r, v;
  };
  /// Empty without one.
  std::optional<MassMotion> mass_motion(const Eigen::VectorXd& y) const;
  /// Energies, momenta and length, summed with `points` Gauss points an element; strains only where they are asked for.
  Observation<D> observe(const Eigen::VectorXd& y, double t, int points, bool strains = false) const;

 private:
  struct JointElements {
    MovingEquations<double, D> left, right;
  };

  /// What moving supports do to the equations of motion.
  class Pull;
  /// Where the four nodal vectors of element k are in an array like q.
  std::array<double*, 4> vectors_of(double* q, int k) const;

  void adopt(const ChainState<D>& chain);
  /// Lengths of the last and the first element below which an end-merge is due [m]; 0 where none will be.
  void set_end_limits();
  /// Gives elements at the joint whose transported weights are about to be lost new ones, by the least change.
  MergedWeights renew_weights(ChainState<D>& chain, double t) const;
  /// What is due where a guard is positive.
  struct Due {
    EventType type;
    Direction direction;
  };
  Due due(int guard) const;
  Guards rider_guards(const Eigen::VectorXd& y, double t) const;
  /// Generalized force of the support on the x of a held rider [N].
  double contact_force(const Eigen::VectorXd& y, double t) const;
  /// The mass hits a support: new velocities, and whether it is then held. Throws ComputationFailed where the run is to
  /// stop.
  void hit(ChainState<D>& chain, Eigen::VectorXd& y, double t);
  /// Where a mass is that has just left a support [m].
  double clear_of_end() const;
  /// Solves M a = f of the nodes of a beam without a joint, in place; what moving supports do is in what it returns.
  std::optional<Pull> solve_apart(double t, double* force) const;
  /// What the rider does to a beam that would have the accelerations `a` without it; completes them.
  std::optional<RiderSolution<D>> solve_rider(const RiderMotion<double, D>& at, const Vector& gravity,
                                              double* a) const {
    return solve_with_rider<D>(rider_->mass, *model_.joint, at, element_nodes<D>(a, rider_->element),
                               at.remainder - gravity, 0, rider_->held, true, a);
  }
  /// The elements at the joint, if there is one.
  std::optional<JointElements> elements_at(const Eigen::VectorXd& y, double t) const {
    if (!has_joint()) return std::nullopt;
    return joint_elements(y.data(), y.data() + coordinates_, t);
  }
  JointElements joint_elements(const double* q, const double* rate, double t) const;
  JointMotion<D> joint_motion(const double* q, const double* rate, double t) const;
  /// Coordinates (or rates, or forces) of element k in an array like q.
  NodalCubic<double, D> element_of(const double* q, int k) const;
  /// Solves M v = p in place for the velocities v that a momentum p means at the coordinates `q`; false where the mass
  /// matrix is singular. `elements` is null without a joint.
  bool solve_mass(const JointElements* elements, const double* q, double* p) const;
  void multiply_mass(const JointElements* elements, const double* q, const double* rate, double* out) const;
  /// Adds what a force (or momentum) on the rider is of its element's nodes and of x.
  void push_rider(const RiderMotion<double, D>& at, const Vector& force, double* out) const;
  /// Momentum by which the velocity field of `before` exceeds that of `after`, on elements `first` to `last`.
  Eigen::VectorXd excess_momentum(const ChainState<D>& before, const ChainState<D>& after, int first, int last) const;
  /// Replaces the rates in `y`, a state of the mesh made from `before`, by the projection of the old velocity field.
  void project_velocities(const ChainState<D>& before, int first, int last, Eigen::VectorXd& y, double t) const;
  /// M phi of the rigid motions phi at the positions `y`: translations, then rotations about the origin.
  Eigen::MatrixXd rigid_momenta(const JointElements* elements, const Eigen::VectorXd& y) const;
  /// Linear and angular momentum of beam and mass, by the model's own points.
  Eigen::VectorXd momenta(const Eigen::VectorXd& y, double t) const;
  /// Gives the rates in `y` these momenta, by the least change, and this total energy, by scaling the velocity
  /// fluctuation, which carries no momentum: as far as it has energy, and at most doubled.
  void restore(const Eigen::VectorXd& momenta, double total, Eigen::VectorXd& y, double t) const;
  Eigen::VectorXd state_of(const ChainState<D>& chain, const Eigen::VectorXd& old) const;
  typename RampWork<D>::Moment moment(const Eigen::VectorXd& y, double t) const {
    const Observation<D> seen = observe(y, t, model_.quadrature_points);
    return {seen.mass_moment, seen.momentum};
  }
  void observe_elements(const ChainState<D>& chain, int first, int last, double t, int points,
                        Observation<D>& seen) const;

  BeamModel<D> model_;
  Mesh mesh_;
  std::vector<double> rest_;  ///< nodes of the rest shape, but for the moving one; empty if it is straight
  int joint_ = no_joint;
  std::optional<Riding> rider_;
  std::array<double, 2> end_limit_{};  ///< [m], of the last and of the first element
  double cut_limit_ = 0;               ///< distance of a rider from the end at which it gets a node [m]
  bool free_mass_ = false;
  Eigen::Matrix<double, node_size<D>, 1> joint_anchor_ = Eigen::Matrix<double, node_size<D>, 1>::Zero();
  Eigen::Index nodal_ = 0, coordinates_ = 0;
  Eigen::Index behind_ = 0;  ///< where q holds the slope behind the joint: the node's own, unless the joint is kinked
  std::optional<Span<D>> left_, right_;
  ShapeTabulation left_table_, right_table_;
  std::array<FixedInertia, 2> end_inertia_;  ///< of the first and the last element where supports move
  Eigen::VectorXd initial_, imposed_;
  std::array<Eigen::Matrix<double, node_size<D>, 1>, 2> anchors_;
  std::optional<Spin> spin_;
  RampWork<D> ramp_;
  std::size_t rhs_evaluations_ = 0, revision_ = 0;
  std::unique_ptr<ImplicitBeam<D>> implicit_;
};

extern template class BeamSystem<2>;
extern template class BeamSystem<3>;

}  // namespace vlbeam
