#include "scene/validate_frames.hpp"

#include <cmath>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/integrator_type.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

constexpr double least_across = 1e-3;  // of an orientation across the beam, over its size

std::string stiffness_key(const Scene& scene, const char* name) {
  const bool given = scene.beam.section.type == Section::Type::stiffness;
  return std::string("/beam/section") + (given ? std::string("/") + name : "");
}

/// EI, or EI_y and EI_z.
void check_stiffnesses(const Scene& scene) {
  const Section& section = scene.beam.section;
  if (section.EI_y.has_value() != section.EI_z.has_value()) {
    const bool y = section.EI_y.has_value();
    refuse(y ? "/beam/section/EI_z" : "/beam/section/EI_y", InvalidInput::missing,
           std::string("it goes together with ") + (y ? "EI_y" : "EI_z") + ": a number > 0 [N m^2]");
  }
  if (section.EI_y && section.EI != 0) {
    refuse("/beam/section/EI", number_text(section.EI), "with EI_y and EI_z it must be left out");
  }
  if (section.EI_y && scene.dimension == 2) {
    refuse("/beam/section/EI_y", number_text(*section.EI_y), "a planar scene has one bending stiffness, EI");
  }
  if (scene.dimension == 3 && !has_frames(scene)) {
    const FrameSection of = build_frames(scene.beam);
    if (of.EI_y == of.EI_z) return;
    refuse("/beam/space_law", "\"scalar\"",
           "it knows one bending stiffness, and the section has " + number_text(of.EI_y) + " and " +
               number_text(of.EI_z) + " N m^2: take \"frames\"");
  }
}

/// Whether the axis y of the section is given wherever it has to be.
void check_orientation(const Scene& scene) {
  const Vec<double, 3> given = vector_of<3>(scene.beam.section.orientation);
  const bool none = given == Vec<double, 3>::Zero();
  if (!has_frames(scene)) {
    if (none) return;
    refuse("/beam/section/orientation", "this key", "only \"space_law\": \"frames\" knows how a section stands");
  }
  const FrameSection section = build_frames(scene.beam);
  if (none && section.EI_y != section.EI_z) {
    refuse("/beam/section/orientation", InvalidInput::missing,
           "the section resists bending about its axis y by " + number_text(section.EI_y) + " and about z by " +
               number_text(section.EI_z) + " N m^2: it needs a direction that is its axis y");
  }
  if (none) return;
  const Axis<3> axis = build_axis<3>(scene);
  for (const double x : place_nodes(scene, axis.breaks()).x) {
    const Vec<double, 3> t = axis.tangent(x).normalized();
    if (t.cross(given).norm() >= least_across * given.norm()) continue;
    refuse("/beam/section/orientation", "a direction along the beam at x = " + number_text(x) + " m",
           "it must be across the beam at every node");
  }
}

void check_torsion(const Scene& scene) {
  const FrameSection section = build_frames(scene.beam);
  if (!(section.EI_y > 0)) {
    refuse("/beam/space_law", "\"frames\"", "a beam without bending stiffness is a cable, which has none");
  }
  if (!(section.GIp > 0)) {
    const bool asked = scene.beam.space_law.has_value();
    refuse(stiffness_key(scene, "GIp"), scene.beam.section.GIp == 0 ? InvalidInput::missing : number_text(section.GIp),
           std::string("a beam in space with frames") +
               (asked ? "" : ", as this one, which is curved at rest, has them,") +
               " twists as it bends: it needs a torsional stiffness > 0 [N m^2]" +
               (asked ? "" : ", or \"out_of_plane\": \"none\" if nothing leaves the plane of the beam"));
  }
  const bool moves = scene.analysis == Analysis::dynamics || scene.statics.frequencies > 0;
  if (moves && !(section.rhoIp > 0)) {
    refuse(stiffness_key(scene, "rhoIp"), InvalidInput::missing,
           "sections that turn in a motion have inertia about the axis: it must be a number > 0 [kg m]");
  }
}

/// What nodes that move along the beam, `law` having been chosen, do not do yet.
void check_moving_nodes(const Scene& scene, const std::string& law) {
  const auto none = [&](bool there, const std::string& key, const std::string& what) {
    if (there) refuse(key, "this key", law + what);
  };
  const auto wants = [&](bool other, const std::string& key, const std::string& value, const std::string& allowed) {
    if (other) refuse(key, value, law + "and joints it must be " + allowed);
  };
  none(scene.flow.has_value(), "/flow", "nodes do not travel all together: leave it out, or take \"scalar\"");
  const auto joints = sliding_joints(scene);
  if (joints.empty() && !fed(scene)) return;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::string key = joint_key(scene, i);
    const JointSlopes slopes = joint_slopes(scene, joints[i]);
    wants(slopes != JointSlopes::continuous, key + "/slopes", quoted(slopes), "\"continuous\"");
    none(joints[i].pitch.has_value(), key + "/pitch", "there is no nut: leave it out, or take \"scalar\" and /spin");
    wants(has_several_joints(scene) && joints[i].at_support != AtSupport::stop, key + "/at_support",
          quoted(joints[i].at_support), "\"stop\" where there are several");
  }
  none(!scene.blocks.empty(), "/blocks", "there are no blocks: leave them out, or take \"scalar\"");
  if (scene.contact) {
    wants(scene.contact->joints != AtSupport::stop, "/contact/joints", quoted(scene.contact->joints), "\"stop\"");
  }
  const MergePolicy merge = merge_policy(scene);
  wants(merge == MergePolicy::least_change || merge == MergePolicy::relaxed || merge == MergePolicy::own,
        "/length_control/merge", quoted(merge), "\"rest-arc\", \"point-fit\" or \"unit\"");
  const CutPolicy cut = cut_policy(scene);
  wants(cut != CutPolicy::exact, "/length_control/cut", quoted(cut), "\"exact\"");
  const WeightTransport transport = weight_transport(scene);
  wants(transport != WeightTransport::frozen, "/weights", quoted(transport), "\"frozen\"");
  wants(scene.formulation != Formulation::variational, "/formulation", quoted(scene.formulation), "\"variational\"");
  if (!build_axis<3>(scene).kinks().empty()) {
    refuse("/beam/curve", "a curve with corners", law + "joints slide on smooth curves: round them off");
  }
}

void check_others(const Scene& scene) {
  const bool asked = scene.beam.space_law.has_value();
  const std::string law = std::string("with /beam/space_law \"frames\"") +
                          (asked ? " " : ", which is the default of this beam unless out_of_plane is \"none\", ");
  const auto none = [&](bool there, const std::string& key, const std::string& allowed) {
    if (there) refuse(key, "this key", law + allowed);
  };
  check_moving_nodes(scene, law);

  none(scene.spin.has_value(), "/spin",
       "sections turn without it: /initial_velocity with a rotation about the beam spins it, and motion/angle of a "
       "clamp "
       "drives it; or take \"scalar\"");
  if (scene.beam.rotary_inertia != BendingInertia::none) {
    refuse("/beam/rotary_inertia", quoted(scene.beam.rotary_inertia), law + "it must be \"none\"");
  }
  const IntegratorType type = scene.integrator.type;
  const bool moves = scene.analysis == Analysis::dynamics;
  if (moves && (type == IntegratorType::energy_momentum || of_sundials(type))) {
    refuse("/integrator/type", quoted(type), law + "take \"generalized-alpha\" or a method of Odeint");
  }
}

}  // namespace

void validate_frames(const Scene& scene) {
  if (scene.dimension != 3 && scene.beam.space_law) {
    refuse("/beam/space_law", quoted(*scene.beam.space_law), "a planar scene has none: leave it out");
  }
  check_stiffnesses(scene);
  check_orientation(scene);
  if (!has_frames(scene)) return;
  check_torsion(scene);
  check_others(scene);
}

}  // namespace vlbeam
