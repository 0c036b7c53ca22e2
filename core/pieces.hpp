#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <numeric>
#include <vector>

namespace vlbeam {

/// Long ranges are worked on in pieces, several at once where the program has several threads (oneTBB). The range alone
/// decides which pieces there are, so that digits do not depend on threads.
inline constexpr std::ptrdiff_t long_range = 16384;     // numbers; a shorter range is not worth the call of a thread
inline constexpr std::ptrdiff_t piece_of_range = 2048;  // numbers

/// While it lives the program has no more threads at work than that; else one a processor. No effect without oneTBB.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int threads_;
};

/// Calls task(context, i) for i from 0 to `count` - 1, at once where there are threads. Nothing may be thrown.
void at_once(std::ptrdiff_t count, void (*task)(const void* context, std::ptrdiff_t i), const void* context);

/// Calls f(i) for i from 0 to `count` - 1, at once where there are threads. Nothing may be thrown.
template <class Function>
void at_once(std::ptrdiff_t count, const Function& f) {
  at_once(
      count, [](const void* context, std::ptrdiff_t i) { (*static_cast<const Function*>(context))(i); },
      std::addressof(f));
}

/// Items of a piece, each of which stands for `size` numbers, and how many pieces `count` of them make.
constexpr std::ptrdiff_t piece_of(std::ptrdiff_t size) { return std::max(std::ptrdiff_t{1}, piece_of_range / size); }
constexpr std::ptrdiff_t pieces_of(std::ptrdiff_t count, std::ptrdiff_t size) {
  return (count + piece_of(size) - 1) / piece_of(size);
}

/// Calls f(first, count) for the pieces of `count` items, each of which stands for `size` numbers. Pieces may not write
/// to the same place.
template <class Function>
void in_pieces(std::ptrdiff_t count, std::ptrdiff_t size, const Function& f) {
  if (count * size < long_range) return f(std::ptrdiff_t{0}, count);
  const std::ptrdiff_t piece = piece_of(size);
  at_once(pieces_of(count, size), [&](std::ptrdiff_t i) { f(i * piece, std::min(piece, count - i * piece)); });
}

/// The same where neighbouring pieces meet in a place that both add to: every other one at once, then those between.
template <class Function>
void in_meeting_pieces(std::ptrdiff_t count, std::ptrdiff_t size, const Function& f) {
  if (count * size < long_range) return f(std::ptrdiff_t{0}, count);
  const std::ptrdiff_t piece = piece_of(size), pieces = pieces_of(count, size);
  for (const std::ptrdiff_t odd : {0, 1}) {
    at_once((pieces + 1 - odd) / 2, [&](std::ptrdiff_t i) {
      const std::ptrdiff_t first = (2 * i + odd) * piece;
      f(first, std::min(piece, count - first));
    });
  }
}

/// Sum of f(first, count) over the pieces, in their order.
template <class Sum, class Function>
Sum sum_in_pieces(std::ptrdiff_t count, std::ptrdiff_t size, const Function& f) {
  if (count * size < long_range) return f(std::ptrdiff_t{0}, count);
  std::vector<Sum> sums(static_cast<std::size_t>(pieces_of(count, size)));
  in_pieces(count, size, [&](std::ptrdiff_t first, std::ptrdiff_t number) {
    sums[static_cast<std::size_t>(first / piece_of(size))] = f(first, number);
  });
  return std::accumulate(sums.begin() + 1, sums.end(), sums.front());
}

/// The same where neighbouring pieces meet.
template <class Sum, class Function>
Sum sum_in_meeting_pieces(std::ptrdiff_t count, std::ptrdiff_t size, const Function& f) {
  if (count * size < long_range) return f(std::ptrdiff_t{0}, count);
  std::vector<Sum> sums(static_cast<std::size_t>(pieces_of(count, size)));
  in_meeting_pieces(count, size, [&](std::ptrdiff_t first, std::ptrdiff_t number) {
    sums[static_cast<std::size_t>(first / piece_of(size))] = f(first, number);
  });
  return std::accumulate(sums.begin() + 1, sums.end(), sums.front());
}

/// Lets `largest` be at least `value`, which other threads may do, too.
inline void raise(std::atomic<double>& largest, double value) {
  double known = largest.load(std::memory_order_relaxed);
  while (value > known && !largest.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
  }
}

}  // namespace vlbeam
