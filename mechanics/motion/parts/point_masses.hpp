#pragma once

#include <vector>

#include "core/beam/point_mass.hpp"
#include "core/geometry/vec.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/parts/point_matrix.hpp"

namespace vlbeam {

template <int D>
struct ChainView;
template <class Real, int D>
struct MovingEquations;

/// Masses on material points: each adds m r'.r'/2 + m g.r to the Lagrangian, and so m N^T (r'' - g) to the equations of
/// motion, r'' = N q'' + r_v. On elements of fixed length the inertia is part of their constant mass matrix, see
/// add_point_masses(); what is left there is the weight.
template <int D>
struct PointMasses {
  using Vector = Vec<double, D>;

  std::vector<PointMass> points = {};  ///< in the order of their material coordinates

  bool present() const { return !points.empty(); }

  /// Index of the element that holds the `i`-th. At a joint which of the two it is changes at a passage, and not
  /// before: a step that goes past it is a smooth one until the passage is located.
  int element_of(const ChainView<D>& beam, std::size_t i) const {
    int k = beam.element_at(points[i].x);
    const int rank = static_cast<int>(i);
    for (const auto& joint : beam.joints) {
      k += k + 1 == joint.node && joint.passed >= 0 && rank >= joint.passed ? 1 : 0;
    }
    for (std::size_t n = beam.joints.size(); n-- > 0;) {
      k -= k == beam.joints[n].node && rank < beam.joints[n].passed ? 1 : 0;
    }
    return k;
  }

  /// Adds the weight of those on elements of fixed length to an array like q.
  void add_weight(const ChainView<D>& beam, const Vector& gravity, double* force) const;
  /// Adds those on element k, which is at the joint, to its equations of motion.
  void add_to(const ChainView<D>& beam, int k, const Vector& gravity, MovingEquations<double, D>& equations) const;
  /// Adds m N^T (r'' - g) of those at the joint to an array like q.
  void add_residual(const ChainView<D>& beam, const double* a, const Vector& gravity, double* residual) const;
  /// Calls `add(element, matrix)` with the tangent of that.
  template <class Add>
  void add_tangent(const ChainView<D>& beam, const double* a, const Vector& gravity, const TangentWeights& by,
                   const Add& add) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int k = element_of(beam, i);
      if (beam.at_joint(k)) add(k, tangent(points[i], beam, k, a, gravity, by));
    }
  }

 private:
  static PointMatrix<D> tangent(const PointMass& point, const ChainView<D>& beam, int k, const double* a,
                                const Vector& gravity, const TangentWeights& by);
};

}  // namespace vlbeam
