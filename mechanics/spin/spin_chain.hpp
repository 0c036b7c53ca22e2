#pragma once

#include <array>
#include <vector>

#include "core/beam/block_tridiagonal.hpp"
#include "core/beam/chain_view.hpp"
#include "core/element/moving_element.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/flow/chain_mass.hpp"
#include "mechanics/flow/driven_residual.hpp"
#include "mechanics/spin/angle_field.hpp"
#include "mechanics/spin/spin_element.hpp"

namespace vlbeam {

/// The section's angle along a chain of variable-length elements: one field of one component, with the equations of the
/// axis or, where it is linear, their closed form. Coordinates are those of node 0, of node 1, ...: angle [rad] and, if
/// cubic, twist [rad/m].
class SpinChain {
 public:
  using Equations = MovingEquations<double, 1>;
  using Coordinates = MovingCoordinates<double, 1>;
  using Nodes = std::vector<Prescribed>;

  /// `driven` are the nodes whose angle is prescribed.
  SpinChain(const SpinSection& section, AngleField field, Formulation formulation, int elements, int quadrature_points,
            const std::vector<int>& driven);

  int per_node() const { return field_ == AngleField::linear ? 1 : 2; }
  int nodes() const { return static_cast<int>(free_.size()); }
  Eigen::Index coordinates() const { return Eigen::Index{per_node()} * nodes(); }
  bool driven(int node) const { return free_[static_cast<std::size_t>(node)][0][0] == 0; }
  const SpinSection& section() const { return section_; }
  const BeamRule& rule() const { return table_.rule; }

  /// Of element k, from those of the chain and the nodes' material coordinates or one of their rates.
  Coordinates local(const double* values, const Nodes& nodes, double Prescribed::*x, int k) const;
  /// Adds four entries (angle and twist at either end of element k), the twists only where they are coordinates.
  void scatter(int k, const std::array<double, 4>& entries, double* values) const;

  Equations equations(const Coordinates& q, const Coordinates& rate) const;
  /// Fills the equations of all elements.
  void evaluate(const double* q, const double* rate, const Nodes& nodes);
  /// Adds their M a - Q.
  void add_residual(const double* a, const Nodes& nodes, double* r) const;
  /// Power that they lose to damping [W].
  double dissipation() const;
  /// Solves M a = f in place; of driven angles f becomes zero.
  bool solve(double* f);
  /// The same by the factor that is there.
  void solve_again(double* f);
  /// Adds M a - Q of all elements without their equations; returns the power lost to damping [W].
  double residual(const double* q, const double* rate, const double* a, const Nodes& nodes, double* r);
  /// Adds M a of the angles and twists.
  void add_inertia(const double* a, const Nodes& nodes, double* r) const;
  /// Forces along the beam [N] that move the ends of element k as their marks move, of the last residual().
  const std::array<double, 2>& guiding_forces(int k) const { return guiding_[static_cast<std::size_t>(k)]; }
  /// Derivative of the residual of element k by angle and twist at its ends.
  Eigen::Matrix4d tangent(const Nodes& nodes, const TangentWeights& by, int k) const;

  /// What is at a point of element k: its shape functions, how its angle changes with x_A and x_B at a fixed material
  /// point, its twist [rad/m] and the spin of the matter there [rad/s]; then the angle [rad], the rate of the twist at
  /// a fixed material point and the twist's gradient along the beam [rad/m^2], and the gradients of the shape
  /// functions.
  struct Point {
    std::array<double, 4> s;
    double by_a, by_b, twist, spin, angle, twist_rate, twist_gradient;
    std::array<double, 4> s_x;
  };
  Point at(const Coordinates& q, const Coordinates& rate, double u) const;

 private:
  SpinSection section_;
  AngleField field_;
  MovingLaw<1> law_;
  ShapeTabulation table_;
  std::vector<Equations> elements_;
  std::vector<std::array<double, 2>> guiding_;
  std::vector<std::array<ChainMass<1>::Components, 2>> free_;
  ChainMass<1> mass_;
  std::vector<double> work_;  // angle and twist at each node
};

/// The tangent of a chain's angles, tridiagonal in the nodes.
class SpinTangent {
 public:
  /// Of angle and twist at each node; whoever assembles may add to it before it is factored.
  BorderedBlockTridiagonal<2> band;

  void assemble(const SpinChain& chain, const SpinChain::Nodes& nodes, const TangentWeights& by);
  /// Replaces the row of each driven angle by that of the unit matrix, times `by_a`. False if the matrix is singular.
  bool factor(const SpinChain& chain, double by_a);
  /// Solves in place.
  void solve(double* angles) const;

 private:
  bool twists_ = false;
  mutable std::vector<double> work_;
};

}  // namespace vlbeam
