#include "mechanics/motion/system/event_map.hpp"

#include <algorithm>

#include "core/length_control/chain_motion.hpp"
#include "mechanics/time/assign.hpp"

namespace vlbeam {
namespace {

constexpr double small_way = 1e-5;  // of an element, for a derivative along it

}  // namespace

template <int D>
Vec<double, D> EventMap<D>::at(double x, WeightTransport transport, const Eigen::VectorXd& a) const {
  const ChainState<D>& chain = before_->chain;
  const int k = chain.mesh.element_at(x);
  const auto nodes =
      ChainView<D>{chain.mesh, transport, nullptr, a.data(), before_->places}.rates(chain.part.before + k);
  const auto point = motion_at(chain, k, x, transport);
  return combine_nodes<double, D>(point.s, nodes.e) + point.y_a * nodes.x_a + point.y_b * nodes.x_b + point.remainder;
}

template <int D>
void EventMap<D>::carry_node(const CurrentBeam<D>& beam, int node, const Eigen::VectorXd& a,
                             Eigen::VectorXd& to) const {
  const auto joint_of = [](const std::vector<JointPlace>& places, int of) {
    const auto at = std::ranges::find(places, of, &JointPlace::node);
    return at == places.end() ? -1 : static_cast<int>(at - places.begin());
  };
  const auto& [chain, places, was] = *before_;
  const std::vector<double>&x_now = beam.mesh().x, &x_before = chain.mesh.x;
  const auto i = static_cast<std::size_t>(node);
  int from = -1;  // the same node before
  if (const int joint = joint_of(beam.places(), node); joint >= 0) {
    from = places[static_cast<std::size_t>(joint)].node;
  } else if (const auto at = std::ranges::lower_bound(x_before, x_now[i]); at != x_before.end() && *at == x_now[i]) {
    from = chain.part.before + static_cast<int>(at - x_before.begin());
    if (joint_of(places, from) >= 0) from = -1;
  }
  const bool turns = beam.unknowns() != nullptr && beam.unknowns()->of_nodes();
  if (from >= 0) {
    to.segment<node_size<D>>(Eigen::Index{node_size<D>} * node) =
        a.segment<node_size<D>>(Eigen::Index{node_size<D>} * from);
    if (turns) to[beam.dofs().angle() + node] = a[was.angle() + from];
    return;
  }
  const WeightTransport transport = beam.model().transport;
  const double x = x_now[i], step = small_way * std::min(x - x_now[i - 1], x_now[i + 1] - x);
  position<D>(to.data(), node) = at(x, transport, a);
  slope<D>(to.data(), node) = (at(x + step, transport, a) - at(x - step, transport, a)) / (2 * step);
  if (!turns) return;
  // Sections turn linearly along an element. Damped, they would be thrown far off by what stops their spin at once.
  const int k = chain.mesh.element_at(x);
  const auto behind = static_cast<std::size_t>(k);
  const double u = (x - x_before[behind]) / (x_before[behind + 1] - x_before[behind]);
  const Eigen::Index angle = was.angle() + chain.part.before + k;
  to[beam.dofs().angle() + node] = (1 - u) * a[angle] + u * a[angle + 1];
}

template <int D>
bool EventMap<D>::carry(const CurrentBeam<D>& beam, const Eigen::VectorXd& a, Eigen::VectorXd& to) const {
  if (!before_ || before_->places.size() != beam.places().size()) return false;
  const DofMap<D>&was = before_->layout, &is = beam.dofs();
  if (was.free_masses != is.free_masses || was.kinks != is.kinks || a.size() < was.coordinates()) return false;

  const BeamPart& part = before_->chain.part;
  const Eigen::Index before = Eigen::Index{node_size<D>} * part.before,
                     behind = Eigen::Index{node_size<D>} * part.behind;
  assign_to(to.head(before), a.head(before));
  assign_to(to.segment(is.mark() - behind, behind), a.segment(was.mark() - behind, behind));
  for (int node = part.before; node < is.nodes - part.behind; ++node) carry_node(beam, node, a, to);
  for (std::size_t i = 0; i < beam.places().size(); ++i) {
    const JointPlace &from = before_->places[i], &place = beam.places()[i];
    to[place.mark] = a[from.mark];
    if (place.behind >= 0) to.segment<D>(place.behind) = a.segment<D>(from.behind);
  }
  const Eigen::Index free_masses = Eigen::Index{D} * is.free_masses;
  to.segment(is.free_mass(), free_masses) = a.segment(was.free_mass(), free_masses);
  if (beam.unknowns() != nullptr && !beam.unknowns()->of_nodes())
    to.segment(is.angle(), is.turning) = a.segment(was.angle(), was.turning);
  return true;
}

template class EventMap<2>;
template class EventMap<3>;

}  // namespace vlbeam
