#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// A choice of the scene or of a result, with the name users read and write.
template <class E>
struct Named {
  E value;
  std::string_view name;
};

constexpr auto names(SceneSetting) {
  return std::to_array<Named<SceneSetting>>(
      {{SceneSetting::standard, "default"}, {SceneSetting::ding_ouyang_2022, "ding-ouyang-2022"}});
}
constexpr auto names(ElementKind) {
  using enum ElementKind;
  return std::to_array<Named<ElementKind>>(
      {{ale_rancf, "ALE-RANCF"}, {ale_ancf, "ALE-ANCF"}, {rancf, "RANCF"}, {ancf, "ANCF"}});
}
constexpr auto names(CurveType) {
  using enum CurveType;
  return std::to_array<Named<CurveType>>({{line, "line"}, {arc, "arc"}, {nurbs, "nurbs"}, {polyline, "polyline"}});
}
constexpr auto names(RestShape) {
  return std::to_array<Named<RestShape>>(
      {{RestShape::as_built, "as-built"}, {RestShape::straight, "straight"}, {RestShape::paper, "paper"}});
}
constexpr auto names(AxisForm) {
  return std::to_array<Named<AxisForm>>({{AxisForm::even, "even"}, {AxisForm::exact, "exact"}});
}
constexpr auto names(BendingInertia) {
  using enum BendingInertia;
  return std::to_array<Named<BendingInertia>>({{none, "none"}, {rayleigh, "rayleigh"}, {gyroscopic, "gyroscopic"}});
}
constexpr auto names(StrainLaw) {
  return std::to_array<Named<StrainLaw>>({{StrainLaw::green, "green"}, {StrainLaw::engineering, "engineering"}});
}
constexpr auto names(Compression) {
  return std::to_array<Named<Compression>>({{Compression::full, "full"}, {Compression::none, "none"}});
}
constexpr auto names(OutOfPlane) { return std::to_array<Named<OutOfPlane>>({{OutOfPlane::none, "none"}}); }
constexpr auto names(SpaceLaw) {
  return std::to_array<Named<SpaceLaw>>({{SpaceLaw::frames, "frames"}, {SpaceLaw::scalar, "scalar"}});
}
constexpr auto names(AxialStrain) {
  return std::to_array<Named<AxialStrain>>({{AxialStrain::full, "full"}, {AxialStrain::lobatto, "lobatto"}});
}
constexpr auto names(BearingType) {
  using enum BearingType;
  return std::to_array<Named<BearingType>>({{pin, "pin"}, {roller, "roller"}, {spring, "spring"}});
}
constexpr auto names(SupportType) {
  using enum SupportType;
  return std::to_array<Named<SupportType>>({{clamp, "clamp"}, {pin, "pin"}, {slide, "slide"}, {free, "free"}});
}
constexpr auto names(AngleField) {
  return std::to_array<Named<AngleField>>({{AngleField::linear, "linear"}, {AngleField::hermite, "hermite"}});
}
constexpr auto names(LoadType) {
  using enum LoadType;
  return std::to_array<Named<LoadType>>(
      {{force, "force"}, {follower, "follower"}, {moment, "moment"}, {torque, "torque"}});
}
constexpr auto names(Analysis) {
  return std::to_array<Named<Analysis>>({{Analysis::dynamics, "dynamics"}, {Analysis::statics, "statics"}});
}
constexpr auto names(InitialShape) {
  return std::to_array<Named<InitialShape>>(
      {{InitialShape::built, "built"}, {InitialShape::equilibrium, "equilibrium"}});
}
constexpr auto names(LoadControl) {
  return std::to_array<Named<LoadControl>>({{LoadControl::load, "load"}, {LoadControl::arc_length, "arc-length"}});
}
constexpr auto names(StaticJoints) {
  return std::to_array<Named<StaticJoints>>({{StaticJoints::released, "released"}, {StaticJoints::held, "held"}});
}
constexpr auto names(LoadPlace) {
  using enum LoadPlace;
  return std::to_array<Named<LoadPlace>>({{node, "node"}, {point, "point"}, {beam, "beam"}});
}
constexpr auto names(BeamEnd) {
  return std::to_array<Named<BeamEnd>>({{BeamEnd::start, "start"}, {BeamEnd::end, "end"}});
}
constexpr auto names(Winding) {
  return std::to_array<Named<Winding>>({{Winding::stretched, "stretched"}, {Winding::unstretched, "unstretched"}});
}
constexpr auto names(ClampType) {
  return std::to_array<Named<ClampType>>({{ClampType::direction, "direction"}, {ClampType::full, "full"}});
}
constexpr auto names(JointSlopes) {
  using enum JointSlopes;
  return std::to_array<Named<JointSlopes>>(
      {{continuous, "continuous"}, {tangent, "tangent"}, {equal_stretch, "equal-stretch"}, {free, "free"}});
}
constexpr auto names(AtSupport) {
  using enum AtSupport;
  return std::to_array<Named<AtSupport>>({{stop, "stop"}, {rest, "rest"}, {rebound, "rebound"}});
}
constexpr auto names(MergePolicy) {
  using enum MergePolicy;
  return std::to_array<Named<MergePolicy>>({{point_fit, "point-fit"},
                                            {unit, "unit"},
                                            {rest_arc, "rest-arc"},
                                            {least_change, "least-change"},
                                            {own, "own"},
                                            {relaxed, "relaxed"}});
}
constexpr auto names(CutPolicy) {
  return std::to_array<Named<CutPolicy>>({{CutPolicy::exact, "exact"}, {CutPolicy::relaxed, "relaxed"}});
}
constexpr auto names(VelocityTransfer) {
  using enum VelocityTransfer;
  return std::to_array<Named<VelocityTransfer>>(
      {{nodal, "nodal"}, {projected, "projected"}, {conservative, "conservative"}});
}
constexpr auto names(StandardProfile) {
  std::array<Named<StandardProfile>, standard_profiles.size()> list{};
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = {static_cast<StandardProfile>(i), standard_profiles[i].name};
  return list;
}
constexpr auto names(IntegratorType) {
  using enum IntegratorType;
  return std::to_array<Named<IntegratorType>>({{dopri5, "dopri5"},
                                               {cash_karp, "cash-karp"},
                                               {fehlberg78, "fehlberg78"},
                                               {bulirsch_stoer, "bulirsch-stoer"},
                                               {adams_bashforth_moulton, "adams-bashforth-moulton"},
                                               {rosenbrock4, "rosenbrock4"},
                                               {generalized_alpha, "generalized-alpha"},
                                               {energy_momentum, "energy-momentum"},
                                               {ida, "ida"},
                                               {cvode, "cvode"},
                                               {arkode, "arkode"}});
}
constexpr auto names(Constraints) {
  using enum Constraints;
  return std::to_array<Named<Constraints>>({{eliminated, "eliminated"}, {multipliers, "multipliers"}});
}
constexpr auto names(ErrorEstimate) {
  return std::to_array<Named<ErrorEstimate>>({{ErrorEstimate::all, "all"}, {ErrorEstimate::filtered, "filtered"}});
}
constexpr auto names(NewtonKind) {
  return std::to_array<Named<NewtonKind>>({{NewtonKind::modified, "modified"}, {NewtonKind::full, "full"}});
}
constexpr auto names(Section::Type) {
  using enum Section::Type;
  return std::to_array<Named<Section::Type>>({{circle, "circle"},
                                              {rectangle, "rectangle"},
                                              {stiffness, "stiffness"},
                                              {tube, "tube"},
                                              {box, "box"},
                                              {profile, "profile"},
                                              {rope, "rope"},
                                              {chain, "chain"}});
}
constexpr auto names(RopeConstruction) {
  using enum RopeConstruction;
  return std::to_array<Named<RopeConstruction>>({{wire_fibre_core, "wire-fibre-core"},
                                                 {wire_wire_core, "wire-wire-core"},
                                                 {nylon, "nylon"},
                                                 {polyester, "polyester"},
                                                 {polypropylene, "polypropylene"}});
}
constexpr auto names(ChainLinks) {
  return std::to_array<Named<ChainLinks>>({{ChainLinks::studless, "studless"}, {ChainLinks::studlink, "studlink"}});
}
constexpr auto names(MaterialName) {
  using enum MaterialName;
  return std::to_array<Named<MaterialName>>(
      {{own, "own"}, {steel, "steel"}, {aluminium, "aluminium"}, {timber, "timber"}});
}
constexpr auto names(Formulation) {
  using enum Formulation;
  return std::to_array<Named<Formulation>>({{variational, "variational"}, {virtual_work, "virtual-work"}});
}
constexpr auto names(WeightTransport) {
  using enum WeightTransport;
  return std::to_array<Named<WeightTransport>>({{frozen, "frozen"}, {transported, "transported"}});
}
constexpr auto names(EventType) {
  using enum EventType;
  return std::to_array<Named<EventType>>({{segment_merge, "segment-merge"},
                                          {segmentation, "segmentation"},
                                          {merging, "merging"},
                                          {separation, "separation"},
                                          {reweighting, "reweighting"},
                                          {end_merge, "end-merge"},
                                          {end_cut, "end-cut"},
                                          {contact, "contact"},
                                          {lift_off, "lift-off"},
                                          {passage, "passage"}});
}
constexpr auto names(RunStatus) {
  using enum RunStatus;
  return std::to_array<Named<RunStatus>>(
      {{completed, "completed"}, {separated, "separated"}, {failed, "failed"}, {interrupted, "interrupted"}});
}
constexpr auto names(WarningKind) {
  using enum WarningKind;
  return std::to_array<Named<WarningKind>>({{energy_at_events, "energy-at-events"},
                                            {energy_not_restored, "energy-not-restored"},
                                            {energy_between_events, "energy-between-events"},
                                            {energy_unexplained, "energy-unexplained"},
                                            {stability_limits_steps, "stability-limits-steps"},
                                            {large_strain, "large-strain"},
                                            {thick_elements, "thick-elements"},
                                            {light_material, "light-material"},
                                            {buckled_elements, "buckled-elements"},
                                            {hidden_stability, "hidden-stability"},
                                            {assumed_material, "assumed-material"},
                                            {rounded_corner, "rounded-corner"},
                                            {held_ring, "held-ring"},
                                            {ringing_friction, "ringing-friction"},
                                            {error_in_time, "error-in-time"},
                                            {error_of_mesh, "error-of-mesh"},
                                            {redundant_links, "redundant-links"},
                                            {sudden_gravity, "sudden-gravity"},
                                            {lifting_wheel, "lifting-wheel"},
                                            {free_twist, "free-twist"},
                                            {no_ground_friction, "no-ground-friction"}});
}

/// A choice whose values have names.
template <class E>
concept NamedEnum = requires {
  names(E{});
};

template <NamedEnum E>
constexpr std::string_view to_string(E value) {
  for (const auto& entry : names(value)) {
    if (entry.value == value) return entry.name;
  }
  return "?";
}

/// The name as a message writes what the scene says.
template <NamedEnum E>
std::string quoted(E value) {
  return "\"" + std::string(to_string(value)) + "\"";
}

/// The choice called `name`, or nothing.
template <NamedEnum E>
constexpr std::optional<E> from_string(std::string_view name) {
  for (const auto& entry : names(E{})) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

}  // namespace vlbeam
