#pragma once

#include <algorithm>

#include "mechanics/time/archive.hpp"
#include "mechanics/time/newton_stop.hpp"

namespace vlbeam {

inline constexpr int tangent_work = 4;  // iterations, that take as long as a tangent and its factor

/// Whether a step of Newton's iteration starts with the tangent of the step before, or makes its own. Where a tangent
/// that was kept proves useless in the very next step, tries become rare: stiff beams of fine meshes turn by more in a
/// step than any tangent bears.
class KeptTangent {
 public:
  /// The next step makes its own.
  bool is_old() const { return old_; }

  /// A step started with its own, and its slowest contraction [-] was that.
  void made(double slowest) {
    served_ = false;
    if (waits_ > 0) --waits_;
    old_ = waits_ > 0 || (slowest > fast_contraction && slowest < slow_contraction);
  }
  /// A step started with the one before's, and went on with it, or had to make its own on the way.
  void kept(int iterations, bool renewed) {
    old_ = !renewed && iterations >= tangent_work;
    if (!renewed && !old_) {
      served_ = true;
      wait_ = 0;
      return;
    }
    wait_ = served_ ? 0 : std::clamp(2 * wait_, 1, longest_wait);
    waits_ = wait_;
    old_ = old_ || waits_ > 0;
    served_ = false;
  }

  void exchange(Archive& memory) {
    for (bool* answer : {&old_, &served_}) memory(*answer);
    for (int* number : {&wait_, &waits_}) memory(*number);
  }

 private:
  static constexpr double fast_contraction = 1e-3;  // with the step's own: the next step may keep it
  static constexpr int longest_wait = 32;           // steps

  bool old_ = false;
  bool served_ = false;  ///< for a whole step, since it was made
  int wait_ = 0;         ///< steps that make their own before the next try
  int waits_ = 0;        ///< so many of them are left
};

}  // namespace vlbeam
