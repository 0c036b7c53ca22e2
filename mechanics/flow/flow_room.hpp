#pragma once

#include "mechanics/flow/mesh_motion.hpp"
#include "mechanics/flow/rotary_inertia.hpp"
#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

/// All nodes of a beam travel along it, or stand still, as prescribed: there are no joints then and no length control.
/// Every element is a variable-length one, and matter comes in through the ends with the velocity it has there.
template <int D>
class FlowRoom final : public Room<D> {
 public:
  MeshMotion motion;
  RotaryInertia<D> rotary = {};  ///< needs the variational formulation and frozen weights
  bool books = true;             ///< the state counts all that the beam is given, not just what it loses

  BalanceEntries counted(const BalanceEntries& asked) const override {
    return books ? BalanceEntries{true, true, true, false, D} : BalanceEntries{.dissipated = asked.dissipated};
  }
  std::unique_ptr<PrescribedMesh<D>> prescribed_mesh(const CurrentBeam<D>& beam,
                                                     const std::vector<WeightFunction>& weights) const override;
  void add_sources(const BeamInside<D>& inside, EventSources<D>& sources) const override;
};

extern template class FlowRoom<2>;
extern template class FlowRoom<3>;

/// To write on: see bring().
template <int D>
FlowRoom<D>& flow_in(BeamModel<D>& model) {
  return bring<FlowRoom<D>>(model);
}

}  // namespace vlbeam
