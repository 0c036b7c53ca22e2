#pragma once

#include <array>
#include <cstddef>

#include "core/instruction_set.hpp"

namespace vlbeam {

/// What a step of generalized-alpha does to each coordinate, compiled for one instruction set.
struct StepKernels {
  struct Rates {
    double h, by_v, by_a;
  };
  /// Of `count` numbers; no two overlap.
  struct Arrays {
    const double *base_q, *base_v, *predicted_v, *predicted_a;
    double *d, *q, *v, *a;
  };
  /// Of the method, and the length of the step.
  struct Rule {
    double h, carried, gamma, alpha_m, alpha_f;
  };
  /// The end of a step of `count` coordinates whose positions go on with the velocity: AlphaStep::predicted_v and
  /// predicted_a, from the velocities and the accelerations at its start. No two overlap.
  void (*predict)(std::ptrdiff_t count, const Rule& rule, const double* base_v, const double* a0, const double* true_a0,
                  double* predicted_v, double* predicted_a);
  /// d -= correction, unless that is null; q = base_q + h base_v + d, v = predicted_v + by_v d,
  /// a = predicted_a + by_a d.
  void (*complete)(std::ptrdiff_t count, const Rates& by, const double* correction, const Arrays& step);
  /// Of each of four neighbouring numbers the largest magnitude in `count` such groups, one behind the other; of finite
  /// numbers.
  void (*largest)(std::ptrdiff_t count, const double* groups, std::array<double, 4>& largest);
  /// Of `count` coordinates, which a step takes from somewhere to somewhere, the largest error over what is allowed:
  /// scale allowed + rtol times the larger magnitude of both places.
  double (*error_ratio)(std::ptrdiff_t count, const double* error, const double* allowed, const double* from,
                        const double* to, double scale, double rtol);
};

/// Those for an instruction set that is available().
StepKernels step_kernels(InstructionSet set);

/// The fastest ones.
const StepKernels& step_kernels();

namespace portable {
StepKernels kernels_of_steps();
}
namespace avx2 {
StepKernels kernels_of_steps();
}

}  // namespace vlbeam
