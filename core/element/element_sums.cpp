#include "core/element/element_sums.hpp"

namespace vlbeam {

template <int D>
SumKernels<D> sum_kernels([[maybe_unused]] InstructionSet set) {
#ifdef VLBEAM_HAS_AVX2
  if (set == InstructionSet::avx2) return avx2::sum_kernels<D>();
#endif
  return portable::sum_kernels<D>();
}

template <int D>
const SumKernels<D>& fastest_sum_kernels() {
  static const SumKernels<D> kernels = sum_kernels<D>(fastest_instruction_set());
  return kernels;
}

template SumKernels<2> sum_kernels(InstructionSet);
template SumKernels<3> sum_kernels(InstructionSet);
template const SumKernels<2>& fastest_sum_kernels();
template const SumKernels<3>& fastest_sum_kernels();

}  // namespace vlbeam
