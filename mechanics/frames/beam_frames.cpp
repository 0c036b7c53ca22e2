// What frames of sections add to a beam with joints.
#include <utility>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

template <int D>
void CurrentBeam<D>::take_frames(const ChainState<D>& chain) {
  if constexpr (D == 3) {
    std::erase(acting_, sections_.frames);
    sections_.frames =
        std::make_shared<Frames>(*model_.frames, chain.mesh, chain.rest.empty() ? nullptr : chain.rest.data(),
                                 chain.rest_sections, chain.q.data(), chain.sections);
    acting_.push_back(sections_.frames);
    sections_.rest = chain.rest_sections;
    sections_.rest_triads = chain.rest_triads;
  }
}

template void CurrentBeam<2>::take_frames(const ChainState<2>&);
template void CurrentBeam<3>::take_frames(const ChainState<3>&);

}  // namespace vlbeam
