#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/element/moving_points.hpp"
#include "mechanics/motion/parts/material_point.hpp"
#include "mechanics/motion/parts/part.hpp"

namespace vlbeam {

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

/// Conjugate to the slope r_x, what a moment M does: M times the derivative of the slope's angle.
template <class Real>
Vec<Real, 2> turning_force(double moment, const Vec<Real, 2>& r_x) {
  const Real share = Real(moment) / r_x.squaredNorm();
  return {-share * r_x[1], share * r_x[0]};
}

/// Tangent of minus a force on the material point x of element k, whose ends joints may be, by the element's
/// coordinates: of a constant force, and of one that turns with the slope there, by `turning`.
template <int D>
PointMatrix<D> constant_force_tangent(const ChainView<D>& beam, int k, double x, const Vec<double, D>& force,
                                      const Eigen::Matrix<double, D, D>& turning = Eigen::Matrix<double, D, D>::Zero());

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

/// The concentrated ones as a part of the equations; `loads` must outlive it.
template <int D>
class ActingLoads final : public Part<D> {
 public:
  explicit ActingLoads(const Loads<D>& loads) : loads_(loads) {}
  Tally add_force(const Motion<D>& motion, double* force) const override {
    return {.loads = loads_.add_forces(motion.beam, motion.t, force)};
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    loads_.add_tangent(motion.beam, motion.t, by,
                       [&](int k, const PointMatrix<D>& matrix) { tangent.add_point(motion.beam, k, matrix); });
  }

 private:
  const Loads<D>& loads_;
};

extern template class ActingLoads<2>;
extern template class ActingLoads<3>;

/// Rate of the integral of r dx over an element [m^2/s], by the points of its table: as they move along the beam, or,
/// for the virtual work, at fixed material points. The power of an even force over the force.
template <int D>
Vec<double, D> swept(const MovingKinematics<double, D>& element, const ShapeTabulation& table, bool reshaped,
                     Formulation formulation);

}  // namespace vlbeam
