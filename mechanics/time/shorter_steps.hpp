#pragma once

#include <algorithm>

#include "mechanics/time/archive.hpp"

namespace vlbeam {

/// How long steps stay shorter than asked, once Newton's iteration has failed: no longer than that one, but longer and
/// longer where the next whole one fails again. Where stiff modes are excited, steps that were whole again at once
/// would fail at once, and excite them further.
class ShorterSteps {
 public:
  /// [s], of the next step, where one of `whole` is asked for.
  double longest(double whole) const { return left_ > 0 ? std::min(whole, solvable_) : whole; }

  /// A step failed, and `half` of it is tried next.
  void failed(double half) {
    solvable_ = half;
    if (!failed_) wait_ = whole_since_ ? 0 : std::clamp(2 * wait_, least_wait, most_wait);
    failed_ = true;  // halvings in a row are one failure
    whole_since_ = false;
    left_ = wait_;
  }
  /// A step of length h was taken, where one of `whole` was asked for.
  void taken(double h, double whole) {
    failed_ = false;
    if (h >= whole) whole_since_ = true;
    if (left_ == 0 || --left_ > 0) return;
    if (solvable_ < whole) {
      solvable_ *= 2;
      left_ = wait_;
    }
  }

  void exchange(Archive& memory) {
    memory(solvable_);
    memory(failed_);
    memory(whole_since_);
    memory(wait_);
    memory(left_);
  }

 private:
  static constexpr int least_wait = 4, most_wait = 64;  // steps

  bool failed_ = false;      ///< the last step did
  bool whole_since_ = true;  ///< a whole one has been taken since the last failure
  double solvable_ = 0;      ///< [s], for so many steps:
  int left_ = 0;
  int wait_ = 0;  ///< steps of one length, before a longer one is tried
};

}  // namespace vlbeam
