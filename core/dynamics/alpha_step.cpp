#include "core/dynamics/alpha_step.hpp"

#include "core/dynamics/step_kernels.hpp"

namespace vlbeam {

StepKernels step_kernels([[maybe_unused]] InstructionSet set) {
#ifdef VLBEAM_HAS_AVX2
  if (set == InstructionSet::avx2) return avx2::kernels_of_steps();
#endif
  return portable::kernels_of_steps();
}

const StepKernels& step_kernels() {
  static const StepKernels fastest = step_kernels(fastest_instruction_set());
  return fastest;
}

void AlphaStep::complete(const AlphaRule& rule, double h, const double* correction) {
  const StepKernels& kernels = step_kernels();
  const StepKernels::Rates by{h, rule.by_v(h), rule.by_a(h)};
  in_pieces(d.size(), 1, [&](Eigen::Index first, Eigen::Index count) {
    kernels.complete(
        count, by, correction == nullptr ? nullptr : correction + first,
        {base_q.data() + first, base_v.data() + first, predicted_v.data() + first, predicted_a.data() + first,
         d.data() + first, q.data() + first, v.data() + first, a.data() + first});
  });
}

}  // namespace vlbeam
