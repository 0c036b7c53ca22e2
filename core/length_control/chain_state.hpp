#pragma once

#include <optional>
#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/node_map.hpp"

namespace vlbeam {

inline constexpr int no_joint = -1;

/// A beam's mesh with its motion, and the node that moves along it, if one does.
/// Rates at the moving node are those of the node, at all others those of the material point. Where the beam may be
/// kinked at the moving node, the node's slope is the one before it.
template <int D>
struct ChainState {
  Mesh mesh;
  std::vector<double> q, rate;  ///< nodal arrays
  std::vector<double> rest;     ///< where the nodes are when nothing stresses the beam; empty: straight, unstrained
  int joint = no_joint;         ///< index of the moving node
  double joint_rate = 0;        ///< rate of its material coordinate mesh.x[joint] [m/s]
  /// The beam's slope behind the moving node.
  struct Kink {
    Vec<double, D> slope, rate;
  };
  std::optional<Kink> kink;
  /// A mass inside the first or the last element, instead of a moving node.
  struct Rider {
    int element;
    double x, rate;     ///< material coordinate [m] and its rate [m/s]
    bool held = false;  ///< at the end of the beam, by a support
  };
  std::optional<Rider> rider;

  /// Coordinates and rates of element k, its moving ends included.
  MovingCoordinates<double, D> coordinates(int k) const {
    const auto i = static_cast<std::size_t>(k);
    MovingCoordinates<double, D> result{element_nodes<D>(q.data(), k), mesh.x[i], mesh.x[i + 1]};
    if (kink && k == joint) result.e.s_a = kink->slope;
    return result;
  }
  MovingCoordinates<double, D> rates(int k) const {
    MovingCoordinates<double, D> result{element_nodes<D>(rate.data(), k), k == joint ? joint_rate : 0,
                                        k + 1 == joint ? joint_rate : 0};
    if (kink && k == joint) result.e.s_a = kink->rate;
    return result;
  }

  bool curved_at_rest() const { return !rest.empty(); }
  /// Nodes of element k in its rest shape.
  NodalCubic<double, D> rest_nodes(int k) const { return element_nodes<D>(rest.data(), k); }

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
