// Compiled once for each instruction set, with VLBEAM_KERNELS its name.
#include "mechanics/time/step_kernels.hpp"

#include "core/pack.hpp"

namespace vlbeam::VLBEAM_KERNELS {
namespace {

// Arrays that do not overlap, said of parameters of functions of their own: GCC believes it nowhere else, and works on
// one coordinate at a time then.

[[gnu::noinline]] void take(std::ptrdiff_t count, const double* __restrict correction, double* __restrict d) {
  for (std::ptrdiff_t i = 0; i < count; ++i) d[i] -= correction[i];
}

[[gnu::noinline]] void finish(std::ptrdiff_t count, const StepKernels::Rule rule, const double* __restrict d,
                              const double* __restrict base_q, const double* __restrict base_v,
                              const double* __restrict a0, const double* __restrict true_a0, double* __restrict q,
                              double* __restrict v, double* __restrict a) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double next = rule.carried * a0[i];
    const double predicted_v = base_v[i] + rule.h * ((1 - rule.gamma) * a0[i] + rule.gamma * next);
    const double predicted_a =
        ((1 - rule.alpha_m) * next + rule.alpha_m * a0[i] - rule.alpha_f * true_a0[i]) / (1 - rule.alpha_f);
    q[i] = base_q[i] + (rule.h * base_v[i] + d[i]);
    v[i] = predicted_v + rule.by_v * d[i];
    a[i] = predicted_a + rule.by_a * d[i];
  }
}

void complete(std::ptrdiff_t count, const StepKernels::Rule& rule, const double* correction,
              const StepKernels::Arrays& of) {
  if (correction != nullptr) take(count, correction, of.d);
  finish(count, rule, of.d, of.base_q, of.base_v, of.a0, of.true_a0, of.q, of.v, of.a);
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

double error_ratio(std::ptrdiff_t count, const double* error, const double* allowed, const double* from,
                   const double* to, double scale, double rtol) {
  Pack most(0);
  const auto look = [&](const Pack& e, const Pack& tolerance, const Pack& start, const Pack& end) {
    const Pack size = larger(larger(Pack(0), start), end);
    most = larger(most, e / (Pack(scale) * tolerance + Pack(rtol) * size));
  };
  for (; count >= Pack::width; count -= Pack::width) {
    look(Pack::load(error), Pack::load(allowed), Pack::load(from), Pack::load(to));
    error += Pack::width, allowed += Pack::width, from += Pack::width, to += Pack::width;
  }
  if (count > 0) {  // what lacks to a pack has no error
    Pack e(0), tolerance(1), start(0), end(0);
    for (int i = 0; i < count; ++i) {
      e.set(i, error[i]);
      tolerance.set(i, allowed[i]);
      start.set(i, from[i]);
      end.set(i, to[i]);
    }
    look(e, tolerance, start, end);
  }
  double ratio = 0;
  for (int i = 0; i < Pack::width; ++i) ratio = most[i] > ratio ? most[i] : ratio;
  return ratio;
}

}  // namespace

StepKernels kernels_of_steps() { return {&complete, &largest, &error_ratio}; }

}  // namespace vlbeam::VLBEAM_KERNELS
