#pragma once

#include "mechanics/motion/system/room.hpp"
#include "mechanics/spin/spin.hpp"

namespace vlbeam {

/// The section of a beam turns about its axis.
template <int D>
class SpinRoom final : public Room<D>, public SpinModel {
 public:
  void count(BalanceEntries& balance) const override;
  std::unique_ptr<Unknowns<D>> unknowns(const CurrentBeam<D>& beam, const std::vector<double>& x) const override;
};

extern template class SpinRoom<2>;
extern template class SpinRoom<3>;

/// How the section of a model's beam turns; null where there is no angle at all, but of frames.
template <int D>
const SpinModel* spin_model(const BeamModel<D>& model) {
  return room_of<SpinRoom<D>>(model);
}
/// The same to write on: see bring().
template <int D>
SpinModel& spin_in(BeamModel<D>& model) {
  return bring<SpinRoom<D>>(model);
}

}  // namespace vlbeam
