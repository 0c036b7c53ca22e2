#pragma once

#include <array>
#include <cstddef>

#include "core/instruction_set.hpp"

namespace vlbeam {

/// What a step of generalized-alpha does to each coordinate, compiled for one instruction set.
struct StepKernels {
  /// Of the method, and what velocities and accelerations change by with the increment of a step of length h.
  struct Rule {
    double h, carried, gamma, alpha_m, alpha_f, by_v, by_a;
  };
  /// Of `count` numbers; none that is written overlaps another. Accelerations at the start are the method's own, a0,
  /// and the true ones.
  struct Arrays {
    const double *base_q, *base_v, *a0, *true_a0;
    double *d, *q, *v, *a;
  };
  /// d -= correction, unless that is null; then the end of a step: positions are d off those of the velocity going on,
  /// velocities by_v d and accelerations by_a d off what the method makes of those at the start.
  void (*complete)(std::ptrdiff_t count, const Rule& rule, const double* correction, const Arrays& step);
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
