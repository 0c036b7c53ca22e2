// Compiled once for each instruction set, with VLBEAM_KERNELS its name. What is not inlined here would be a function
// that the linker shares with units for other machines: a test looks for it.
#include "core/beam/block_kernels.hpp"

#include <array>
#include <cstddef>

namespace vlbeam::VLBEAM_KERNELS {
namespace {

constexpr std::ptrdiff_t size = 4, block_size = size * size;

#ifdef __AVX__
constexpr std::ptrdiff_t lanes = 4;  // of a register
#else
constexpr std::ptrdiff_t lanes = 2;
#endif
constexpr std::size_t registers = size / lanes;
using Lanes __attribute__((vector_size(lanes * sizeof(double)))) = double;
using InMemory __attribute__((vector_size(lanes * sizeof(double)), aligned(sizeof(double)), may_alias)) = double;

struct Four {
  Lanes part[registers];
};

[[gnu::always_inline]] inline Four load(const double* from) {
  Four x;
  for (std::size_t i = 0; i < registers; ++i) x.part[i] = reinterpret_cast<const InMemory*>(from)[i];
  return x;
}

[[gnu::always_inline]] inline void store(const Four& x, double* to) {
  for (std::size_t i = 0; i < registers; ++i) reinterpret_cast<InMemory*>(to)[i] = x.part[i];
}

/// By two sums, so that fewer operations wait for each other.
[[gnu::always_inline]] inline Four times(const double* block, const double* x) {
  const Four a = load(block), b = load(block + size), c = load(block + 2 * size), d = load(block + 3 * size);
  Four sum;
  for (std::size_t i = 0; i < registers; ++i) {
    sum.part[i] = (a.part[i] * x[0] + b.part[i] * x[1]) + (c.part[i] * x[2] + d.part[i] * x[3]);
  }
  return sum;
}

[[gnu::always_inline]] inline Four difference(const Four& a, const Four& b) {
  Four result;
  for (std::size_t i = 0; i < registers; ++i) result.part[i] = a.part[i] - b.part[i];
  return result;
}

/// C_k x_(k - step)
[[gnu::always_inline]] inline Four coupled(const BlockRun& run, std::ptrdiff_t k, const double* x) {
  return times(run.coupling + block_size * k, x + size * (k - run.step));
}

[[gnu::always_inline]] inline void multiply(const double* a, const double* b, double* product) {  // which may be either
  std::array<Four, size> columns;
  for (std::size_t j = 0; j < size; ++j) columns[j] = times(a, b + size * j);
  for (std::size_t j = 0; j < size; ++j) store(columns[j], product + size * j);
}

template <class Visit>
[[gnu::always_inline]] inline void by_turns(const BlockRun& a, const BlockRun& b, const Visit& visit) {
  const int least = a.count < b.count ? a.count : b.count, both = least > 0 ? least : 0;  // counts below 0 are 0
  const auto at = [&visit](const BlockRun& run, int i) { visit(run, std::ptrdiff_t{run.first} + i * run.step); };
  for (int i = 0; i < both; ++i) {
    at(a, i);
    at(b, i);
  }
  for (int i = both; i < a.count; ++i) at(a, i);
  for (int i = both; i < b.count; ++i) at(b, i);
}

void subtract(const BlockRun& a, const BlockRun& b, double* x) {
  by_turns(a, b, [x](const BlockRun& run, std::ptrdiff_t k) {
    double* const own = x + size * k;
    store(difference(load(own), coupled(run, k, x)), own);
  });
}

void finish(const BlockRun& a, const BlockRun& b, const double* inverse, double* x) {
  by_turns(a, b, [=](const BlockRun& run, std::ptrdiff_t k) {
    double* const own = x + size * k;
    store(difference(load(own), coupled(run, k, x)), own);
    store(times(inverse + block_size * k, own), own);
  });
}

void eliminate(const double* inverse, const double* back, double* forth, double* pivot) {
  multiply(forth, inverse, forth);
  for (std::ptrdiff_t j = 0; j < block_size; j += size) {
    store(difference(load(pivot + j), times(forth, back + j)), pivot + j);
  }
}

}  // namespace

BlockKernels block_kernels() { return {&subtract, &finish, &eliminate}; }

}  // namespace vlbeam::VLBEAM_KERNELS
