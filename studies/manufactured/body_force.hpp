#pragma once

#include "mechanics/motion/parts/part.hpp"
#include "studies/manufactured/solution.hpp"

namespace vlbeam::manufactured {

/// The forces of a manufactured motion, on a beam with free ends.
class BodyForce final : public Part<2> {
 public:
  explicit BodyForce(const Forces& forces) : forces_(forces) {}

  EnergyBalance add_force(const Motion<2>& now, double* force) const override;
  /// None: where marks are prescribed, as here, a force that knows only x and t does not depend on the unknowns.
  void add_tangent(const Motion<2>&, const TangentWeights&, BeamMatrix<2>&) const override {}

 private:
  Forces forces_;
};

}  // namespace vlbeam::manufactured
