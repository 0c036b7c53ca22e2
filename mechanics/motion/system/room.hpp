#pragma once

#include <memory>
#include <vector>

#include "mechanics/motion/system/beam_link.hpp"
#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// A feature that a model brings to its beam, besides what acts on it, which is a Part. The beam knows it by this
/// alone. Features of this library come by rooms.cpp.
template <int D>
class Room {
 public:
  virtual ~Room() = default;
  /// Appends its sources of events.
  virtual void add_sources(const BeamInside<D>& /*inside*/, EventSources<D>& /*sources*/) const {}
  /// Unknowns of its own on a beam that has no others, or null.
  virtual std::unique_ptr<Unknowns<D>> unknowns(const CurrentBeam<D>& /*beam*/) const { return nullptr; }
  /// Appends masses that the beam carries now at points that travel along it: see BeamLink::carrying().
  virtual void add_carried(const ChainView<D>& /*beam*/, double /*t*/, std::vector<BeamLink<D>>& /*carried*/) const {}
  /// Appends its links of the beam as it is now.
  virtual void add_links(const CurrentBeam<D>& /*beam*/, std::vector<BeamLink<D>>& /*links*/) const {}
};

}  // namespace vlbeam
