#include "mechanics/spin/circular_shaft.hpp"
#include "scene/build.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"
#include "scene/slack.hpp"

namespace vlbeam {
namespace {

double shear_modulus(const Material& material) { return material.youngs_modulus / (2 * (1 + material.poisson_ratio)); }

}  // namespace

BeamSection build_section(const BeamSpec& beam) {
  const FrameSection bending = build_frames(beam);
  BeamSection section;
  if (const auto sizes = sizes_of(main_section(beam))) {
    const Material material = named(beam.material);
    section.rhoA = material.density * sizes->area;
    section.stiffness.EA = material.youngs_modulus * sizes->area;
  } else {
    const Section of = with_stiffness(main_section(beam));
    section.rhoA = of.rhoA;
    section.stiffness.EA = of.EA;
  }
  section.stiffness.EI = bending.EI_y;
  section.stiffness.law = beam.strain_law;
  section.damping = beam.material.damping;
  section.curvature_regularization = beam.material.curvature_regularization;
  return section;
}

BeamSection build_section(const Scene& scene) {
  BeamSection section = build_section(scene.beam);
  if (compression(scene) == Compression::none) section.stiffness.slack_over = slack_over(scene);
  return section;
}

FrameSection build_frames(const BeamSpec& beam) {
  const auto sizes = sizes_of(main_section(beam));
  if (!sizes) {
    const Section section = with_stiffness(main_section(beam));
    return {section.EI_y.value_or(section.EI),
            section.EI_z.value_or(section.EI),
            section.GIp,
            section.rhoIp,
            beam.strain_law,
            beam.material.damping};
  }
  const Material material = named(beam.material);
  const double E = material.youngs_modulus;
  return {E * sizes->area * sizes->i2_y,
          E * sizes->area * sizes->i2_z,
          shear_modulus(material) * sizes->torsion,
          material.density * sizes->area * (sizes->i2_y + sizes->i2_z),
          beam.strain_law,
          material.damping};
}

SpinSection build_spin(const BeamSpec& beam) {
  const Section& section = main_section(beam);
  if (section.type == Section::Type::circle) {
    const Material material = named(beam.material);
    return CircularShaft{.radius = section.radius,
                         .density = material.density,
                         .youngs_modulus = material.youngs_modulus,
                         .poisson_ratio = material.poisson_ratio,
                         .damping = material.damping}
        .spin();
  }
  const FrameSection frames = build_frames(beam);
  return {frames.rhoIp, frames.GIp, beam.material.damping};
}

}  // namespace vlbeam
