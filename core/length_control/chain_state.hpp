#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/node_map.hpp"
#include "core/geometry/axis.hpp"

namespace vlbeam {

/// What a feature keeps of a chain's nodes besides. Cuts and merges leave it as it was: who keeps it brings it up to
/// date.
struct KeptAtNodes {
  virtual ~KeptAtNodes() = default;
};

/// A beam's mesh with its motion, and the nodes that move along it, the joints.
/// Rates at a joint are those of the node, at all other nodes those of the material point. Where the beam may be kinked
/// at a joint, the node's slope is the one before it.
template <int D>
struct ChainState {
  Mesh mesh;
  /// Of a beam whose other nodes the chain does not hold: its node 0 is the beam's node part.before, and so on.
  BeamPart part = {};
  std::vector<double> q, rate;     ///< nodal arrays
  std::vector<double> mark_rates;  ///< of the nodes' material coordinates, where all of them travel [m/s]
  std::vector<double> rest;        ///< where the nodes are when nothing stresses the beam; empty: straight, unstrained
  const Axis<D>* rest_curve = nullptr;           ///< what new nodes follow then
  std::shared_ptr<const KeptAtNodes> kept = {};  ///< what a feature has at the nodes besides
  /// The beam's slope behind a joint.
  struct Kink {
    Vec<double, D> slope, rate;
  };
  /// How a joint touches a neighbour.
  struct Touch {
    double distance = 0;  ///< at which, once it has rested there [m]; 0 for that of the model
    bool rests = false;
  };
  /// A node that moves along the beam.
  struct Joint {
    int node;
    double rate = 0;  ///< of its material coordinate mesh.x[node] [m/s]
    std::optional<Kink> kink = {};
    int index = 0;                      ///< which of the joints there were at the start
    std::array<Touch, 2> touches = {};  ///< the support at the start, and the next joint or the support at the end
  };
  std::vector<Joint> joints;  ///< in the order of the chain
  /// A sliding mass that has left the beam.
  struct FreeMass {
    int index;  ///< which of the joints it was
    Vec<double, D> r, v;
  };
  std::vector<FreeMass> free_masses;
  /// A mass inside the first or the last element, instead of a moving node.
  struct Loose {
    int element;
    double x, rate;     ///< material coordinate [m] and its rate [m/s]
    bool held = false;  ///< at the end of the beam, by a support
  };
  std::optional<Loose> loose;

  /// Coordinates and rates of element k, its moving ends included.
  MovingCoordinates<double, D> coordinates(int k) const {
    const auto i = static_cast<std::size_t>(k);
    MovingCoordinates<double, D> result{element_nodes<D>(q.data(), k), mesh.x[i], mesh.x[i + 1]};
    const Joint* const start = joint_at(k);
    if (start != nullptr && start->kink) result.e.s_a = start->kink->slope;
    return result;
  }
  MovingCoordinates<double, D> rates(int k) const {
    if (!mark_rates.empty()) return {element_nodes<D>(rate.data(), k), mark_rate(k), mark_rate(k + 1)};
    const Joint *const start = joint_at(k), *const end = joint_at(k + 1);
    MovingCoordinates<double, D> result{element_nodes<D>(rate.data(), k), start != nullptr ? start->rate : 0,
                                        end != nullptr ? end->rate : 0};
    if (start != nullptr && start->kink) result.e.s_a = start->kink->rate;
    return result;
  }

  /// The joint at a node, or null.
  const Joint* joint_at(int node) const {
    for (const Joint& joint : joints) {
      if (joint.node == node) return &joint;
    }
    return nullptr;
  }
  /// Index of the element that holds the material point x; of the first or the last one beyond the ends.
  int element_at(double x) const { return mesh.element_at(x); }
  /// Rate of a node's material coordinate [m/s].
  double mark_rate(int node) const {
    if (!mark_rates.empty()) return mark_rates[static_cast<std::size_t>(node)];
    const Joint* const joint = joint_at(node);
    return joint != nullptr ? joint->rate : 0;
  }
  /// Whether an end of element k moves.
  bool moves(int k) const { return !mark_rates.empty() || joint_at(k) != nullptr || joint_at(k + 1) != nullptr; }

  bool curved_at_rest() const { return !rest.empty(); }
  /// Nodes of element k in its rest shape.
  NodalCubic<double, D> rest_nodes(int k) const { return element_nodes<D>(rest.data(), k); }

  /// One more node, before what is now node `at`, with nothing in it; the element that held it becomes two.
  void insert_node(int at) {
    const auto i = static_cast<std::size_t>(at), first = i * node_size<D>;
    const auto widen = [&](std::vector<double>& nodal) {
      nodal.insert(nodal.begin() + static_cast<std::ptrdiff_t>(first), node_size<D>, 0.0);
    };
    mesh.x.insert(mesh.x.begin() + at, mesh.x[i]);
    mesh.weights.insert(mesh.weights.begin() + at, mesh.weights[i - 1]);
    widen(q);
    widen(rate);
    if (curved_at_rest()) widen(rest);
    for (Joint& joint : joints) joint.node += joint.node >= at ? 1 : 0;
  }
  /// Without node `at`, which is no joint: its two elements become one, that has the weights of the first.
  void erase_node(int at) {
    const auto first = static_cast<std::ptrdiff_t>(node_size<D>) * at;
    const auto narrow = [&](std::vector<double>& nodal) {
      nodal.erase(nodal.begin() + first, nodal.begin() + first + node_size<D>);
    };
    mesh.x.erase(mesh.x.begin() + at);
    mesh.weights.erase(mesh.weights.begin() + at);
    narrow(q);
    narrow(rate);
    if (curved_at_rest()) narrow(rest);
    for (Joint& joint : joints) joint.node -= joint.node > at ? 1 : 0;
  }

  /// insert_node(at) and erase_node() of what is node `erased` before it, at the cost of the nodes between alone.
  /// Returns the index of the new node.
  int trade_node(int at, int erased) {
    const bool forward = erased >= at;
    const int low = forward ? at : erased, high = forward ? erased : at - 1;
    const auto shift = [&](auto& entries, std::ptrdiff_t size) {
      const auto first = entries.begin() + size * low, end = entries.begin() + size * (high + 1);
      std::rotate(first, forward ? end - size : first + size, end);
    };
    shift(mesh.x, 1);
    shift(mesh.weights, 1);
    for (auto* nodal : {&q, &rate}) shift(*nodal, node_size<D>);
    if (curved_at_rest()) shift(rest, node_size<D>);
    for (Joint& joint : joints) {
      if (low <= joint.node && joint.node <= high) joint.node += forward ? 1 : -1;
    }
    const int now = forward ? low : high;
    mesh.weights[static_cast<std::size_t>(now)] = mesh.weights[static_cast<std::size_t>(now) - 1];
    return now;
  }

  /// Copies node `from` of `other` to node `to`.
  void copy_node(int to, const ChainState& other, int from) {
    mesh.x[static_cast<std::size_t>(to)] = other.mesh.x[static_cast<std::size_t>(from)];
    position<D>(q.data(), to) = position<D>(other.q.data(), from);
    slope<D>(q.data(), to) = slope<D>(other.q.data(), from);
    position<D>(rate.data(), to) = position<D>(other.rate.data(), from);
    slope<D>(rate.data(), to) = slope<D>(other.rate.data(), from);
    if (!curved_at_rest()) return;
    position<D>(rest.data(), to) = position<D>(other.rest.data(), from);
    slope<D>(rest.data(), to) = slope<D>(other.rest.data(), from);
  }
};

}  // namespace vlbeam
