// Compiled once for each instruction set, with VLBEAM_KERNELS its name. What is not inlined here would be a function
// that the linker shares with units for other machines: a test looks for it.
#include <algorithm>

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

/// The coordinates of four nodes in the plane, lane by lane.
std::array<Vec<Pack, 2>, 2> load_nodes(const double* first, const std::array<int, Pack::width>& offset) {
  Pack a = Pack::load(first + offset[0]), b = Pack::load(first + offset[1]), c = Pack::load(first + offset[2]),
       d = Pack::load(first + offset[3]);
  Pack::transpose(a, b, c, d);
  return {Vec<Pack, 2>(a, b), Vec<Pack, 2>(c, d)};
}

template <int D>
NodalCubic<Pack, D> load_elements(const double* nodes, int first, const std::array<int, Pack::width>& offset) {
  const double* a = nodes + node_size<D> * first;
  const double* b = a + node_size<D>;
  if constexpr (D == 2) {
    const auto at_a = load_nodes(a, offset), at_b = load_nodes(b, offset);
    return {at_a[0], at_a[1], at_b[0], at_b[1]};
  } else {
    return {load_lanes<D>(a, offset), load_lanes<D>(a + D, offset), load_lanes<D>(b, offset),
            load_lanes<D>(b + D, offset)};
  }
}

/// Offsets of a pack's elements in a nodal array; lanes beyond the last element repeat it.
template <int D>
std::array<int, Pack::width> lane_offsets(int count) {
  std::array<int, Pack::width> offset;
  for (int i = 0; i < Pack::width; ++i) offset[static_cast<std::size_t>(i)] = node_size<D> * std::min(i, count - 1);
  return offset;
}

/// Numbers of an element's nodal vectors.
template <int D>
struct Rows {
  Vec<Pack, D> r_a, s_a, r_b, s_b;
};

/// Forces of an element, and its weight.
template <int D>
Rows<D> rows_of(const FixedForce<Pack, D>& f, const std::array<Pack, 4>& load, const Vec<double, D>& gravity) {
  const Vec<Pack, D> g = gravity.template cast<Pack>();
  return {g * load[0] - f.r_b, g * load[1] + f.s_a, g * load[2] + f.r_b, g * load[3] + f.s_b};
}

template <int D>
Rows<D> inertia_of(const FixedInertiaOf<Pack>& of, const NodalCubic<Pack, D>& a) {
  const auto row = [&](std::size_t i) -> Vec<Pack, D> {
    return (a.r_a * of.mass[i][0] + a.s_a * of.mass[i][1]) + (a.r_b * of.mass[i][2] + a.s_b * of.mass[i][3]);
  };
  return {row(0), row(1), row(2), row(3)};
}

/// Adds those of the first `count` elements of a pack to the nodes from `out` on.
template <int D>
void add_lanes(const Rows<D>& rows, int count, double* out) {
  constexpr int stride = node_size<D>;
  if constexpr (D == 2) {
    std::array<Pack, Pack::width> a{rows.r_a[0], rows.r_a[1], rows.s_a[0], rows.s_a[1]},
        b{rows.r_b[0], rows.r_b[1], rows.s_b[0], rows.s_b[1]};
    Pack::transpose(a[0], a[1], a[2], a[3]);
    Pack::transpose(b[0], b[1], b[2], b[3]);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i, out += stride) {
      (Pack::load(out) + a[i]).store(out);
      (Pack::load(out + stride) + b[i]).store(out + stride);
    }
  } else {
    for (int i = 0; i < count; ++i, out += stride) {
      for (int c = 0; c < D; ++c) {
        out[c] += rows.r_a[c][i];
        out[D + c] += rows.s_a[c][i];
        out[stride + c] += rows.r_b[c][i];
        out[stride + D + c] += rows.s_b[c][i];
      }
    }
  }
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

/// Adds forces to `out`, or where accelerations `a` are given inertia less forces. `Sampled`: the axial strain has
/// points of its own. Where it has none, the loop over them costs 2 %.
template <int D, Kernel K, bool Sampled, bool Inertia>
[[gnu::flatten]] double add_packs(Packs packs, const BeamSection& of, const double* q, const double* rate,
                                  const double* a, const Vec<double, D>& gravity, double* out) {
  const BeamSection section = known<K>(of);
  double dissipation = 0;
  for (const auto& pack : packs) {
    const auto offset = lane_offsets<D>(pack.count);
    const auto e = load_elements<D>(q, pack.first, offset);
    const auto e_rate = section.damped() ? load_elements<D>(rate, pack.first, offset) : e;
    const PackTables& tables = *pack.tables;
    auto f = FixedForce<Pack, D>::zero();
    if constexpr (Sampled) {
      f = fixed_force<Pack, D>(tables.basis, e, e_rate, section);
    } else {
      add_fixed_force<Pack, D>(tables.basis.points, e, e_rate, section, f);
    }
    Rows<D> rows = rows_of<D>(f, tables.inertia.load, gravity);
    if constexpr (Inertia) {
      const auto inertia = inertia_of<D>(tables.inertia, load_elements<D>(a, pack.first, offset));
      rows = {inertia.r_a - rows.r_a, inertia.s_a - rows.s_a, inertia.r_b - rows.r_b, inertia.s_b - rows.s_b};
    }
    add_lanes<D>(rows, pack.count, out + node_size<D> * pack.first);
    if (section.damped()) {
      for (int i = 0; i < pack.count; ++i) dissipation += f.dissipation[i];
    }
  }
  return dissipation;
}

template <int D>
[[gnu::flatten]] void inertia(Packs packs, const double* a, double* out) {
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(a, pack.first, lane_offsets<D>(pack.count));
    add_lanes<D>(inertia_of<D>(pack.tables->inertia, e), pack.count, out + node_size<D> * pack.first);
  }
}

/// Adds entry(row, column) to blocks of the first `count` elements of a pack, one behind the other.
template <int D, class Entry>
void add_blocks(const Entry& entry, int count, NodeTangent<D>* blocks) {
  constexpr int size = node_size<D>;
#pragma GCC unroll 6
  for (int column = 0; column < size; ++column) {
    std::array<Pack, std::size_t{size}> rows;
#pragma GCC unroll 6
    for (int row = 0; row < size; ++row) rows[static_cast<std::size_t>(row)] = entry(row, column);
    double* to = blocks->data() + size * column;
    if constexpr (D == 2) Pack::transpose(rows[0], rows[1], rows[2], rows[3]);
    for (int i = 0; i < count; ++i, to += size * size) {
      if constexpr (D == 2) {
        (Pack::load(to) + rows[static_cast<std::size_t>(i)]).store(to);
      } else {
        for (int row = 0; row < size; ++row) to[row] += rows[static_cast<std::size_t>(row)][i];
      }
    }
  }
}

/// Adds the tangent of a pack, with `by_a` times the mass, to the node blocks of its first element and of those behind.
/// Unknowns r_A, s_A, r_B, s_B: r_A enters through minus the chord r_B - r_A, r_B through the chord.
template <int D>
void add_tangent(const ChordTangent<Pack, D>& stiffness, double by_a, const FixedInertiaOf<Pack>& inertia, int count,
                 NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower) {
  const auto block = [&](int node_row, int node_column) {
    return [&stiffness, &inertia, by_a, node_row, node_column](int row, int column) -> Pack {
      const auto i = static_cast<std::size_t>(2 * node_row + row / D),
                 j = static_cast<std::size_t>(2 * node_column + column / D);
      constexpr std::array<std::size_t, 4> of_chord{0, 1, 0, 2};
      Pack entry = stiffness[of_chord[i]][of_chord[j]](row % D, column % D);
      if ((i == 0) != (j == 0)) entry = -entry;
      return row % D == column % D ? entry + Pack(by_a) * inertia.mass[i][j] : entry;
    };
  };
  add_blocks<D>(block(0, 0), count, diagonal);
  add_blocks<D>(block(0, 1), count, upper);
  add_blocks<D>(block(1, 0), count, lower + 1);
  add_blocks<D>(block(1, 1), count, diagonal + 1);
}

template <int D>
void scale(ChordTangent<Pack, D>& tangent, double by) {
  for (auto& row : tangent) {
    for (auto& block : row) block *= Pack(by);
  }
}

template <int D, Kernel K>
[[gnu::flatten]] void add_pack_tangents(Packs packs, const BeamSection& of, const double* q,
                                        [[maybe_unused]] const double* rate, const TangentWeights& by,
                                        NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower) {
  const BeamSection section = known<K>(of);
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    auto stiffness = elastic_tangent<Pack, D>(pack.tables->basis, e, section);
    scale<D>(stiffness, by.q);
    if constexpr (K == Kernel::general) {
      for (int lane = 0; section.damped() && lane < pack.count; ++lane) {
        const int k = pack.first + lane;
        const auto viscous = viscous_tangent<D>(pack.tables->basis, lane, element_nodes<D>(q, k),
                                                element_nodes<D>(rate, k), section, by);
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) {
            for (int n = 0; n < D * D; ++n) {
              Pack& entry = stiffness[i][j](n / D, n % D);
              entry.set(lane, entry[lane] + viscous[i][j](n / D, n % D));
            }
          }
        }
      }
    }
    add_tangent<D>(stiffness, by.a, pack.tables->inertia, pack.count, diagonal + pack.first, upper + pack.first,
                   lower + pack.first);
  }
}

template <int D, bool Inertia>
double add(Packs packs, const BeamSection& section, const double* q, const double* rate, const double* a,
           const Vec<double, D>& gravity, double* out) {
  const bool sampled = !packs.empty() && !packs.front().tables->basis.stretch.empty();
  return with_kernel(section, [&]<Kernel K>() {
    return sampled ? add_packs<D, K, true, Inertia>(packs, section, q, rate, a, gravity, out)
                   : add_packs<D, K, false, Inertia>(packs, section, q, rate, a, gravity, out);
  });
}

template <int D>
double forces(Packs packs, const BeamSection& section, const double* q, const double* rate,
              const Vec<double, D>& gravity, double* force) {
  if (!has_general && is_general(section)) {
    return portable::span_kernels<D>().forces(packs, section, q, rate, gravity, force);
  }
  return add<D, false>(packs, section, q, rate, nullptr, gravity, force);
}

template <int D>
double residual(Packs packs, const BeamSection& section, const double* q, const double* rate, const double* a,
                const Vec<double, D>& gravity, double* out) {
  if (!has_general && is_general(section)) {
    return portable::span_kernels<D>().residual(packs, section, q, rate, a, gravity, out);
  }
  return add<D, true>(packs, section, q, rate, a, gravity, out);
}

template <int D>
[[gnu::flatten]] void rest_forces(Packs packs, const BeamSection& section, const double* q, double scale, double* out) {
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    const auto f = rest_force<Pack, D>(pack.tables->basis, pack.tables->rest, e, section);
    const Pack by(scale);
    add_lanes<D>({f.r_b * Pack(-scale), f.s_a * by, f.r_b * by, f.s_b * by}, pack.count,
                 out + node_size<D> * pack.first);
  }
}

template <int D>
[[gnu::flatten]] void rest_tangents(Packs packs, const BeamSection& section, const double* q, double by_q,
                                    NodeTangent<D>* diagonal, NodeTangent<D>* upper, NodeTangent<D>* lower) {
  for (const auto& pack : packs) {
    const auto e = load_elements<D>(q, pack.first, lane_offsets<D>(pack.count));
    auto tangent = rest_tangent<Pack, D>(pack.tables->basis, pack.tables->rest, e, section);
    scale<D>(tangent, by_q);
    add_tangent<D>(tangent, 0, pack.tables->inertia, pack.count, diagonal + pack.first, upper + pack.first,
                   lower + pack.first);
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
  return {&forces<D>, &residual<D>, &inertia<D>, &rest_forces<D>, &tangents<D>, &rest_tangents<D>};
}
template SpanKernels<2> span_kernels();
template SpanKernels<3> span_kernels();

}  // namespace vlbeam::VLBEAM_KERNELS
