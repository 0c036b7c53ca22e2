#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mechanics/time/archive.hpp"

namespace vlbeam {

/// How far a state is from its constraints C(q) = 0, the largest of all.
struct ConstraintResidual {
  double position = 0;  ///< |C| [m]
  double velocity = 0;  ///< |C_q q'| [m/s], the hidden constraint
};

/// What Newton's iterations took.
struct NewtonCounters {
  std::size_t iterations = 0;
  std::size_t tangents = 0;
  std::size_t failures = 0;         ///< steps that they did not solve
  std::vector<double> longest;      ///< corrections, relative to the increment, of the step that took most of them
  ConstraintResidual constraints;   ///< the largest of all steps
  std::vector<double> multipliers;  ///< of the last step, as the system scales them

  void exchange(Archive& memory) {
    memory(iterations);
    memory(tangents);
    memory(failures);
    memory(longest);
    memory(constraints.position);
    memory(constraints.velocity);
    memory(multipliers);
  }
};

/// What keeps a step from being longer.
enum class StepLimit {
  given,   ///< the step given, the longest one, or the end of the run
  error,   ///< the tolerance of the error
  newton,  ///< Newton's iteration, which failed in a longer one
  events,  ///< it ends at an event, or a longer one was too long for an event to be looked for in it
};
inline constexpr std::size_t step_limits = 4;
using StepsByLimit = std::array<std::size_t, step_limits>;

/// What a run took.
struct SolverCounters {
  std::size_t steps = 0;
  std::size_t rejected = 0;
  StepsByLimit limited_by{}, rejected_by{};
  std::size_t rhs_evaluations = 0;
  double smallest_step = 0;  ///< [s], of the accepted steps that no event cut short
  NewtonCounters newton;     ///< of implicit methods

  void exchange(Archive& memory) {
    memory(steps);
    memory(rejected);
    for (StepsByLimit* counts : {&limited_by, &rejected_by}) {
      for (std::size_t& count : *counts) memory(count);
    }
    memory(smallest_step);
    newton.exchange(memory);
  }
};

}  // namespace vlbeam
