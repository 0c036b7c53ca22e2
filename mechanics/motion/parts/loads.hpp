#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/geometry/vec.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/parts/point_matrix.hpp"

namespace vlbeam {

template <int D>
struct ChainView;

/// Concentrated loads on one material point, each a function of time; those that are empty are absent.
template <int D>
struct PointLoad {
  int node = -1;                                       ///< the point is what this node marks, wherever that moves to,
  std::function<double(double t)> x = {};              ///< or has this material coordinate [m], which may travel
  std::function<Vec<double, D>(double t)> force = {};  ///< [N], of a direction of its own
  std::function<double(double t)> follower = {};       ///< [N], along the tangent of the axis
  std::function<double(double t)> moment = {};         ///< [N m], turns the slope, in the plane

  /// Its material coordinate on a beam [m].
  double place(const ChainView<D>& beam, double t) const { return x ? x(t) : beam.mark_of(node); }
  /// Whether that is on the beam: a load that travels comes and goes.
  bool acts_at(double place, const ChainView<D>& beam) const { return !x || beam.contains(place); }
  /// Of force and follower, where the axis has the slope r_x [N].
  Vec<double, D> force_on(const Vec<double, D>& r_x, double t) const {
    Vec<double, D> sum = Vec<double, D>::Zero();
    if (force) sum += force(t);
    if (follower) sum += follower(t) * r_x.normalized();
    return sum;
  }
  /// Its derivative by r_x.
  Eigen::Matrix<double, D, D> turning(const Vec<double, D>& r_x, double t) const {
    const Vec<double, D> tangent = r_x.normalized();
    return (follower ? follower(t) / r_x.norm() : 0) *
           (Eigen::Matrix<double, D, D>::Identity() - tangent * tangent.transpose());
  }
};

/// Throws ModelError where the material point of a load is not between the ends of the beam in [0, until]; `ends`
/// gives their material coordinates, `beyond` [m] is what rounding may be off.
template <int D>
void check_places(const std::vector<PointLoad<D>>& loads, double until, double beyond,
                  const std::function<std::pair<double, double>(double t)>& ends);

/// Forces on material points of a beam, and along all of it. A force F on the material point x is N^T F of the
/// element that holds it, N = [S, y_A, y_B]; along the beam it acts on the mark of a joint, if that is an end of it. A
/// moment is the same of the slope, with N_x. What is distributed evenly acts as gravity does, of the beam alone: see
/// CurrentBeam::beam_gravity.
template <int D>
struct Loads {
  using ElementMatrix = PointMatrix<D>;

  std::vector<PointLoad<D>> points = {};
  std::function<Vec<double, D>(double t)> line_force = {};  ///< on the whole beam [N/m]

  bool present() const { return !points.empty() || line_force; }

  /// Adds the concentrated ones to an array like q; returns their power [W]. Where nodes are prescribed, what they do
  /// along the beam [N] is added to `on_marks`, one entry a node, unless that is null.
  double add_forces(const ChainView<D>& beam, double t, double* force, double* on_marks = nullptr) const;
  /// Calls `add(element, matrix)` with the tangent of minus these forces by the element's coordinates.
  template <class Add>
  void add_tangent(const ChainView<D>& beam, double t, const TangentWeights& by, const Add& add) const {
    for (const PointLoad<D>& load : points) {
      const double x = load.place(beam, t);
      if (!load.acts_at(x, beam)) continue;
      const int k = beam.element_at(x);
      if (load.follower || beam.at_joint(k)) add(k, ElementMatrix(by.q * tangent(load, beam, k, t)));
      if (load.moment) add(k, ElementMatrix(by.q * moment_tangent(load, beam, k, t)));
    }
  }
  /// Where the concentrated ones are [m]; no numbers while one is not on the beam.
  std::vector<Vec<double, D>> places(const ChainView<D>& beam, double t) const;

 private:
  ElementMatrix tangent(const PointLoad<D>& load, const ChainView<D>& beam, int k, double t) const;
  static ElementMatrix moment_tangent(const PointLoad<D>& load, const ChainView<D>& beam, int k, double t);
};

}  // namespace vlbeam
