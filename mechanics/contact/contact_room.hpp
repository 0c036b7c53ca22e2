#pragma once

#include <vector>

#include "mechanics/contact/at_support.hpp"
#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

/// What becomes of joints that reach each other, or supports at the ends of the beam that they may not leave. Without
/// it a run ends there.
template <int D>
class ContactRoom final : public Room<D> {
 public:
  std::vector<Impact> at_support;  ///< of the model's joints; of those behind them, the run ends
  Impact at_meeting = {};          ///< of two joints
  bool joints_rest = false;        ///< what bounces lower and lower stays, else the run ends there

  bool parts_joints() const override { return at_meeting.law != AtSupport::stop; }
  void add_sources(const BeamInside<D>& inside, EventSources<D>& sources) const override;
};

extern template class ContactRoom<2>;
extern template class ContactRoom<3>;

/// What becomes of joint `index` of a model at a support.
template <int D>
Impact impact_at_support(const BeamModel<D>& model, int index) {
  const auto* const room = room_of<ContactRoom<D>>(model);
  const auto i = static_cast<std::size_t>(index);
  return room != nullptr && i < room->at_support.size() ? room->at_support[i] : Impact{};
}

}  // namespace vlbeam
