#include "core/pieces.hpp"

#ifdef VLBEAM_HAVE_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <mutex>
#endif

namespace vlbeam {
namespace {

std::atomic<int> most_threads{0};  // 0 for one a processor

#ifdef VLBEAM_HAVE_TBB

/// Tells oneTBB of the limit, before its first work and not before that: to start it takes longer than many a run.
class LimitOfTbb {
 public:
  void set(int threads) {
    const std::scoped_lock alone(mutex_);
    if (threads == known_) return;
    known_ = threads;
    control_.reset();
    if (threads > 0) {
      control_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                       static_cast<std::size_t>(threads));
    }
  }

 private:
  std::mutex mutex_;
  int known_ = 0;
  std::unique_ptr<tbb::global_control> control_;
};

LimitOfTbb limit_of_tbb;

#endif

}  // namespace

ThreadLimit::ThreadLimit(int threads) : before_(most_threads) {
  most_threads = before_ > 0 ? std::min(before_, threads) : threads;
}

ThreadLimit::~ThreadLimit() { most_threads = before_; }

// Not OpenMP: its threads wait for each other at the end of each loop, and where other programs keep one of them from a
// processor, all of them wait; here the others do its share.
void at_once(std::ptrdiff_t count, void (*task)(const void* context, std::ptrdiff_t i), const void* context) {
#ifdef VLBEAM_HAVE_TBB
  if (const int threads = most_threads; threads != 1) {
    limit_of_tbb.set(threads);
    tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, count), [&](const auto& range) {
      for (std::ptrdiff_t i = range.begin(); i < range.end(); ++i) task(context, i);
    });
    return;
  }
#endif
  for (std::ptrdiff_t i = 0; i < count; ++i) task(context, i);
}

}  // namespace vlbeam
