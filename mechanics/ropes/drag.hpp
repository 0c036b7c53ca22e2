#pragma once

#include <cmath>

#include "mechanics/motion/parts/part.hpp"
#include "mechanics/motion/system/beam_model.hpp"
#include "mechanics/ropes/line_force.hpp"

namespace vlbeam {

/// Of a force per unstretched length against a velocity across and along the axis.
struct DragCoefficients {
  double normal = 0, tangential = 0;

  bool present() const { return normal != 0 || tangential != 0; }
};

/// What a fluid around a beam does to it, per unstretched length, at the velocity v of the material point against that
/// of the fluid and the tangent t = r_x/|r_x|, v_t = v.t, v_n = v - v_t t:
///   f = -(c_n v_n + c_t v_t t) - (q_n |v_n| v_n + q_t |v_t| v_t t).
/// Damping in proportion to the beam's mass is c_n = c_t = alpha rhoA. Summed up at the model's points as its inertia
/// is, N^T f: what it takes is exactly the work of the generalized forces, and what a stream gives is a load's. Lumped
/// masses and what slides have none.
template <int D>
struct Drag {
  DragCoefficients linear;     ///< [N s/m^2]
  DragCoefficients quadratic;  ///< [N s^2/m^3]
  int quadrature_points = 5;
  Vec<double, D> stream = Vec<double, D>::Zero();  ///< velocity of the fluid [m/s]

  bool present() const { return linear.present() || quadratic.present(); }
  bool streams() const { return present() && stream.squaredNorm() > 0; }
  /// Whether the force is a multiple of the velocity, as of mass damping: on an element of fixed length it is its mass
  /// matrix that damps, then.
  bool proportional() const { return linear.normal == linear.tangential && !quadratic.present(); }

  static bool acts(const Vec<double, D>& /*place*/) { return true; }
  /// Per unstretched length [N/m].
  template <class Real>
  Vec<Real, D> force(const LinePoint<Real, D>& at) const {
    const Vec<Real, D> v = at.v - stream.template cast<Real>();
    Vec<Real, D> f = v * Real(-linear.normal);
    if (proportional()) return f;
    const Vec<Real, D> t = at.r_x * Real(Real(1) / sqrt(Real(at.r_x.squaredNorm())));
    const Real along = v.dot(t);
    const Vec<Real, D> across = v - t * along;
    const Real speed2 = across.squaredNorm(), speed_along = along < Real(0) ? Real(-along) : along;
    f -= t * Real(along * Real(Real(linear.tangential - linear.normal) + speed_along * Real(quadratic.tangential)));
    if (speed2 > Real(0)) f -= across * Real(Real(sqrt(speed2)) * Real(quadratic.normal));
    return f;
  }

  /// Adds it to an array like q; returns the power that it takes and gives. Where nodes are prescribed, what it does
  /// along the beam [N] is added to `on_marks`, one entry a node, unless that is null.
  EnergyBalance add_forces(const ChainView<D>& beam, double* force, double* on_marks = nullptr) const;
  /// Calls `add(element, matrix)` with the tangent of minus it by the element's coordinates.
  template <class Add>
  void add_tangent(const ChainView<D>& beam, const TangentWeights& by, const Add& add) const {
    for (int k = 0; present() && k < beam.mesh.elements(); ++k) {
      add(k, proportional() && !moves_along(beam, k) ? proportional_tangent(beam, k, by)
                                                     : line_tangent<D>(beam, k, quadrature_points, *this, by));
    }
  }

 private:
  EnergyBalance add_proportional_force(const ChainView<D>& beam, int k, double* force) const;
  PointMatrix<D> proportional_tangent(const ChainView<D>& beam, int k, const TangentWeights& by) const;
};

/// Drag as a part of the equations.
template <int D>
class ActingDrag final : public Part<D> {
 public:
  explicit ActingDrag(const Drag<D>& drag) : drag_(drag) {}
  const Drag<D>& drag() const { return drag_; }
  bool gives() const override { return drag_.streams(); }
  bool takes_evenly() const override { return true; }
  EnergyBalance add_force(const Motion<D>& motion, double* force) const override {
    return drag_.add_forces(motion.beam, force);
  }
  double load_power(const Motion<D>& motion, double* scratch) const override {
    return drag_.streams() ? drag_.add_forces(motion.beam, scratch).loads : 0;
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    drag_.add_tangent(motion.beam, by,
                      [&](int k, const PointMatrix<D>& matrix) { tangent.add_point(motion.beam, k, matrix); });
  }

 private:
  Drag<D> drag_;
};

/// The drag among the parts of a model, or null.
template <int D>
const Drag<D>* drag_of(const BeamModel<D>& model) {
  for (const auto& part : model.parts) {
    if (const auto* const acting = dynamic_cast<const ActingDrag<D>*>(part.get())) return &acting->drag();
  }
  return nullptr;
}

extern template class ActingDrag<2>;
extern template class ActingDrag<3>;

}  // namespace vlbeam
