#include <algorithm>

#include "core/beam/span.hpp"
#include "core/element/fixed_tangent.hpp"

namespace vlbeam {
namespace {

template <int D>
Vec<Pack, D> load_lanes(const double* first, const std::array<int, Pack::width>& offset) {
  Vec<Pack, D> result;
  for (int c = 0; c < D; ++c) {
    result[c] = Pack(first[offset[0] + c], first[offset[1] + c], first[offset[2] + c], first[offset[3] + c]);
  }
  return result;
}

template <int D>
NodalCubic<Pack, D> load_elements(const double* nodes, int first, const std::array<int, Pack::width>& offset) {
  const double* a = nodes + node_size<D> * first;
  const double* b = a + node_size<D>;
  return {load_lanes<D>(a, offset), load_lanes<D>(a + D, offset), load_lanes<D>(b, offset),
          load_lanes<D>(b + D, offset)};
}

/// Offsets of a pack's elements in a nodal array; lanes beyond the last element repeat it.
template <int D>
std::array<int, Pack::width> lane_offsets(int count) {
  std::array<int, Pack::width> offset;
  for (int i = 0; i < Pack::width; ++i) offset[static_cast<std::size_t>(i)] = node_size<D> * std::min(i, count - 1);
  return offset;
}

}  // namespace

// Flattened, here and in the elements at the joint: the compiler otherwise leaves the vector arithmetic of packs in
// calls.
template <int D>
template <StrainLaw Law, bool Bending, bool Damped>
[[gnu::flatten]] double Span<D>::forces(const double* q, const double* rate, double* force) const {
  constexpr int stride = node_size<D>;
  double dissipation = 0;
  for (const auto& pack : packs_) {
    const auto offset = lane_offsets<D>(pack.count);
    const auto e = load_elements<D>(q, pack.first, offset);
    const auto e_rate = Damped ? load_elements<D>(rate, pack.first, offset) : e;
    const auto f = fixed_force<Law, Bending, Damped, Pack, D>(pack.tables->basis, e, e_rate, section_);
    double* out = force + stride * pack.first;
    for (int i = 0; i < pack.count; ++i, out += stride) {
      for (int c = 0; c < D; ++c) {
        out[c] -= f.r_b[c][i];
        out[D + c] += f.s_a[c][i];
        out[stride + c] += f.r_b[c][i];
        out[stride + D + c] += f.s_b[c][i];
      }
      if constexpr (Damped) dissipation += f.dissipation[i];
    }
  }
  return dissipation;
}

template <int D>
void Span<D>::add_inertia(const double* a, double* out) const {
  for (const auto& pack : packs_) {
    for (int i = 0; i < pack.count; ++i) {
      const int k = pack.first + i;
      const auto& m = pack.tables->mass[static_cast<std::size_t>(i)];
      const auto e = element_nodes<D>(a, k);
      auto inertia = [&](std::size_t row) -> Vector {
        return m[row][0] * e.r_a + m[row][1] * e.s_a + m[row][2] * e.r_b + m[row][3] * e.s_b;
      };
      position<D>(out, k) += inertia(0);
      slope<D>(out, k) += inertia(1);
      position<D>(out, k + 1) += inertia(2);
      slope<D>(out, k + 1) += inertia(3);
    }
  }
}

template <int D>
template <StrainLaw Law, bool Bending, bool Damped>
[[gnu::flatten]] void Span<D>::tangents(const double* q, [[maybe_unused]] const double* rate,
                                        [[maybe_unused]] double by_v, double by_a, NodeTangent<D>* diagonal,
                                        NodeTangent<D>* upper, NodeTangent<D>* lower) const {
  using Matrix = Eigen::Matrix<double, D, D>;
  for (const auto& pack : packs_) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    const auto elastic = elastic_tangent<Law, Bending, Pack, D>(pack.tables->basis, e, section_.stiffness);
    for (int i = 0; i < pack.count; ++i) {
      const int k = pack.first + i;
      ChordTangent<double, D> viscous;
      if constexpr (Damped) {
        viscous = viscous_tangent<Law, Bending, D>(pack.tables->basis, i, element_nodes<D>(q, k),
                                                   element_nodes<D>(rate, k), section_, by_v);
      }
      auto stiffness = [&](std::size_t row, std::size_t column) {
        Matrix result;
        for (int c = 0; c < D; ++c) {
          for (int d = 0; d < D; ++d) result(c, d) = elastic[row][column](c, d)[i];
        }
        if constexpr (Damped) result += viscous[row][column];
        return result;
      };
      const auto& m = pack.tables->mass[static_cast<std::size_t>(i)];
      // unknowns r_A, s_A, r_B, s_B: r_A enters through minus the chord r_B - r_A, r_B through the chord
      auto add = [&](NodeTangent<D>& block, std::size_t row, std::size_t column, double sign, std::size_t chord_row,
                     std::size_t chord_column) {
        auto part = block.template block<D, D>(row % 2 * D, column % 2 * D);
        part += sign * stiffness(chord_row, chord_column);
        part.diagonal().array() += by_a * m[row][column];
      };
      auto &aa = diagonal[k], &ab = upper[k], &ba = lower[k + 1], &bb = diagonal[k + 1];
      add(aa, 0, 0, 1, 0, 0), add(aa, 0, 1, -1, 0, 1), add(aa, 1, 0, -1, 1, 0), add(aa, 1, 1, 1, 1, 1);
      add(ab, 0, 2, -1, 0, 0), add(ab, 0, 3, -1, 0, 2), add(ab, 1, 2, 1, 1, 0), add(ab, 1, 3, 1, 1, 2);
      add(ba, 2, 0, -1, 0, 0), add(ba, 2, 1, 1, 0, 1), add(ba, 3, 0, -1, 2, 0), add(ba, 3, 1, 1, 2, 1);
      add(bb, 2, 2, 1, 0, 0), add(bb, 2, 3, 1, 0, 2), add(bb, 3, 2, 1, 2, 0), add(bb, 3, 3, 1, 2, 2);
    }
  }
}

template <int D>
void Span<D>::add_tangent(const double* q, const double* rate, double by_v, double by_a, NodeTangent<D>* diagonal,
                          NodeTangent<D>* upper, NodeTangent<D>* lower) const {
  (this->*tangents_)(q, rate, by_v, by_a, diagonal, upper, lower);
}

template <int D>
template <StrainLaw Law, bool Bending, bool Damped>
void Span<D>::use_kernels() {
  forces_ = &Span::forces<Law, Bending, Damped>;
  tangents_ = &Span::tangents<Law, Bending, Damped>;
}

template <int D>
void Span<D>::choose_kernels(StrainLaw law) {
  auto choose = [&]<StrainLaw Law>() {
    if (section_.bends()) {
      section_.damped() ? use_kernels<Law, true, true>() : use_kernels<Law, true, false>();
    } else {
      section_.damped() ? use_kernels<Law, false, true>() : use_kernels<Law, false, false>();
    }
  };
  law == StrainLaw::green ? choose.template operator()<StrainLaw::green>()
                          : choose.template operator()<StrainLaw::engineering>();
}

template void Span<2>::choose_kernels(StrainLaw);
template void Span<3>::choose_kernels(StrainLaw);
template void Span<2>::add_inertia(const double*, double*) const;
template void Span<3>::add_inertia(const double*, double*) const;
template void Span<2>::add_tangent(const double*, const double*, double, double, NodeTangent<2>*, NodeTangent<2>*,
                                   NodeTangent<2>*) const;
template void Span<3>::add_tangent(const double*, const double*, double, double, NodeTangent<3>*, NodeTangent<3>*,
                                   NodeTangent<3>*) const;

}  // namespace vlbeam
