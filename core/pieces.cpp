#include "core/pieces.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace vlbeam {

void use_threads([[maybe_unused]] int count) {
#ifdef _OPENMP
  omp_set_num_threads(count);
#endif
}

void at_once(std::ptrdiff_t count, void (*task)(const void* context, std::ptrdiff_t i), const void* context) {
#ifdef _OPENMP
#pragma omp parallel for schedule(static)
#endif
  for (std::ptrdiff_t i = 0; i < count; ++i) task(context, i);
}

}  // namespace vlbeam
