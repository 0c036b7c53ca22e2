#pragma once

#include <memory>
#include <utility>

#include "mechanics/assembly/handle.hpp"
#include "mechanics/motion/parts/part.hpp"

namespace vlbeam {

/// Forces of links on a beam, as a part of its equations.
template <int D>
class ActingLinks final : public Part<D> {
 public:
  explicit ActingLinks(std::shared_ptr<const LinkForces<D>> forces) : forces_(std::move(forces)) {}

  EnergyBalance add_force(const Motion<D>& /*motion*/, double* force) const override {
    forces_->add_to(force);
    return {};
  }
  double load_power(const Motion<D>& /*motion*/, double* /*scratch*/) const override { return 0; }
  bool works() const override { return false; }
  Vec<double, D> force_on_joint(int node) const override {
    Vec<double, D> sum = Vec<double, D>::Zero();
    for (const auto& on : forces_->all) {
      if (on.handle->shares.front().at == Eigen::Index{node_size<D>} * node) sum += on.force;
    }
    return sum;
  }
  /// Links know how their forces change: AssemblyEquations.
  void add_tangent(const Motion<D>& /*motion*/, const TangentWeights& /*by*/,
                   BeamMatrix<D>& /*tangent*/) const override {}

 private:
  std::shared_ptr<const LinkForces<D>> forces_;
};

}  // namespace vlbeam
