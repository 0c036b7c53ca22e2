#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace vlbeam {

/// How long the rest of some work takes, by how fast the last half of the time went: what a run has done before it was
/// interrupted cost this process nothing, and steps become longer and shorter.
class TimeLeft {
 public:
  /// A `fraction` of all work, in [0, 1], is done at the time `now` [s], which grows.
  void seen(double now, double fraction);
  /// [s]; none until something has been done.
  std::optional<double> estimate() const;

 private:
  struct Mark {
    double time, fraction;
  };
  std::optional<Mark> first_;
  std::deque<Mark> marks_;  ///< of the last half of the time
};

/// Writes one line to standard error: the part that is done, and about how long the rest takes. Silent if standard
/// error is not a terminal. Several threads may call it.
class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of the work that is done, in [0, 1]; detail(), called where it is shown, says it in words ("3/20
  /// runs").
  template <class Detail>
  void update(double fraction, const Detail& detail) {
    if (!terminal_) return;
    const std::scoped_lock lock(mutex_);
    if (Clock::now() - shown_ >= std::chrono::milliseconds(200)) show(fraction, detail());
  }

 private:
  using Clock = std::chrono::steady_clock;

  void show(double fraction, const std::string& detail);

  std::string title_;
  bool terminal_;
  std::mutex mutex_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
  TimeLeft left_;
};

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace vlbeam
