#pragma once

#include <memory>
#include <vector>

#include "mechanics/motion/system/beam_link.hpp"
#include "mechanics/motion/system/beam_model.hpp"
#include "mechanics/motion/system/event_source.hpp"
#include "mechanics/motion/system/prescribed_mesh.hpp"
#include "mechanics/motion/system/unknowns.hpp"

namespace vlbeam {

/// A feature that a model brings to its beam, besides what acts on it, which is a Part. The beam knows it by this
/// alone. A room is what it says in the model: its functions make what it brings of a beam.
template <int D>
class Room {
 public:
  virtual ~Room() = default;
  /// Whether it takes the place of the axis's own bending.
  virtual bool bends() const { return false; }
  /// Whether joints that meet are its own matter; else a run ends there.
  virtual bool parts_joints() const { return false; }
  /// Whether it brings loads that have no potential, as those that follow the beam.
  virtual bool follows() const { return false; }
  /// Adds the energies that the state has to count for it.
  virtual void count(BalanceEntries& /*balance*/) const {}
  /// What a state counts in all, of what the rest of the model asks for.
  virtual BalanceEntries counted(const BalanceEntries& asked) const { return asked; }
  /// The mesh of a beam all of whose nodes move along it as it prescribes, with the weights at t = 0; or null.
  virtual std::unique_ptr<PrescribedMesh<D>> prescribed_mesh(const CurrentBeam<D>& /*beam*/,
                                                             const std::vector<WeightFunction>& /*weights*/) const {
    return nullptr;
  }
  /// Unknowns of its own on a beam that has no others, whose nodes are at `x` at t = 0, or null.
  virtual std::unique_ptr<Unknowns<D>> unknowns(const CurrentBeam<D>& /*beam*/,
                                                const std::vector<double>& /*x*/) const {
    return nullptr;
  }
  /// Appends its sources of events.
  virtual void add_sources(const BeamInside<D>& /*inside*/, EventSources<D>& /*sources*/) const {}
  /// Appends masses that the beam carries now at points that travel along it: see BeamLink::carrying().
  virtual void add_carried(const ChainView<D>& /*beam*/, double /*t*/, std::vector<BeamLink<D>>& /*carried*/) const {}
  /// Appends its links of the beam as it is now.
  virtual void add_links(const CurrentBeam<D>& /*beam*/, std::vector<BeamLink<D>>& /*links*/) const {}
};

/// The room of that type that a model has, or null.
template <class R, int D>
const R* room_of(const BeamModel<D>& model) {
  for (const auto& room : model.rooms) {
    if (const auto* const found = dynamic_cast<const R*>(room.get())) return found;
  }
  return nullptr;
}

/// A copy of it to write on, in its place, or a new one; valid until the next call.
template <class R, int D>
R& bring(BeamModel<D>& model) {
  for (auto& room : model.rooms) {
    const auto found = std::dynamic_pointer_cast<const R>(room);
    if (!found) continue;
    const auto own = std::make_shared<R>(*found);
    room = own;
    return *own;
  }
  const auto own = std::make_shared<R>();
  model.rooms.push_back(own);
  return *own;
}

}  // namespace vlbeam
