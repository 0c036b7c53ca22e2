#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

// Equilibria of a beam whose loads and displacements of supports grow evenly with a load factor, which is the model's
// time: r(q, f) = -Q(q, f) = 0, with r linear in f at given q. What slides on it keeps its material coordinate while
// the load factor grows, or has the one that a guide gives it, and may then be released.

struct EquilibriumOptions {
  int steps = 10;           ///< of the load factor, from 0 to 1
  bool arc_length = false;  /// steps along the path instead, the first of that size
  double tolerance = 1e-12;
  bool release = true;  ///< what slides is free in the last equilibrium
  /// Of one that stays held: the slopes at its kink meet their conditions as they will once it is free.
  bool conditions_at_held = false;
};

/// What slides finds no place where nothing needs to hold it.
class NotBalanced : public ComputationFailed {
 public:
  NotBalanced(const std::string& message, int of, double lacks)
      : ComputationFailed(message, 1), joint(of), force(lacks) {}

  int joint;     ///< of the model's
  double force;  ///< along the beam, that would have to hold it where the search ends [N]
};

/// A point on the path of equilibria.
struct Equilibrium {
  double factor = 0;
  Eigen::VectorXd y;                 ///< a state at rest
  int negative_pivots = 0;           ///< of the tangent: directions in which the potential energy falls
  int hidden_pivots = 0;             ///< directions of which rounding hides whether it falls
  Eigen::VectorXd multipliers = {};  ///< of the conditions on the slopes of a kinked joint
  Eigen::VectorXd links = {};        ///< forces of its links: see OuterForces [N]
  bool joint_held = true;            ///< joints that nothing guides keep their material coordinates
  std::vector<double> holding = {};  ///< what it takes for that, or for the guide, along the beam: of each joint [N]
  double holding_force = 0;          ///< of the first joint that nothing guides

  bool stable() const { return negative_pivots == 0; }
};

/// Follows the path from the initial state and calls `on_point` for every point of it, false from it ends the path. The
/// initial state comes first where it is an equilibrium. Newton's iteration with the exact tangent; steps it does not
/// solve are halved. A start that holds no load (a slack cable) is first relaxed: steps (K + mu M) dq = -r, mu falling,
/// go down the potential energy to a stable equilibrium; of a rope, forces along it that are unknowns of their own lead
/// there (FreeTension), and so they do on steps that Newton's iteration does not solve. Throws ComputationFailed, at
/// the factor reached, where there is none, naming the direction in which the beam moves freely. At load factor 1 a
/// joint that is alone in having no guide is released by moving its material coordinate x: the force that holds it
/// there is a function of x, followed in steps from where the joint is, downhill, to where it vanishes, through the
/// system's length control. Each step is a point of the path; the last one solves for x, too. Several are released
/// together: those of a rope slide downhill (JointsDescent), else the forces that hold them fall in proportion to 1 -
/// s, and s goes from 0 to 1 along the path that this makes. Throws NotBalanced where the beam slides on in a ring.
template <int D>
void trace_equilibria(BeamSystem<D>& system, const EquilibriumOptions& options,
                      const std::function<bool(const Equilibrium&)>& on_point, SolverCounters& counters);

/// The lowest natural frequencies about an equilibrium [Hz], in increasing order; of a direction in which the energy
/// falls minus the rate of growth over 2 pi. What slides on the beam does so in them unless it is held. Dense: O(n^3).
/// Throws ComputationFailed where one of them flutters, under a force that follows the beam.
template <int D>
std::vector<double> natural_frequencies(BeamSystem<D>& system, const Equilibrium& at, int count);

}  // namespace vlbeam
