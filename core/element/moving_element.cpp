#include "core/element/moving_element.hpp"

#include "core/element/moving_kernels.hpp"
#include "core/element/twist_law.hpp"

namespace vlbeam {

template <int D, MovingEnds Ends>
MovingKernels<D, Ends> moving_kernels([[maybe_unused]] InstructionSet set) {
#ifdef VLBEAM_HAS_AVX2
  if (set == InstructionSet::avx2) return avx2::moving_kernels<D, Ends>();
#endif
  return portable::moving_kernels<D, Ends>();
}

template <int D, MovingEnds Ends>
const MovingKernels<D, Ends>& fastest_moving_kernels() {
  static const MovingKernels<D, Ends> kernels = moving_kernels<D, Ends>(fastest_instruction_set());
  return kernels;
}

template <int D, MovingEnds Ends>
MovingEquations<double, D> MovingElement<double, D, Ends>::equations(const Coordinates& q, const Coordinates& rate,
                                                                     const WeightFunction& weights,
                                                                     const ShapeTabulation& table,
                                                                     const MovingLaw<D>& law) {
  if (law.pieces != nullptr) {
    const MovingLaw<D> here = law_between(law, q.x_a, q.x_b);
    if (here.pieces == nullptr) return equations(q, rate, weights, table, here);
    return moving_sums<double, D, Ends>(q, rate, AtAnyAcceleration{}, weights, table, here);
  }
  if (law.rest != nullptr) return moving_sums<double, D, Ends>(q, rate, AtAnyAcceleration{}, weights, table, law);
  return fastest_moving_kernels<D, Ends>().equations(q, rate, weights, table, law);
}

template <int D, MovingEnds Ends>
MovingEquations<double, D> MovingElement<double, D, Ends>::forces(const Coordinates& q, const Coordinates& rate,
                                                                  const Coordinates& a, const WeightFunction& weights,
                                                                  const ShapeTabulation& table,
                                                                  const MovingLaw<D>& law) {
  if (law.pieces != nullptr) {
    const MovingLaw<D> here = law_between(law, q.x_a, q.x_b);
    if (here.pieces == nullptr) return forces(q, rate, a, weights, table, here);
    return moving_sums<double, D, Ends>(q, rate, a, weights, table, here);
  }
  if (law.rest != nullptr) return moving_sums<double, D, Ends>(q, rate, a, weights, table, law);
  return fastest_moving_kernels<D, Ends>().forces(q, rate, a, weights, table, law);
}

template <int D, MovingEnds Ends>
MovingEquations<double, D> MovingElement<double, D, Ends>::masses(const Coordinates& q, const WeightFunction& weights,
                                                                  const ShapeTabulation& table,
                                                                  const MovingLaw<D>& law) {
  if (law.pieces != nullptr) {
    const MovingLaw<D> here = law_between(law, q.x_a, q.x_b);
    if (here.pieces == nullptr) return masses(q, weights, table, here);
    auto eq = mass_sums<double, D, Ends>(q, weights, table, here);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) eq.mass[i][j] = eq.mass[j][i];
    }
    return eq;
  }
  return fastest_moving_kernels<D, Ends>().masses(q, weights, table, law);
}

template struct MovingElement<double, 1, MovingEnds::both>;
template struct MovingElement<double, 2, MovingEnds::a>;
template struct MovingElement<double, 2, MovingEnds::b>;
template struct MovingElement<double, 2, MovingEnds::both>;
template struct MovingElement<double, 3, MovingEnds::a>;
template struct MovingElement<double, 3, MovingEnds::b>;
template struct MovingElement<double, 3, MovingEnds::both>;
template MovingKernels<1, MovingEnds::both> moving_kernels(InstructionSet);
template MovingKernels<2, MovingEnds::a> moving_kernels(InstructionSet);
template MovingKernels<2, MovingEnds::b> moving_kernels(InstructionSet);
template MovingKernels<2, MovingEnds::both> moving_kernels(InstructionSet);
template MovingKernels<3, MovingEnds::a> moving_kernels(InstructionSet);
template MovingKernels<3, MovingEnds::b> moving_kernels(InstructionSet);
template MovingKernels<3, MovingEnds::both> moving_kernels(InstructionSet);
template const MovingKernels<1, MovingEnds::both>& fastest_moving_kernels();
template const MovingKernels<2, MovingEnds::a>& fastest_moving_kernels();
template const MovingKernels<2, MovingEnds::b>& fastest_moving_kernels();
template const MovingKernels<2, MovingEnds::both>& fastest_moving_kernels();
template const MovingKernels<3, MovingEnds::a>& fastest_moving_kernels();
template const MovingKernels<3, MovingEnds::b>& fastest_moving_kernels();
template const MovingKernels<3, MovingEnds::both>& fastest_moving_kernels();

}  // namespace vlbeam
