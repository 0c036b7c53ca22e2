#pragma once

#include <memory>
#include <vector>

#include "core/length_control/chain_state.hpp"
#include "mechanics/frames/rest_triads.hpp"

namespace vlbeam {

/// How sections are turned at the nodes of a chain, and are at rest.
struct FrameSections final : KeptAtNodes {
  std::vector<SectionState> now, at_rest;
  std::shared_ptr<const RestTriads> rest_triads = {};  ///< what new nodes, and those that move, follow at rest
};

/// Those of a chain that has them.
inline const FrameSections& sections_of(const ChainState<3>& chain) {
  return dynamic_cast<const FrameSections&>(*chain.kept);
}
/// A copy of them to write on, in their place.
inline FrameSections& own_sections(ChainState<3>& chain) {
  const auto own = std::make_shared<FrameSections>(sections_of(chain));
  chain.kept = own;
  return *own;
}

}  // namespace vlbeam
