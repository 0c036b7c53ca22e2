#include "core/pieces.hpp"

#ifdef VLBEAM_HAVE_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace vlbeam {

#ifdef VLBEAM_HAVE_TBB

struct ThreadLimit::Control {
  tbb::global_control control;
};
ThreadLimit::ThreadLimit(int threads)
    : control_(new Control{{tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}}) {}

// Not OpenMP: its threads wait for each other at the end of each loop, and where other programs keep one of them from a
// processor, all of them wait; here the others do its share.
void at_once(std::ptrdiff_t count, void (*task)(const void* context, std::ptrdiff_t i), const void* context) {
  tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, count), [&](const auto& range) {
    for (std::ptrdiff_t i = range.begin(); i < range.end(); ++i) task(context, i);
  });
}

#else

struct ThreadLimit::Control {};
ThreadLimit::ThreadLimit(int /*threads*/) {}

void at_once(std::ptrdiff_t count, void (*task)(const void* context, std::ptrdiff_t i), const void* context) {
  for (std::ptrdiff_t i = 0; i < count; ++i) task(context, i);
}

#endif

ThreadLimit::~ThreadLimit() = default;

}  // namespace vlbeam
