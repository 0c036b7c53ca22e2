#include "tools/progress.hpp"

#include <unistd.h>

#include <cmath>
#include <iostream>
#include <utility>

namespace vlbeam {

void TimeLeft::seen(double now, double fraction) {
  if (!first_) first_ = {now, fraction};
  marks_.push_back({now, fraction});
  const double half = (first_->time + now) / 2;
  while (marks_.size() > 1 && marks_[1].time <= half) marks_.pop_front();
}

std::optional<double> TimeLeft::estimate() const {
  if (marks_.empty()) return {};
  const Mark& now = marks_.back();
  for (const Mark& since : {marks_.front(), *first_}) {  // several runs at once end in fits and starts
    const double done = now.fraction - since.fraction;
    if (done > 0) return (now.time - since.time) * (1 - now.fraction) / done;
  }
  return {};
}

Progress::Progress(std::string title) : title_(std::move(title)), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  constexpr const char* erase_line = "\r\033[K";
  if (terminal_ && shown_ != Clock::time_point{}) std::cerr << erase_line << std::flush;
}

void Progress::show(double fraction, const std::string& detail) {
  shown_ = Clock::now();
  const double elapsed = std::chrono::duration<double>(shown_ - start_).count();
  std::cerr << '\r' << title_ << ": " << static_cast<int>(100 * fraction) << " %, " << detail;
  left_.seen(elapsed, fraction);
  const auto left = left_.estimate();
  if (left && elapsed > 1) std::cerr << ", about " << duration_text(*left) << " left";
  std::cerr << "\033[K" << std::flush;
}

std::string duration_text(double seconds) {
  const auto total = std::lround(seconds);
  if (total < 60) return std::to_string(total) + " s";
  if (total < 3600) return std::to_string(total / 60) + " min " + std::to_string(total % 60) + " s";
  return std::to_string(total / 3600) + " h " + std::to_string(total % 3600 / 60) + " min";
}

}  // namespace vlbeam
