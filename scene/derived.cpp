#include "scene/derived.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/rooms.hpp"
#include "scene/build.hpp"
#include "scene/corners.hpp"
#include "scene/options.hpp"
#include "scene/sections.hpp"
#include "scene/shared_checks.hpp"
#include "scene/slack.hpp"

namespace vlbeam {
namespace {

// Points beyond which the error of the mesh hides that of the rule (studies/falling_beam, convergence in points).
constexpr int polynomial_points = 5;
constexpr int rational_points = 10;
// EA l^2/EI of an element above which it errs less by sampled axial strain: the falling beam and the elastica cross
// there (studies/slender). By a little more, for elements of exactly that.
constexpr double slender = 100 * (1 + 1e-6);
constexpr double separation_share = 1e-3;  // of the beam's length
constexpr double default_end_merge = 0.5;  // of L_std

bool is_curved_at_rest(const Scene& scene) { return has_rest_shape(scene) && is_curved(scene); }

}  // namespace

Scene scene_in(SceneSetting setting) {
  Scene scene;
  scene.setting = setting;
  if (setting == SceneSetting::standard) return scene;
  scene.beam.element = ElementKind::ale_rancf;
  scene.beam.rest_shape = RestShape::paper;
  scene.beam.strain_law = StrainLaw::green;
  scene.formulation = Formulation::virtual_work;
  scene.weights = WeightTransport::frozen;
  scene.beam.axial_strain = AxialStrain::full;
  scene.length_control.merge = MergePolicy::point_fit;
  scene.length_control.cut = CutPolicy::exact;
  scene.length_control.velocities = VelocityTransfer::nodal;
  scene.length_control.end_merge = 0;
  return scene;
}

bool is_curved(const Scene& scene) {
  const CurveSpec& curve = scene.beam.curve;
  if (curve.type == CurveType::line) return false;
  return !may_have_corners(curve) || !build_axis<3>(scene).straightened().straight();
}

bool has_rest_shape(const Scene& scene) {
  const auto& weights = scene.beam.weights;
  const bool unit = std::all_of(weights.begin(), weights.end(), [](double w) { return w == 1; });
  return scene.beam.rest_shape == RestShape::as_built && (!unit || is_curved(scene));
}

bool has_frames(const Scene& scene) {
  const BeamSpec& beam = scene.beam;
  if (scene.dimension != 3) return false;
  if (beam.space_law) return *beam.space_law == SpaceLaw::frames;
  const FrameSection section = build_frames(beam);
  return section.EI_y != section.EI_z || (section.EI_y > 0 && is_curved_at_rest(scene) && !beam.out_of_plane);
}

int quadrature_points(const Scene& scene) {
  if (scene.beam.quadrature_points > 0) return scene.beam.quadrature_points;
  return is_polynomial(scene.beam.element) ? polynomial_points : rational_points;
}

int points_of_polynomials(const Scene& scene) {
  if (scene.beam.polynomial_points > 0) return scene.beam.polynomial_points;
  if (scene.beam.quadrature_points > 0) return scene.beam.quadrature_points;
  // where a rope goes slack its law bends sharply, and is no polynomial of anything; it may have points of its own
  const bool bends_sharply = compression(scene) == Compression::none && axial_strain(scene) == AxialStrain::full;
  return bends_sharply ? quadrature_points(scene) : polynomial_points;
}

AxialStrain axial_strain(const Scene& scene) {
  const double EA = build_section(scene.beam).stiffness.EA, l = standard_length(scene);
  const FrameSection bending = build_frames(scene.beam);
  const double EI = scene.dimension == 3 ? std::min(bending.EI_y, bending.EI_z) : bending.EI_y;
  // the outlet of a winch that runs freely pumps what sampled strain leaves without stiffness in a slack rope
  const bool freely = scene.start.winds_freely() || scene.end.winds_freely();
  const bool locks = EI > 0 ? EA * l * l > slender * EI : !has_bare_end(scene) && !freely;
  return scene.beam.axial_strain.value_or(locks ? AxialStrain::lobatto : AxialStrain::full);
}

double beam_length(const Scene& scene) { return build_axis<3>(scene).length(); }

double standard_length(const Scene& scene) { return beam_length(scene) / scene.beam.elements; }

StaticJoints static_joints(const Scene& scene) {
  const auto is_ring = [](const SlidingJointSpec& joint) {
    return joint.support == SupportType::pin && !joint.x && !joint.pulley && !joint.friction && joint.velocity == 0;
  };
  const auto& joints = scene.sliding_joints;
  const bool rings = !build_section(scene.beam).bends() && !scene.sliding_mass && !joints.empty() &&
                     std::ranges::all_of(joints, is_ring) && !fed(scene) && scene.blocks.empty();
  const bool released = scene.analysis == Analysis::statics || rings;
  return scene.statics.joints.value_or(released ? StaticJoints::released : StaticJoints::held);
}

AxisForm axis_form(const Scene& scene) {
  const bool curved = is_curved(scene);
  const bool can_be_exact = !is_polynomial(scene.beam.element) && scene.beam.curve.pitch == 0 &&
                            !(has_rest_shape(scene) && sliding_joint(scene));
  const bool exact = scene.setting == SceneSetting::ding_ouyang_2022 && curved && can_be_exact;
  return scene.beam.axis.value_or(exact ? AxisForm::exact : AxisForm::even);
}

CutPolicy cut_policy(const Scene& scene) {
  const bool sampled = axial_strain(scene) == AxialStrain::lobatto;
  return scene.length_control.cut.value_or(sampled && !has_frames(scene) ? CutPolicy::relaxed : CutPolicy::exact);
}

namespace {

/// Whether weights that fit a point would fit noise. In space a point fits three equations to three weights: those of a
/// nearly straight element become anything, and curvature and torsion at two points of an element with such weights are
/// no longer its energy. Along a taut rope a point fits what its waves stretch: weights of 0.002 follow, and slopes
/// that turn the next merge into a blow.
bool fits_noise(const Scene& scene) { return has_frames(scene) || is_rope(scene.beam); }

}  // namespace

MergePolicy merge_policy(const Scene& scene) {
  const bool relaxes = axial_strain(scene) == AxialStrain::lobatto && !has_frames(scene);
  const MergePolicy otherwise = relaxes                    ? MergePolicy::relaxed
                                : is_curved_at_rest(scene) ? MergePolicy::rest_arc
                                : fits_noise(scene)        ? MergePolicy::unit
                                                           : MergePolicy::point_fit;
  return scene.length_control.merge.value_or(otherwise);
}

bool merges_rationally(const Scene& scene) {
  return !is_polynomial(scene.beam.element) && (scene.length_control.merge || !fits_noise(scene));
}

WeightTransport weight_transport(const Scene& scene) {
  const bool transported = is_curved_at_rest(scene) && !has_frames(scene);
  return scene.weights.value_or(transported ? WeightTransport::transported : WeightTransport::frozen);
}

double separation_distance(const Scene& scene, const SlidingMassSpec& joint) {
  return joint.separation_distance.value_or(separation_share * beam_length(scene));
}

double end_merge(const Scene& scene) {
  if (scene.analysis == Analysis::statics) return 0;  // nothing rides there
  const bool kinked =
      sliding_joint(scene) && joint_slopes(scene, sliding_joints(scene).front()) != JointSlopes::continuous;
  const bool stops = !sliding_joint(scene) || sliding_joint(scene)->at_support == AtSupport::stop;
  const bool held = joint_support(scene) != SupportType::free || guided(scene) || threaded(scene);  // it needs a node
  const bool several = has_several_joints(scene);
  const bool rides = has_room("ride") && scene.length_control.enabled && !(kinked && stops) && !held && !several;
  const double otherwise = rides ? default_end_merge : 0;
  return scene.length_control.end_merge.value_or(otherwise);
}

bool joints_may_rest(const Scene& scene) {
  if (!takes_links(scene.integrator.type)) return false;
  const auto& joints = scene.sliding_joints;
  return std::ranges::none_of(joints, [](const SlidingJointSpec& joint) { return joint.friction || joint.pitch; });
}

bool has_several_joints(const Scene& scene) {
  return scene.sliding_joints.size() > 1 || fed(scene) || !knots(scene).empty();
}

namespace {

/// Whether nodes are moved to where point masses, supports and changes of the section are, off those of equal elements.
bool moves_nodes(const Scene& scene) {
  constexpr double rounding = 1e-9;  // of an element
  const auto is_off = [l = standard_length(scene)](double x) { return std::abs(x / l - std::round(x / l)) > rounding; };
  return std::ranges::any_of(section_changes(scene.beam), is_off) ||
         std::ranges::any_of(scene.bearings, [&](const BearingSpec& bearing) { return is_off(bearing.x); }) ||
         std::ranges::any_of(scene.point_masses,
                             [&](const PointMassSpec& mass) { return mass.position && is_off(*mass.position); });
}

}  // namespace

double merge_below(const Scene& scene) {
  const auto& control = scene.length_control;
  // with one joint cuts and merges come together, which elements of unequal lengths would set off again and again
  const bool uneven = scene.analysis == Analysis::dynamics && may_have_corners(scene.beam.curve) &&
                      drawn_axis<3>(scene.beam.curve).breaks().size() > 2;
  const bool apart = control.enabled && (uneven || has_several_joints(scene) ||
                                         (scene.analysis == Analysis::dynamics && moves_nodes(scene)));
  const double otherwise = apart ? 2 - control.upper * (1 + control.hysteresis) : 0;
  return control.lower.value_or(otherwise);
}

AbsoluteTolerances with_defaults(AbsoluteTolerances atol, const Scene& scene) {
  if (!atol.angle) atol.angle = atol.length / standard_length(scene);
  if (!atol.spin) atol.spin = atol.velocity / standard_length(scene);
  return atol;
}

}  // namespace vlbeam
