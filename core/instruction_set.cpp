#include "core/instruction_set.hpp"

// The C library's answer, where it has one: its tunables can hide instructions, and so a test runs the other kernels.
#if defined(VLBEAM_HAS_AVX2) && __has_include(<sys/platform/x86.h>)
#include <sys/platform/x86.h>
#endif

namespace vlbeam {

bool available(InstructionSet set) {
  if (set == InstructionSet::portable) return true;
#ifndef VLBEAM_HAS_AVX2
  return false;
#elif defined(CPU_FEATURE_ACTIVE)
  return CPU_FEATURE_ACTIVE(AVX2);
#else
  return __builtin_cpu_supports("avx2") != 0;
#endif
}

InstructionSet fastest_instruction_set() {
  return available(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::portable;
}

}  // namespace vlbeam
