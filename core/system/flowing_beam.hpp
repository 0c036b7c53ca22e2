#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/beam/chain_mass.hpp"
#include "core/beam/mesh_motion.hpp"
#include "core/beam/support.hpp"
#include "core/dynamics/integrate.hpp"
#include "core/element/driven_tangent.hpp"
#include "core/geometry/axis.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/parts/loads.hpp"
#include "core/parts/spin.hpp"
#include "core/system/observation.hpp"
#include "core/system/ramp_work.hpp"

namespace vlbeam {

/// What holds the axis at a node, through which the beam may flow.
template <int D>
struct NodeSupport {
  int node;
  Support<D> support;
};

/// What a flowing beam is made of and which choices its equations follow.
template <int D>
struct FlowingModel {
  BeamSection section;
  std::optional<SpinModel> spin;  ///< without it there is no angle at all
  RotaryInertia<D> rotary = {};   ///< needs the variational formulation and frozen weights
  Formulation formulation = Formulation::variational;
  WeightTransport transport = WeightTransport::frozen;
  int quadrature_points = 5;
  Vec<double, D> gravity = Vec<double, D>::Zero();  ///< [m/s^2]
  double gravity_ramp = 0;                          ///< time over which it grows smoothly [s]
  MeshMotion motion;
  std::vector<WeightFunction> weights = {};  ///< one an element; none for unit weights
  std::vector<NodeSupport<D>> supports = {};
  Loads<D> loads = {};
  /// What the nodes of the rest shape follow, by arc length; null for a straight, unstrained one.
  std::shared_ptr<const Axis<D>> rest = nullptr;
  bool ledger = false;  ///< the state counts all that is supplied, not just what is dissipated
};

template <int D>
class ImplicitFlow;

/// A beam whose nodes move along it as prescribed: a load that travels, a stem that is fed through its guides, a span
/// that is only what lies between two supports at any time. Every element is a variable-length one.
/// State y = (q, q', tallies): q holds the nodes, position and slope each, then with spin the angle of each node (and
/// its twist, if it is cubic).
///
/// Matter comes in through the ends with the velocity it has there: where an end is free to move the momentum flux
/// belongs to the forces on it.
template <int D>
class FlowingBeam final : public EventedOde {
 public:
  using Vector = Vec<double, D>;
  using Components = typename Support<D>::Components;

  /// Throws InvalidInput where the model makes no sense: nodes that do not exist, elements of no length at t = 0,
  /// an angle that is driven twice, a torque without spin, supports with oblique frames of their own.
  explicit FlowingBeam(const FlowingModel<D>& model);
  ~FlowingBeam() override;

  Eigen::Index size() const override { return 2 * coordinates() + tallies().count(); }
  Tallies tallies() const {
    return model_.ledger ? Tallies{true, true, true, false, D} : Tallies{.dissipated = damped()};
  }
  std::vector<FieldRun> fields() const override;
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override;
  /// Not there: throws InvalidInput.
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;
  std::unique_ptr<SecondOrderSystem> new_second_order() override;
  Guards guards(const Eigen::VectorXd& y, double t) const override;
  void handle_event(int index, Eigen::VectorXd& y, double t) override;
  void sample(const Eigen::VectorXd& y, double t) override {
    if (on_sample) on_sample(y, t);
  }
  bool proceed(const Eigen::VectorXd& y, double t) override {
    if (ramp_.due(t)) {
      const Observation<D> seen = observe(y, t);
      ramp_.advance(t, {seen.mass_moment, seen.momentum});
    }
    return !on_step || on_step(t);
  }
  void exchange(Memory& memory) override {
    memory(rhs_evaluations_);
    ramp_.exchange(memory);
  }

  std::function<void(const Eigen::VectorXd& y, double t)> on_sample;
  std::function<bool(double t)> on_step;

  const FlowingModel<D>& model() const { return model_; }
  int elements() const { return model_.motion.last(); }
  int nodes() const { return elements() + 1; }
  Eigen::Index coordinates() const { return nodal_ + (spin_ ? spin_->coordinates() : 0); }
  /// How the section turns; null if it does not.
  const Spin* spin() const { return spin_ ? &*spin_ : nullptr; }
  /// Where the angle of a node stands among the coordinates.
  Eigen::Index angle(int node) const { return nodal_ + spin_->angle(node); }

  /// Throws InvalidInput, with the time, where the prescribed nodes tangle in [0, until], or a load is beyond the ends.
  /// A run ends where they do at the latest, with ComputationFailed.
  void check_motion(double until) const;
  /// The beam along a straight line at time t, from `start` in the unit direction `along`, stretched by `stretch`; its
  /// material moves at `velocity` along the line, and spins at `spin` [rad/s] from the angle zero.
  Eigen::VectorXd straight_state(const Vector& start, const Vector& along, double stretch, double velocity, double spin,
                                 double t = 0) const;

  /// Energies, mass, momenta and length, summed with `points` Gauss points an element; strains only where they are
  /// asked for.
  Observation<D> observe(const Eigen::VectorXd& y, double t, int points, bool strains = false) const;
  /// The same by the model's own points.
  Observation<D> observe(const Eigen::VectorXd& y, double t) const { return observe(y, t, model_.quadrature_points); }
  /// All that has been supplied since the start, if the model has a ledger.
  Tally ledger(const Eigen::VectorXd& y) const { return tallies().of(y); }
  /// By the accelerations that belong to the state.
  OuterForces<D> forces(const Eigen::VectorXd& y, double t);
  /// Mesh and motion at state y, at time t.
  ChainState<D> chain(const Eigen::VectorXd& y, double t) const;
  /// Material coordinates of the nodes at time t.
  std::vector<Prescribed> nodes_at(double t) const;
  /// Position of the material point x at time t, which must lie between the end nodes.
  Vector position_at(const Eigen::VectorXd& y, double t, double x) const;
  /// Where the concentrated loads are.
  std::vector<Vector> load_places(const Eigen::VectorXd& y, double t) const;
  /// Weights of an element between `nodes`.
  Weights<double> weights_at(std::size_t element, const std::vector<Prescribed>& nodes) const;
  std::size_t rhs_evaluations() const { return rhs_evaluations_; }

 private:
  friend class ImplicitFlow<D>;

  void check_model() const;
  void adopt_supports();
  /// The rest shape of element k between the nodes as they are, if it is not straight and unstrained.
  std::optional<RestElement<D>> rest_of(int k) const;
  bool damped() const { return model_.section.damped() || (model_.spin && model_.spin->section.damping != 0); }
  MovingCoordinates<double, D> axis_of(const double* q, int k, double Prescribed::*x) const;
  ChainView<D> view(const double* q, const double* rate) const {
    return {.mesh = mesh_, .transport = model_.transport, .q = q, .rate = rate, .marks = &nodes_};
  }
  MovingLaw<D> law(double t) const;
  const WeightFunction& weights(int k) const { return mesh_.weights[static_cast<std::size_t>(k)]; }
  /// Fills `nodes_` and `elements_`; false where the elements tangle.
  bool evaluate(const double* q, const double* rate, double t);
  /// Adds M a - Q of the elements' axis, a the accelerations of the coordinates.
  void add_residual(const double* a, double* r) const;
  /// Throws ComputationFailed where a load is beyond the ends of the beam.
  void check_reach(double t) const;
  /// Adds the momentum that comes in with the matter at the end nodes.
  void add_inflow(const double* q, const double* rate, double* f) const;
  /// Momentum conjugate to the slope at an end, of rotary inertia [kg m/s].
  Vector rotary_momentum(const double* q, const double* rate, int k) const;
  double dissipation() const;
  /// Solves M a = f in place; false where the mass matrix is singular.
  bool solve_mass(double* f);
  /// What is supplied in a second at the accelerations `a`, of what was evaluated last.
  Tally supplied(const double* q, const double* rate, const double* a, double t);

  FlowingModel<D> model_;
  Mesh mesh_;
  Eigen::Index nodal_;
  double reference_length_;                      ///< [m], of an element at t = 0
  std::vector<std::array<Components, 2>> free_;  ///< of position and slope, in the frame
  Eigen::Matrix<double, D, D> frame_ = Eigen::Matrix<double, D, D>::Identity();
  bool aligned_ = true;
  std::vector<ShapeTabulation> tables_;
  mutable std::vector<Prescribed> nodes_;
  std::vector<MovingEquations<double, D>> elements_;
  std::vector<RotaryElement> rotary_;
  mutable std::optional<Spin> spin_;
  ChainMass<D> mass_;
  Eigen::VectorXd still_;               // no accelerations
  Eigen::VectorXd residual_, scratch_;  // of what is supplied
  std::vector<double> on_marks_;
  RampWork<D> ramp_;
  std::size_t rhs_evaluations_ = 0;
};

extern template class FlowingBeam<2>;
extern template class FlowingBeam<3>;

}  // namespace vlbeam
