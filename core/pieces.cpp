#include "core/pieces.hpp"

#ifdef VLBEAM_HAVE_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

#include <mutex>
#include <set>

namespace vlbeam {
namespace {

/// The limits that are alive.
class Limits {
 public:
  void add(int threads) {
    const std::scoped_lock alone(mutex_);
    alive_.insert(threads);
    least_ = *alive_.begin();
  }
  void remove(int threads) {
    const std::scoped_lock alone(mutex_);
    alive_.erase(alive_.find(threads));
    least_ = alive_.empty() ? 0 : *alive_.begin();
  }
  /// 0 without any.
  int least() const { return least_; }

 private:
  std::mutex mutex_;
  std::multiset<int> alive_;
  std::atomic<int> least_{0};
};

Limits limits;

#ifdef VLBEAM_HAVE_TBB

/// Tells oneTBB of the limit, before its first work and not before that: to start it takes longer than many a run.
class LimitOfTbb {
 public:
  /// Where it has been told of one.
  void follow(int threads) {
    if (known_ > 0) set(threads);
  }
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
  std::atomic<int> known_{0};
  std::unique_ptr<tbb::global_control> control_;
};

LimitOfTbb limit_of_tbb;

#endif

}  // namespace

ThreadLimit::ThreadLimit(int threads) : threads_(threads) { limits.add(threads); }

ThreadLimit::~ThreadLimit() {
  limits.remove(threads_);
#ifdef VLBEAM_HAVE_TBB
  limit_of_tbb.follow(limits.least());
#endif
}

// Not OpenMP: its threads wait for each other at the end of each loop, and where other programs keep one of them from a
// processor, all of them wait; here the others do its share.
void at_once(std::ptrdiff_t count, void (*task)(const void* context, std::ptrdiff_t i), const void* context) {
#ifdef VLBEAM_HAVE_TBB
  if (const int threads = limits.least(); threads != 1) {
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
