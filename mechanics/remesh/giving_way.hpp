#pragma once

#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

/// Nodes beside what an event has cut and merged give way, until the strain energy that the event has created is gone.
template <int D>
class RemeshRoom final : public Room<D> {
 public:
  bool cuts = false;    ///< the new node of a cut element goes to the least strain energy of the two halves
  bool merges = false;  ///< the outer nodes of a merged element give way

  void add_sources(const BeamInside<D>& inside, EventSources<D>& sources) const override;
};

extern template class RemeshRoom<2>;
extern template class RemeshRoom<3>;

}  // namespace vlbeam
