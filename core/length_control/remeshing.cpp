#include "core/length_control/remeshing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/element/piece_bending.hpp"
#include "core/element/quadrature.hpp"
#include "core/length_control/chain_motion.hpp"
#include "core/length_control/least_change.hpp"
#include "core/length_control/rest_arc.hpp"
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
  if (!chain.curved_at_rest()) return;
  position<D>(chain.rest.data(), k) = node.rest_r;
  slope<D>(chain.rest.data(), k) = node.rest_r_x;
}

/// Gives element k the weights of rest_arc().
template <int D>
const Weights<double>& take_rest_arc(ChainState<D>& chain, int k, const LengthControl& control) {
  const auto i = static_cast<std::size_t>(k);
  const auto& x = chain.mesh.x;
  chain.mesh.weights[i] = chain.curved_at_rest() ? rest_arc(*chain.rest_curve, chain, k, control.trigger_length())
                                                 : WeightFunction{unit_weights, x[i], x[i + 1]};
  return chain.mesh.weights[i].w;
}

/// The same for an element that a cut has left, where the merge policy says so.
template <int D>
void renew_cut(ChainState<D>& chain, int k, const LengthControl& control) {
  if (control.takes_rest_arc()) take_rest_arc(chain, k, control);
}

/// Where an element is cut: at the kept place that is nearest to the usual one, but not so near to a joint that what is
/// left there is merged again. A kept place that is too near stays on the joint's side of the cut.
double place_of_cut(const LengthControl& control, double x_low, double x_high, double usual, bool joint_low,
                    bool joint_high) {
  constexpr double beside_end = 0.01, beside_joint = 0.1, beyond = 0.4;  // of L_std
  const double unit = control.standard_length, near = control.merge_length() + beside_joint * unit;
  const double least = x_low + (joint_low ? near : beside_end * unit);
  const double most = x_high - (joint_high ? near : beside_end * unit);
  double found = usual, away = x_high - x_low;
  for (const double at : control.kept) {
    if (at < least || at > most || !(std::abs(at - usual) < away)) continue;
    found = at;
    away = std::abs(at - usual);
  }
  if (away < x_high - x_low || (joint_low && joint_high)) return found;
  for (const double at : control.kept) {
    if (joint_high && at > x_low && at < x_high)
      found = std::min(found, std::max(at - beyond * unit, (x_low + at) / 2));
    if (joint_low && at > x_low && at < x_high)
      found = std::max(found, std::min(at + beyond * unit, (x_high + at) / 2));
  }
  return found;
}

/// Where EI changes the element bends beyond its cubic: there is its new node, turned by as much.
template <int D>
void bend_at_change(const ChainState<D>& chain, int k, const MovingLaw<D>& law, Segmentation<D>& node) {
  const auto element = kinematics_of(chain, k, law.transport);
  const double x_a = element.coordinates().x_a, x_b = element.coordinates().x_b;
  if (!law.pieces->change_between(x_a, x_b) || chain.curved_at_rest()) return;
  constexpr int points = 10;
  const auto bending = piece_bending(element, beam_rule(points), law.section, *law.pieces);
  if (!bending) return;
  Vec<double, 3> turn = Vec<double, 3>::Zero(), shift = Vec<double, 3>::Zero();
  const auto in_space = [](const Vec<double, D>& v) {
    Vec<double, 3> result = Vec<double, 3>::Zero();
    result.template head<D>() = v;
    return result;
  };
  const auto at_node = motion_at(element, node.x);
  law.pieces->visit(x_a, node.x, [&](const SectionPieces::Stretch& piece) {
    const double EI = piece.share->of(law.section).stiffness.EI;
    for (const auto& [u, weight] : gauss_legendre(points)) {
      const double x = piece.low + u * (piece.high - piece.low);
      const auto at = motion_at(element, x);
      const auto beyond = bending->beyond_cubic(x, EI);
      Vec<double, 3> bends = Vec<double, 3>::Zero();
      if constexpr (D == 2) {
        bends[2] = beyond[0];
      } else {
        bends << beyond[0], beyond[1], beyond[2];
      }
      bends *= weight * (piece.high - piece.low) * at.r_x.norm();
      turn += bends;
      shift += bends.cross(in_space(at_node.r - at.r));
    }
  });
  node.r += shift.template head<D>();
  node.r_x += turn.cross(in_space(node.r_x)).template head<D>();
}

/// A node that a merge deletes.
template <int D>
struct Lost {
  double x;
  Vec<double, D> r, r_x;

  Lost(const ChainState<D>& chain, int node)
      : x(chain.mesh.x[static_cast<std::size_t>(node)]),
        r(position<D>(chain.q.data(), node)),
        r_x(slope<D>(chain.q.data(), node)) {}
};

/// What a rule of one's own makes of an element with the nodal coordinates `q`.
template <int D>
MergedWeights by_rule(const MergeRule& rule, const MovingCoordinates<double, D>& q, const Lost<D>& lost) {
  auto point = [](const Vec<double, D>& v) {
    LostNode::Point p{};
    std::copy(v.begin(), v.end(), p.begin());
    return p;
  };
  const std::array<double, 3> k = rule({q.x_a, q.x_b, point(q.e.r_a), point(q.e.s_a), point(q.e.r_b), point(q.e.s_b),
                                        lost.x, point(lost.r), point(lost.r_x)});
  for (const double weight : k) {
    if (weight > 0 && std::isfinite(weight)) continue;
    std::ostringstream what;
    what << "the merge rule of the program gave the weights " << k[0] << ", " << k[1] << ", " << k[2]
         << " (over the last): they must be positive";
    throw std::domain_error(what.str());
  }
  return {k};
}

/// The beam before a merge, where its rule looks at more of it than the node it deletes.
template <int D>
std::optional<ChainState<D>> seen_by_merge(const ChainState<D>& chain, const LengthControl& control) {
  return control.merge == MergeShape::least_change ? std::optional(chain) : std::nullopt;
}

/// Gives element k of `chain` the shape of one that has lost a node of the chain `before`, see seen_by_merge().
template <int D>
MergedWeights merge_into(ChainState<D>& chain, int k, const std::optional<ChainState<D>>& before, const Lost<D>& lost,
                         const LengthControl& control, const MovingLaw<D>& law) {
  if (before) return least_change(chain, *before, k, control.rational, law);
  if (control.takes_rest_arc()) {
    const auto& weights = take_rest_arc(chain, k, control);
    return {{weights[0], weights[1], weights[2]}};
  }
  const auto q = chain.coordinates(k);
  MergedWeights merged;
  if (control.merge == MergeShape::own) merged = by_rule<D>(control.rule, q, lost);
  if (control.merge == MergeShape::point_fit && control.rational) {
    const double l = q.x_b - q.x_a;
    merged = point_fit<D>(q.e, l, (lost.x - q.x_a) / l, lost.r);
  }
  chain.mesh.weights[static_cast<std::size_t>(k)] = {merged.weights(), q.x_a, q.x_b};
  return merged;
}

}  // namespace

template <int D>
MergedWeights segment_and_merge(ChainState<D>& chain, std::size_t which, Direction direction, const Remeshing& what,
                                const LengthControl& control, const MovingLaw<D>& law) {
  const bool forward = direction == Direction::forward;
  const int j = chain.joints[which].node, deleted = forward ? j + 1 : j - 1;
  const std::optional<ChainState<D>> before = what.merge ? seen_by_merge(chain, control) : std::nullopt;
  const std::optional<Lost<D>> lost = what.merge ? std::optional(Lost<D>(chain, deleted)) : std::nullopt;
  if (what.cut) {
    const int cut = forward ? j - 1 : j, at = cut + 1;
    const auto& x = chain.mesh.x;
    const double x_low = x[static_cast<std::size_t>(cut)], x_high = x[static_cast<std::size_t>(cut) + 1];
    const bool between_joints = chain.joint_at(cut) != nullptr && chain.joint_at(at) != nullptr;
    const double usual = between_joints ? (x_low + x_high) / 2
                         : forward      ? x_low + control.standard_length
                                        : x_high - control.standard_length;
    const double x_new =
        place_of_cut(control, x_low, x_high, usual, chain.joint_at(cut) != nullptr, chain.joint_at(at) != nullptr);
    auto node = segment(chain, cut, x_new, law.transport);
    if (law.pieces != nullptr) bend_at_change(chain, cut, law, node);
    int now = at;
    if (what.merge) {
      now = chain.trade_node(at, deleted);
    } else {
      chain.insert_node(at);
    }
    place_node(chain, now, node);
    chain.mesh.weights[static_cast<std::size_t>(now) - 1] = node.left;
    chain.mesh.weights[static_cast<std::size_t>(now)] = node.right;
  } else if (what.merge) {
    chain.erase_node(deleted);
  }
  const int joint = chain.joints[which].node;
  if (what.cut) {
    const int cut = forward ? joint - 2 : joint;
    renew_cut(chain, cut, control);
    renew_cut(chain, cut + 1, control);
  }
  if (!what.merge) return {};
  return merge_into(chain, forward ? joint : joint - 1, before, *lost, control, law);
}

template <int D>
MergedWeights merge_at_end(ChainState<D>& chain, Direction direction, const LengthControl& control,
                           const MovingLaw<D>& law) {
  const ChainState<D> before = chain;
  const bool forward = direction == Direction::forward;
  const int j = before.joints.front().node, cut = forward ? j - 1 : j, merged = forward ? j : j - 1;
  const auto& x = before.mesh.x;
  const auto i = static_cast<std::size_t>(j);
  const double reach = std::min(control.standard_length, (x[i + 1] - x[i - 1]) / 2);
  const auto node = segment(before, cut, forward ? x[i + 1] - reach : x[i - 1] + reach, law.transport);
  place_node(chain, j, node);
  chain.mesh.weights[static_cast<std::size_t>(cut)] = forward ? node.left : node.right;
  chain.joints.clear();
  chain.loose = {merged, x[i], before.joints.front().rate, false};
  renew_cut(chain, cut, control);
  return merge_into(chain, merged, seen_by_merge(before, control), Lost<D>(before, j), control, law);
}

template <int D>
MergedWeights cut_at_end(ChainState<D>& chain, const LengthControl& control, const MovingLaw<D>& law) {
  const ChainState<D> before = chain;
  const auto& loose = *before.loose;
  const bool forward = loose.element > 0;
  const int cut = loose.element, j = forward ? cut : cut + 1, merged = forward ? cut - 1 : cut + 1;
  const auto node = segment(before, cut, loose.x, law.transport);
  const auto at = motion_at(before, cut, loose.x, law.transport);
  place_node(chain, j, node);
  position<D>(chain.rate.data(), j) += loose.rate * at.r_x;
  slope<D>(chain.rate.data(), j) += loose.rate * at.r_xx;
  chain.mesh.weights[static_cast<std::size_t>(cut)] = forward ? node.right : node.left;
  chain.joints = {{.node = j, .rate = loose.rate}};
  chain.loose.reset();
  renew_cut(chain, cut, control);
  return merge_into(chain, merged, seen_by_merge(before, control), Lost<D>(before, j), control, law);
}

template <int D>
void separate(ChainState<D>& chain, Direction direction, const LengthControl& control, WeightTransport transport) {
  const ChainState<D> before = chain;
  const bool forward = direction == Direction::forward;
  const int j = (forward ? before.joints.back() : before.joints.front()).node, end = forward ? j + 1 : j - 1,
            kept = forward ? j - 1 : j;
  const auto& x = before.mesh.x;
  const double x_end = x[static_cast<std::size_t>(end)];
  const double x_new = forward ? x_end - control.standard_length : x_end + control.standard_length;

  // the element behind the joint, continued to the end: the vanishing one ahead is dropped with its whip
  const auto to_end = segment(before, kept, x_end, transport);
  if (forward) {
    chain.joints.pop_back();
  } else {
    chain.joints.erase(chain.joints.begin());
  }
  place_node(chain, end, to_end);
  const WeightFunction whole = forward ? to_end.left : to_end.right;
  if (whole.x_b - whole.x_a < 1.5 * control.standard_length) {
    chain.erase_node(j);
    chain.mesh.weights[static_cast<std::size_t>(forward ? j - 1 : 0)] = whole;
    return;
  }
  auto part = [&whole](double a, double b) -> WeightFunction {
    return {whole.w == unit_weights ? unit_weights : whole.on(a, b), a, b};
  };
  place_node(chain, j, segment(before, kept, x_new, transport));
  chain.mesh.weights[static_cast<std::size_t>(j) - 1] = part(whole.x_a, x_new);
  chain.mesh.weights[static_cast<std::size_t>(j)] = part(x_new, whole.x_b);
}

template MergedWeights segment_and_merge(ChainState<2>&, std::size_t, Direction, const Remeshing&, const LengthControl&,
                                         const MovingLaw<2>&);
template MergedWeights segment_and_merge(ChainState<3>&, std::size_t, Direction, const Remeshing&, const LengthControl&,
                                         const MovingLaw<3>&);
template MergedWeights merge_at_end(ChainState<2>&, Direction, const LengthControl&, const MovingLaw<2>&);
template MergedWeights merge_at_end(ChainState<3>&, Direction, const LengthControl&, const MovingLaw<3>&);
template MergedWeights cut_at_end(ChainState<2>&, const LengthControl&, const MovingLaw<2>&);
template MergedWeights cut_at_end(ChainState<3>&, const LengthControl&, const MovingLaw<3>&);
template void separate(ChainState<2>&, Direction, const LengthControl&, WeightTransport);
template void separate(ChainState<3>&, Direction, const LengthControl&, WeightTransport);

}  // namespace vlbeam
