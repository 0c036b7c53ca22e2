#include "mechanics/motion/system/beam_model.hpp"

#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

template <int D>
BeamSection BeamModel<D>::axis_section() const {
  BeamSection axis = section;
  for (const auto& room : rooms) {
    if (room->bends()) axis.stiffness.EI = 0;
  }
  return axis;
}

template <int D>
bool BeamModel<D>::parts_work() const {
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part->works(); });
}

template <int D>
bool BeamModel<D>::joints_stop_each_other() const {
  return std::none_of(rooms.begin(), rooms.end(), [](const auto& room) { return room->parts_joints(); });
}

template <int D>
BalanceEntries BeamModel<D>::balance() const {
  const bool gives = std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part->gives(); });
  BalanceEntries asked{parts_work() || section.damped() || rubs(), loads.present() || gives, false, driven()};
  for (const auto& room : rooms) room->count(asked);
  BalanceEntries counted = asked;
  for (const auto& room : rooms) counted = room->counted(counted);
  return counted;
}

template struct BeamModel<2>;
template struct BeamModel<3>;

}  // namespace vlbeam
