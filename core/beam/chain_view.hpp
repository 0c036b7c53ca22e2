#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/node_map.hpp"
#include "core/element/transport.hpp"
#include "core/geometry/prescribed.hpp"

namespace vlbeam {

/// Index of the element, between nodes at `marks`, that holds the material point x. Beyond the ends it is that of the
/// first or the last element.
inline int element_at(const std::vector<Prescribed>& marks, double x) {
  const auto next = std::upper_bound(marks.begin() + 1, marks.end() - 1, x,
                                     [](double at, const Prescribed& node) { return at < node.value; });
  return static_cast<int>(next - marks.begin()) - 1;
}

/// Where the coordinates of a joint stand: of a node that moves along the beam freely. The slope behind
/// it stands apart if the beam may be kinked there.
struct JointPlace {
  int node = 0;              ///< of the mesh
  Eigen::Index mark = 0;     ///< where its material coordinate stands
  Eigen::Index behind = -1;  ///< where the slope behind it stands, if not with the node's other coordinates
  int passed = -1;           ///< how many point masses, in their order, are before it; -1: as its coordinate says
};

/// A beam in motion as a part sees it that acts on its material points: elements between nodes of which some, the
/// joints, may move along the beam freely, or all as prescribed.
template <int D>
struct ChainView {
  const Mesh& mesh;  ///< its entries at joints are not used, nor any `x` where all nodes are prescribed
  WeightTransport transport;
  const double *q, *rate;
  std::span<const JointPlace> joints = {};         ///< in the order of the chain
  const std::vector<Prescribed>* marks = nullptr;  ///< material coordinates of all nodes, where they are prescribed

  /// The joint at a node of the mesh, or null.
  const JointPlace* joint_at(int node) const {
    for (const JointPlace& joint : joints) {
      if (joint.node == node) return &joint;
    }
    return nullptr;
  }
  /// Whether an end of the element is a joint.
  bool at_joint(int element) const { return joint_at(element) != nullptr || joint_at(element + 1) != nullptr; }
  /// Whether an end of element k moves along the beam.
  bool moves(int k) const { return at_joint(k) || marks != nullptr; }
  /// Where the nodal vector i of element k stands: r_A, s_A, r_B, s_B.
  Eigen::Index vector(int k, int i) const {
    if (i == 1) {
      const JointPlace* const joint = joint_at(k);
      if (joint != nullptr && joint->behind >= 0) return joint->behind;
    }
    return Eigen::Index{node_size<D>} * k + Eigen::Index{D} * i;
  }

  MovingCoordinates<double, D> coordinates(int k) const {
    const auto i = static_cast<std::size_t>(k);
    if (marks != nullptr) return {cubic(q, k), (*marks)[i].value, (*marks)[i + 1].value};
    const JointPlace *const a = joint_at(k), *const b = joint_at(k + 1);
    return {cubic(q, k), a != nullptr ? q[a->mark] : mesh.x[i], b != nullptr ? q[b->mark] : mesh.x[i + 1]};
  }
  MovingCoordinates<double, D> rates(int k) const {
    const auto i = static_cast<std::size_t>(k);
    if (marks != nullptr) return {cubic(rate, k), (*marks)[i].rate, (*marks)[i + 1].rate};
    const JointPlace *const a = joint_at(k), *const b = joint_at(k + 1);
    return {cubic(rate, k), a != nullptr ? rate[a->mark] : 0, b != nullptr ? rate[b->mark] : 0};
  }
  MovingKinematics<double, D> kinematics(int k) const {
    return {coordinates(k), rates(k), moves(k) ? transport : WeightTransport::frozen, weights(k)};
  }
  const WeightFunction& weights(int k) const { return mesh.weights[static_cast<std::size_t>(k)]; }

  /// Material coordinate of a node [m].
  double mark_of(int node) const {
    if (marks != nullptr) return (*marks)[static_cast<std::size_t>(node)].value;
    const JointPlace* const joint = joint_at(node);
    return joint != nullptr ? q[joint->mark] : mesh.x[static_cast<std::size_t>(node)];
  }
  /// Whether a material coordinate is one of the beam, to what rounding may be off.
  bool contains(double x) const {
    constexpr double rounding = 1e-9;  // of an element's length, as where scenes are checked
    const double first = mark_of(0), last = mark_of(mesh.last()), beyond = rounding * (last - first) / mesh.elements();
    return x >= first - beyond && x <= last + beyond;
  }
  /// Rate at which the integral of r along the beam grows because matter comes in through its ends [m^2/s].
  Vec<double, D> entering() const {
    Vec<double, D> sum = Vec<double, D>::Zero();
    if (marks != nullptr) {
      return marks->back().rate * position<D>(q, mesh.last()) - marks->front().rate * position<D>(q, 0);
    }
    for (const JointPlace& joint : joints) sum += entering_at(joint);
    return sum;
  }
  /// What of it a joint at an end lets in; that of others is 0.
  Vec<double, D> entering_at(const JointPlace& joint) const {
    if (joint.node == 0) return -rate[joint.mark] * Eigen::Map<const Vec<double, D>>(q);
    if (joint.node != mesh.last()) return Vec<double, D>::Zero();
    return rate[joint.mark] * Eigen::Map<const Vec<double, D>>(q + vector(joint.node - 1, 2));
  }
  /// Index of the element that holds the material point x; of the first or the last one beyond the ends.
  int element_at(double x) const {
    if (marks != nullptr) return vlbeam::element_at(*marks, x);
    int k = mesh.element_at(x);
    for (const JointPlace& joint : joints) k += k + 1 == joint.node && x >= q[joint.mark] ? 1 : 0;
    for (std::size_t i = joints.size(); i-- > 0;) k -= k == joints[i].node && x < q[joints[i].mark] ? 1 : 0;
    return k;
  }

 private:
  NodalCubic<double, D> cubic(const double* values, int k) const {
    const auto part = [&](int i) { return Eigen::Map<const Vec<double, D>>(values + vector(k, i)); };
    return {part(0), part(1), part(2), part(3)};
  }
};

}  // namespace vlbeam
