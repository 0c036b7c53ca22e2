#include "core/beam/span.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/element/fixed_rest.hpp"
#include "core/pieces.hpp"

namespace vlbeam {
namespace {

// What a pack's forces or inertia, and its tangents, cost, in numbers to be copied: where pieces of a span are to end.
constexpr std::ptrdiff_t cost_of_forces = 8 * Pack::width, cost_of_tangents = 16 * Pack::width;

/// Gives all elements of a pack as many points of either kind: those of fewer repeat their last one, with zero weight.
void even_out(std::vector<FixedBasis<double>>& lanes) {
  for (const auto kind : {&FixedBasis<double>::points, &FixedBasis<double>::stretch}) {
    std::size_t most = 0;
    for (const FixedBasis<double>& basis : lanes) most = std::max(most, (basis.*kind).size());
    for (FixedBasis<double>& basis : lanes) {
      if ((basis.*kind).size() == most) continue;
      FixedBasis<double>::Point last = (basis.*kind).back();
      last.weight = 0;
      (basis.*kind).resize(most, last);
    }
  }
}

/// Basis of neighbouring elements as one pack; lanes beyond the last element repeat it with zero weight.
FixedBasis<Pack> pack_basis(const std::vector<FixedBasis<double>>& lanes) {
  FixedBasis<Pack> basis;
  const std::size_t count = lanes.size();
  for (std::size_t g = 0; g < lanes.front().size(); ++g) {
    FixedBasis<Pack>::Point point;
    for (int lane = 0; lane < Pack::width; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      const auto& from = lanes[std::min(i, count - 1)][g];
      point.weight.set(lane, i < count ? from.weight : 0.0);
      for (std::size_t c = 0; c < 3; ++c) {
        point.s_x[c].set(lane, from.s_x[c]);
        point.s_xx[c].set(lane, from.s_xx[c]);
      }
    }
    (g < lanes.front().points.size() ? basis.points : basis.stretch).push_back(point);
  }
  return basis;
}

/// Strains of an element with the nodes `e` at the points of its basis.
template <int D>
std::vector<RestStrain<double>> strains_of(const NodalCubic<double, D>& e, const FixedBasis<double>& basis,
                                           const BeamSection& section) {
  std::vector<RestStrain<double>> strains;
  const Vec<double, D> chord = e.r_b - e.r_a;
  basis.visit(section, [&](const auto& point, const BeamSection& felt, std::size_t /*index*/) {
    const Vec<double, D> r_x = chord * point.s_x[0] + e.s_a * point.s_x[1] + e.s_b * point.s_x[2];
    const Vec<double, D> r_xx = chord * point.s_xx[0] + e.s_a * point.s_xx[1] + e.s_b * point.s_xx[2];
    strains.push_back(rest_strain<D>(r_x, r_xx, felt));
  });
  return strains;
}

std::vector<RestStrain<Pack>> pack_rest(const std::vector<std::vector<RestStrain<double>>>& lanes) {
  std::vector<RestStrain<Pack>> rest(lanes.front().size());
  for (std::size_t g = 0; g < rest.size(); ++g) {
    for (int lane = 0; lane < Pack::width; ++lane) {
      const auto& from = lanes[std::min(static_cast<std::size_t>(lane), lanes.size() - 1)][g];
      rest[g].axial.set(lane, from.axial);
      rest[g].curvature.set(lane, from.curvature);
    }
  }
  return rest;
}

}  // namespace

template <int D>
SpanKernels<D> span_kernels([[maybe_unused]] InstructionSet set) {
#ifdef VLBEAM_HAS_AVX2
  if (set == InstructionSet::avx2) return avx2::span_kernels<D>();
#endif
  return portable::span_kernels<D>();
}

template <int D>
const SpanKernels<D>& span_kernels() {
  static const SpanKernels<D> fastest = span_kernels<D>(fastest_instruction_set());
  return fastest;
}

template <int D>
Span<D>::Span(const Mesh& mesh, int outer, int open, const Support<D>& support, const BeamSections& sections,
              const BeamRules& rules, const double* rest, const std::vector<PointMass>& masses, Span* before,
              int unchanged)
    : outer_(outer),
      open_(open),
      step_(outer <= open ? 1 : -1),
      support_(support),
      section_(sections.own),
      curved_at_rest_(rest != nullptr) {
  const int known = before != nullptr ? take_over(*before, unchanged) : 0;
  build_packs(mesh, rules, sections.pieces, rest, masses);
  factor(known);
}

template <int D>
int Span<D>::take_over(Span& before, int unchanged) {
  if (step_ != before.step_ || (support_.free_position != before.support_.free_position).any() ||
      (support_.free_slope != before.support_.free_slope).any()) {
    return 0;
  }
  const int known = std::min({unchanged, count(), before.count()});
  packs_ = std::move(before.packs_);
  packs_.resize(static_cast<std::size_t>(known / Pack::width));
  for (std::size_t p = 0; outer_ != before.outer_ && p < packs_.size(); ++p) {
    packs_[p].first = first_of(static_cast<int>(p), Pack::width);
  }
  runs_ = std::move(before.runs_);
  const auto last = std::ranges::lower_bound(runs_, known, {}, &PivotRun::end);
  runs_.erase(known > 0 ? last + 1 : last, runs_.end());
  if (known > 0) runs_.back().end = known;
  return known;
}

template <int D>
void Span<D>::build_packs(const Mesh& mesh, const BeamRules& rules, const SectionPieces& pieces, const double* rest,
                          const std::vector<PointMass>& masses) {
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::abs(mesh.x.back());
  auto length = [&](int k) { return mesh.x[static_cast<std::size_t>(k) + 1] - mesh.x[static_cast<std::size_t>(k)]; };
  std::shared_ptr<const PackTables> uniform;  // equal lengths and unit weights share one table
  double uniform_length = 0;
  const SectionShare* uniform_share = nullptr;
  const auto bears_mass = [&](int k) {
    return std::any_of(masses.begin(), masses.end(),
                       [&](const PointMass& point) { return mesh.element_at(point.x) == k; });
  };
  for (int done = static_cast<int>(packs_.size()) * Pack::width; done < this->count(); done += Pack::width) {
    const int count = std::min(Pack::width, this->count() - done), first = first_of(done / Pack::width, count);
    const double start = mesh.x[static_cast<std::size_t>(first)], end = mesh.x[static_cast<std::size_t>(first + count)];
    const SectionShare* const share = pieces.empty() ? nullptr : &pieces.at((start + end) / 2);
    bool is_uniform = count == Pack::width && rest == nullptr && !pieces.change_between(start, end);
    for (int k = first; k < first + count; ++k) {
      is_uniform = is_uniform && mesh.weights[static_cast<std::size_t>(k)].w == unit_weights &&
                   std::abs(length(k) - length(first)) <= rounding && !bears_mass(k);
    }
    if (is_uniform && uniform && share == uniform_share && std::abs(length(first) - uniform_length) <= rounding) {
      packs_.push_back({first, count, uniform});
      continue;
    }
    std::vector<FixedBasis<double>> lanes;
    auto tables = std::make_shared<PackTables>();
    for (int k = first; k < first + count; ++k) {
      const auto& weights = mesh.weights[static_cast<std::size_t>(k)].w;
      const BeamRule& rule = rules.of(weights);
      const double a = mesh.x[static_cast<std::size_t>(k)], b = mesh.x[static_cast<std::size_t>(k) + 1];
      lanes.push_back(fixed_basis(a, b, weights, rule, pieces));
      FixedInertia inertia = fixed_inertia(a, b, weights, rule, pieces);
      for (auto& row : inertia.mass) {
        for (double& entry : row) entry *= section_.rhoA;
      }
      for (double& entry : inertia.load) entry *= section_.rhoA;
      add_point_masses(masses, mesh, k, inertia.mass);
      for (int lane = k - first; lane < Pack::width; ++lane) tables->set_inertia(lane, inertia);
    }
    even_out(lanes);
    tables->basis = pack_basis(lanes);
    if (rest != nullptr) {
      std::vector<std::vector<RestStrain<double>>> rest_lanes;
      for (int i = 0; i < count; ++i) {
        const auto& basis = lanes[static_cast<std::size_t>(i)];
        rest_lanes.push_back(strains_of<D>(element_nodes<D>(rest, first + i), basis, section_));
      }
      tables->rest = pack_rest(rest_lanes);
    }
    packs_.push_back({first, count, tables});
    if (is_uniform) {
      uniform = tables;
      uniform_length = length(first);
      uniform_share = share;
    }
  }
}

template <int D>
FixedInertia Span<D>::inertia(int i) const {
  const PackOfElements& pack = packs_[static_cast<std::size_t>(i / Pack::width)];
  return pack.tables->inertia_of(element(i) - pack.first);
}

template <int D>
void Span<D>::factor(int known) {
  NodeBlock<D> block;
  Components free_r = support_.free_position, free_s = support_.free_slope;
  const std::size_t near = step_ > 0 ? 0 : 2, far = 2 - near;  // rows of an element's outer node and of the next one
  // The block that the elimination of a node leaves to the next one, before that one's own next element.
  const auto carry_on = [&](const FixedInertia& of, const Pivot& pivot) {
    const auto& m = of.mass;
    const auto& next = pivot.next;
    block.rr = m[far][far] - (m[near][far] * next.rr + m[near + 1][far] * next.sr);
    block.rs = m[far][far + 1] - (m[near][far] * next.rs + m[near + 1][far] * next.ss);
    block.ss = m[far + 1][far + 1] - (m[near][far + 1] * next.rs + m[near + 1][far + 1] * next.ss);
    free_r.setOnes();
    free_s.setOnes();
  };
  if (known > 0) {
    const FixedInertia last = inertia(known - 1);
    carry_on(last, runs_.back()[known - 1]);
  }
  for (int i = known; i < count(); ++i) {
    const FixedInertia of = inertia(i);
    const auto& m = of.mass;
    block.rr += m[near][near];
    block.rs += m[near][near + 1];
    block.ss += m[near + 1][near + 1];
    const CouplingBlock<double> c{m[near][far], m[near][far + 1], m[near + 1][far], m[near + 1][far + 1]};
    Pivot pivot;
    pivot.inverse = block.inverse(free_r, free_s);
    const auto& inv = pivot.inverse;
    if (!inv.rr.isFinite().all() || (inv.rr < 0).any() || (inv.ss < 0).any()) {
      throw std::invalid_argument("the mass matrix of a fixed-length element is singular: use at least 3 points");
    }
    pivot.next = {inv.rr * c.rr + inv.rs * c.sr, inv.rr * c.rs + inv.rs * c.ss, inv.rs * c.rr + inv.ss * c.sr,
                  inv.rs * c.rs + inv.ss * c.ss};
    add_pivot(pivot, i);
    carry_on(of, pivot);
  }
  open_mass_ = block;
}

template <int D>
void Span<D>::add_pivot(const Pivot& pivot, int node) {
  const bool goes_on = !runs_.empty() && (node < runs_.back().first + PivotRun::turns || runs_.back()[node] == pivot);
  if (!goes_on) runs_.emplace_back(pivot, node);
  PivotRun& run = runs_.back();
  run.pivots[static_cast<std::size_t>(node) % PivotRun::turns] = pivot;
  run.end = node + 1;
}

template <int D>
double Span<D>::add_forces(const double* q, const double* rate, const Vector& gravity, double* force) const {
  const SpanKernels<D>& kernels = span_kernels<D>();
  return sum_in_meeting_pieces<double>(std::ssize(packs_), cost_of_forces, [&](std::ptrdiff_t first, std::ptrdiff_t n) {
    const Packs packs = some_packs(first, n);
    if (curved_at_rest_) kernels.rest_forces(packs, section_, q, 1, force);
    return kernels.forces(packs, section_, q, rate, gravity, force);
  });
}

template <int D>
double Span<D>::add_residual(const double* q, const double* rate, const double* a, const Vector& gravity,
                             double* residual, int most) const {
  const SpanKernels<D>& kernels = span_kernels<D>();
  const std::ptrdiff_t packs = most < count() ? (most + Pack::width - 1) / Pack::width : std::ssize(packs_);
  return sum_in_meeting_pieces<double>(packs, cost_of_forces, [&](std::ptrdiff_t first, std::ptrdiff_t n) {
    const Packs some = some_packs(first, n);
    if (curved_at_rest_) kernels.rest_forces(some, section_, q, -1, residual);
    return kernels.residual(some, section_, q, rate, a, gravity, residual);
  });
}

template <int D>
void Span<D>::add_inertia(const double* a, double* out, int left_out) const {
  const SpanKernels<D>& kernels = span_kernels<D>();
  const std::ptrdiff_t from = left_out / Pack::width;
  in_meeting_pieces(std::ssize(packs_) - from, cost_of_forces, [&](std::ptrdiff_t first, std::ptrdiff_t n) {
    kernels.inertia(some_packs(from + first, n), a, out);
  });
}

template <int D>
void Span<D>::add_tangent(const double* q, const double* rate, const TangentWeights& by, NodeTangent<D>* diagonal,
                          NodeTangent<D>* upper, NodeTangent<D>* lower) const {
  const SpanKernels<D>& kernels = span_kernels<D>();
  in_meeting_pieces(std::ssize(packs_), cost_of_tangents, [&](std::ptrdiff_t first, std::ptrdiff_t n) {
    const Packs packs = some_packs(first, n);
    kernels.tangents(packs, section_, q, rate, by, diagonal, upper, lower);
    if (curved_at_rest_) kernels.rest_tangents(packs, section_, q, by.q, diagonal, upper, lower);
  });
}

template <int D>
typename Span<D>::Vector Span<D>::first_moment(const double* q) const {
  Vector sum = Vector::Zero();
  for (const PackOfElements& pack : packs_) {
    for (int i = 0; i < pack.count; ++i) {
      const auto& load = pack.tables->inertia.load;
      const auto e = element_nodes<D>(q, pack.first + i);
      sum += load[0][i] * e.r_a + load[1][i] * e.s_a + load[2][i] * e.r_b + load[3][i] * e.s_b;
    }
  }
  return sum;
}

template <int D>
void Span<D>::reduce(double* force, int left_out) const {
  Components carry_r = Components::Zero(), carry_s = Components::Zero();
  auto run = std::ranges::upper_bound(runs_, left_out, {}, &PivotRun::end);
  for (int i = left_out; i < count(); ++i) {
    if (i == run->end) ++run;
    const auto& next = (*run)[i].next;
    auto f_r = position<D>(force, node(i));
    auto f_s = slope<D>(force, node(i));
    const Components y_r = support_.into_frame(f_r).array() - carry_r;
    const Components y_s = support_.into_frame(f_s).array() - carry_s;
    f_r = y_r.matrix();
    f_s = y_s.matrix();
    carry_r = next.rr * y_r + next.sr * y_s;
    carry_s = next.rs * y_r + next.ss * y_s;
  }
  position<D>(force, open_) -= support_.out_of_frame(carry_r.matrix());
  slope<D>(force, open_) -= support_.out_of_frame(carry_s.matrix());
}

template <int D>
void Span<D>::substitute(double* force, int left_out) const {
  Components a_r = support_.into_frame(position<D>(force, open_)).array();
  Components a_s = support_.into_frame(slope<D>(force, open_)).array();
  auto run = runs_.rbegin();
  for (int i = count() - 1; i >= left_out; --i) {
    if (i < run->first) ++run;
    const auto& [inv, next] = (*run)[i];
    auto f_r = position<D>(force, node(i));
    auto f_s = slope<D>(force, node(i));
    const Components y_r = f_r.array(), y_s = f_s.array();
    const Components x_r = inv.rr * y_r + inv.rs * y_s - (next.rr * a_r + next.rs * a_s);
    const Components x_s = inv.rs * y_r + inv.ss * y_s - (next.sr * a_r + next.ss * a_s);
    f_r = support_.out_of_frame(x_r.matrix());
    f_s = support_.out_of_frame(x_s.matrix());
    a_r = x_r;
    a_s = x_s;
  }
}

template class Span<2>;
template class Span<3>;
template SpanKernels<2> span_kernels(InstructionSet);
template SpanKernels<3> span_kernels(InstructionSet);

}  // namespace vlbeam
