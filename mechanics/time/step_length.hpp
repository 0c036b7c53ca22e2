#pragma once

#include <limits>

#include "mechanics/time/integrate.hpp"

namespace vlbeam {

/// [s], given, of a method with a fixed step; the longest one of generalized-alpha that adapts.
inline double longest_step(const IntegrationOptions& options) {
  if (!options.has_fixed_step()) return std::numeric_limits<double>::infinity();
  return options.by_generalized_alpha() ? options.generalized_alpha.step : options.step;
}

/// Counts what keeps the steps of a run from being longer.
class StepLength {
 public:
  StepLength(const IntegrationOptions& options, SolverCounters& counters)
      : counters_(counters), longest_(longest_step(options)), controls_error_(controls_error(options)) {
    after_ = usual();
  }

  /// By the method itself: Newton's iteration has `failed`, or the error is too large, where the method looks at it.
  void rejected(bool failed) { rejected(failed || !controls_error_ ? StepLimit::newton : StepLimit::error); }
  void rejected(StepLimit by) {
    ++counters_.rejected;
    ++at(counters_.rejected_by, by);
    after_ = by;
  }
  /// A step that was to be `length` long, and ended at an event or at the end of the run, or at neither.
  void accepted(double length, bool at_event, bool at_end) {
    const bool whole = at_end || length >= longest_ * (1 - slightly_longer);
    ++counters_.steps;
    ++at(counters_.limited_by, at_event ? StepLimit::events : whole ? StepLimit::given : after_);
    // who controls the error says how long the next one is; a fixed step stays short until it is whole again
    if (controls_error_ || whole) after_ = usual();
  }

  void exchange(Archive& memory) {
    auto after = static_cast<int>(after_);
    memory(after);
    after_ = static_cast<StepLimit>(after);
  }

 private:
  static std::size_t& at(StepsByLimit& counts, StepLimit limit) { return counts[static_cast<std::size_t>(limit)]; }
  static bool controls_error(const IntegrationOptions& options) {
    return !options.has_fixed_step() || (options.by_generalized_alpha() && options.generalized_alpha.adaptive);
  }
  StepLimit usual() const { return controls_error_ ? StepLimit::error : StepLimit::given; }

  SolverCounters& counters_;
  double longest_;  ///< [s]
  bool controls_error_;
  StepLimit after_;  ///< of a step that is shorter than the longest
};

}  // namespace vlbeam
