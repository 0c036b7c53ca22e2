#pragma once

#include <utility>

#include "mechanics/frames/frames.hpp"
#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

/// A beam in space whose nodes rest bends about two axes, and twists. Without it bending knows the size of the
/// curvature alone.
class FrameRoom final : public Room<3>, public FrameModel {
 public:
  FrameRoom() = default;
  explicit FrameRoom(FrameModel model) : FrameModel(std::move(model)) {}

  bool bends() const override { return true; }
  bool follows() const override { return loaded(); }
  void count(BalanceEntries& balance) const override { balance.loads = balance.loads || loaded(); }
  std::unique_ptr<Unknowns<3>> unknowns(const CurrentBeam<3>& beam, const std::vector<double>& x) const override;
  void add_sources(const BeamInside<3>& inside, EventSources<3>& sources) const override;
};

/// The frames of a model; null without.
template <int D>
const FrameModel* frame_model(const BeamModel<D>& model) {
  if constexpr (D == 3) return room_of<FrameRoom>(model);
  return nullptr;
}

}  // namespace vlbeam
