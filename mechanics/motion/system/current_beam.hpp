#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "mechanics/motion/system/beam_elements.hpp"
#include "mechanics/motion/system/loose_mass.hpp"
#include "mechanics/motion/system/supports.hpp"
#include "mechanics/motion/system/unknowns.hpp"

namespace vlbeam {

/// A beam as it is between two events: its mesh, its joints, what holds it and what acts on it, and where all of it
/// stands in a state y = (q, q', balance). q holds the nodes (position and slope each), x_i of the joints, the slopes
/// behind those that are kinked, and the positions of masses that have left; or x of a mass that rides inside an end
/// element; then the angles of a section that spins, at the nodes that there were at t = 0: joints and what they do to
/// the mesh leave them alone; where all nodes travel, at these. The last are those of BeamModel::balance(). What a
/// support drives stands in the state too, but is read from its motion, wherever it counts, and so is where a nut is,
/// from the angles.
template <int D>
class CurrentBeam : public BeamElements<D> {
 public:
  using Vector = Vec<double, D>;
  using BeamElements<D>::coordinates;
  using BeamElements<D>::gravity;
  using BeamElements<D>::guided;
  using BeamElements<D>::kinked;
  using BeamElements<D>::view;

  /// `chain` is the initial state; its joints, inner nodes, must be those of the model. A single mass may ride inside
  /// an end element instead.
  CurrentBeam(const BeamModel<D>& model, const ChainState<D>& chain);
  CurrentBeam(const CurrentBeam&) = delete;
  CurrentBeam& operator=(const CurrentBeam&) = delete;

  /// Counts the meshes there have been.
  std::size_t revision() const { return revision_; }

  /// That at time t, with the accelerations `a` or null.
  Motion<D> motion(const double* q, const double* rate, const double* a, double t) const {
    return {view(q, rate), a, t, gravity(t)};
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
  /// Writes the state of a chain whose mesh is this one; the balance, and angles of a section that spins, are those of
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
  /// What holds nodes in space.
  const Supports<D>& supports() const { return supports_; }

  /// Material coordinate of a joint on the beam: an event will find a guided one where it is to be, not where
  /// integration has it [m].
  double mark_at(std::size_t which, const Eigen::VectorXd& y, double t) const { return mark_motion(which, y, t).x; }
  /// With its rate [m/s].
  struct MarkMotion {
    double x, rate;
  };
  MarkMotion mark_motion(std::size_t which, const Eigen::VectorXd& y, double t) const;
  /// Whether joint `index` of the model is on the beam.
  bool on_beam(int index) const { return loose_ ? index == 0 : find(index) >= 0; }
  /// Masses that have left the beam are in the state: which of the model's joints they were.
  const std::vector<int>& free_masses() const { return free_masses_; }
  /// Where the position of one of them stands.
  Eigen::Index free_mass_at(std::size_t i) const { return dofs_.free_mass(static_cast<int>(i)); }
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
  Eigen::Index angles() const { return dofs_.angle(); }

 protected:
  using BeamElements<D>::dofs_;
  using BeamElements<D>::find;
  using BeamElements<D>::joints_;
  using BeamElements<D>::mesh_;
  using BeamElements<D>::model_;
  using BeamElements<D>::places_;
  using BeamElements<D>::prescribed_;
  using BeamElements<D>::rest_;
  using BeamElements<D>::spans_;

 private:
  using typename BeamElements<D>::Joint;

  void adopt_joints(const ChainState<D>& chain);
  /// Puts where the joints are, and how they move, into a state.
  void write_joints(const ChainState<D>& chain, Eigen::VectorXd& y) const;

  std::vector<int> free_masses_;  ///< which of the model's joints have left the beam
  std::unique_ptr<LooseMass<D>> loose_;
  Supports<D> supports_;
  std::vector<std::shared_ptr<const Part<D>>> acting_;
  std::unique_ptr<Unknowns<D>> unknowns_;
  std::shared_ptr<const Part<D>> own_part_;  ///< of the unknowns, one of what acts on the beam
  std::size_t revision_ = 0;
};

/// The mass that rides in a chain, on the beam that has just become that of the chain. Defined in rooms.cpp.
template <int D>
std::unique_ptr<LooseMass<D>> loose_mass_of_rooms(const CurrentBeam<D>& beam, const ChainState<D>& chain);

extern template class CurrentBeam<2>;
extern template class CurrentBeam<3>;

}  // namespace vlbeam
