// Compiled once for each instruction set, with VLBEAM_KERNELS its name. What is not inlined here would be a function
// that the linker shares with units for other machines: a test looks for it.
#include <algorithm>

#include "core/beam/chord_tangent.hpp"
#include "core/beam/span_kernels.hpp"
#include "core/element/fixed_rest.hpp"
#include "core/element/fixed_tangent.hpp"

namespace vlbeam::VLBEAM_KERNELS {
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

/// `scale` times one lane of a block.
template <int D>
Eigen::Matrix<double, D, D> lane(const Eigen::Matrix<Pack, D, D>& block, int i, double scale) {
  Eigen::Matrix<double, D, D> result;
  for (int c = 0; c < D; ++c) {
    for (int d = 0; d < D; ++d) result(c, d) = scale * block(c, d)[i];
  }
  return result;
}

#ifdef VLBEAM_GENERAL_KERNELS
constexpr bool has_general = true;
#else
constexpr bool has_general = false;  // it differentiates automatically, and not all of that is inlined
#endif

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

bool is_general(const BeamSection& section) {
  return section.damped() || (!section.bends() && section.stiffness.slackens());
}

/// Calls f with the kernel for the section.
template <class Function>
auto with_kernel(const BeamSection& section, const Function& f) {
  if constexpr (has_general) {
    if (is_general(section)) return f.template operator()<Kernel::general>();
  }
  if (!section.bends()) {
    return section.stiffness.green() ? f.template operator()<Kernel::axial_green>()
                                     : f.template operator()<Kernel::axial_engineering>();
  }
  return section.stiffness.green() ? f.template operator()<Kernel::green>()
                                   : f.template operator()<Kernel::engineering>();
}

// Flattened, here and in the elements at the joint: the compiler otherwise leaves the vector arithmetic of packs in
// calls. Free functions: for a member of a class template GCC takes the attribute at its declaration only.

/// `Sampled`: the axial strain has points of its own. Where it has none, the loop over them costs 2 %.
template <int D, Kernel K, bool Sampled>
[[gnu::flatten]] double add_pack_forces(Packs packs, const BeamSection& of, const double* q, const double* rate,
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

template <int D, Kernel K>
[[gnu::flatten]] void add_pack_tangents(Packs packs, const BeamSection& of, const double* q, const double* rate,
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
      if constexpr (K == Kernel::general) {
        if (section.damped()) {
          viscous =
              viscous_tangent<D>(pack.tables->basis, i, element_nodes<D>(q, k), element_nodes<D>(rate, k), section, by);
        }
      }
      auto stiffness = [&](std::size_t row, std::size_t column) {
        Matrix result = lane<D>(elastic[row][column], i, by.q);
        if (section.damped()) result += viscous[row][column];
        return result;
      };
      const auto& m = pack.tables->inertia[static_cast<std::size_t>(i)].mass;
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

template <int D>
double forces(Packs packs, const BeamSection& section, const double* q, const double* rate, double* force) {
  if (!has_general && is_general(section)) return portable::span_kernels<D>().forces(packs, section, q, rate, force);
  const bool sampled = !packs.empty() && !packs.front().tables->basis.stretch.empty();
  return with_kernel(section, [&]<Kernel K>() {
    return sampled ? add_pack_forces<D, K, true>(packs, section, q, rate, force)
                   : add_pack_forces<D, K, false>(packs, section, q, rate, force);
  });
}

template <int D>
[[gnu::flatten]] void rest_forces(Packs packs, const BeamSection& section, const double* q, double* force) {
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    const auto f = rest_force<Pack, D>(pack.tables->basis, pack.tables->rest, e, section);
    add_lanes<D>(f, pack.count, force + node_size<D> * pack.first);
  }
}

template <int D>
[[gnu::flatten]] void rest_tangents(Packs packs, const BeamSection& section, const double* q, double by_q,
                                    NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower) {
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    const auto tangent = rest_tangent<Pack, D>(pack.tables->basis, pack.tables->rest, e, section);
    for (int i = 0; i < pack.count; ++i) {
      const int k = pack.first + i;
      const auto stiffness = [&](std::size_t row, std::size_t column) {
        return lane<D>(tangent[row][column], i, by_q);
      };
      add_chord_tangent<D>(stiffness, diagonal + k, upper + k, lower + k);
    }
  }
}

template <int D>
void tangents(Packs packs, const BeamSection& section, const double* q, const double* rate, const TangentWeights& by,
              NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower) {
  if (!has_general && is_general(section)) {
    return portable::span_kernels<D>().tangents(packs, section, q, rate, by, diagonal, upper, lower);
  }
  with_kernel(section,
              [&]<Kernel K>() { add_pack_tangents<D, K>(packs, section, q, rate, by, diagonal, upper, lower); });
}

}  // namespace

template <int D>
SpanKernels<D> span_kernels() {
  return {&forces<D>, &rest_forces<D>, &tangents<D>, &rest_tangents<D>};
}
template SpanKernels<2> span_kernels();
template SpanKernels<3> span_kernels();

}  // namespace vlbeam::VLBEAM_KERNELS
