#include "mechanics/remesh/giving_way.hpp"

#include "mechanics/remesh/relaxation.hpp"

namespace vlbeam {

template <int D>
int GivingWay<D>::give_way(const std::vector<Reshaped>& where, const EventReach& reach, double t,
                           const ChainState<D>& before, ChainState<D>& after) const {
  const BeamModel<D>& model = beam_.model();
  std::vector<GivingNode> giving;
  const auto slope_is_free = [&](int node) {
    if (node == 0 || node == after.mesh.last()) {
      const auto& support = node == 0 ? model.start : model.end;
      if ((support.free_slope == 0).any()) return false;
    }
    const auto* const at = after.joint_at(node);
    if (at == nullptr) return true;
    const auto& support = model.joints[static_cast<std::size_t>(at->index)].support;
    return !at->kink && !(support && (support->free_slope == 0).any());
  };
  const auto place_is_free = [&](int node) {
    return node > 0 && node < after.mesh.last() && after.joint_at(node) == nullptr;
  };
  for (const auto& [cut, merged] : where) {
    if (cut >= 0 && model.length_control.cut == CutPolicy::relaxed && place_is_free(cut)) {
      giving.push_back({cut, true, true});
    }
    if (merged < 0 || model.length_control.merge != MergePolicy::relaxed) continue;
    for (const int node : {merged, merged + 1}) giving.push_back({node, place_is_free(node), slope_is_free(node)});
  }
  if (giving.empty()) return 0;
  const Energy stored = energy_jump(beam_, before, after, reach, t, own_points);
  return relax(after, giving, beam_.rules(), beam_.moving_law(t), stored.axial + stored.bending);
}

template class GivingWay<2>;
template class GivingWay<3>;

}  // namespace vlbeam
