#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/motion/system/accelerations.hpp"
#include "mechanics/motion/system/beam_links.hpp"
#include "mechanics/motion/system/beam_mass.hpp"
#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/motion/system/event_source.hpp"
#include "mechanics/motion/system/observation.hpp"
#include "mechanics/motion/system/ramp_work.hpp"
#include "mechanics/motion/system/velocity_transfer.hpp"
#include "mechanics/time/constrained_system.hpp"
#include "mechanics/time/integrate.hpp"

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
  bool conserved;        ///< false: energy and momenta were to be as before, and the energy is not
  Eigen::VectorXd
      momentum_jump;            ///< linear, then angular about the origin, by the model's own rule; not of a separation
  ChainState<D> before, after;  ///< beyond LengthControl::most_whole elements the part around the joint
  int given_way = 0;            ///< iterations until nodes had given way
  double seconds;               ///< wall time spent
};

template <int D>
class ImplicitBeam;

/// One beam with, possibly, joints that slide on it and may leave it, as equations with events: the beam as it is
/// between two events, its accelerations, and what an event makes of both.
template <int D>
class BeamSystem final : public EventedOde, public CurrentBeam<D> {
  using Beam = CurrentBeam<D>;

 public:
  using Vector = Vec<double, D>;
  using Beam::coordinates;
  using Beam::dofs;
  using Beam::has_joint;
  using Beam::joint;
  using Beam::joint_index;
  using Beam::mesh;
  using Beam::model;
  using Beam::places;

  /// `chain` is the initial state, but for the velocity of driven supports; its joints, inner nodes, must be those of
  /// the model. A single mass may ride inside an end element instead. Throws ModelError for moving supports with
  /// conservative velocities at events.
  BeamSystem(const BeamModel<D>& of, const ChainState<D>& chain);
  ~BeamSystem() override;

  Eigen::Index size() const override { return dofs().state(); }
  std::vector<FieldRun> fields() const override { return dofs().fields(Beam::unknowns()); }
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override { accelerations_.rates(y, dydt, t); }
  Guards guards(const Eigen::VectorXd& y, double t) const override;
  void handle_event(int index, Eigen::VectorXd& y, double t) override;
  void sample(const Eigen::VectorXd& y, double t) override;
  /// Explicit methods drift from what links hold of material points, and are brought back where `corrects` says so.
  void correct(Eigen::VectorXd& y, double t) override;
  bool corrects = false;
  bool proceed(const Eigen::VectorXd& y, double t) override {
    check_order(y, t);
    if (ramp_.due(t)) ramp_.advance(t, moment(y, t));
    if (on_state) on_state(y, t);
    return !on_step || on_step(t);
  }
  /// The beam becomes that of a chain, and all that depends on it follows.
  void take(const ChainState<D>& chain);
  ChainState<D> chain_of(const Eigen::VectorXd& y, double t) const { return Beam::chain(y, t); }
  std::string fastest(const Eigen::VectorXd& y) const override;
  void exchange(Archive& memory) override;

  std::function<void(const Eigen::VectorXd& y, double t)> on_sample;
  std::function<void(const EventRecord<D>&)> on_event;
  std::function<void(const Eigen::VectorXd& y, double t)> on_state;  ///< after each step, before on_step
  std::function<bool(double t)> on_step;

  Eigen::VectorXd initial_state() const { return initial_; }
  /// The same, for who asks last: it is not kept.
  Eigen::VectorXd release_initial_state() { return std::move(initial_); }
  /// The equations between two events.
  Accelerations<D>& accelerations() { return accelerations_; }
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;
  /// A view of the equations for whoever needs one for a moment: another call may factor another matrix in it.
  ConstrainedSystem* second_order();
  std::unique_ptr<SecondOrderSystem> new_second_order() override;
  /// By the accelerations that belong to the state.
  OuterForces<D> forces(const Eigen::VectorXd& y, double t);
  /// Without accelerations, at a state at rest, with the forces of its links: see OuterForces::links.
  OuterForces<D> forces_at_rest(const Eigen::VectorXd& y, double t, const Eigen::VectorXd& of_links = {});
  /// Evaluations of the equations, as accelerations or as a residual.
  std::size_t rhs_evaluations() const { return accelerations_.evaluations(); }
  /// Those of blocks and rooms, then what rests against each other.
  const BeamLinks<D>& links() const { return links_; }
  /// Energies, momenta and length, summed with `points` Gauss points an element, or own_points; strains only where they
  /// are asked for.
  Observation<D> observe(const Eigen::VectorXd& y, double t, int points, bool strains = false) const;

 private:
  void adopt_parts();
  /// Brings positions and velocities back to what links hold of material points.
  void come_back_to_links(Eigen::VectorXd& y, double t);
  /// Throws ComputationFailed where joints are no longer in their order along the beam: events have to prevent it.
  void check_order(const Eigen::VectorXd& y, double t) const;
  /// What events of the mesh may change of a beam with one joint.
  BeamPart part_around_joint() const;
  std::vector<EventRecord<D>> records_of(const std::vector<PendingEvent>& dues, const BeamPart& part,
                                         const Eigen::VectorXd& y, double t);
  EventReach reach_of(const std::vector<PendingEvent>& dues, const BeamPart& part) const;
  /// What an event changes, and of what it has to be told: that of PendingEvent, and
  struct EventScope {
    bool observes_all, always_transfers, keeps_momenta, goes_on;
    bool transfers;            ///< velocities follow from those of the mesh before,
    bool conserves;            ///< and keep the energy
    bool is_local;             ///< it looks at, and changes, the part of the beam around its joint alone
    bool changes_nodes_alone;  ///< the rest of the state stays as it is
    BeamPart part;
    EventReach reach;
  };
  EventScope scope_of(const std::vector<PendingEvent>& dues) const;
  /// Nothing holds the joint of a beam that has one, nor drives anything: around it velocities may be any.
  bool has_free_joint() const;
  struct BeforeEvent {
    /// By the ledger's points and by the model's, as far as they are looked at; of a part, `own` is its kinetic energy.
    Energy energy, own;
    Eigen::VectorXd momenta;
    double work = 0;  ///< of supports [J]
  };
  BeforeEvent look_before(const EventScope& scope, const Eigen::VectorXd& y, double t);
  /// Makes of the chain of the first record what the events make of it.
  void change_chain(EventSource<D>& source, const std::vector<PendingEvent>& dues, const EventScope& scope,
                    std::vector<EventRecord<D>>& records, Eigen::VectorXd& y, double t);
  /// Gives the new mesh in `y` the velocities of the beam before, of the state old_, and does what else an event does
  /// to them.
  void change_velocities(const EventScope& scope, const BeforeEvent& before, EventRecord<D>& record, Eigen::VectorXd& y,
                         double t);
  /// Writes what energies and momenta jump by.
  void book_jumps(const EventScope& scope, const BeforeEvent& before, EventRecord<D>& record, const Eigen::VectorXd& y,
                  double t);
  /// Tells of the events, of which the first record holds what happened.
  void tell(std::vector<EventRecord<D>>& records) const;
  typename RampWork<D>::Moment moment(const Eigen::VectorXd& y, double t) const {
    const Observation<D> seen = observe(y, t, own_points);
    return {seen.mass_moment, moment_rate(seen, y)};
  }
  /// Rate of the first moment of mass: the momentum, and what is fed into the beam.
  Vector moment_rate(const Observation<D>& seen, const Eigen::VectorXd& y) const {
    return seen.momentum + model().section.rhoA * Beam::view(y.data(), y.data() + coordinates()).entering();
  }

  BeamLinks<D> links_;
  BeamMass<D> mass_;
  Accelerations<D> accelerations_;
  VelocityProjection<D> velocities_;
  std::optional<LocalConservation<D>> conservation_ = local_conservation_of_rooms<D>();
  EventSources<D> sources_;
  ChainState<D> spare_chain_;  ///< memory for the next event
  Eigen::VectorXd old_;        ///< the state before the last event
  RampWork<D> ramp_;
  Eigen::VectorXd initial_;
  std::unique_ptr<ImplicitBeam<D>> implicit_;
};

extern template class BeamSystem<2>;
extern template class BeamSystem<3>;

}  // namespace vlbeam
