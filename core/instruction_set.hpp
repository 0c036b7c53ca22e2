#pragma once

namespace vlbeam {

/// What the machine must have besides what all of its family have. Kernels are compiled for each of them, and give the
/// same digits with all: lanes of a pack never mix, and no product is fused with a sum.
enum class InstructionSet { portable, avx2 };

/// Whether this build has kernels for it, and this machine can run them.
bool available(InstructionSet set);

/// The fastest one available.
InstructionSet fastest_instruction_set();

}  // namespace vlbeam
