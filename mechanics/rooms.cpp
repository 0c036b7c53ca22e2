// What features bring to a beam: the only place that knows both.
#include "mechanics/rooms.hpp"

#include "mechanics/motion/system/joint_cuts.hpp"
#include "mechanics/motion/system/joint_limits.hpp"
#include "mechanics/motion/system/passages.hpp"
#include "mechanics/motion/system/room.hpp"
#include "mechanics/motion/system/section_changes.hpp"
#include "mechanics/remesh/restore_beside_joint.hpp"
#include "mechanics/ride/ride_events.hpp"
#include "mechanics/ride/riding_mass.hpp"

namespace vlbeam {

template <int D>
EventSources<D> sources_of_rooms(const BeamInside<D>& inside) {
  const BeamModel<D>& model = inside.beam.model();
  EventSources<D> sources;
  if (!model.joints.empty()) {
    sources.push_back(std::make_unique<JointCuts<D>>(inside));
    sources.push_back(std::make_unique<JointLimits<D>>(inside));
    if constexpr (has_room("ride")) sources.push_back(std::make_unique<RideEvents<D>>(inside));
    if (model.masses.present()) sources.push_back(std::make_unique<Passages<D>>(inside));
    if (!model.pieces.empty()) sources.push_back(std::make_unique<SectionChanges<D>>(inside));
  }
  for (const auto& room : model.rooms) room->add_sources(inside, sources);
  return sources;
}

template <int D>
std::unique_ptr<LooseMass<D>> loose_mass_of_rooms([[maybe_unused]] const CurrentBeam<D>& beam,
                                                  [[maybe_unused]] const ChainState<D>& chain) {
  if constexpr (has_room("ride")) {
    if (chain.loose) return std::make_unique<RidingMass<D>>(beam, *chain.loose);
  }
  return nullptr;
}

template <int D>
std::optional<LocalConservation<D>> local_conservation_of_rooms() {
  if constexpr (has_room("remesh")) return LocalConservation<D>{&kinetic_energy<D>, &restore_beside_joint<D>};
  return std::nullopt;
}

template std::optional<LocalConservation<2>> local_conservation_of_rooms();
template std::optional<LocalConservation<3>> local_conservation_of_rooms();
template std::unique_ptr<LooseMass<2>> loose_mass_of_rooms(const CurrentBeam<2>&, const ChainState<2>&);
template std::unique_ptr<LooseMass<3>> loose_mass_of_rooms(const CurrentBeam<3>&, const ChainState<3>&);
template EventSources<2> sources_of_rooms(const BeamInside<2>&);
template EventSources<3> sources_of_rooms(const BeamInside<3>&);

}  // namespace vlbeam
