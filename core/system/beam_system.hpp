#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/beam/span_between.hpp"
#include "core/dynamics/integrate.hpp"
#include "core/joint/joint_chain.hpp"
#include "core/joint/kinks.hpp"
#include "core/joint/rider.hpp"
#include "core/length_control/event_type.hpp"
#include "core/parts/nut.hpp"
#include "core/system/beam_model.hpp"
#include "core/system/held.hpp"
#include "core/system/layout.hpp"
#include "core/system/moving_mesh.hpp"
#include "core/system/node_contact.hpp"
#include "core/system/observation.hpp"
#include "core/system/ramp_work.hpp"

namespace vlbeam {

/// What happened to a beam system at an event.
template <int D>
struct EventRecord {
  double t;
  EventType type;
  int joint;  ///< which of the model's
  double joint_position;
  MergedWeights merged;
  Energy jump;           ///< by a 25-point rule
  double discrete_jump;  ///< of the total, by the model's own rule
  bool restored;         ///< false: energy and momenta were to be as before, and the energy is not
  Eigen::VectorXd
      momentum_jump;  ///< linear, then angular about the origin, by the model's own rule; not of a separation
  ChainState<D> before, after;
  int relaxation = 0;  ///< iterations until nodes had given way
  double seconds;      ///< wall time spent
};

template <int D>
class ImplicitBeam;

/// One beam with, possibly, joints that slide on it and may leave it: the equations of motion in minimal coordinates.
/// State y = (q, q', tallies): q holds the nodes (position and slope each), x_i of the joints, the slopes behind those
/// that are kinked, and the positions of masses that have left; or x of a mass that rides inside an end element; then
/// the angles of a section that spins, at the nodes that there were at t = 0: joints and what they do to the mesh leave
/// them alone; where all nodes travel, at these. The tallies are those of BeamModel::tallies(). What a support drives
/// stands in the state too, but is read from its motion, wherever it counts, and so is where a nut is, from the angles.
template <int D>
class BeamSystem final : public EventedOde {
 public:
  using Vector = Vec<double, D>;

  /// `chain` is the initial state, but for the velocity of driven supports; its joints, inner nodes, must be those of
  /// the model. A single mass may ride inside an end element instead. Throws ModelError for moving supports with
  /// conservative velocities at events.
  BeamSystem(const BeamModel<D>& model, const ChainState<D>& chain);
  ~BeamSystem() override;

  Eigen::Index size() const override { return layout_.state(); }
  std::vector<FieldRun> fields() const override { return layout_.fields(spin()); }
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override;
  Guards guards(const Eigen::VectorXd& y, double t) const override;
  void handle_event(int index, Eigen::VectorXd& y, double t) override;
  void sample(const Eigen::VectorXd& y, double t) override;
  bool proceed(const Eigen::VectorXd& y, double t) override {
    if (ramp_.due(t)) ramp_.advance(t, moment(y, t));
    return !on_step || on_step(t);
  }
  void exchange(Memory& memory) override;

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
  /// The beam with coordinates q and their rates, arrays like those of the state; where its nodes travel, as travel()
  /// was told last.
  ChainView<D> view(const double* q, const double* rate) const {
    return {mesh_, model_.transport, q, rate, places_, marks()};
  }
  /// That at time t, with the accelerations `a` or null.
  Motion<D> motion(const double* q, const double* rate, const double* a, double t) const {
    return {view(q, rate), a, t, gravity(t)};
  }
  /// What acts on the beam, but for its elements and what slides on it.
  const std::vector<std::shared_ptr<const Part<D>>>& acting() const { return acting_; }
  /// Lets nodes that travel be where they are at time t; false where they tangle.
  bool travel(double t) const {
    if (!moving_) return true;
    const bool sound = moving_->move(t);
    if (spin_) spin_->move(moving_->marks());
    return sound;
  }
  /// The mesh of a beam whose nodes travel, or null.
  MovingMesh<D>* moving_mesh() const { return moving_ ? &*moving_ : nullptr; }
  /// Material coordinates of all nodes, if they travel, or null.
  const std::vector<Prescribed>* marks() const { return moving_ ? &moving_->marks() : nullptr; }
  /// M a - Q of a beam whose nodes travel, of the nodal accelerations `a`, added to an array like q; returns the power
  /// lost to damping [W].
  double add_travelling_residual(const double* q, const double* rate, const double* a, double t, double* r);
  /// What such a beam is given in a second at the accelerations `a`, of what was evaluated last.
  Tally flow_power(const double* q, const double* rate, const double* a, double t);
  /// Power of the load along the beam [W].
  double line_power(const ChainView<D>& beam, double t) const;
  /// What feeds that are given do besides the work of their force along the beam, which takes the load for a potential:
  /// matter that comes in brings none of it [W].
  double fed_line_power(const ChainView<D>& beam, double t) const {
    if (!model_.loads.line_force) return 0;
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (guides(i)) sum += beam.inflow_at(places_[i]);
    }
    return model_.loads.line_force(t).dot(sum);
  }
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

  /// Mesh and motion at state y, at time t.
  ChainState<D> chain(const Eigen::VectorXd& y, double t) const;
  bool has_joint() const { return !places_.empty(); }
  /// Where the coordinates of the joints stand that are on the beam, in the order of the chain.
  const std::vector<JointPlace>& places() const { return places_; }
  /// The same joints in the model.
  const ModelJoint<D>& joint(std::size_t which) const { return model_.joints[static_cast<std::size_t>(index_[which])]; }
  int joint_index(std::size_t which) const { return index_[which]; }
  /// Whether that joint is an end of the beam, through which it is fed: there is an element on one side only.
  bool feeds(std::size_t which) const { return places_[which].node == 0 || places_[which].node == mesh_.last(); }
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
  /// What holds a joint's node, or null.
  const Support<D>* held(std::size_t which) const {
    const auto& support = joint(which).support;
    return support ? &*support : nullptr;
  }
  /// Masses that have left the beam are in the state: which of the model's joints they were.
  const std::vector<int>& departed() const { return departed_; }
  /// Where the position of one of them stands.
  Eigen::Index departed_at(std::size_t i) const { return layout_.departed_mass(static_cast<int>(i)); }
  /// Whether joint `index` of the model is on the beam.
  bool on_beam(int index) const {
    return rider_ ? index == 0 : std::find(index_.begin(), index_.end(), index) != index_.end();
  }
  /// Motion of the rider, of arrays like q and q' with x behind the nodes.
  RiderMotion<double, D> rider_motion(const double* q, const double* rate) const {
    const bool held = rider_->held;
    return vlbeam::rider_motion<double, D>(rider_->curve, element_nodes<D>(q, rider_->element),
                                           element_nodes<D>(rate, rider_->element),
                                           held ? rider_->end : q[layout_.mark()], held ? 0 : rate[layout_.mark()]);
  }
  /// How the section turns; null if it does not. Its angles stand behind all else.
  Spin* spin() { return spin_ ? &*spin_ : nullptr; }
  const Spin* spin() const { return spin_ ? &*spin_ : nullptr; }
  /// Of a beam whose sections have frames, or null. Their angles stand behind the nodes.
  Frames* frames() const { return frames_.get(); }
  /// After a step on a path of equilibria: what angles are counted from follows.
  void follow(const Eigen::VectorXd& q) {
    if (frames_) frames_->follow(q.data(), nullptr);
  }
  /// Where the angles stand among the coordinates.
  Eigen::Index angles() const { return layout_.angle(); }
  /// Where the angle of a node of the mesh at t = 0 stands.
  Eigen::Index angle(int node) const { return angles() + spin_->angle(node); }
  /// Which of the joints on the beam is a nut; nothing where none is.
  std::optional<std::size_t> nut_place() const {
    for (std::size_t i = 0; nut_ && i < places_.size(); ++i) {
      if (joint(i).pitch != 0) return i;
    }
    return std::nullopt;
  }
  const Nut& nut() const { return *nut_; }
  /// Where the concentrated loads are.
  std::vector<Vector> load_places(const Eigen::VectorXd& y, double t) const {
    return model_.loads.places(view(y.data(), y.data() + coordinates()), t);
  }
  /// The beam has two slopes at that joint.
  bool kinked(std::size_t which) const { return joint(which).law.kinked(); }
  bool kinked() const {
    return std::any_of(places_.begin(), places_.end(), [](const JointPlace& place) { return place.behind >= 0; });
  }
  /// Slopes at a joint, before and behind it, of an array of coordinates or rates.
  Eigen::Matrix<double, 2 * D, 1> joint_slopes(std::size_t which, const double* q) const {
    return slopes_at<D>(places_[which], q);
  }
  /// How far the slopes at joints are from their conditions [-], [1/s].
  ConstraintResidual slope_residual(const Eigen::VectorXd& y) const;
  const Mesh& mesh() const { return mesh_; }
  Eigen::Index coordinates() const { return layout_.coordinates(); }
  const Layout<D>& layout() const { return layout_; }
  /// Counts the meshes there have been.
  std::size_t revision() const { return revision_; }
  /// The elements at the joints, in the order of the chain.
  const std::vector<MovingPart>& moving_parts() const { return parts_; }
  MovingLaw<D> moving_law(double t) const {
    return {model_.axis_section(), model_.formulation, model_.transport, beam_gravity(t)};
  }
  /// The rest shape of an element at joints whose coordinates are in `q`; nothing if it is straight.
  std::optional<RestElement<D>> rest_of(const MovingPart& part, const double* q) const;
  /// The fixed elements before the first and behind the last joint, or before and behind the middle of the beam.
  const Span<D>& left() const { return *left_; }
  const Span<D>& right() const { return *right_; }
  /// Those between joints.
  const std::vector<SpanBetween<D>>& between() const { return between_; }
  using Contact = NodeContact<D>;
  using Link = NodeLink<D>;
  /// Nodes that keep a distance: those of blocks, then what rests against each other.
  const std::vector<Link>& links() const { return links_; }
  /// With what they push each other apart, by the accelerations that rhs() has given last [N].
  const Eigen::VectorXd& link_forces() const { return link_forces_; }
  /// What holds nodes in space.
  const Held<D>& holding() const { return held_; }
  /// Whether a guide prescribes a joint's material coordinate.
  bool guides(std::size_t which) const { return static_cast<bool>(joint(which).x); }
  /// What it prescribes; nothing where there is none.
  std::optional<Prescribed> guided(std::size_t which, double t) const {
    const TimeFunction& x = joint(which).x;
    return x ? std::optional(x(t)) : std::nullopt;
  }
  /// Puts what supports and guides drive where it is at time t.
  void impose(Eigen::VectorXd& y, double t) const;
  /// Where a sliding mass is, on the beam or off it, and how it moves.
  struct MassMotion {
    Vector r, v;
  };
  /// Of joint `index` of the model; empty once a beam has run out of its ring or sleeve.
  std::optional<MassMotion> mass_motion(const Eigen::VectorXd& y, int index = 0) const;
  /// Energies, momenta and length, summed with `points` Gauss points an element; strains only where they are asked for.
  Observation<D> observe(const Eigen::VectorXd& y, double t, int points, bool strains = false) const;

 private:
  using JointElements = std::vector<MovingEquations<double, D>>;  ///< of the moving parts

  /// What moving supports do to the equations of motion.
  class PrescribedMotion;
  /// Lets the supports of the spans stand as they do at time t.
  void orient(double t) const;
  /// Where the four nodal vectors of element k are in an array like q.
  std::array<double*, 4> vectors_of(double* q, int k) const;

  void adopt(const ChainState<D>& chain);
  /// The frames of a chain, in the place of those there were.
  void take_frames(const ChainState<D>& chain);
  /// Gives the nodes of `after`, which an event has made of `before` at the state `y`, their sections: new nodes those
  /// that were there in the beam.
  void turn_sections(const ChainState<D>& before, const Eigen::VectorXd& y, ChainState<D>& after) const;
  /// Angular momentum of sections that spin [kg m^2/s].
  Vec<double, 3> spin_momentum(const Eigen::VectorXd& y) const {
    return frames_ ? frames_->observe(y.data(), y.data() + coordinates()).momentum : Vec<double, 3>::Zero();
  }
  /// The joints are solved for as a chain.
  bool chained() const {
    return places_.size() > 1 || (has_joint() && (guides(0) || feeds(0) || joint(0).pitch != 0 || frames_));
  }
  /// The state is read from what prescribes parts of it.
  bool imposes() const { return model_.driven() || nut_; }
  /// Lengths of the last and the first element below which an end-merge is due [m]; 0 where none will be.
  void set_end_limits();
  /// Gives elements at a joint whose transported weights are about to be lost new ones, by the least change.
  MergedWeights renew_weights(ChainState<D>& chain, std::size_t which, double t) const;
  /// Material coordinate of a joint on the beam: an event will find a guided one where it is to be, not where
  /// integration has it [m].
  double mark_at(std::size_t which, const Eigen::VectorXd& y, double t) const {
    const auto guide = guided(which, t);
    if (guide) return guide->value;
    const double x = y[places_[which].mark];
    if (!nut_ || joint(which).pitch == 0) return x;
    return nut_->place(*spin_, y.data() + angles(), y.data() + coordinates() + angles(), x).x;
  }
  void add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  /// Throws ComputationFailed: joint `which` is as near the next one as joints come.
  [[noreturn]] void joints_met(std::size_t which, double t) const;
  /// What is due where a guard is positive.
  struct PendingEvent {
    EventType type;
    Direction direction;
    std::size_t which;    ///< of the joints on the beam
    Remeshing remeshing;  ///< of the mesh at a joint
  };
  PendingEvent due(const Guard& guard, const Eigen::VectorXd& y) const;
  /// That event, and all others of the mesh that are due at the same instant, in their order.
  std::vector<PendingEvent> all_due(int index, const Eigen::VectorXd& y, double t) const;
  /// Neighbouring joints ask for the same cut or the same merge: one of them does it.
  void drop_doubles(std::vector<PendingEvent>& dues) const;
  /// Whether the guard `index` asks for no more than that frames follow.
  bool turns_away(int index, const Eigen::VectorXd& y, double t) const;
  /// What a joint, moving in a direction, asks for of the mesh: a cut behind it, a merge ahead.
  Remeshing wanted(std::size_t which, Direction direction, const Eigen::VectorXd& y) const;
  /// Material coordinate of a node of the mesh [m].
  double mark_of(int node, const double* q) const { return view(q, q).mark_of(node); }
  /// The joint leaves the beam where it may; throws ComputationFailed where it may not.
  void check_leaving(const PendingEvent& due, double t) const;
  /// What an event makes of the chain, and of `y` where it is an impact.
  MergedWeights change(const PendingEvent& due, ChainState<D>& chain, Eigen::VectorXd& y, double t);
  /// Lets the nodes beside what an event has cut and merged give way, as length control says, until `excess` [J] is
  /// gone; the iterations it took.
  int relax_after(const std::vector<PendingEvent>& dues, ChainState<D>& chain, double t, double excess) const;
  bool at_joint(int node) const { return view(nullptr, nullptr).joint_at(node) != nullptr; }
  Guards rider_guards(const Eigen::VectorXd& y, double t) const;
  Guards travel_guards(double t) const;
  /// Nodes that travel cannot go on: throws ComputationFailed.
  [[noreturn]] void stop_travelling(int index, double t) const;
  /// Generalized force of the support on the x of a held rider [N].
  double contact_force(const Eigen::VectorXd& y, double t) const;
  /// What acts on the coordinates but for spin, and its power but for what accelerations tell.
  Tally add_forces(const double* q, const double* rate, double t, double* force, JointElements& elements) const;
  std::vector<Contact> contacts() const;
  /// Of a contact: how far its nodes are apart, the direction from one to the other, and the rate of the distance.
  struct Gap {
    double distance, rate;
    Vector direction;
  };
  Gap gap(const Contact& contact, const Eigen::VectorXd& y) const;
  /// Where they touch for the first time [m].
  double touching() const { return model_.contact_distance * model_.length_control.standard_length; }
  /// From now on its nodes rest against each other, or no longer.
  void close_contact(const Contact& contact, const Eigen::VectorXd& y);
  void open_contact(const Contact& contact, const Eigen::VectorXd& y);
  /// What rests, and with it the links.
  void find_resting();
  /// Of joint `index` of the model, which is on the beam.
  const JointPlace& place_of(int index) const {
    return places_[static_cast<std::size_t>(std::ranges::find(index_, index) - index_.begin())];
  }
  /// The distances that joints of a block have there, an array like q, are those that they keep.
  void tie_blocks(const double* q);
  /// All that touch and come nearer strike each other at once, and what rests bears it: new velocities, and what rests
  /// then. Throws ComputationFailed where it cannot.
  void strike(Eigen::VectorXd& y, double t);
  /// Throws ComputationFailed.
  [[noreturn]] void comes_to_rest(const Contact& contact, double t) const;
  /// Velocities after an impact of these.
  void collide(const std::vector<Contact>& contacts, Eigen::VectorXd& y, double t);
  /// Adds what forces (or momenta) along the lines of links do to the accelerations (or velocities) `a` of a beam
  /// without them, so that L . (a_ahead - a_behind) is as `wanted` on each line L. Returns them, positive where they
  /// push; nothing where the mass matrix is singular.
  std::optional<Eigen::VectorXd> press(const std::vector<Link>& links, const JointElements& elements, const double* q,
                                       const Eigen::VectorXd& wanted, double* a) const;
  /// Of what prescribes parts of the state: what it does as such forces change accelerations (or momenta velocities) by
  /// `change`.
  double work_of_prescribed(const std::vector<Link>& links, const Eigen::VectorXd& forces,
                            const JointElements& elements, const double* q, const double* rate,
                            const Eigen::VectorXd& change) const;
  /// What press() is to give the accelerations of links, by C'' = 0.
  Eigen::VectorXd bending_in(const double* rate) const;
  /// Forces of links, at a state [N].
  Eigen::VectorXd forces_of_links(const Eigen::VectorXd& y, double t) const;
  /// The mass hits a support: new velocities, and whether it is then held. Throws ComputationFailed where the run is to
  /// stop.
  void hit(ChainState<D>& chain, Eigen::VectorXd& y, double t);
  /// Where a mass is that has just left a support [m].
  double clear_of_end() const;
  /// Solves M a = f of the nodes of a beam without a joint, in place; what moving supports do is in what it returns.
  std::optional<PrescribedMotion> solve_apart(const double* q, const double* rate, double t, double* force) const;
  /// The law of the mass that rides.
  const SlidingJoint& rider_law() const { return model_.joints.front().law; }
  /// What the rider does to a beam that would have the accelerations `a` without it; completes them.
  std::optional<RiderSolution<D>> solve_rider(const RiderMotion<double, D>& at, const Vector& gravity,
                                              double* a) const {
    return solve_with_rider<D>(rider_->mass, rider_law(), at, element_nodes<D>(a, rider_->element),
                               at.remainder - gravity, 0, rider_->held, true, a);
  }
  JointElements elements_at(const Eigen::VectorXd& y, double t) const {
    JointElements elements;
    fill_elements(y.data(), y.data() + coordinates(), t, elements);
    return elements;
  }
  void fill_elements(const double* q, const double* rate, double t, JointElements& elements) const;
  JointMotion<D> joint_motion(std::size_t which, const double* q, const double* rate, double t) const;
  /// Solves M a = f, friction included, in place; nothing is returned where there is no solution. `motions` holds an
  /// entry a joint.
  std::optional<JointPower> solve_joints(const JointElements& elements, const std::vector<JointMotion<D>>& motions,
                                         double* force) const;
  /// The same of what rhs() has evaluated, of several joints on a beam with frames.
  std::optional<JointPower> solve_with_frames(double* force);
  /// Solves M v = p in place for the velocities v that a momentum p means at the coordinates `q`; false where the mass
  /// matrix is singular.
  bool solve_mass(const JointElements& elements, const double* q, double* p) const;
  /// As if nothing rested against anything.
  bool solve_mass_apart(const JointElements& elements, const double* q, double* p) const;
  void multiply_mass(const JointElements& elements, const double* q, const double* rate, double* out) const;
  /// Adds what a force (or momentum) on the rider is of its element's nodes and of x.
  void push_rider(const RiderMotion<double, D>& at, const Vector& force, double* out) const;
  /// Momentum by which the velocity field of `before` exceeds that of `after`, on elements `first` to `last`.
  Eigen::VectorXd excess_momentum(const ChainState<D>& before, const ChainState<D>& after, int first, int last) const;
  /// Replaces the rates in `y`, a state of the mesh made from `before`, by the projection of the old velocity field.
  void project_velocities(const ChainState<D>& before, int first, int last, Eigen::VectorXd& y, double t) const;
  /// M phi of the rigid motions phi at the positions `y`: translations, then rotations about the origin.
  Eigen::MatrixXd rigid_momenta(const JointElements& elements, const Eigen::VectorXd& y) const;
  /// Linear and angular momentum of beam and mass, by the model's own points.
  Eigen::VectorXd momenta(const Eigen::VectorXd& y, double t) const;
  /// Gives the rates in `y` these momenta, by the least change, and this total energy, by scaling the velocity
  /// fluctuation, which carries no momentum: as far as it has energy, and at most doubled.
  void restore(const Eigen::VectorXd& momenta, double total, Eigen::VectorXd& y, double t) const;
  /// The same once, of the motion of the axis.
  void restore_axis(const Eigen::VectorXd& momenta, double total, Eigen::VectorXd& y, double t) const;
  Eigen::VectorXd state_of(const ChainState<D>& chain, const Eigen::VectorXd& old) const;
  typename RampWork<D>::Moment moment(const Eigen::VectorXd& y, double t) const {
    const Observation<D> seen = observe(y, t, model_.quadrature_points);
    return {seen.mass_moment, moment_rate(seen, y)};
  }
  /// Rate of the first moment of mass: the momentum, and what is fed into the beam.
  Vector moment_rate(const Observation<D>& seen, const Eigen::VectorXd& y) const {
    return seen.momentum + model_.section.rhoA * view(y.data(), y.data() + coordinates()).inflow();
  }
  void observe_elements(const ChainState<D>& chain, int first, int last, double t, int points,
                        Observation<D>& seen) const;

  BeamModel<D> model_;
  Mesh mesh_;
  std::vector<double> rest_;        ///< nodes of the rest shape, but for the moving one; empty if it is straight
  std::vector<JointPlace> places_;  ///< of the joints on the beam, in the order of the chain
  std::vector<int> index_;          ///< which of the model's they are
  std::vector<std::array<typename ChainState<D>::Touch, 2>> touches_;  ///< of the joints on the beam
  /// Two of the model's joints that are tied to each other, and the way from the one to the other [m].
  struct Tie {
    int behind, ahead;
    Vector apart;
  };
  std::vector<Tie> ties_;
  std::vector<Contact> resting_;
  std::vector<Link> links_;
  Eigen::VectorXd link_forces_;
  std::vector<int> departed_;  ///< the same of masses that have left
  std::vector<int> passed_;    ///< of the model's joints: how many point masses are behind it
  mutable std::optional<Riding> rider_;
  mutable std::optional<MovingMesh<D>> moving_;  ///< its nodes are where travel() was told last
  std::array<double, 2> end_limit_{};            ///< [m], of the last and of the first element
  double cut_limit_ = 0;                         ///< distance of a rider from the end at which it gets a node [m]
  Held<D> held_;
  std::vector<std::shared_ptr<const Part<D>>> acting_;
  std::shared_ptr<Frames> frames_;  ///< one of these, too
  std::vector<SectionState> rest_sections_;
  std::shared_ptr<const RestTriads> rest_triads_;
  Layout<D> layout_;
  mutable std::optional<Span<D>> left_, right_;  ///< their supports stand as orient() was told last
  std::vector<SpanBetween<D>> between_;
  std::vector<MovingPart> parts_;
  JointElements elements_;                   ///< of the right-hand side
  std::vector<JointMotion<D>> motions_;      ///< the same
  Eigen::VectorXd round_forces_;             ///< of solve_with_frames()
  std::vector<double> round_marks_;          ///< the same
  mutable JointChain<D> joint_chain_;        ///< of several joints, or one that is guided
  std::array<FixedInertia, 2> end_inertia_;  ///< of the first and the last element where supports move
  Eigen::VectorXd initial_, imposed_;
  Eigen::VectorXd flow_residual_, flow_forces_;  ///< of flow_power()
  std::vector<double> on_marks_;                 ///< the same
  mutable std::optional<Spin> spin_;
  std::optional<Nut> nut_;
  RampWork<D> ramp_;
  std::size_t rhs_evaluations_ = 0, revision_ = 0;
  std::unique_ptr<ImplicitBeam<D>> implicit_;
};

extern template class BeamSystem<2>;
extern template class BeamSystem<3>;

}  // namespace vlbeam
