#pragma once

#include "core/instruction_set.hpp"

namespace vlbeam {

/// Nodes of four unknowns, one behind the other: first, first + step, ... Each couples to the one before it by a block,
/// sixteen numbers by columns.
struct BlockRun {
  const double* coupling = nullptr;  ///< of all nodes
  int first = 0, step = 1, count = 0;
};

/// What a block tridiagonal matrix does at each node, compiled for one instruction set. Two runs that need nothing of
/// each other go by turns, so that the processor works on the one while the other waits for what it needs of itself.
struct BlockKernels {
  /// x_k -= C_k x_(k - step), with the couplings C.
  void (*subtract)(const BlockRun& a, const BlockRun& b, double* x);
  /// x_k = P_k (x_k - C_k x_(k - step)), with the inverse pivots P of all nodes.
  void (*finish)(const BlockRun& a, const BlockRun& b, const double* inverse, double* x);
  /// forth = forth * inverse; pivot -= forth * back. All are single blocks.
  void (*eliminate)(const double* inverse, const double* back, double* forth, double* pivot);
};

/// Those for an instruction set that is available().
BlockKernels block_kernels(InstructionSet set);

namespace portable {
BlockKernels block_kernels();
}
namespace avx2 {
BlockKernels block_kernels();
}

}  // namespace vlbeam
