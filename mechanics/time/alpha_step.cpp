#include "mechanics/time/alpha_step.hpp"

#include "core/pieces.hpp"
#include "mechanics/time/step_kernels.hpp"

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
  const StepKernels::Rule of_step{h,           rule.carried(), rule.gamma, rule.alpha_m, rule.alpha_f, rule.by_v(h),
                                  rule.by_a(h)};
  const auto part = [&](Eigen::Index at, Eigen::Index count, const double* from_q, const double* from_v) {
    step_kernels().complete(count, of_step, correction == nullptr ? nullptr : correction + at,
                            {from_q, from_v, start.a.data() + at, start.true_acceleration.data() + at, d.data() + at,
                             q.data() + at, v.data() + at, end.true_acceleration.data() + at});
  };
  in_pieces(of_state_, 1,
            [&](Eigen::Index at, Eigen::Index count) { part(at, count, base_q().data() + at, base_v().data() + at); });
  const Eigen::Index others = d.size() - of_state_;
  if (others == 0) return;
  zero_.setZero(others);
  part(of_state_, others, zero_.data(), zero_.data());
}

}  // namespace vlbeam
