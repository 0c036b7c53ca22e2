#pragma once

#include <vector>

#include "core/length_control/event_type.hpp"
#include "core/length_control/length_control.hpp"
#include "mechanics/motion/system/accelerations.hpp"
#include "mechanics/time/ode.hpp"

namespace vlbeam {

/// What is due where a guard is positive.
struct PendingEvent {
  EventType type;
  Direction direction;
  std::size_t which;    ///< of the joints on the beam
  Remeshing remeshing;  ///< of the mesh at a joint
};

/// The functions of a state whose roots are events, and which events these are.
template <int D>
class EventGuards {
 public:
  /// All must outlive this object.
  EventGuards(const CurrentBeam<D>& beam, const BeamLinks<D>& links, const Accelerations<D>& accelerations)
      : beam_(beam), links_(links), accelerations_(accelerations) {}

  /// After each change of the beam.
  void adopt();
  Guards at(const Eigen::VectorXd& y, double t) const;
  /// Whether the guard `index` asks for no more than that frames follow.
  bool turns_away(int index, const Eigen::VectorXd& y, double t) const;
  /// The event of the guard `index`, and all others of the mesh that are due at the same instant, in their order.
  /// Throws ComputationFailed where the run cannot go on.
  std::vector<PendingEvent> due(int index, const Eigen::VectorXd& y, double t) const;

 private:
  using Contact = NodeContact<D>;

  void add_joint_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  void add_feed_guards(std::size_t which, const Eigen::VectorXd& y, double t, Guards& guards) const;
  void add_contact_guards(const Eigen::VectorXd& y, double t, Guards& guards) const;
  Guards rider_guards(const Eigen::VectorXd& y, double t) const;
  Guards travel_guards(double t) const;
  PendingEvent event_of(const Guard& guard, const Eigen::VectorXd& y) const;
  /// Neighbouring joints ask for the same cut or the same merge: one of them does it.
  void drop_doubles(std::vector<PendingEvent>& dues) const;
  /// What a joint, moving in a direction, asks for of the mesh: a cut behind it, a merge ahead.
  Remeshing wanted(std::size_t which, Direction direction, const Eigen::VectorXd& y) const;
  /// Throws ComputationFailed: nodes that travel cannot go on; joint `which` is as near the next one as joints come;
  /// that feed has drawn in what there was.
  [[noreturn]] void stop_travelling(int index, double t) const;
  [[noreturn]] void joints_met(std::size_t which, double t) const;
  [[noreturn]] void used_up(std::size_t which, double t) const;

  const CurrentBeam<D>& beam_;
  const BeamLinks<D>& links_;
  const Accelerations<D>& accelerations_;
  std::array<double, 2> end_limit_{};  ///< length of the last and of the first element where an end-merge is due [m]
  double cut_limit_ = 0;               ///< distance of a rider from the end at which it gets a node [m]
};

extern template class EventGuards<2>;
extern template class EventGuards<3>;

}  // namespace vlbeam
