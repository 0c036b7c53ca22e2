#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/axis.hpp"
#include "mechanics/frames/frame_damping.hpp"
#include "mechanics/frames/frame_packs.hpp"
#include "mechanics/frames/frame_table.hpp"
#include "mechanics/frames/moving_frame_spin.hpp"
#include "mechanics/frames/section_moment.hpp"
#include "mechanics/frames/triad.hpp"
#include "mechanics/motion/parts/part.hpp"
#include "mechanics/spin/spin.hpp"
#include "mechanics/time/archive.hpp"

namespace vlbeam {

/// What frames add to a beam in space.
struct FrameModel {
  FrameSection section;
  Torques torques = {};  ///< about the tangent, which they follow
  std::vector<SectionMoment> moments = {};

  /// Whether loads turn sections.
  bool loaded() const { return torques.present() || !moments.empty(); }
};

/// Two bendings and torsion of a beam in space, with the inertia of its sections about the tangent: an angle a node.
/// Its elements stretch elsewhere. Angles stand behind the coordinates of all nodes, or where let_slide() says.
///
/// The spin of the section at a node is omega = phi' + A.s', see TriadReference, that along an element linear between
/// its ends. The kinetic energy omega^T M omega/2 so has the momenta p = M omega, and Lagrange's equations are
///   p' on phi,   A p' + p s' x C on s,   C = s/|s|^3.
/// Elements at joints are those of moving_frame.hpp: frames_at_joints.cpp.
class Frames final : public Part<3> {
 public:
  /// `rest` are the nodes of the rest shape, null for a straight one; `rest_sections` how the sections stand there,
  /// `sections` how they do at the coordinates `q`, an array of nodes.
  Frames(const FrameModel& model, const Mesh& mesh, const double* rest, const std::vector<SectionState>& rest_sections,
         const double* q, const std::vector<SectionState>& sections);
  ~Frames() override;
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  const FrameModel& model() const { return model_; }
  int nodes() const { return static_cast<int>(references_.size()); }
  Eigen::Index coordinates() const { return nodes(); }
  /// Where the angle of a node stands in an array like q.
  Eigen::Index angle(int node) const {
    return (first_angle_ < 0 ? Eigen::Index{node_size<3>} * nodes() : first_angle_) + node;
  }
  /// Nodes at these joints move along the beam; angles stand from `angles` on. At rest joints follow the curve `rest`,
  /// null for a straight beam, with sections that stand as `along` says.
  void let_slide(std::span<const JointPlace> joints, Eigen::Index angles, const Axis<3>* rest,
                 std::shared_ptr<const RestTriads> along);

  EnergyBalance add_force(const Motion<3>& motion, double* force) const override;
  double load_power(const Motion<3>& motion, double* scratch) const override;
  /// With that of the inertia.
  void add_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const override;
  /// Adds M a and what is quadratic in velocities.
  void add_inertia(const double* q, const double* rate, const double* a, double* r) const;

  /// Says of each node whether its angle is held.
  void hold(const std::vector<bool>& held) { held_ = held; }
  /// In an array of forces: keeps on slopes the part that moves the axis, and replaces torques by the accelerations of
  /// spin that they cause, 0 where the angle is `held`.
  void solve_spins(const double* q, const double* rate, double* force) const;
  /// The inertia of spins on the mark of joint `on` against x'' of joint `by` [kg], less what of it solve_spins() has
  /// eliminated.
  double mark_inertia(std::size_t on, std::size_t by) const { return mark_inertia_[on * joints_.size() + by]; }

  /// In place: makes of these, and of the accelerations of slopes, those of the angles.
  void complete(const double* q, const double* rate, double* a) const;

  /// How far tangents have turned from what angles are counted from: positive where that is due to follow.
  double turned_away(const double* q) const;
  /// Lets what angles are counted from follow; the rates of angles change, unless `rate` is null.
  void follow(const double* q, double* rate);
  void exchange(Archive& memory);
  /// Makes spins the projection of those of the frames that there were before an event, at the coordinates `was` and
  /// their rates, arrays like those of these: momentum stays, and energy does not grow.
  void project_spins(const Frames& before, const double* was, const double* was_rate, const double* q,
                     double* rate) const;

  std::vector<SectionState> sections(const double* q, const double* rate) const;
  /// How a new node at the material point x is to stand: as the element's own frame does there, turned by what that
  /// of the element at rest is off the field that nodes follow at rest.
  TriadReference section_at(const double* q, double x) const;
  /// The twist from the first node to each of these material points [rad].
  std::vector<double> twists_to(const double* q, const std::vector<double>& x) const;
  /// The spin of a section there, or of the triads that pass as a mark there moves at `x_rate`.
  double spin_at(const double* q, const double* rate, double x, double x_rate) const;
  struct Seen {
    double kinetic = 0, bending = 0, torsion = 0;      ///< [J]
    Vec<double, 3> momentum = Vec<double, 3>::Zero();  ///< angular [kg m^2/s]
    double curvature = 0;                              ///< largest, from the rest shape [1/m]

    void add(const FrameStrain<double>& bent) { curvature = std::max(curvature, portable::hypot(bent.y, bent.z)); }
  };
  Seen observe(const double* q, const double* rate) const;
  /// Moments about the section's axes y and z and about the tangent, of each element at its two Gauss points, without
  /// damping [N m].
  std::vector<std::array<FrameStrain<double>, 2>> moments(const double* q) const;

 private:
  FrameNode node(const double* q, int k) const;
  /// The twist of element k, to within half a turn [rad].
  double turned(const double* q, int k) const {
    return q[angle(k + 1)] - q[angle(k)] + between_[static_cast<std::size_t>(k)];
  }
  int elements() const { return nodes() - 1; }
  /// Which holds the material point x.
  int element_of(double x) const {
    return static_cast<int>(std::upper_bound(x_.begin() + 1, x_.end() - 1, x) - x_.begin()) - 1;
  }
  /// Calls visit(k, on A, on B) for what torques do at the ends of elements.
  template <class Visit>
  void at_torques(double t, const Visit& visit) const;
  /// Calls visit(node, moment) for the moments on sections.
  template <class Visit>
  void at_moments(const Visit& visit) const {
    for (const SectionMoment& moment : model_.moments) {
      visit(moment.node < 0 ? nodes() + moment.node : moment.node, moment);
    }
  }
  /// Adds what torques and moments do, once look() was told; returns their power [W].
  double add_loads(const Motion<3>& motion, double* force) const;
  double add_moments(const double* q, const double* rate, double t, double* force) const;
  /// Looks at all nodes and elements, for what is asked below.
  void look(const double* q) const;
  /// Whether that is where it looked last.
  bool seen(const double* q) const;
  /// The spin of a node, and its rate but for what the angle's acceleration adds.
  double spin_of(const double* rate, int k) const;
  double bent_spin_rate(const double* q, const double* rate, const double* a, int k) const;
  /// Writes M x, x and the result a number a node.
  void times_inertia(const std::vector<double>& x, std::vector<double>& result) const;
  /// The matrix of the inertia of spins, tridiagonal: from nothing, of one element, factored.
  void start_spin_matrix() const;
  void add_to_spin_matrix(std::size_t element, double share) const;
  void factor_spin_matrix() const;
  /// Writes the spins and the momenta.
  void look_at_spins(const double* rate) const;

  bool damped() const { return model_.section.damping != 0; }
  /// Element k, whose table is of length 1 where its ends may move.
  FrameDamping damping_of(const FrameTable& table, const double* q, int k) const;
  FrameVector gathered(const double* q, int k) const;
  /// Of elements between marks that move; returns the power that is lost [W].
  double add_sliding_damping(const double* q, const double* rate, double* force) const;
  void add_damping_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const;

  /// An element between marks of which one or both move.
  struct Sliding {
    int element;
    std::array<int, 2> joints;  ///< which of the joints its ends are, -1 where it is none
    FrameTable unit;            ///< of length 1
  };
  struct AtJoint {
    Eigen::Index mark = 0;         ///< where its material coordinate stands
    std::vector<double> response;  ///< of triads: what accelerates their spins with x'' [rad/m]
  };
  bool slides(int k) const { return !slides_.empty() && slides_[static_cast<std::size_t>(k)]; }
  MovingFrame element_at(const Sliding& sliding, const double* q) const;
  /// Coordinates of MovingFrame, of an array like q; of one of rates or accelerations with `still` marks that do not
  /// move.
  MovingFrameVector gathered(const Sliding& sliding, const double* q, bool still) const;
  void scatter(const Sliding& sliding, const MovingFrameVector& values, double* to) const;
  MovingFrameInertia inertia_of(const Sliding& sliding, const double* q) const;
  MovingFrameSpin<double> spin_of(const Sliding& sliding, const double* q, const double* rate) const;
  /// The parts of the functions of these names that are of such elements.
  void add_sliding_force(const double* q, double* force) const;
  void add_sliding_inertia(const double* q, const double* rate, const double* a, double* r) const;
  void add_sliding_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const;
  /// Adds their inertia to the rows of spins, and what of these knows no acceleration to the right-hand sides.
  void start_sliding_spins(const double* q, const double* rate) const;
  /// Once the triads' accelerations of spin are known, but for those that come with x'': forces on all else.
  void finish_sliding_spins(double* force) const;
  /// In place, the matrix of their inertia being factored; 0 where an angle is held.
  void solve_for_spins(std::vector<double>& x) const;

  /// The ends of element k at rest, as they are now.
  std::array<FrameRestEnd, 2> rest_ends(int k) const;
  /// Twist and inner angle of element k [rad], once look() was told.
  std::array<double, 2> angles_in(const double* q, int k) const;
  /// The spin of a section there, once look() was told.
  double spin_within(const double* q, const double* rate, double x) const;
  /// The twist of element k [rad], once look() was told.
  double twist(const double* q, int k) const;
  void observe_sliding(const double* q, const double* rate, Seen& seen) const;
  /// What torques at u of an element at joints do to marks; the power of that [W].
  double add_torque_on_marks(int k, const double* q, const double* rate, double on_a, double on_b, double* force) const;

  FrameModel model_;
  mutable std::vector<double> x_;  ///< material coordinates of nodes, where look() was told [m]
  std::vector<FrameTable> tables_;
  std::vector<Weights<double>> weights_;
  std::vector<TriadReference> references_;
  std::vector<bool> held_;
  FramePacks packs_;                                ///< of elements whose nodes rest
  mutable std::vector<FrameNode> nodes_;            ///< where look() was told
  mutable std::vector<double> looked_at_, turned_;  ///< the coordinates there; twists of elements, as turned() has them
  mutable std::vector<double> spins_, momenta_, spin_rates_, momentum_rates_, diagonal_, beside_;  ///< of nodes
  mutable std::vector<MovingFrameSpin<double>> seen_spins_;
  mutable std::vector<double> mark_inertia_, by_x_;
  Eigen::Index first_angle_ = -1;
  mutable std::vector<AtJoint> joints_;
  std::vector<int> joint_nodes_;
  std::vector<Sliding> sliding_;
  std::vector<bool> slides_;  ///< of elements; empty where none does
  const Axis<3>* rest_curve_ = nullptr;
  std::shared_ptr<const RestTriads> along_;
  std::vector<FrameRestEnd> rest_ends_;  ///< of nodes, where the beam is curved at rest
  std::vector<double> between_;  ///< of an element: its twist less the difference of its angles, when last followed
};

}  // namespace vlbeam
