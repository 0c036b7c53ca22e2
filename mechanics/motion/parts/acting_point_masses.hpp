#pragma once

#include "mechanics/motion/parts/material_point.hpp"
#include "mechanics/motion/parts/part.hpp"
#include "mechanics/motion/parts/point_masses.hpp"

namespace vlbeam {

/// Point masses as a part of the equations; `masses` must outlive it.
template <int D>
class ActingPointMasses final : public Part<D> {
 public:
  explicit ActingPointMasses(const PointMasses<D>& masses) : masses_(masses) {}
  EnergyBalance add_force(const Motion<D>& motion, double* force) const override {
    masses_.add_weight(motion.beam, motion.gravity, force);
    return {};
  }
  double load_power(const Motion<D>& /*motion*/, double* /*scratch*/) const override { return 0; }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    masses_.add_tangent(motion.beam, motion.a, motion.gravity, by,
                        [&](int k, const PointMatrix<D>& matrix) { tangent.add_point(motion.beam, k, matrix); });
  }

 private:
  const PointMasses<D>& masses_;
};

extern template class ActingPointMasses<2>;
extern template class ActingPointMasses<3>;

}  // namespace vlbeam
