#include "core/system/event_map.hpp"

#include <algorithm>

#include "core/length_control/chain_motion.hpp"

namespace vlbeam {
namespace {

constexpr double small_way = 1e-5;  // of an element, for a derivative along it

}  // namespace

template <int D>
Vec<double, D> EventMap<D>::at(double x, WeightTransport transport, const Eigen::VectorXd& a) const {
  const ChainState<D>& chain = before_->chain;
  const int k = chain.mesh.element_at(x);
  const auto nodes = ChainView<D>{chain.mesh, transport, chain.q.data(), a.data(), before_->places}.rates(k);
  const auto point = motion_at(chain, k, x, transport);
  return combine_nodes<double, D>(point.s, nodes.e) + point.y_a * nodes.x_a + point.y_b * nodes.x_b + point.remainder;
}

template <int D>
bool EventMap<D>::carry(const CurrentBeam<D>& beam, const Eigen::VectorXd& a, Eigen::VectorXd& to) const {
  if (!before_ || before_->places.size() != beam.places().size()) return false;
  const Layout<D>&was = before_->layout, &is = beam.layout();
  if (was.departed != is.departed || was.kinks != is.kinks || a.size() < was.coordinates()) return false;
  const WeightTransport transport = beam.model().transport;
  const std::vector<double>& x_before = before_->chain.mesh.x;
  const bool frames = beam.frames() != nullptr;

  const auto joint_of = [](const std::vector<JointPlace>& places, int node) {
    const auto at = std::ranges::find(places, node, &JointPlace::node);
    return at == places.end() ? -1 : static_cast<int>(at - places.begin());
  };
  auto at_or_behind = x_before.begin();
  for (int node = 0; node < is.nodes; ++node) {
    const double x = beam.mesh().x[static_cast<std::size_t>(node)];
    while (at_or_behind != x_before.end() && *at_or_behind < x) ++at_or_behind;
    int from = -1;  // the same node before
    if (const int joint = joint_of(beam.places(), node); joint >= 0) {
      from = before_->places[static_cast<std::size_t>(joint)].node;
    } else if (at_or_behind != x_before.end() && *at_or_behind == x) {
      from = static_cast<int>(at_or_behind - x_before.begin());
      if (joint_of(before_->places, from) >= 0) from = -1;
    }
    if (from >= 0) {
      to.segment<node_size<D>>(Eigen::Index{node_size<D>} * node) =
          a.segment<node_size<D>>(Eigen::Index{node_size<D>} * from);
      if (frames) to[is.angle() + node] = a[was.angle() + from];
      continue;
    }
    const auto& [low, high] =
        std::pair(beam.mesh().x[static_cast<std::size_t>(node) - 1], beam.mesh().x[static_cast<std::size_t>(node) + 1]);
    const double step = small_way * std::min(x - low, high - x);
    position<D>(to.data(), node) = at(x, transport, a);
    slope<D>(to.data(), node) = (at(x + step, transport, a) - at(x - step, transport, a)) / (2 * step);
  }
  for (std::size_t i = 0; i < beam.places().size(); ++i) {
    const JointPlace &from = before_->places[i], &place = beam.places()[i];
    to[place.mark] = a[from.mark];
    if (place.behind >= 0) to.segment<D>(place.behind) = a.segment<D>(from.behind);
  }
  const Eigen::Index departed = Eigen::Index{D} * is.departed;
  to.segment(is.departed_mass(), departed) = a.segment(was.departed_mass(), departed);
  if (beam.spin() != nullptr) to.segment(is.angle(), is.turning) = a.segment(was.angle(), was.turning);
  return true;
}

template class EventMap<2>;
template class EventMap<3>;

}  // namespace vlbeam
