#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/beam/span_between.hpp"
#include "core/element/element_sums.hpp"
#include "mechanics/motion/joint/joint_chain.hpp"
#include "mechanics/motion/joint/kinks.hpp"
#include "mechanics/motion/system/beam_model.hpp"
#include "mechanics/motion/system/held.hpp"
#include "mechanics/motion/system/layout.hpp"
#include "mechanics/motion/system/loose_mass.hpp"
#include "mechanics/motion/system/prescribed_mesh.hpp"
#include "mechanics/motion/system/unknowns.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

/// How many elements at the start and at the end of a beam stay as they are.
struct UnchangedElements {
  int at_start = 0, at_end = 0;
};

/// A beam as it is between two events: its mesh, its joints, what holds it and what acts on it, and where all of it
/// stands in a state y = (q, q', tallies). q holds the nodes (position and slope each), x_i of the joints, the slopes
/// behind those that are kinked, and the positions of masses that have left; or x of a mass that rides inside an end
/// element; then the angles of a section that spins, at the nodes that there were at t = 0: joints and what they do to
/// the mesh leave them alone; where all nodes travel, at these. The tallies are those of BeamModel::tallies(). What a
/// support drives stands in the state too, but is read from its motion, wherever it counts, and so is where a nut is,
/// from the angles.
template <int D>
class CurrentBeam {
 public:
  using Vector = Vec<double, D>;
  using JointElements = std::vector<MovingEquations<double, D>>;  ///< of the elements at joints: moving_parts()

  /// `chain` is the initial state; its joints, inner nodes, must be those of the model. A single mass may ride inside
  /// an end element instead.
  CurrentBeam(const BeamModel<D>& model, const ChainState<D>& chain);
  CurrentBeam(const CurrentBeam&) = delete;
  CurrentBeam& operator=(const CurrentBeam&) = delete;

  const BeamModel<D>& model() const { return model_; }
  const Mesh& mesh() const { return mesh_; }
  /// Of the elements.
  const BeamRules& rules() const { return rules_; }
  /// For sums over elements by so many Gauss points, or own_points.
  const SumTables& tables(int points) const;
  const Layout<D>& layout() const { return layout_; }
  Eigen::Index coordinates() const { return layout_.coordinates(); }
  /// Counts the meshes there have been.
  std::size_t revision() const { return revision_; }

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
  /// The beam with coordinates q and their rates, arrays like those of the state; where its nodes travel, as
  /// move_nodes() was told last.
  ChainView<D> view(const double* q, const double* rate) const {
    return {mesh_, model_.transport, q, rate, places_, marks()};
  }
  /// That at time t, with the accelerations `a` or null.
  Motion<D> motion(const double* q, const double* rate, const double* a, double t) const {
    return {view(q, rate), a, t, gravity(t)};
  }
  /// Where the four nodal vectors of element k are in an array like q.
  std::array<double*, 4> vectors_of(double* q, int k) const;
  /// Sets an array of coordinates to zero, but for nodes outside of a part.
  void clear(double* q, const BeamPart& part) const {
    std::fill(q + Eigen::Index{node_size<D>} * part.before,
              q + layout_.mark() - Eigen::Index{node_size<D>} * part.behind, 0.0);
    std::fill(q + layout_.mark(), q + coordinates(), 0.0);
  }
  /// What acts on the beam, but for its elements and what slides on it.
  const std::vector<std::shared_ptr<const Part<D>>>& acting() const { return acting_; }

  /// Mesh and motion at state y, at time t.
  ChainState<D> chain(const Eigen::VectorXd& y, double t) const {
    ChainState<D> result;
    write_chain(y, t, {}, result);
    return result;
  }
  /// The same of a part of the beam, into the memory of another chain; frames, travelling nodes and riders are of the
  /// whole.
  void write_chain(const Eigen::VectorXd& y, double t, const BeamPart& part, ChainState<D>& result) const;
  /// Brings that chain up to date with a state that differs in rates and angles alone.
  void take_rates(const Eigen::VectorXd& y, ChainState<D>& chain) const;
  /// Writes the state of a chain whose mesh is this one; tallies, and angles of a section that spins, are those of
  /// `old`, if there is one.
  void write_state(const ChainState<D>& chain, const Eigen::VectorXd& old, Eigen::VectorXd& y) const;
  /// Brings a state of the beam before an event up to date with what the event has made of nodes and joints: the chain,
  /// which may hold a part of the mesh, and no frames or masses that ride.
  void write_nodes(const ChainState<D>& chain, Eigen::VectorXd& y) const;
  /// The state at t = 0 of that chain, from which nuts and supports count.
  Eigen::VectorXd start(const ChainState<D>& chain);
  /// Becomes the beam of a chain that an event has made.
  void adopt(const ChainState<D>& chain);
  /// The state is read from what prescribes parts of it.
  bool imposes() const {
    bool tied = false;
    for (std::size_t i = 0; unknowns_ && i < places_.size(); ++i) tied = tied || unknowns_->ties(i);
    return tied || model_.driven();
  }
  /// Puts what supports and guides drive where it is at time t.
  void impose(Eigen::VectorXd& y, double t) const;
  /// Lets the supports of the spans stand as they do at time t.
  void orient(double t) const;
  /// Lets nodes that are prescribed along the beam be where they are at time t; false where they tangle.
  bool move_nodes(double t) const {
    if (!prescribed_) return true;
    const bool sound = prescribed_->move(t);
    if (unknowns_) unknowns_->move();
    return sound;
  }
  /// The mesh of a beam all of whose nodes are, or null.
  PrescribedMesh<D>* prescribed_mesh() const { return prescribed_.get(); }
  /// Material coordinates of all nodes, if they are, or null.
  const std::vector<Prescribed>* marks() const { return prescribed_ ? &prescribed_->marks() : nullptr; }
  /// What holds nodes in space.
  const Held<D>& holding() const { return held_; }

  bool has_joint() const { return !places_.empty(); }
  /// Where the coordinates of the joints stand that are on the beam, in the order of the chain.
  const std::vector<JointPlace>& places() const { return places_; }
  /// The same joints in the model.
  const ModelJoint<D>& joint(std::size_t which) const {
    return model_.joints[static_cast<std::size_t>(joints_[which].index)];
  }
  int joint_index(std::size_t which) const { return joints_[which].index; }
  /// Where joint `index` of the model is, which is on the beam.
  const JointPlace& place_of(int index) const { return places_[static_cast<std::size_t>(find(index))]; }
  /// Whether joint `index` of the model is on the beam.
  bool on_beam(int index) const { return loose_ ? index == 0 : find(index) >= 0; }
  bool at_joint(int node) const { return view(nullptr, nullptr).joint_at(node) != nullptr; }
  /// Whether that joint is an end of the beam, through which it is fed: there is an element on one side only.
  bool feeds(std::size_t which) const { return places_[which].node == 0 || places_[which].node == mesh_.last(); }
  /// What holds a joint's node, or null.
  const Support<D>* held(std::size_t which) const {
    const auto& support = joint(which).support;
    return support ? &*support : nullptr;
  }
  /// Whether a guide prescribes a joint's material coordinate.
  bool guides(std::size_t which) const { return static_cast<bool>(joint(which).x); }
  /// What it prescribes; nothing where there is none.
  std::optional<Prescribed> guided(std::size_t which, double t) const {
    const TimeFunction& x = joint(which).x;
    return x ? std::optional(x(t)) : std::nullopt;
  }
  /// Material coordinate of a joint on the beam: an event will find a guided one where it is to be, not where
  /// integration has it [m].
  double mark_at(std::size_t which, const Eigen::VectorXd& y, double t) const { return mark_motion(which, y, t).x; }
  /// With its rate [m/s].
  struct MarkMotion {
    double x, rate;
  };
  MarkMotion mark_motion(std::size_t which, const Eigen::VectorXd& y, double t) const;
  /// Material coordinate of a node of the mesh [m].
  double mark_of(int node, const double* q) const { return view(q, q).mark_of(node); }
  /// A joint on the beam has passed a point mass, forwards or backwards.
  void pass(std::size_t which, int by) { places_[which].passed += by; }
  using Touch = typename ChainState<D>::Touch;
  /// Of a joint on the beam and what is before it (side 0) or behind it (side 1).
  const Touch& touch(std::size_t which, std::size_t side) const { return joints_[which].touches[side]; }
  void set_touch(std::size_t which, std::size_t side, const Touch& touch) { joints_[which].touches[side] = touch; }

  /// The beam has two slopes at that joint.
  bool kinked(std::size_t which) const { return joint(which).law.kinked(); }
  bool kinked() const {
    return std::any_of(places_.begin(), places_.end(), [](const JointPlace& place) { return place.behind >= 0; });
  }
  /// Slopes at a joint, before and behind it, of an array of coordinates or rates.
  Eigen::Matrix<double, 2 * D, 1> joint_slopes(std::size_t which, const double* q) const {
    return slopes_at<D>(places_[which], q);
  }
  /// Of what turns at a joint, against the acceleration of its material coordinate [kg].
  double turning_inertia(std::size_t which, const double* q) const {
    const Turning& turning = joint(which).law.turning;
    if (!turning.present()) return 0;
    return turning.against<D>(q[places_[which].mark], slope<D>(q, places_[which].node));
  }
  /// What that inertia needs on the coordinate besides [N].
  double turning_lag(std::size_t which, const double* q, const double* rate) const {
    const Turning& turning = joint(which).law.turning;
    if (!turning.stretched) return 0;
    const JointPlace& place = places_[which];
    return turning.lag<D>(q[place.mark], rate[place.mark], slope<D>(q, place.node), slope<D>(rate, place.node));
  }
  /// How far the slopes at joints are from their conditions [-], [1/s].
  ConstraintResidual slope_residual(const Eigen::VectorXd& y) const;

  /// Masses that have left the beam are in the state: which of the model's joints they were.
  const std::vector<int>& free_masses() const { return free_masses_; }
  /// Where the position of one of them stands.
  Eigen::Index free_mass_at(std::size_t i) const { return layout_.free_mass(static_cast<int>(i)); }
  /// Where a sliding mass is, on the beam or off it, and how it moves.
  struct MassMotion {
    Vector r, v;
  };
  /// Of joint `index` of the model; empty once a beam has run out of its ring or sleeve.
  std::optional<MassMotion> mass_motion(const Eigen::VectorXd& y, int index = 0) const;

  /// The mass of the only joint while no node carries it, or null.
  const LooseMass<D>* loose() const { return loose_.get(); }

  /// What stands behind all else; null where nothing does.
  Unknowns<D>* unknowns() const { return unknowns_.get(); }
  /// Whether a joint on the beam is tied to them.
  bool ties(std::size_t which) const { return unknowns_ && unknowns_->ties(which); }
  /// After a step on a path of equilibria: what angles are counted from follows.
  void follow(const Eigen::VectorXd& q) {
    if (unknowns_) unknowns_->settle(q.data());
  }
  /// Where the angles stand among the coordinates.
  Eigen::Index angles() const { return layout_.angle(); }

  /// The elements at the joints, in the order of the chain.
  const std::vector<MovingPart>& moving_parts() const { return parts_; }
  MovingLaw<D> moving_law(double t) const {
    MovingLaw<D> law{model_.axis_section(), model_.formulation, model_.transport, beam_gravity(t)};
    law.pieces = model_.several_sections();
    return law;
  }
  /// The rest shape of an element at joints whose coordinates are in `q`; nothing if it is straight.
  std::optional<RestElement<D>> rest_of(const MovingPart& part, const double* q) const;
  /// Mass matrix and forces of the elements at joints.
  void fill_elements(const double* q, const double* rate, double t, JointElements& elements) const;
  /// Their mass matrices alone; not of a beam whose nodes travel.
  void fill_masses(const double* q, double t, JointElements& elements) const;
  JointElements masses_at(const Eigen::VectorXd& y, double t) const {
    JointElements elements;
    fill_masses(y.data(), t, elements);
    return elements;
  }
  /// The fixed elements before the first and behind the last joint, or before and behind the middle of the beam.
  const Span<D>& left() const { return *spans_.left; }
  const Span<D>& right() const { return *spans_.right; }
  /// Those between joints.
  const std::vector<SpanBetween<D>>& between() const { return spans_.between; }

  /// Where the concentrated loads are.
  std::vector<Vector> load_places(const Eigen::VectorXd& y, double t) const {
    return model_.loads.places(view(y.data(), y.data() + coordinates()), t);
  }
  /// Power of the load along the beam [W].
  double line_power(const ChainView<D>& beam, double t) const;
  /// What feeds that are given do besides the work of their force along the beam, which takes the load for a potential:
  /// matter that comes in brings none of it [W].
  double fed_line_power(const ChainView<D>& beam, double t) const;

 private:
  /// Runs of fixed elements; the first and the last stand on supports, as orient() was told last.
  struct Spans {
    std::optional<Span<D>> left, right;
    std::vector<SpanBetween<D>> between;
  };

  /// A joint on the beam: which of the model's it is, and what it touches.
  struct Joint {
    int index;
    std::array<Touch, 2> touches;
  };

  /// Which of the joints on the beam is joint `index` of the model; -1 for none.
  int find(int index) const {
    const auto at = std::ranges::find(joints_, index, &Joint::index);
    return at == joints_.end() ? -1 : static_cast<int>(at - joints_.begin());
  }
  const RestEnd<D>& rest_end(double x) const;
  /// Calls equations_of(part, law) with the ends of each part.
  template <class Equations>
  void fill(const ChainView<D>& beam, double t, JointElements& elements, const Equations& equations_of) const;
  void adopt_joints(const ChainState<D>& chain);
  /// Puts where the joints are, and how they move, into a state.
  void write_joints(const ChainState<D>& chain, Eigen::VectorXd& y) const;
  /// The same.
  void adopt_elements(const UnchangedElements& unchanged);

  BeamModel<D> model_;
  BeamRules rules_;
  mutable std::map<int, SumTables> tables_;  ///< those that have been asked for
  Mesh mesh_;
  mutable RestEnd<D> last_rest_end_{std::numeric_limits<double>::quiet_NaN(), {}};
  std::vector<double> rest_;        ///< nodes of the rest shape, but for the moving one; empty if it is straight
  std::vector<JointPlace> places_;  ///< of the joints on the beam, in the order of the chain
  std::vector<Joint> joints_;       ///< the same
  std::vector<int> free_masses_;    ///< the same of masses that have left
  std::unique_ptr<LooseMass<D>> loose_;
  std::unique_ptr<PrescribedMesh<D>> prescribed_;  ///< its nodes are where move_nodes() was told last
  Held<D> held_;
  std::vector<std::shared_ptr<const Part<D>>> acting_;
  std::unique_ptr<Unknowns<D>> unknowns_;
  std::shared_ptr<const Part<D>> own_part_;  ///< of the unknowns, one of what acts on the beam
  Layout<D> layout_;
  mutable Spans spans_;
  std::vector<MovingPart> parts_;
  std::size_t revision_ = 0;
};

/// The mass that rides in a chain, on the beam that has just become that of the chain. Defined in rooms.cpp.
template <int D>
std::unique_ptr<LooseMass<D>> loose_mass_of_rooms(const CurrentBeam<D>& beam, const ChainState<D>& chain);

extern template class CurrentBeam<2>;
extern template class CurrentBeam<3>;

}  // namespace vlbeam
