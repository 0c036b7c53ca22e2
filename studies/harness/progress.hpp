#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace vlbeam {

/// One line on standard error: how far a computation is and about how long it still takes. Silent where standard error
/// is not a terminal. May be called from several threads.
class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of the work that is done, in [0, 1]; `detail` says what of ("3/20 runs").
  void update(double fraction, const std::string& detail = "");

 private:
  using Clock = std::chrono::steady_clock;

  std::string title_;
  bool terminal_;
  std::mutex mutex_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
};

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace vlbeam
