// What features bring to a beam: the only place that knows both.
#include "mechanics/contact/contact_events.hpp"
#include "mechanics/flow/travel_events.hpp"
#include "mechanics/frames/frame_events.hpp"
#include "mechanics/motion/system/joint_cuts.hpp"
#include "mechanics/motion/system/joint_limits.hpp"
#include "mechanics/motion/system/passages.hpp"
#include "mechanics/motion/system/room.hpp"
#include "mechanics/remesh/giving_way.hpp"
#include "mechanics/ride/ride_events.hpp"
#include "mechanics/ride/riding_mass.hpp"
#include "mechanics/spin/spin_unknowns.hpp"

namespace vlbeam {

template <int D>
EventSources<D> sources_of_rooms(const BeamInside<D>& inside) {
  const BeamModel<D>& model = inside.beam.model();
  const LengthControl& control = model.length_control;
  EventSources<D> sources;
  if (model.travels()) {
    sources.push_back(std::make_unique<TravelEvents<D>>(inside));
    return sources;
  }
  if (!model.joints.empty()) {
    sources.push_back(std::make_unique<JointCuts<D>>(inside));
    sources.push_back(std::make_unique<JointLimits<D>>(inside));
    sources.push_back(std::make_unique<RideEvents<D>>(inside));
    if (model.masses.present()) sources.push_back(std::make_unique<Passages<D>>(inside));
    sources.push_back(std::make_unique<ContactEvents<D>>(inside));
    if (control.cut == CutPolicy::relaxed || control.merge == MergePolicy::relaxed) {
      sources.push_back(std::make_unique<GivingWay<D>>(inside));
    }
  }
  if constexpr (D == 3) {
    if (model.frames) sources.push_back(std::make_unique<FrameEvents>(inside));
  }
  for (const auto& room : model.rooms) room->add_sources(inside, sources);
  return sources;
}

template <int D>
std::unique_ptr<Unknowns<D>> unknowns_of_rooms(const CurrentBeam<D>& beam, const std::vector<double>& x) {
  if (beam.model().spin) return std::make_unique<SpinUnknowns<D>>(beam, x);
  if constexpr (D == 3) {
    if (beam.model().frames) return std::make_unique<FrameUnknowns>(beam);
  }
  return nullptr;
}

template <int D>
std::unique_ptr<LooseMass<D>> loose_mass_of_rooms(const CurrentBeam<D>& beam, const ChainState<D>& chain) {
  return chain.rider ? std::make_unique<RidingMass<D>>(beam, *chain.rider) : nullptr;
}

template <int D>
std::unique_ptr<PrescribedMesh<D>> prescribed_mesh_of_rooms(const CurrentBeam<D>& beam,
                                                            const std::vector<WeightFunction>& weights) {
  return beam.model().travels() ? std::make_unique<MovingMesh<D>>(beam.model(), weights) : nullptr;
}

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
