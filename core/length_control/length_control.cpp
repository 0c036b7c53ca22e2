#include "core/length_control/length_control.hpp"

#include "core/length_control/chain_motion.hpp"
#include "core/length_control/least_change.hpp"
#include "core/length_control/segmentation.hpp"

namespace vlbeam {
namespace {

template <int D>
void place_node(ChainState<D>& chain, int k, const Segmentation<D>& node) {
  chain.mesh.x[static_cast<std::size_t>(k)] = node.x;
  position<D>(chain.q.data(), k) = node.r;
  slope<D>(chain.q.data(), k) = node.r_x;
  position<D>(chain.rate.data(), k) = node.v;
  slope<D>(chain.rate.data(), k) = node.v_x;
}

/// Gives element k of `chain` the shape of one that has lost node `deleted` of the chain `before`.
template <int D>
MergedWeights merge_into(ChainState<D>& chain, int k, const ChainState<D>& before, int deleted,
                         const LengthControl& control, const MovingLaw<D>& law) {
  if (control.merge == MergePolicy::least_change) {
    return least_change(chain, before, k, control.rational, law);
  }
  const auto q = chain.coordinates(k);
  MergedWeights merged;
  if (control.merge == MergePolicy::point_fit && control.rational) {
    const double l = q.x_b - q.x_a;
    const double u = (before.mesh.x[static_cast<std::size_t>(deleted)] - q.x_a) / l;
    merged = point_fit<D>(q.e, l, u, position<D>(before.q.data(), deleted));
  }
  chain.mesh.weights[static_cast<std::size_t>(k)] = {merged.weights(), q.x_a, q.x_b};
  return merged;
}

}  // namespace

template <int D>
MergedWeights segment_and_merge(ChainState<D>& chain, Direction direction, const LengthControl& control,
                                const MovingLaw<D>& law) {
  const ChainState<D> before = chain;
  const bool forward = direction == Direction::forward;
  const int j = before.joint;
  const int cut = forward ? j - 1 : j, deleted = forward ? j + 1 : j - 1, merged = forward ? j + 1 : j - 2;
  const auto& x = before.mesh.x;
  const double x_new = forward ? x[static_cast<std::size_t>(cut)] + control.standard_length
                               : x[static_cast<std::size_t>(cut) + 1] - control.standard_length;
  const auto node = segment(before, cut, x_new, law.transport);
  place_node(chain, j, node);
  chain.copy_node(deleted, before, j);
  chain.joint = deleted;
  chain.mesh.weights[static_cast<std::size_t>(j) - 1] = node.left;
  chain.mesh.weights[static_cast<std::size_t>(j)] = node.right;
  return merge_into(chain, merged, before, deleted, control, law);
}

template <int D>
MergedWeights merge_at_end(ChainState<D>& chain, Direction direction, const LengthControl& control,
                           const MovingLaw<D>& law) {
  const ChainState<D> before = chain;
  const bool forward = direction == Direction::forward;
  const int j = before.joint, cut = forward ? j - 1 : j, merged = forward ? j : j - 1;
  const auto& x = before.mesh.x;
  const auto i = static_cast<std::size_t>(j);
  const double reach = std::min(control.standard_length, (x[i + 1] - x[i - 1]) / 2);
  const auto node = segment(before, cut, forward ? x[i + 1] - reach : x[i - 1] + reach, law.transport);
  place_node(chain, j, node);
  chain.mesh.weights[static_cast<std::size_t>(cut)] = forward ? node.left : node.right;
  chain.joint = no_joint;
  chain.joint_rate = 0;
  chain.kink.reset();
  chain.rider = {merged, x[i], before.joint_rate, false};
  return merge_into(chain, merged, before, j, control, law);
}

template <int D>
MergedWeights cut_at_end(ChainState<D>& chain, const LengthControl& control, const MovingLaw<D>& law) {
  const ChainState<D> before = chain;
  const auto& rider = *before.rider;
  const bool forward = rider.element > 0;
  const int cut = rider.element, j = forward ? cut : cut + 1, merged = forward ? cut - 1 : cut + 1;
  const auto node = segment(before, cut, rider.x, law.transport);
  const auto at = motion_at(before, cut, rider.x, law.transport);
  place_node(chain, j, node);
  position<D>(chain.rate.data(), j) += rider.rate * at.r_x;
  slope<D>(chain.rate.data(), j) += rider.rate * at.r_xx;
  chain.mesh.weights[static_cast<std::size_t>(cut)] = forward ? node.right : node.left;
  chain.joint = j;
  chain.joint_rate = rider.rate;
  chain.rider.reset();
  return merge_into(chain, merged, before, j, control, law);
}

template <int D>
void separate(ChainState<D>& chain, Direction direction, const LengthControl& control, WeightTransport transport) {
  const ChainState<D> before = chain;
  const bool forward = direction == Direction::forward;
  const int j = before.joint, end = forward ? j + 1 : j - 1, kept = forward ? j - 1 : j;
  const auto& x = before.mesh.x;
  const double x_end = x[static_cast<std::size_t>(end)];
  const double x_new = forward ? x_end - control.standard_length : x_end + control.standard_length;

  // the element behind the joint, continued to the end: the vanishing one ahead is dropped with its whip
  const auto q = before.coordinates(kept), rate = before.rates(kept);
  const WeightFunction& weights = before.mesh.weights[static_cast<std::size_t>(kept)];
  const MovingKinematics<double, D> kinematics(q, rate, transport, weights);
  const auto& w = kinematics.weights();
  auto parameter = [&](double at) { return (at - q.x_a) / (q.x_b - q.x_a); };
  auto at_material_point = [&](double at) -> Segmentation<D> {
    const auto point = kinematics.at(parameter(at), rational_shape(w, parameter(at)));
    return {at, point.r, point.r_x, point.v, point.v_x, {}, {}};
  };
  auto weights_between = [&](double a, double b) -> WeightFunction {
    if (weights.w == unit_weights) return {unit_weights, a, b};
    return {restrict_cubic(w, parameter(a), parameter(b)), a, b};
  };
  place_node(chain, j, at_material_point(x_new));
  place_node(chain, end, at_material_point(x_end));
  const double x_low = forward ? q.x_a : x_end, x_high = forward ? x_end : q.x_b;
  chain.mesh.weights[static_cast<std::size_t>(j) - 1] = weights_between(x_low, x_new);
  chain.mesh.weights[static_cast<std::size_t>(j)] = weights_between(x_new, x_high);
  chain.joint = no_joint;
  chain.joint_rate = 0;
  chain.kink.reset();
}

template MergedWeights segment_and_merge(ChainState<2>&, Direction, const LengthControl&, const MovingLaw<2>&);
template MergedWeights segment_and_merge(ChainState<3>&, Direction, const LengthControl&, const MovingLaw<3>&);
template MergedWeights merge_at_end(ChainState<2>&, Direction, const LengthControl&, const MovingLaw<2>&);
template MergedWeights merge_at_end(ChainState<3>&, Direction, const LengthControl&, const MovingLaw<3>&);
template MergedWeights cut_at_end(ChainState<2>&, const LengthControl&, const MovingLaw<2>&);
template MergedWeights cut_at_end(ChainState<3>&, const LengthControl&, const MovingLaw<3>&);
template void separate(ChainState<2>&, Direction, const LengthControl&, WeightTransport);
template void separate(ChainState<3>&, Direction, const LengthControl&, WeightTransport);

}  // namespace vlbeam
