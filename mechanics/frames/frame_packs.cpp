#include "mechanics/frames/frame_packs.hpp"

#include "mechanics/frames/frame_damping.hpp"
#include "mechanics/frames/frame_stiffness.hpp"

namespace vlbeam {
namespace {

using Elements = std::array<std::size_t, Pack::width>;

void set_lane(FrameTableOf<Pack>& table, int lane, const FrameTable& from) {
  table.length.set(lane, from.length);
  for (std::size_t c = 0; c < 3; ++c) table.middle[c].set(lane, from.middle[c]);
  for (std::size_t g = 0; g < 2; ++g) {
    auto& point = table.points[g];
    const auto& one = from.points[g];
    point.u = one.u;
    point.weight.set(lane, one.weight);
    for (std::size_t c = 0; c < 3; ++c) {
      point.s_x[c].set(lane, one.s_x[c]);
      point.s_xx[c].set(lane, one.s_xx[c]);
    }
    point.rest.y.set(lane, one.rest.y);
    point.rest.z.set(lane, one.rest.z);
    point.rest.torsion.set(lane, one.rest.torsion);
  }
}

/// Of one end of each element.
template <class Of>
Vec<Pack, 3> lanes(const FrameNode* nodes, const Elements& k, const Of& of) {
  const Vec<double, 3>&a = of(nodes[k[0]]), &b = of(nodes[k[1]]), &c = of(nodes[k[2]]), &d = of(nodes[k[3]]);
  return {Pack(a[0], b[0], c[0], d[0]), Pack(a[1], b[1], c[1], d[1]), Pack(a[2], b[2], c[2], d[2])};
}

const Vec<double, 3>& place(const FrameNode& node) { return node.r; }
const Vec<double, 3>& slope_at(const FrameNode& node) { return node.s; }
const Vec<double, 3>& direction(const FrameNode& node) { return node.direction; }
const Vec<double, 3>& spin_by_slope(const FrameNode& node) { return node.spin_by_slope; }

FrameEnds<Pack> ends_of(const FrameNode* nodes, const Elements& k, const double* turned) {
  return {lanes(nodes + 1, k, place) - lanes(nodes, k, place),
          lanes(nodes, k, slope_at),
          lanes(nodes + 1, k, slope_at),
          lanes(nodes, k, direction),
          lanes(nodes + 1, k, direction),
          Pack(turned[k[0]], turned[k[1]], turned[k[2]], turned[k[3]])};
}

/// From arrays of nodes, and of one number a node.
FrameRates<Pack> rates_of(const double* rate, const double* spins, const Elements& k) {
  const auto vector = [&](int first) -> Vec<Pack, 3> {
    std::array<const double*, Pack::width> at;
    for (std::size_t i = 0; i < k.size(); ++i) at[i] = rate + std::size_t{node_size<3>} * k[i] + first;
    const auto component = [&](int c) { return Pack(at[0][c], at[1][c], at[2][c], at[3][c]); };
    return {component(0), component(1), component(2)};
  };
  const auto spin = [&](std::size_t end) {
    return Pack(spins[k[0] + end], spins[k[1] + end], spins[k[2] + end], spins[k[3] + end]);
  };
  constexpr int slope = 3, next = node_size<3>;
  return {vector(next) - vector(0), vector(slope), vector(next + slope), spin(0), spin(1)};
}

/// With what acts on the spins, which slopes turn, too.
FrameForce<Pack> on_slopes(FrameForce<Pack> f, const FrameNode* nodes, const Elements& k) {
  f.s_a += lanes(nodes, k, spin_by_slope) * f.spin_a;
  f.s_b += lanes(nodes + 1, k, spin_by_slope) * f.spin_b;
  return f;
}

void add_lanes(const FrameForce<Pack>& f, const Elements& elements, int count, double* force, double* torque) {
  for (int i = 0; i < count; ++i) {
    const std::size_t k = elements[static_cast<std::size_t>(i)];
    double *a = force + std::size_t{node_size<3>} * k, *b = a + node_size<3>;
    for (int c = 0; c < 3; ++c) {
      a[c] += f.chord[c][i];
      a[3 + c] -= f.s_a[c][i];
      b[c] -= f.chord[c][i];
      b[3 + c] -= f.s_b[c][i];
    }
    torque[k] -= f.spin_a[i];
    torque[k + 1] -= f.spin_b[i];
  }
}

// Flattened, as the kernels of spans are.

[[gnu::flatten]] FrameForce<Pack> force_of(const FrameTableOf<Pack>& table, const FrameSection& section,
                                           const FrameNode* nodes, const Elements& k, const double* turned) {
  const FrameElement<Pack> element(table, section, ends_of(nodes, k, turned));
  return on_slopes(element.force(element.inner()), nodes, k);
}

/// Writes the power that is lost.
[[gnu::flatten]] FrameForce<Pack> damped_force_of(const FrameTableOf<Pack>& table, const FrameSection& section,
                                                  const FrameNode* nodes, const Elements& k, const double* turned,
                                                  const FrameRates<Pack>& rates, Pack& lost) {
  const FrameElement<Pack> element(table, section, ends_of(nodes, k, turned));
  FrameForce<Pack> f = element.force(element.inner());
  const FrameViscous<Pack> viscous(element, resistances<Pack>(table, section, Pack(1)), rates);
  f.chord += viscous.force.chord;
  f.s_a += viscous.force.s_a;
  f.s_b += viscous.force.s_b;
  f.spin_a += viscous.force.spin_a;
  f.spin_b += viscous.force.spin_b;
  lost = viscous.power;
  return on_slopes(f, nodes, k);
}

[[gnu::flatten]] FrameStiffness<Pack> stiffness_of(const FrameElement<Pack>& element, const FrameNode* nodes,
                                                   const Elements& k) {
  return {element, element.inner(), lanes(nodes, k, spin_by_slope), lanes(nodes + 1, k, spin_by_slope)};
}

}  // namespace

void FramePacks::add(int k, const FrameTable& table) {
  if (packs_.empty() || packs_.back().count == Pack::width) packs_.emplace_back();
  Four& pack = packs_.back();
  for (int lane = pack.count; lane < Pack::width; ++lane) {
    pack.elements[static_cast<std::size_t>(lane)] = static_cast<std::size_t>(k);
    set_lane(pack.table, lane, table);
  }
  ++pack.count;
}

void FramePacks::add_forces(const FrameSection& section, const std::vector<FrameNode>& nodes,
                            const std::vector<double>& turned, double* force, double* torque) const {
  for (const Four& pack : packs_) {
    const auto f = force_of(pack.table, section, nodes.data(), pack.elements, turned.data());
    add_lanes(f, pack.elements, pack.count, force, torque);
  }
}

double FramePacks::add_damped_forces(const FrameSection& section, const std::vector<FrameNode>& nodes,
                                     const std::vector<double>& turned, const double* rate,
                                     const std::vector<double>& spins, double* force, double* torque) const {
  double lost = 0;
  for (const Four& pack : packs_) {
    Pack of_each;
    const auto f = damped_force_of(pack.table, section, nodes.data(), pack.elements, turned.data(),
                                   rates_of(rate, spins.data(), pack.elements), of_each);
    add_lanes(f, pack.elements, pack.count, force, torque);
    for (int i = 0; i < pack.count; ++i) lost += of_each[i];
  }
  return lost;
}

void FramePacks::add_tangents(const FrameSection& section, const std::vector<FrameNode>& nodes,
                              const std::vector<double>& turned, double by, BeamMatrix<3>& tangent) const {
  for (const Four& pack : packs_) {
    const FrameElement<Pack> element(pack.table, section, ends_of(nodes.data(), pack.elements, turned.data()));
    const auto stiffness = stiffness_of(element, nodes.data(), pack.elements);
    for (int i = 0; i < pack.count; ++i) {
      const std::size_t k = pack.elements[static_cast<std::size_t>(i)];
      FrameMatrix matrix = by * stiffness.in_order(i);
      add_turned_reference(nodes[k], by * stiffness.torques[0][i], 3, matrix);
      add_turned_reference(nodes[k + 1], by * stiffness.torques[1][i], 10, matrix);
      tangent.add_turning_element(static_cast<int>(k), matrix);
    }
  }
}

}  // namespace vlbeam
