#pragma once

#include "core/geometry/vec.hpp"

namespace vlbeam {

/// Kinetic energy that sections have besides that of the axis.
template <int D>
class SectionInertia {
 public:
  virtual ~SectionInertia() = default;
  /// Of a `weight` [m] of sections where the slope changes at the rate v_x at a fixed material point [J].
  virtual double kinetic(double weight, const Vec<double, D>& v_x) const = 0;
};

}  // namespace vlbeam
