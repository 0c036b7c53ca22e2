#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace vlbeam {

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
};

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace vlbeam
