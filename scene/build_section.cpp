#include <algorithm>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "scene/build.hpp"
#include "scene/slack.hpp"

namespace vlbeam {
namespace {

/// Of what is made of one material: area [m^2], squares of the radii of gyration about its axes y and z [m^2], and
/// what torsion has for a second moment [m^4].
struct SolidSection {
  double area, i2_y, i2_z, torsion;
};

/// Saint-Venant's series (Timoshenko & Goodier, Theory of Elasticity, section 109).
double rectangle_torsion(double one, double other) {
  const double a = std::max(one, other), b = std::min(one, other);
  double sum = 0;
  for (int n = 1; n < 100; n += 2) {
    const double n5 = static_cast<double>(n) * n * n * n * n;
    sum += portable::tanh(n * std::numbers::pi * a / (2 * b)) / n5;
  }
  constexpr double pi5 = std::numbers::pi * std::numbers::pi * std::numbers::pi * std::numbers::pi * std::numbers::pi;
  return a * b * b * b / 3 * (1 - 192 / pi5 * b / a * sum);
}

SolidSection solid(const Section& section) {
  if (section.type == Section::Type::circle) {
    const double r2 = section.radius * section.radius, area = std::numbers::pi * r2;
    return {area, r2 / 4, r2 / 4, area * r2 / 2};
  }
  const double w = section.width, h = section.height;
  return {w * h, h * h / 12, w * w / 12, rectangle_torsion(w, h)};
}

bool is_solid(const Section& section) { return section.type != Section::Type::stiffness; }

double shear_modulus(const Material& material) { return material.youngs_modulus / (2 * (1 + material.poisson_ratio)); }

}  // namespace

BeamSection build_section(const BeamSpec& beam) {
  const FrameSection bending = build_frames(beam);
  BeamSection section;
  const double E = beam.material.youngs_modulus;
  if (is_solid(beam.section)) {
    const double area = solid(beam.section).area;
    section.rhoA = beam.material.density * area;
    section.stiffness.EA = E * area;
  } else {
    section.rhoA = beam.section.rhoA;
    section.stiffness.EA = beam.section.EA;
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
  const Section& section = beam.section;
  if (!is_solid(section)) {
    return {section.EI_y.value_or(section.EI),
            section.EI_z.value_or(section.EI),
            section.GIp,
            section.rhoIp,
            beam.strain_law,
            beam.material.damping};
  }
  const SolidSection of = solid(section);
  const double E = beam.material.youngs_modulus;
  return {E * of.area * of.i2_y,
          E * of.area * of.i2_z,
          shear_modulus(beam.material) * of.torsion,
          beam.material.density * of.area * (of.i2_y + of.i2_z),
          beam.strain_law,
          beam.material.damping};
}

SpinSection build_spin(const BeamSpec& beam) {
  const Section& section = beam.section;
  if (section.type == Section::Type::circle) {
    return CircularShaft{.radius = section.radius,
                         .density = beam.material.density,
                         .youngs_modulus = beam.material.youngs_modulus,
                         .poisson_ratio = beam.material.poisson_ratio,
                         .damping = beam.material.damping}
        .spin();
  }
  const FrameSection frames = build_frames(beam);
  return {frames.rhoIp, frames.GIp, beam.material.damping};
}

}  // namespace vlbeam
