#pragma once

#include <vector>

#include "mechanics/motion/system/event_source.hpp"
#include "mechanics/motion/system/node_link.hpp"

namespace vlbeam {

/// A feature that a model brings to its beam, besides what acts on it, which is a Part. The beam knows it by this
/// alone. Features of this library come by rooms.cpp.
template <int D>
class Room {
 public:
  virtual ~Room() = default;
  /// Appends its sources of events.
  virtual void add_sources(const BeamInside<D>& /*inside*/, EventSources<D>& /*sources*/) const {}
  /// Appends its links between nodes of the beam as it is now.
  virtual void add_links(const CurrentBeam<D>& /*beam*/, std::vector<NodeLink<D>>& /*links*/) const {}
};

}  // namespace vlbeam
