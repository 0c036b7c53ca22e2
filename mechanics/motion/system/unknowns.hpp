#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/joint/sliding_joint.hpp"
#include "mechanics/motion/parts/part.hpp"
#include "mechanics/motion/system/observation.hpp"
#include "mechanics/time/energy_balance.hpp"
#include "mechanics/time/fields.hpp"

namespace vlbeam {

/// The tangent of unknowns behind those of nodes and joints, which couple to these as Unknowns says. Each view of the
/// equations has its own.
template <int D>
class UnknownsTangent {
 public:
  virtual ~UnknownsTangent() = default;

  /// Puts the equations of what is driven or tied in place of theirs, in a residual r; `free` tells of a residual
  /// without what holds.
  virtual void constrain(const double* q, const double* v, const double* a, double t, double* r) const = 0;
  /// Assembles and factors it, and takes what is tied out of the beam's own, with `size` in its place; false where it
  /// is singular.
  virtual bool prepare(const TangentWeights& by, double size, BeamMatrix<D>& beam) = 0;
  /// Whether complete() has to be called.
  virtual bool ties() const = 0;
  /// Once the beam's is factored; `free` is the residual without what holds.
  virtual void complete(const double* q, const double* v, const double* free, const BeamMatrix<D>& beam) = 0;
  /// Solves in place, before and after the beam's has solved for all else.
  virtual void solve_before(double* r) = 0;
  virtual void solve_after(double* r) const = 0;
  /// Assembled with weights `by`, before anything is driven, dense.
  virtual void expand(const TangentWeights& by, Eigen::MatrixXd& dense) = 0;
};

/// Unknowns of a feature that stand behind those of nodes and joints, such as angles of sections. They are eliminated
/// before joints are solved for, and couple these through their material coordinates, some of which may be tied to
/// them. Arrays are whole ones, like q.
template <int D>
class Unknowns {
 public:
  virtual ~Unknowns() = default;

  virtual Eigen::Index count() const = 0;
  /// Whether there is one a node of the mesh, an angle that supports may hold: it stands in the beam's own tangent, and
  /// what acts on it is a part.
  virtual bool of_nodes() const { return false; }
  virtual std::shared_ptr<const Part<D>> part() const { return nullptr; }
  /// Appends what they are; they stand from `first` on.
  virtual void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const = 0;
  /// The beam becomes that of a chain: before anything else of it stands, and after.
  virtual void take(const ChainState<D>& /*chain*/) {}
  virtual void adopt() {}
  /// Writes them, and their rates, at t = 0, where all else is in the arrays.
  virtual void start(double* q, double* rate) = 0;
  /// Writes them as they stand in a chain, or as they stood in the state before, the first of them and the first of
  /// their rates; null where there is none.
  virtual void write(const ChainState<D>& chain, const double* old_q, const double* old_rate, double* q,
                     double* rate) const = 0;
  /// Completes a chain that has all else.
  virtual void read(const double* /*q*/, const double* /*rate*/, ChainState<D>& /*chain*/) const {}
  /// A path of equilibria has come to q: what they are counted from may follow.
  virtual void settle(const double* /*q*/) {}
  /// Writes or reads what they are counted from.
  virtual void exchange(Archive& /*memory*/) {}
  /// Nodes travel, and are elsewhere.
  virtual void move() {}

  /// Whether they prescribe the material coordinate of a joint on the beam.
  virtual bool ties(std::size_t /*joint*/) const { return false; }
  struct Tied {
    double x = 0, rate = 0;
  };
  /// Where that joint is by them, and how fast; q has a first guess.
  virtual Tied tied(std::size_t /*joint*/, const double* /*q*/, const double* /*rate*/) const { return {}; }

  /// Writes their accelerations in place of their forces, as if nothing were tied, and adds the power lost [W]; false
  /// where there are none.
  virtual bool accelerate(const double* q, const double* rate, double t, double* a, double& dissipated) = 0;
  /// Adds what they are to joints: inertia and force along the beam. False where there is no solution.
  virtual bool load(const double* q, const double* rate, double* a, std::vector<JointMotion<D>>& joints) = 0;
  /// Corrects their accelerations by those of all else.
  virtual void follow(const double* q, const double* rate, double* a) = 0;
  /// Whether they tie joints to each other, and the inertia on the one against x'' of the other [kg].
  virtual bool couples_joints() const { return false; }
  virtual double coupling(std::size_t /*on*/, std::size_t /*by*/) const { return 0; }
  /// Whether energy comes in through them, beside their part.
  virtual bool supplied() const { return false; }
  /// Powers of what acts on them, but for what flows in: after follow(), or, where `free` is not null, by a residual
  /// without what holds.
  virtual EnergyBalance power(const double* /*q*/, const double* /*rate*/, const double* /*a*/, double /*t*/,
                              const double* /*free*/) {
    return {};
  }

  /// Adds M a - Q, but for their part, before anything is driven or tied; returns the power lost [W].
  virtual double residual(const double* q, const double* v, const double* a, double t, double* r) = 0;
  /// Writes M a, and of what is driven a itself, where they have a tangent of their own.
  virtual void inertia(const double* /*a*/, double* /*r*/) const {}
  /// Null where they stand in the beam's own.
  virtual std::unique_ptr<UnknownsTangent<D>> new_tangent() { return nullptr; }

  /// Adds their energies and momenta, by `points` points an element.
  virtual void observe(const double* q, const double* rate, int points, Observation<D>& seen) const = 0;
  /// Their angular momentum, of bodies that turn beside their points [kg m^2/s].
  virtual Vec<double, 3> momentum(const double* /*q*/, const double* /*rate*/) const { return Vec<double, 3>::Zero(); }
  /// Adds what drives them, and guides what is tied, by a residual `free` of what holds.
  virtual void observe_forces(const double* /*q*/, const double* /*v*/, const double* /*free*/,
                              OuterForces<D>& /*forces*/) const {}
};

}  // namespace vlbeam
