#include "core/beam/span.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vlbeam {
namespace {

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
Span<D>::Span(const Mesh& mesh, int outer, int open, const Support<D>& support, const BeamSection& section,
              const BeamRule& rule, const double* rest, const std::vector<PointMass>& masses)
    : outer_(outer),
      open_(open),
      step_(outer <= open ? 1 : -1),
      support_(support),
      section_(section),
      curved_at_rest_(rest != nullptr) {
  build_packs(mesh, rule, rest, masses);
  factor(mesh, rule, masses);
}

template <int D>
void Span<D>::build_packs(const Mesh& mesh, const BeamRule& rule, const double* rest,
                          const std::vector<PointMass>& masses) {
  const int low = std::min(outer_, open_), high = std::max(outer_, open_);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::abs(mesh.x.back());
  auto length = [&](int k) { return mesh.x[static_cast<std::size_t>(k) + 1] - mesh.x[static_cast<std::size_t>(k)]; };
  std::shared_ptr<const Tables> uniform;  // equal lengths and unit weights share one table
  double uniform_length = 0;
  const auto bears_mass = [&](int k) {
    return std::any_of(masses.begin(), masses.end(),
                       [&](const PointMass& point) { return mesh.element_at(point.x) == k; });
  };
  for (int first = low; first < high; first += Pack::width) {
    const int count = std::min(Pack::width, high - first);
    bool is_uniform = count == Pack::width && rest == nullptr;
    for (int k = first; k < first + count; ++k) {
      is_uniform = is_uniform && mesh.weights[static_cast<std::size_t>(k)].w == unit_weights &&
                   std::abs(length(k) - length(first)) <= rounding && !bears_mass(k);
    }
    if (is_uniform && uniform && std::abs(length(first) - uniform_length) <= rounding) {
      packs_.push_back({first, count, uniform});
      continue;
    }
    std::vector<FixedBasis<double>> lanes;
    std::vector<std::vector<RestStrain<double>>> rest_lanes;
    auto tables = std::make_shared<Tables>();
    for (int k = first; k < first + count; ++k) {
      const auto& weights = mesh.weights[static_cast<std::size_t>(k)].w;
      lanes.push_back(fixed_basis(length(k), weights, rule));
      if (rest != nullptr) rest_lanes.push_back(strains_of<D>(element_nodes<D>(rest, k), lanes.back(), section_));
      auto& mass = tables->mass[static_cast<std::size_t>(k - first)];
      mass = fixed_inertia(length(k), weights, rule).mass;
      for (auto& row : mass) {
        for (auto& entry : row) entry *= section_.rhoA;
      }
      add_point_masses(masses, mesh, k, mass);
    }
    tables->basis = pack_basis(lanes);
    if (rest != nullptr) tables->rest = pack_rest(rest_lanes);
    packs_.push_back({first, count, tables});
    if (is_uniform) {
      uniform = tables;
      uniform_length = length(first);
    }
  }
}

template <int D>
void Span<D>::factor(const Mesh& mesh, const BeamRule& rule, const std::vector<PointMass>& masses) {
  const int low = std::min(outer_, open_), count = std::abs(open_ - outer_);
  load_.assign(static_cast<std::size_t>(count) + 1, {0, 0});
  NodeBlock<D> block;
  Components free_r = support_.free_position, free_s = support_.free_slope;
  for (int k = outer_; k != open_; k += step_) {
    const auto e = static_cast<std::size_t>(step_ > 0 ? k : k - 1);
    FixedInertia inertia = fixed_inertia(mesh.x[e + 1] - mesh.x[e], mesh.weights[e].w, rule);
    for (auto& row : inertia.mass) {
      for (auto& entry : row) entry *= section_.rhoA;
    }
    add_point_masses(masses, mesh, static_cast<int>(e), inertia.mass);
    const std::size_t node = e - static_cast<std::size_t>(low);
    load_[node][0] += section_.rhoA * inertia.load[0];
    load_[node][1] += section_.rhoA * inertia.load[1];
    load_[node + 1][0] += section_.rhoA * inertia.load[2];
    load_[node + 1][1] += section_.rhoA * inertia.load[3];

    const std::size_t i = step_ > 0 ? 0 : 2, j = 2 - i;  // rows of this node and of the next one inwards
    const auto& m = inertia.mass;
    block.rr += m[i][i];
    block.rs += m[i][i + 1];
    block.ss += m[i + 1][i + 1];
    const CouplingBlock<double> c{m[i][j], m[i][j + 1], m[i + 1][j], m[i + 1][j + 1]};
    Pivot pivot;
    pivot.inverse = block.inverse(free_r, free_s);
    const auto& inv = pivot.inverse;
    if (!inv.rr.isFinite().all() || (inv.rr < 0).any() || (inv.ss < 0).any()) {
      throw std::invalid_argument("the mass matrix of a fixed-length element is singular: use at least 3 points");
    }
    pivot.next = {inv.rr * c.rr + inv.rs * c.sr, inv.rr * c.rs + inv.rs * c.ss, inv.rs * c.rr + inv.ss * c.sr,
                  inv.rs * c.rs + inv.ss * c.ss};
    NodeBlock<D> following;
    following.rr = m[j][j] - (c.rr * pivot.next.rr + c.sr * pivot.next.sr);
    following.rs = m[j][j + 1] - (c.rr * pivot.next.rs + c.sr * pivot.next.ss);
    following.ss = m[j + 1][j + 1] - (c.rs * pivot.next.rs + c.ss * pivot.next.ss);
    pivots_.push_back(pivot);
    block = following;
    free_r.setOnes();
    free_s.setOnes();
  }
  open_mass_ = block;
}

template <int D>
double Span<D>::add_forces(const double* q, const double* rate, const Vector& gravity, double* force) const {
  const double dissipation = forces(q, rate, force);
  if (curved_at_rest_) rest_forces(q, force);
  const int low = std::min(outer_, open_);
  for (std::size_t k = 0; k < load_.size(); ++k) {
    const int node = low + static_cast<int>(k);
    position<D>(force, node) += load_[k][0] * gravity;
    slope<D>(force, node) += load_[k][1] * gravity;
  }
  return dissipation;
}

template <int D>
typename Span<D>::Vector Span<D>::first_moment(const double* q) const {
  Vector sum = Vector::Zero();
  const int low = std::min(outer_, open_);
  for (std::size_t k = 0; k < load_.size(); ++k) {
    const int node = low + static_cast<int>(k);
    sum += load_[k][0] * position<D>(q, node) + load_[k][1] * slope<D>(q, node);
  }
  return sum;
}

template <int D>
void Span<D>::reduce(double* force) const {
  Components carry_r = Components::Zero(), carry_s = Components::Zero();
  int node = outer_;
  for (const Pivot& pivot : pivots_) {
    auto f_r = position<D>(force, node);
    auto f_s = slope<D>(force, node);
    const Components y_r = support_.into_frame(f_r).array() - carry_r;
    const Components y_s = support_.into_frame(f_s).array() - carry_s;
    f_r = y_r.matrix();
    f_s = y_s.matrix();
    carry_r = pivot.next.rr * y_r + pivot.next.sr * y_s;
    carry_s = pivot.next.rs * y_r + pivot.next.ss * y_s;
    node += step_;
  }
  position<D>(force, open_) -= support_.out_of_frame(carry_r.matrix());
  slope<D>(force, open_) -= support_.out_of_frame(carry_s.matrix());
}

template <int D>
void Span<D>::substitute(double* force) const {
  Components a_r = support_.into_frame(position<D>(force, open_)).array();
  Components a_s = support_.into_frame(slope<D>(force, open_)).array();
  int node = open_ - step_;
  for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot, node -= step_) {
    auto f_r = position<D>(force, node);
    auto f_s = slope<D>(force, node);
    const Components y_r = f_r.array(), y_s = f_s.array();
    const auto& inv = pivot->inverse;
    const Components x_r = inv.rr * y_r + inv.rs * y_s - (pivot->next.rr * a_r + pivot->next.rs * a_s);
    const Components x_s = inv.rs * y_r + inv.ss * y_s - (pivot->next.sr * a_r + pivot->next.ss * a_s);
    f_r = support_.out_of_frame(x_r.matrix());
    f_s = support_.out_of_frame(x_s.matrix());
    a_r = x_r;
    a_s = x_s;
  }
}

template class Span<2>;
template class Span<3>;

}  // namespace vlbeam
