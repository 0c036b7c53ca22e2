#include "mechanics/remesh/giving_way.hpp"

#include "mechanics/remesh/relaxation.hpp"

namespace vlbeam {
namespace {

template <int D>
class GivingWay final : public EventSource<D> {
 public:
  GivingWay(const BeamInside<D>& inside, const RemeshRoom<D>& room) : beam_(inside.beam), room_(room) {}

  void add_guards(const Eigen::VectorXd& /*y*/, double /*t*/, Guards& /*guards*/) const override {}
  std::vector<PendingEvent> due(const Guard& /*first*/, const Eigen::VectorXd& /*y*/, double /*t*/) const override {
    return {};
  }
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& /*dues*/, ChainState<D>& /*chain*/,
                                   Eigen::VectorXd& /*y*/, double /*t*/) override {
    return {};
  }

  int reach() const override { return 3; }
  int give_way(const std::vector<Reshaped>& where, const EventReach& reach, double t, const ChainState<D>& before,
               ChainState<D>& after) const override;

 private:
  const CurrentBeam<D>& beam_;
  const RemeshRoom<D>& room_;  ///< of the beam's model
};

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
    if (cut >= 0 && room_.cuts && place_is_free(cut)) {
      giving.push_back({cut, true, true});
    }
    if (merged < 0 || !room_.merges) continue;
    for (const int node : {merged, merged + 1}) giving.push_back({node, place_is_free(node), slope_is_free(node)});
  }
  if (giving.empty()) return 0;
  const Energy stored = energy_jump(beam_, before, after, reach, t, own_points);
  return relax(after, giving, beam_.rules(), beam_.moving_law(t), stored.axial + stored.bending);
}

}  // namespace

template <int D>
void RemeshRoom<D>::add_sources(const BeamInside<D>& inside, EventSources<D>& sources) const {
  if (!inside.beam.model().joints.empty()) sources.push_back(std::make_unique<GivingWay<D>>(inside, *this));
}

template class RemeshRoom<2>;
template class RemeshRoom<3>;

}  // namespace vlbeam
