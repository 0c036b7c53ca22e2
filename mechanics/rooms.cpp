// What features bring to a beam: the only place that knows both.
#include "mechanics/rooms.hpp"

#include "mechanics/contact/contact_events.hpp"
#include "mechanics/flow/travel_events.hpp"
#include "mechanics/frames/frame_events.hpp"
#include "mechanics/motion/system/joint_cuts.hpp"
#include "mechanics/motion/system/joint_limits.hpp"
#include "mechanics/motion/system/passages.hpp"
#include "mechanics/motion/system/room.hpp"
#include "mechanics/motion/system/section_changes.hpp"
#include "mechanics/remesh/giving_way.hpp"
#include "mechanics/remesh/restore_beside_joint.hpp"
#include "mechanics/ride/ride_events.hpp"
#include "mechanics/ride/riding_mass.hpp"
#include "mechanics/spin/spin_unknowns.hpp"

namespace vlbeam {

template <int D>
EventSources<D> sources_of_rooms(const BeamInside<D>& inside) {
  const BeamModel<D>& model = inside.beam.model();
  [[maybe_unused]] const LengthControl& control = model.length_control;
  EventSources<D> sources;
  if constexpr (has_room("flow")) {
    if (model.travels()) {
      sources.push_back(std::make_unique<TravelEvents<D>>(inside));
      return sources;
    }
  }
  if (!model.joints.empty()) {
    sources.push_back(std::make_unique<JointCuts<D>>(inside));
    sources.push_back(std::make_unique<JointLimits<D>>(inside));
    if constexpr (has_room("ride")) sources.push_back(std::make_unique<RideEvents<D>>(inside));
    if (model.masses.present()) sources.push_back(std::make_unique<Passages<D>>(inside));
    if (!model.pieces.empty()) sources.push_back(std::make_unique<SectionChanges<D>>(inside));
    if constexpr (has_room("contact")) sources.push_back(std::make_unique<ContactEvents<D>>(inside));
    if constexpr (has_room("remesh")) {
      if (control.cut == CutPolicy::relaxed || control.merge == MergePolicy::relaxed) {
        sources.push_back(std::make_unique<GivingWay<D>>(inside));
      }
    }
  }
  if constexpr (D == 3 && has_room("frames")) {
    if (model.frames) sources.push_back(std::make_unique<FrameEvents>(inside));
  }
  for (const auto& room : model.rooms) room->add_sources(inside, sources);
  return sources;
}

template <int D>
void add_parts_of_rooms([[maybe_unused]] const BeamModel<D>& model,
                        [[maybe_unused]] std::vector<std::shared_ptr<const Part<D>>>& acting) {
  if constexpr (has_room("ropes")) {
    if (model.drag.present()) acting.push_back(std::make_shared<ActingDrag<D>>(model.drag));
  }
}

template <int D>
std::unique_ptr<Unknowns<D>> unknowns_of_rooms([[maybe_unused]] const CurrentBeam<D>& beam,
                                               [[maybe_unused]] const std::vector<double>& x) {
  if constexpr (has_room("spin")) {
    if (beam.model().spin) return std::make_unique<SpinUnknowns<D>>(beam, x);
  }
  if constexpr (D == 3 && has_room("frames")) {
    if (beam.model().frames) return std::make_unique<FrameUnknowns>(beam);
  }
  for (const auto& room : beam.model().rooms) {
    if (auto unknowns = room->unknowns(beam)) return unknowns;
  }
  return nullptr;
}

template <int D>
std::unique_ptr<LooseMass<D>> loose_mass_of_rooms([[maybe_unused]] const CurrentBeam<D>& beam,
                                                  [[maybe_unused]] const ChainState<D>& chain) {
  if constexpr (has_room("ride")) {
    if (chain.rider) return std::make_unique<RidingMass<D>>(beam, *chain.rider);
  }
  return nullptr;
}

template <int D>
std::unique_ptr<PrescribedMesh<D>> prescribed_mesh_of_rooms(
    [[maybe_unused]] const CurrentBeam<D>& beam, [[maybe_unused]] const std::vector<WeightFunction>& weights) {
  if constexpr (has_room("flow")) {
    if (beam.model().travels()) return std::make_unique<MovingMesh<D>>(beam.model(), weights);
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
template void add_parts_of_rooms(const BeamModel<2>&, std::vector<std::shared_ptr<const Part<2>>>&);
template void add_parts_of_rooms(const BeamModel<3>&, std::vector<std::shared_ptr<const Part<3>>>&);
template std::unique_ptr<PrescribedMesh<2>> prescribed_mesh_of_rooms(const CurrentBeam<2>&,
                                                                     const std::vector<WeightFunction>&);
template std::unique_ptr<PrescribedMesh<3>> prescribed_mesh_of_rooms(const CurrentBeam<3>&,
                                                                     const std::vector<WeightFunction>&);
template std::unique_ptr<LooseMass<2>> loose_mass_of_rooms(const CurrentBeam<2>&, const ChainState<2>&);
template std::unique_ptr<LooseMass<3>> loose_mass_of_rooms(const CurrentBeam<3>&, const ChainState<3>&);
template std::unique_ptr<Unknowns<2>> unknowns_of_rooms(const CurrentBeam<2>&, const std::vector<double>&);
template std::unique_ptr<Unknowns<3>> unknowns_of_rooms(const CurrentBeam<3>&, const std::vector<double>&);
template EventSources<2> sources_of_rooms(const BeamInside<2>&);
template EventSources<3> sources_of_rooms(const BeamInside<3>&);

}  // namespace vlbeam
