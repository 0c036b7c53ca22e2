#include "mechanics/motion/system/event_ledger.hpp"

#include <algorithm>
#include <array>

#include "core/element/quadrature.hpp"
#include "core/length_control/chain_motion.hpp"
#include "mechanics/motion/system/beam_observation.hpp"

namespace vlbeam {
namespace {

constexpr int exact_points = 4;  // of the square of a cubic

/// Of velocities that are cubic along an element: of its integral, not of its points, as long as the rule is exact.
struct CubicRule {
  struct Point {
    double weight;
    std::array<double, 4> shape;  ///< of positions and, times the length, of slopes
  };
  std::array<Point, exact_points> points;

  CubicRule() {
    const QuadratureRule& rule = gauss_legendre(exact_points);
    for (std::size_t p = 0; p < exact_points; ++p) {
      const auto table = hermite_shape(rule[p].u);
      points[p] = {rule[p].weight, {table[0][0], table[1][0], table[2][0], table[3][0]}};
    }
  }
};

/// The change of the kinetic energy from an element of one chain to the same one of another, over the beam's
/// own mass per length, by several rules.
template <int D, std::size_t Rules>
class KineticChange {
 public:
  KineticChange(const BeamModel<D>& model, const ChainState<D>& before, const ChainState<D>& after,
                const std::array<const SumTables*, Rules>& tables)
      : model_(model), before_(before), after_(after), tables_(tables) {}

  void add(int k_before, int k_after, std::array<double, Rules>& sums) const {
    const auto was = before_.rates(k_before), is = after_.rates(k_after);
    const NodalCubic<double, D> change = difference(is.e, was.e);
    const bool still = is.x_a == was.x_a && is.x_b == was.x_b;
    if (still && change.r_a.isZero(0) && change.s_a.isZero(0) && change.r_b.isZero(0) && change.s_b.isZero(0)) return;
    const Mesh& mesh = after_.mesh;
    const auto k = static_cast<std::size_t>(k_after);
    const Weights<double>& weights = mesh.weights[k].w;
    const bool cubic =
        weights == unit_weights && !after_.moves(k_after) && !model_.pieces.change_between(mesh.x[k], mesh.x[k + 1]);
    const double exact =
        cubic ? share_between(mesh.x[k], mesh.x[k + 1]) * of_cubics(was.e, change, mesh.x[k + 1] - mesh.x[k]) : 0;
    for (std::size_t i = 0; i < Rules; ++i) {
      const auto points = with_mass(tables_[i]->of(weights).rule);
      sums[i] += cubic && points.size() >= exact_points ? exact : by_points(k_before, k_after, points);
    }
  }

 private:
  static double of_cubics(const NodalCubic<double, D>& was, const NodalCubic<double, D>& change, double length) {
    static const CubicRule rule;
    double sum = 0;
    for (const auto& [weight, shape] : rule.points) {
      const std::array<double, 4> s{shape[0], length * shape[1], shape[2], length * shape[3]};
      const Vec<double, D> v_was = combine_nodes<double, D>(s, was), v_change = combine_nodes<double, D>(s, change);
      sum += weight * v_change.dot(2 * v_was + v_change);
    }
    return sum * length / 2;
  }
  static NodalCubic<double, D> difference(const NodalCubic<double, D>& a, const NodalCubic<double, D>& b) {
    return {a.r_a - b.r_a, a.s_a - b.s_a, a.r_b - b.r_b, a.s_b - b.s_b};
  }
  double by_points(int k_before, int k_after, std::span<const BeamPoint> points) const {
    const auto was = kinematics_of(before_, k_before, model_.transport),
               is = kinematics_of(after_, k_after, model_.transport);
    double sum = 0;
    const auto add = [&](double u, double weight) {
      const auto shape = rational_shape(is.weights(), u);
      const Vec<double, D> v0 = was.at(u, shape).v, v1 = is.at(u, shape).v;
      sum += weight * (v1 - v0).dot(v1 + v0);
    };
    const double x_a = is.coordinates().x_a, x_b = is.coordinates().x_b;
    if (model_.pieces.empty()) {
      for (const auto& [u, weight, feels] : points) add(u, weight);
    } else {
      model_.pieces.visit(x_a, x_b, [&](const SectionPieces::Stretch& piece) {
        const double from = (piece.low - x_a) / (x_b - x_a), size = (piece.high - piece.low) / (x_b - x_a);
        for (const auto& [u, weight, feels] : points) add(from + u * size, weight * size * piece.share->mass);
      });
    }
    return sum * is.length() / 2;
  }

  /// Of the mass per length, of an element of one section.
  double share_between(double x_a, double x_b) const {
    return model_.pieces.empty() ? 1 : model_.pieces.at((x_a + x_b) / 2).mass;
  }

  const BeamModel<D>& model_;
  const ChainState<D>&before_, &after_;
  std::array<const SumTables*, Rules> tables_;
};

/// The first element before `end` at whose nodes the rates differ; far from an event none does.
template <int D>
int first_to_differ(const ChainState<D>& before, const ChainState<D>& after, int end) {
  const auto nodes = before.rate.begin();
  const auto at = std::mismatch(nodes, nodes + std::ptrdiff_t{node_size<D>} * (end + 1), after.rate.begin()).first;
  return std::max(0, static_cast<int>((at - nodes) / node_size<D>) - 1);
}

/// The last element from `first` on at whose nodes they do, by its number before; first - 1 for none.
template <int D>
int last_to_differ(const ChainState<D>& before, const ChainState<D>& after, int first) {
  const auto nodes = before.rate.rbegin();
  const std::ptrdiff_t count = std::ptrdiff_t{node_size<D>} * (before.mesh.last() - first + 1);
  const auto at = std::mismatch(nodes, nodes + count, after.rate.rbegin()).first;
  return before.mesh.last() - std::max(1, static_cast<int>((at - nodes) / node_size<D>));
}

}  // namespace

template <int D, std::size_t Rules>
std::array<Energy, Rules> energy_jumps(const CurrentBeam<D>& beam, const ChainState<D>& before,
                                       const ChainState<D>& after, const EventReach& reach, double t,
                                       const std::array<int, Rules>& points) {
  const int more = after.mesh.elements() - before.mesh.elements();
  const BeamModel<D>& model = beam.model();
  std::array<const SumTables*, Rules> tables;
  for (std::size_t i = 0; i < Rules; ++i) tables[i] = &beam.tables(points[i]);
  const KineticChange<D, Rules> change(model, before, after, tables);
  std::array<double, Rules> outside{};
  for (int k = first_to_differ<D>(before, after, reach.lowest); k < reach.lowest; ++k) change.add(k, k, outside);
  for (int k = reach.highest, last = last_to_differ<D>(before, after, reach.highest); k <= last; ++k) {
    change.add(k, k + more, outside);
  }
  Energy jump;  // of what is lumped
  const auto add_lumped = [&jump](double mass, const Vec<double, D>& v0, const Vec<double, D>& v1) {
    jump.kinetic += 0.5 * mass * (v1 - v0).dot(v1 + v0);
  };
  for (const PointMass& point : model.masses.points) {
    if (point.x < before.mesh.x.front() || point.x > before.mesh.x.back()) continue;  // it goes on outside the part
    const int k = before.mesh.element_at(point.x);
    if (k >= reach.lowest && k < reach.highest) continue;
    const int k_after = k < reach.lowest ? k : k + more;
    add_lumped(point.mass, motion_at(before, k, point.x, model.transport).v,
               motion_at(after, k_after, point.x, model.transport).v);
  }
  for (const auto& from : before.joints) {
    const auto to = std::ranges::find(after.joints, from.index, &ChainState<D>::Joint::index);
    const SlidingJoint& law = model.joints[static_cast<std::size_t>(from.index)].law;
    const auto turning = [&law](const ChainState<D>& chain, int node) {
      return law.turning.against<D>(chain.mesh.x[static_cast<std::size_t>(node)], slope<D>(chain.q.data(), node));
    };
    if (to ==
        after.joints.end()) {  // a mass flies on; what holds a ring, and its wheel, have no more to do with the beam
      jump.kinetic -= 0.5 * turning(before, from.node) * from.rate * from.rate;
      if (std::ranges::count(after.free_masses, from.index, &ChainState<D>::FreeMass::index) > 0) continue;
      const Vec<double, D> v = position<D>(before.rate.data(), from.node);
      jump.kinetic -= 0.5 * law.mass * v.squaredNorm();
      jump.gravity += law.mass * beam.gravity(t).dot(position<D>(before.q.data(), from.node));
      continue;
    }
    add_lumped(law.mass, position<D>(before.rate.data(), from.node), position<D>(after.rate.data(), to->node));
    jump.kinetic +=
        0.5 * (turning(after, to->node) * to->rate * to->rate - turning(before, from.node) * from.rate * from.rate);
  }
  std::array<Energy, Rules> jumps;
  for (std::size_t i = 0; i < Rules; ++i) {
    jumps[i] = energies_of_elements(beam, after, reach.lowest, reach.highest + more, t, points[i]) -
               energies_of_elements(beam, before, reach.lowest, reach.highest, t, points[i]);
    jumps[i].kinetic += model.section.rhoA * outside[i];
    jumps[i] += jump;
  }
  return jumps;
}

template std::array<Energy, 1> energy_jumps(const CurrentBeam<2>&, const ChainState<2>&, const ChainState<2>&,
                                            const EventReach&, double, const std::array<int, 1>&);
template std::array<Energy, 1> energy_jumps(const CurrentBeam<3>&, const ChainState<3>&, const ChainState<3>&,
                                            const EventReach&, double, const std::array<int, 1>&);
template std::array<Energy, 2> energy_jumps(const CurrentBeam<2>&, const ChainState<2>&, const ChainState<2>&,
                                            const EventReach&, double, const std::array<int, 2>&);
template std::array<Energy, 2> energy_jumps(const CurrentBeam<3>&, const ChainState<3>&, const ChainState<3>&,
                                            const EventReach&, double, const std::array<int, 2>&);

}  // namespace vlbeam
