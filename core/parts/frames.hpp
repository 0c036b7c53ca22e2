#pragma once

#include <vector>

#include "core/dynamics/memory.hpp"
#include "core/element/frame_table.hpp"
#include "core/element/triad.hpp"
#include "core/parts/frame_packs.hpp"
#include "core/parts/part.hpp"
#include "core/parts/spin.hpp"

namespace vlbeam {

/// What frames add to a beam in space.
struct FrameModel {
  FrameSection section;
  Torques torques = {};  ///< about the tangent, which they follow
};

/// Two bendings and torsion of a beam in space whose nodes rest, with the inertia of its sections about the tangent: an
/// angle a node, which stands behind the coordinates of all nodes. Its elements stretch elsewhere.
///
/// The spin of the section at a node is omega = phi' + A.s', see TriadReference, that along an element linear between
/// its ends. The kinetic energy omega^T M omega/2 so has the momenta p = M omega, and Lagrange's equations are
///   p' on phi,   A p' + p s' x C on s,   C = s/|s|^3.
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
  Eigen::Index angle(int node) const { return Eigen::Index{node_size<3>} * nodes() + node; }

  Tally add_force(const Motion<3>& motion, double* force) const override;
  /// With that of the inertia.
  void add_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const override;
  /// Adds M a and what is quadratic in velocities.
  void add_inertia(const double* q, const double* rate, const double* a, double* r) const;

  /// Says of each node whether its angle is held.
  void hold(const std::vector<bool>& held) { held_ = held; }
  /// In an array of forces: keeps on slopes the part that moves the axis, and replaces torques by the accelerations of
  /// spin that they cause, 0 where the angle is `held`.
  void solve_spins(const double* q, const double* rate, double* force) const;
  /// In place: makes of these, and of the accelerations of slopes, those of the angles.
  void complete(const double* q, const double* rate, double* a) const;

  /// How far tangents have turned from what angles are counted from: positive where that is due to follow.
  double turned_away(const double* q) const;
  /// Lets what angles are counted from follow; the rates of angles change, unless `rate` is null.
  void follow(const double* q, double* rate);
  void exchange(Memory& memory);

  std::vector<SectionState> sections(const double* q, const double* rate) const;
  struct Seen {
    double kinetic = 0, bending = 0, torsion = 0;      ///< [J]
    Vec<double, 3> momentum = Vec<double, 3>::Zero();  ///< angular [kg m^2/s]
    double curvature = 0;                              ///< largest, from the rest shape [1/m]
  };
  Seen observe(const double* q, const double* rate) const;

 private:
  FrameNode node(const double* q, int k) const;
  /// The twist of element k, to within half a turn [rad].
  double turned(const double* q, int k) const {
    return q[angle(k + 1)] - q[angle(k)] + between_[static_cast<std::size_t>(k)];
  }
  int elements() const { return nodes() - 1; }
  /// Calls visit(k, on A, on B) for what torques do at the ends of elements.
  template <class Visit>
  void at_torques(double t, const Visit& visit) const;
  /// Looks at all nodes and elements, for what is asked below.
  void look(const double* q) const;
  /// Whether that is where it looked last.
  bool seen(const double* q) const;
  /// The spin of a node, and its rate but for what the angle's acceleration adds.
  double spin_of(const double* rate, int k) const;
  double bent_spin_rate(const double* q, const double* rate, const double* a, int k) const;
  /// Writes M x, x and the result a number a node.
  void times_inertia(const std::vector<double>& x, std::vector<double>& result) const;
  /// Writes the spins and the momenta.
  void look_at_spins(const double* rate) const;

  FrameModel model_;
  std::vector<double> x_;  ///< material coordinates of nodes [m]
  std::vector<FrameTable> tables_;
  std::vector<TriadReference> references_;
  std::vector<bool> held_;
  FramePacks packs_;                                ///< of elements whose nodes rest
  mutable std::vector<FrameNode> nodes_;            ///< where look() was told
  mutable std::vector<double> looked_at_, turned_;  ///< the coordinates there; twists of elements, as turned() has them
  mutable std::vector<double> spins_, momenta_, spin_rates_, momentum_rates_, diagonal_, beside_;  ///< of nodes
  std::vector<double> between_;  ///< of an element: its twist less the difference of its angles, when last followed
};

}  // namespace vlbeam
