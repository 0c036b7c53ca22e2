#pragma once

#include <functional>
#include <vector>

#include "mechanics/assembly/assembly.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

struct AssemblyStaticsOptions {
  int steps = 10;            ///< of the load factor, from 0 to 1
  bool arc_length = false;   ///< steps along the path instead, the first of that size: the factor may fall
  double tolerance = 1e-12;  ///< largest last correction: of positions over the length of the whole, and of slopes
  double length = 1;         ///< of the whole [m]
  double wave_rate = 1;      ///< of axial waves over that length [1/s]
};

/// An equilibrium of an assembly.
struct AssemblyEquilibrium {
  double factor = 0;
  Eigen::VectorXd y;            ///< a state at rest; the members' link forces are those of it
  Eigen::VectorXd multipliers;  ///< where AssemblyEquations has them among its accelerations, which are 0
  int falls = 0;                ///< directions in which the potential energy falls
  bool falls_known = false;     ///< not at the start, nor of sections with frames
};

/// Follows the equilibria of an assembly whose loads grow evenly with a load factor, which is the models' time, and
/// calls `on_point` for each of them, false from it ends the path. Newton's iteration with the tangent of
/// AssemblyEquations, plus `by_a` times the masses: what links alone hold, a member that floats without them, is held
/// by its mass until they do. by_a begins where a slack assembly falls by its own length, and falls as corrections do;
/// equilibria do not depend on it. Derived in docs/theory/assemblies.md. Throws ComputationFailed where there is none.
template <int D>
void trace_equilibria(AssemblySystem<D>& system, const AssemblyStaticsOptions& options,
                      const std::function<bool(const AssemblyEquilibrium&)>& on_point, SolverCounters& counters);

/// The lowest natural frequencies about an equilibrium [Hz], in increasing order; of a direction in which the energy
/// falls minus the rate of growth over 2 pi. By Lanczos' method on (K + s M)^-1 M: O(N) a step. Throws
/// ComputationFailed where the assembly has no mass matrix of its own (frames).
template <int D>
std::vector<double> natural_frequencies(AssemblySystem<D>& system, const AssemblyStaticsOptions& options,
                                        const AssemblyEquilibrium& at, int count);

}  // namespace vlbeam
