#pragma once

#include <memory>
#include <vector>

#include "core/length_control/remeshing.hpp"
#include "mechanics/motion/system/accelerations.hpp"
#include "mechanics/motion/system/event_ledger.hpp"
#include "mechanics/motion/system/event_type.hpp"
#include "mechanics/time/ode.hpp"

namespace vlbeam {

/// An event that is due, and what it does to a beam.
struct PendingEvent {
  EventType type;
  Direction direction = Direction::forward;
  std::size_t which = 0;     ///< of what its source has: of the joints on the beam, for one
  Remeshing remeshing = {};  ///< of the mesh at a joint
  int joint = 0;             ///< which of the model's
  int node = 0;              ///< of the mesh: elements around it change
  double x = 0;              ///< its joint's material coordinate [m]
  int reach = 2;             ///< elements on either side of the node whose shape it may change

  bool remeshes = false;          ///< the mesh becomes another one, and velocities follow
  bool always_transfers = false;  ///< velocities of nodes stay, but a mass gives its momentum to them
  bool observes_all = false;      ///< it changes more than the mesh around its node
  bool goes_on = false;           ///< accelerations do, through it
  bool keeps_momenta = true;      ///< what it changes of momenta is an error, and told
};

/// Where an event has cut an element and merged two.
struct Reshaped {
  int new_node = -1, merged_element = -1;  ///< -1 for none
};

/// What a source of events may look at, and change.
template <int D>
struct BeamInside {
  CurrentBeam<D>& beam;
  BeamLinks<D>& links;
  BeamMass<D>& mass;
  Accelerations<D>& accelerations;
};

/// Events of one kind: the functions of a state whose roots they are, and what they do. Each feature brings its own.
template <int D>
class EventSource {
 public:
  virtual ~EventSource() = default;

  /// After each change of the beam.
  virtual void adopt() {}
  /// Appends guards; as many and in the same order until the next event.
  virtual void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const = 0;
  /// Whether that guard asks for what is no event to tell of; it is then done.
  virtual bool settles(const Guard& /*guard*/, Eigen::VectorXd& /*y*/) { return false; }
  /// What is due where `first` of its guards has turned positive. Several at once are done as one. Throws
  /// ComputationFailed where the run cannot go on.
  virtual std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double t) const = 0;
  /// Makes of the chain what the events make of it, and of `y` where it is an impact; weights of merged elements, an
  /// entry an event.
  virtual std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain,
                                           Eigen::VectorXd& y, double t) = 0;
  /// In the chain after it.
  virtual Reshaped reshaped(const PendingEvent& /*due*/, const ChainState<D>& /*after*/) const { return {}; }

  // Of every source, at the events of all.

  /// Whether energies of more than the mesh change in any event.
  virtual bool observes_all() const { return false; }
  /// Elements on either side that are changed at least.
  virtual int reach() const { return 0; }
  /// Lets what was cut and merged change on, in the chain `after` that was `before`; returns iterations taken.
  virtual int give_way(const std::vector<Reshaped>& /*where*/, const EventReach& /*reach*/, double /*t*/,
                       const ChainState<D>& /*before*/, ChainState<D>& /*after*/) const {
    return 0;
  }
  /// Completes the chain `after` an event at the state y, that was `before`.
  virtual void complete(const ChainState<D>& /*before*/, const Eigen::VectorXd& /*y*/, ChainState<D>& /*after*/) const {
  }
  /// An event is about to change the beam.
  virtual void keep() {}
  /// Gives the new state `y` velocities that follow from those of `old`, as a remeshed beam has them.
  virtual void transfer(const Eigen::VectorXd& /*old*/, Eigen::VectorXd& /*y*/) const {}
};

template <int D>
using EventSources = std::vector<std::unique_ptr<EventSource<D>>>;

/// Those of the features that a model has. Defined beside the features, which the beam does not know: rooms.cpp.
template <int D>
EventSources<D> sources_of_rooms(const BeamInside<D>& inside);

}  // namespace vlbeam
