#pragma once

#include <algorithm>

#include "core/dynamics/memory.hpp"

namespace vlbeam {

/// How long steps stay shorter than asked, once Newton's iteration has failed: longer and longer where it fails again.
/// Steps that were whole again at once would fail at once where stiff modes are excited, and excite them further.
class ShorterSteps {
 public:
  /// [s], of the next step, where one of `whole` is asked for.
  double longest(double whole) const { return left_ > 0 ? std::min(whole, solvable_) : whole; }

  /// A step failed, and `half` of it is tried next.
  void failed(double half) {
    solvable_ = half;
    if (!failed_) wait_ = std::clamp(2 * wait_, least_wait, most_wait);  // halvings in a row are one failure
    failed_ = true;
    left_ = wait_;
  }
  /// A step was taken: after some of them twice the length is tried, up to `whole`.
  void taken(double whole) {
    failed_ = false;
    if (left_ == 0 || --left_ > 0) return;
    if (solvable_ < whole) {
      solvable_ *= 2;
      left_ = wait_;
    } else {
      wait_ = 0;
    }
  }

  void exchange(Memory& memory) {
    memory(solvable_);
    memory(failed_);
    memory(wait_);
    memory(left_);
  }

 private:
  static constexpr int least_wait = 4, most_wait = 64;  // steps

  bool failed_ = false;  ///< the last step did
  double solvable_ = 0;  ///< [s], for so many steps:
  int left_ = 0;
  int wait_ = 0;  ///< steps of one length, before a longer one is tried
};

}  // namespace vlbeam
