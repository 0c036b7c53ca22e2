#pragma once

#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/mesh_motion.hpp"
#include "core/beam/node_map.hpp"
#include "core/element/transport.hpp"

namespace vlbeam {

/// A beam in motion as a part sees it that acts on its material points: elements between nodes of which one, the
/// joint, may move along the beam freely, or all as prescribed. Where the coordinates of an element stand depends on
/// how the joint's node is kept: once, with the slope behind it apart if the beam is kinked there, or twice.
template <int D>
struct ChainView {
  const Mesh& mesh;  ///< its entry at the joint is not used, nor any `x` where all nodes are prescribed
  WeightTransport transport;
  const double *q, *rate;
  int joint = -1;            ///< index of the moving node; negative without one
  Eigen::Index mark = 0;     ///< where its material coordinate stands
  Eigen::Index behind = -1;  ///< where the slope behind it stands, if not with the node's other coordinates
  bool cut = false;          ///< its node is there twice, the copies next to each other
  const std::vector<Prescribed>* marks = nullptr;  ///< material coordinates of all nodes, where they are prescribed

  bool has_joint() const { return joint >= 0; }
  bool at_joint(int element) const { return has_joint() && (element == joint || element + 1 == joint); }
  /// The node, copies counted, at which element k starts.
  int first_node(int k) const { return k + (cut && k >= joint ? 1 : 0); }
  /// Where the nodal vector i of element k stands: r_A, s_A, r_B, s_B.
  Eigen::Index vector(int k, int i) const {
    if (i == 1 && k == joint && behind >= 0) return behind;
    return Eigen::Index{node_size<D>} * first_node(k) + Eigen::Index{D} * i;
  }

  MovingCoordinates<double, D> coordinates(int k) const {
    const auto i = static_cast<std::size_t>(k);
    if (marks != nullptr) return {cubic(q, k), (*marks)[i].value, (*marks)[i + 1].value};
    return {cubic(q, k), has_joint() && k == joint ? q[mark] : mesh.x[i],
            has_joint() && k + 1 == joint ? q[mark] : mesh.x[i + 1]};
  }
  MovingCoordinates<double, D> rates(int k) const {
    const auto i = static_cast<std::size_t>(k);
    if (marks != nullptr) return {cubic(rate, k), (*marks)[i].rate, (*marks)[i + 1].rate};
    return {cubic(rate, k), has_joint() && k == joint ? rate[mark] : 0, has_joint() && k + 1 == joint ? rate[mark] : 0};
  }
  MovingKinematics<double, D> kinematics(int k) const {
    const bool moving = at_joint(k) || marks != nullptr;
    return {coordinates(k), rates(k), moving ? transport : WeightTransport::frozen, weights(k)};
  }
  const WeightFunction& weights(int k) const { return mesh.weights[static_cast<std::size_t>(k)]; }

  /// Material coordinate of a node [m].
  double mark_of(int node) const {
    if (marks != nullptr) return (*marks)[static_cast<std::size_t>(node)].value;
    return has_joint() && node == joint ? q[mark] : mesh.x[static_cast<std::size_t>(node)];
  }
  /// Index of the element that holds the material point x; of the first or the last one beyond the ends.
  int element_at(double x) const {
    if (marks != nullptr) return vlbeam::element_at(*marks, x);
    const int k = mesh.element_at(x);
    if (!at_joint(k)) return k;
    return x < q[mark] ? joint - 1 : joint;
  }

 private:
  NodalCubic<double, D> cubic(const double* values, int k) const {
    const auto part = [&](int i) { return Eigen::Map<const Vec<double, D>>(values + vector(k, i)); };
    return {part(0), part(1), part(2), part(3)};
  }
};

}  // namespace vlbeam
