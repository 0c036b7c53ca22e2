#include <algorithm>

#include "core/beam/span.hpp"
#include "core/element/fixed_rest.hpp"
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

/// Adds a ChordTangent, stiffness(i, j), of the element between the first node and the next. Unknowns r_A, s_A, r_B,
/// s_B: r_A enters through minus the chord r_B - r_A, r_B through the chord.
template <int D, class Stiffness>
void add_chord_tangent(const Stiffness& stiffness, NodeTangent<D>* diagonal, NodeTangent<D>* upper,
                       NodeTangent<D>* lower) {
  auto add = [&](NodeTangent<D>& block, int row, int column, double sign, std::size_t chord_row,
                 std::size_t chord_column) {
    block.template block<D, D>(row * D, column * D) += sign * stiffness(chord_row, chord_column);
  };
  auto &aa = diagonal[0], &ab = upper[0], &ba = lower[1], &bb = diagonal[1];
  add(aa, 0, 0, 1, 0, 0), add(aa, 0, 1, -1, 0, 1), add(aa, 1, 0, -1, 1, 0), add(aa, 1, 1, 1, 1, 1);
  add(ab, 0, 0, -1, 0, 0), add(ab, 0, 1, -1, 0, 2), add(ab, 1, 0, 1, 1, 0), add(ab, 1, 1, 1, 1, 2);
  add(ba, 0, 0, -1, 0, 0), add(ba, 0, 1, 1, 0, 1), add(ba, 1, 0, -1, 2, 0), add(ba, 1, 1, 1, 2, 1);
  add(bb, 0, 0, 1, 0, 0), add(bb, 0, 1, 1, 0, 2), add(bb, 1, 0, 1, 2, 0), add(bb, 1, 1, 1, 2, 2);
}

/// Adds the forces on the first `count` elements of a pack to the nodes from `out` on.
template <int D>
void add_lanes(const FixedForce<Pack, D>& f, int count, double* out) {
  constexpr int stride = node_size<D>;
  for (int i = 0; i < count; ++i, out += stride) {
    for (int c = 0; c < D; ++c) {
      out[c] -= f.r_b[c][i];
      out[D + c] += f.s_a[c][i];
      out[stride + c] += f.r_b[c][i];
      out[stride + D + c] += f.s_b[c][i];
    }
  }
}

/// What a kernel is compiled for: branches on the section cost much between the few operations of a pack. Bending
/// without damping, by either law, has its own, and so has stretching alone; all else shares one.
enum class Kernel { green, engineering, axial_green, axial_engineering, general };

/// Tells the compiler so.
template <Kernel K>
BeamSection known(BeamSection section) {
  if constexpr (K != Kernel::general) {
    constexpr bool green = K == Kernel::green || K == Kernel::axial_green;
    section.stiffness.law = green ? StrainLaw::green : StrainLaw::engineering;
    section.damping = section.stiffness.slack_over = 0;
    if constexpr (K == Kernel::axial_green || K == Kernel::axial_engineering) {
      section.stiffness.EI = 0;
    } else {
      if (!section.bends()) __builtin_unreachable();
    }
  }
  return section;
}

/// Calls f with the kernel for the section.
template <class Function>
auto with_kernel(const BeamSection& section, const Function& f) {
  if (section.damped()) return f.template operator()<Kernel::general>();
  if (!section.bends()) {
    if (section.stiffness.slackens()) return f.template operator()<Kernel::general>();
    return section.stiffness.green() ? f.template operator()<Kernel::axial_green>()
                                     : f.template operator()<Kernel::axial_engineering>();
  }
  return section.stiffness.green() ? f.template operator()<Kernel::green>()
                                   : f.template operator()<Kernel::engineering>();
}

// Flattened, here and in the elements at the joint: the compiler otherwise leaves the vector arithmetic of packs in
// calls. Free functions: for a member of a class template GCC takes the attribute at its declaration only.

/// `Sampled`: the axial strain has points of its own. Where it has none, the loop over them costs 2 %.
template <int D, Kernel K, bool Sampled, class Packs>
[[gnu::flatten]] double add_pack_forces(const Packs& packs, const BeamSection& of, const double* q, const double* rate,
                                        double* force) {
  const BeamSection section = known<K>(of);
  double dissipation = 0;
  for (const auto& pack : packs) {
    const auto offset = lane_offsets<D>(pack.count);
    const auto e = load_elements<D>(q, pack.first, offset);
    const auto e_rate = section.damped() ? load_elements<D>(rate, pack.first, offset) : e;
    const auto& basis = pack.tables->basis;
    auto f = FixedForce<Pack, D>::zero();
    if constexpr (Sampled) {
      f = fixed_force<Pack, D>(basis, e, e_rate, section);
    } else {
      add_fixed_force<Pack, D>(basis.points, e, e_rate, section, f);
    }
    add_lanes<D>(f, pack.count, force + node_size<D> * pack.first);
    if (section.damped()) {
      for (int i = 0; i < pack.count; ++i) dissipation += f.dissipation[i];
    }
  }
  return dissipation;
}

template <int D, Kernel K, class Packs>
[[gnu::flatten]] void add_pack_tangents(const Packs& packs, const BeamSection& of, const double* q, const double* rate,
                                        const TangentWeights& by, NodeTangent<D>* diagonal, NodeTangent<D>* upper,
                                        NodeTangent<D>* lower) {
  using Matrix = Eigen::Matrix<double, D, D>;
  const BeamSection section = known<K>(of);
  ChordTangent<double, D> viscous;
  for (auto& row : viscous) row.fill(Matrix::Zero());
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    const auto elastic = elastic_tangent<Pack, D>(pack.tables->basis, e, section);
    for (int i = 0; i < pack.count; ++i) {
      const int k = pack.first + i;
      if (section.damped()) {
        viscous =
            viscous_tangent<D>(pack.tables->basis, i, element_nodes<D>(q, k), element_nodes<D>(rate, k), section, by);
      }
      auto stiffness = [&](std::size_t row, std::size_t column) {
        Matrix result;
        for (int c = 0; c < D; ++c) {
          for (int d = 0; d < D; ++d) result(c, d) = by.q * elastic[row][column](c, d)[i];
        }
        if (section.damped()) result += viscous[row][column];
        return result;
      };
      const auto& m = pack.tables->mass[static_cast<std::size_t>(i)];
      auto add_mass = [&](NodeTangent<D>& block, std::size_t row, std::size_t column) {
        for (std::size_t r = 0; r < 2; ++r) {
          for (std::size_t c = 0; c < 2; ++c) {
            block.template block<D, D>(static_cast<int>(r) * D, static_cast<int>(c) * D).diagonal().array() +=
                by.a * m[row + r][column + c];
          }
        }
      };
      add_mass(diagonal[k], 0, 0), add_mass(upper[k], 0, 2), add_mass(lower[k + 1], 2, 0);
      add_mass(diagonal[k + 1], 2, 2);
      add_chord_tangent<D>(stiffness, diagonal + k, upper + k, lower + k);
    }
  }
}

}  // namespace

template <int D>
double Span<D>::forces(const double* q, const double* rate, double* force) const {
  const bool sampled = !packs_.empty() && !packs_.front().tables->basis.stretch.empty();
  return with_kernel(section_, [&]<Kernel K>() {
    return sampled ? add_pack_forces<D, K, true>(packs_, section_, q, rate, force)
                   : add_pack_forces<D, K, false>(packs_, section_, q, rate, force);
  });
}

template <int D>
void Span<D>::rest_forces(const double* q, double* force) const {
  for (const auto& pack : packs_) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    const auto f = rest_force<Pack, D>(pack.tables->basis, pack.tables->rest, e, section_);
    add_lanes<D>(f, pack.count, force + node_size<D> * pack.first);
  }
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
void Span<D>::rest_tangents(const double* q, double by_q, NodeTangent<D>* diagonal, NodeTangent<D>* upper,
                            NodeTangent<D>* lower) const {
  for (const auto& pack : packs_) {
    for (int i = 0; i < pack.count; ++i) {
      const int k = pack.first + i;
      const auto tangent = rest_tangent<D>(pack.tables->basis, pack.tables->rest, i, element_nodes<D>(q, k), section_);
      add_chord_tangent<D>(
          [&](std::size_t row, std::size_t column) -> Eigen::Matrix<double, D, D> {
            return by_q * tangent[row][column];
          },
          diagonal + k, upper + k, lower + k);
    }
  }
}

template <int D>
void Span<D>::add_tangent(const double* q, const double* rate, const TangentWeights& by, NodeTangent<D>* diagonal,
                          NodeTangent<D>* upper, NodeTangent<D>* lower) const {
  with_kernel(section_,
              [&]<Kernel K>() { add_pack_tangents<D, K>(packs_, section_, q, rate, by, diagonal, upper, lower); });
  if (curved_at_rest_) rest_tangents(q, by.q, diagonal, upper, lower);
}

template double Span<2>::forces(const double*, const double*, double*) const;
template double Span<3>::forces(const double*, const double*, double*) const;
template void Span<2>::rest_forces(const double*, double*) const;
template void Span<3>::rest_forces(const double*, double*) const;
template void Span<2>::rest_tangents(const double*, double, NodeTangent<2>*, NodeTangent<2>*, NodeTangent<2>*) const;
template void Span<3>::rest_tangents(const double*, double, NodeTangent<3>*, NodeTangent<3>*, NodeTangent<3>*) const;
template void Span<2>::add_inertia(const double*, double*) const;
template void Span<3>::add_inertia(const double*, double*) const;
template void Span<2>::add_tangent(const double*, const double*, const TangentWeights&, NodeTangent<2>*,
                                   NodeTangent<2>*, NodeTangent<2>*) const;
template void Span<3>::add_tangent(const double*, const double*, const TangentWeights&, NodeTangent<3>*,
                                   NodeTangent<3>*, NodeTangent<3>*) const;

}  // namespace vlbeam
