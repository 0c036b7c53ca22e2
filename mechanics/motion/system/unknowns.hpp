#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/joint/sliding_joint.hpp"
#include "mechanics/motion/system/observation.hpp"
#include "mechanics/time/fields.hpp"
#include "mechanics/time/tallies.hpp"

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

/// Unknowns of a feature that stand behind those of nodes and joints, such as angles of sections that spin. They couple
/// to all else through the material coordinates of joints alone, some of which may be tied to them. Arrays are whole
/// ones, like q.
template <int D>
class Unknowns {
 public:
  virtual ~Unknowns() = default;

  virtual Eigen::Index count() const = 0;
  /// Appends what they are; they stand from `first` on.
  virtual void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const = 0;
  /// Writes them, and their rates, at t = 0, where all else is in the arrays.
  virtual void start(double* q, double* rate) = 0;
  /// Nodes travel, and are elsewhere.
  virtual void move() {}

  /// Whether they prescribe the material coordinate of a joint on the beam.
  virtual bool ties(std::size_t joint) const = 0;
  struct Tied {
    double x, rate;
  };
  /// Where that joint is by them, and how fast; q has a first guess.
  virtual Tied tied(std::size_t joint, const double* q, const double* rate) const = 0;

  /// Writes their accelerations in place of their forces, as if nothing were tied, and adds the power lost [W]; false
  /// where there are none.
  virtual bool accelerate(const double* q, const double* rate, double t, double* a, double& dissipated) = 0;
  /// Adds what they are to joints: inertia and force along the beam. False where there is no solution.
  virtual bool load(const double* q, const double* rate, double* a, std::vector<JointMotion<D>>& joints) = 0;
  /// Corrects their accelerations by those of the joints.
  virtual void follow(double* a) = 0;
  /// Whether energy comes in through them.
  virtual bool supplied() const = 0;
  /// Powers of what acts on them, but for what flows in: after follow(), or, where `free` is not null, by a residual
  /// without what holds.
  virtual Tally power(const double* q, const double* rate, const double* a, double t, const double* free) = 0;

  /// Writes M a - Q before anything is driven or tied; returns the power lost [W].
  virtual double residual(const double* q, const double* v, const double* a, double t, double* r) = 0;
  /// Writes M a, and of what is driven a itself.
  virtual void inertia(const double* a, double* r) const = 0;
  virtual std::unique_ptr<UnknownsTangent<D>> new_tangent() = 0;

  /// Adds their energies and momenta, by `points` points an element.
  virtual void observe(const double* q, const double* rate, int points, Observation<D>& seen) const = 0;
  /// Adds what drives them, and guides what is tied, by a residual `free` of what holds.
  virtual void observe_forces(const double* q, const double* v, const double* free, OuterForces<D>& forces) const = 0;
};

template <int D>
class CurrentBeam;

/// Those of the features that a beam has, of `last` + 1 nodes at the material coordinates `x`; null without. Defined
/// beside the features: rooms.cpp.
template <int D>
std::unique_ptr<Unknowns<D>> unknowns_of_rooms(const CurrentBeam<D>& beam, const std::vector<double>& x);

}  // namespace vlbeam
