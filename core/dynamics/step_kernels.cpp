// Compiled once for each instruction set, with VLBEAM_KERNELS its name.
#include "core/dynamics/step_kernels.hpp"

#include "core/pack.hpp"

namespace vlbeam::VLBEAM_KERNELS {
namespace {

// Arrays that do not overlap, said of parameters of functions of their own: GCC believes it nowhere else, and works on
// one coordinate at a time then.

[[gnu::noinline]] void take(std::ptrdiff_t count, const double* __restrict correction, double* __restrict d) {
  for (std::ptrdiff_t i = 0; i < count; ++i) d[i] -= correction[i];
}

[[gnu::noinline]] void finish(std::ptrdiff_t count, double h, double by_v, double by_a, const double* __restrict d,
                              const double* __restrict base_q, const double* __restrict base_v,
                              const double* __restrict predicted_v, const double* __restrict predicted_a,
                              double* __restrict q, double* __restrict v, double* __restrict a) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    q[i] = base_q[i] + (h * base_v[i] + d[i]);
    v[i] = predicted_v[i] + by_v * d[i];
    a[i] = predicted_a[i] + by_a * d[i];
  }
}

void complete(std::ptrdiff_t count, const StepKernels::Rates& by, const double* correction,
              const StepKernels::Arrays& of) {
  if (correction != nullptr) take(count, correction, of.d);
  finish(count, by.h, by.by_v, by.by_a, of.d, of.base_q, of.base_v, of.predicted_v, of.predicted_a, of.q, of.v, of.a);
}

void largest(std::ptrdiff_t count, const double* groups, std::array<double, 4>& result) {
  Pack one(0), other(0);  // each maximum waits for the one before it
  for (; count > 1; count -= 2, groups += 8) {
    one = larger(one, Pack::load(groups));
    other = larger(other, Pack::load(groups + 4));
  }
  if (count > 0) one = larger(one, Pack::load(groups));
  larger(one, other).store(result.data());
}

}  // namespace

StepKernels kernels_of_steps() { return {&complete, &largest}; }

}  // namespace vlbeam::VLBEAM_KERNELS
