#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

/// Ends a run that does not get on, by what it has done and not by how long that took: the same run ends at the same
/// step everywhere.
class Progress {
 public:
  /// `usual` is a step that no method needs for long [s]: less than what the fastest wave takes through an element. All
  /// must outlive this object.
  Progress(double t, double t_end, double usual, const SolverCounters& counters)
      : counters_(counters), before_(so_far()), t_before_(t), t_end_(t_end), usual_(usual) {}

  /// Before a step from t is tried. Throws ComputationFailed where the last 50,000 were on average a hundredth of the
  /// usual step, and the rest of the run would take more than 1e8 of them; `where` then says what moves fastest.
  void tries(double t, const std::function<std::string()>& where) {
    if (++tries_ == window) look(t, where);
  }

 private:
  static constexpr std::size_t window = 50000;

  void look(double t, const std::function<std::string()>& where);
  /// Steps by what held them short, accepted ones and rejected ones.
  StepsByLimit so_far() const {
    StepsByLimit sum = counters_.limited_by;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += counters_.rejected_by[i];
    return sum;
  }

  const SolverCounters& counters_;
  StepsByLimit before_;  ///< when this window began
  double t_before_, t_end_, usual_;
  std::size_t tries_ = 0;
};

}  // namespace vlbeam
