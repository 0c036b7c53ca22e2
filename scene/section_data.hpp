#pragma once

#include <optional>
#include <string>

#include "scene/scene.hpp"

namespace vlbeam {

/// What a section of one material is by its sizes.
struct SectionSizes {
  double area;            ///< [m^2]
  double i2_y, i2_z;      ///< squares of the radii of gyration about its axes y and z [m^2]
  double torsion;         ///< what torsion has for a second moment [m^4]
  double half_y, half_z;  ///< how far it reaches from its middle along y and z [m]
};

/// Whether sizes and a material make up a section; else it has stiffnesses of its own.
inline bool has_sizes(Section::Type type) {
  using enum Section::Type;
  return type == circle || type == rectangle || type == tube || type == box || type == profile;
}
/// Empty where a section has none.
std::optional<SectionSizes> sizes_of(const Section& section);

/// Whether it is known what the section displaces of a fluid: of a circle, a tube with closed ends, a rope, a chain.
inline bool displaces(Section::Type type) {
  using enum Section::Type;
  return type == circle || type == tube || type == rope || type == chain;
}
/// That, per length [m^2].
double displaced_area(const Section& section);

/// Whether it does not resist bending.
bool is_rope_section(const Section& section);

/// The stiffnesses and the mass of a rope or a chain, by its diameter; any other section as it is.
Section with_stiffness(const Section& section);

/// Density, Young's modulus and Poisson's ratio of a material that has a name are those of the name.
Material named(const Material& material);

/// Of a rope, a chain, a tube, a box, a profile, or a material by its name: what was taken for it. Empty for others.
std::string section_in_words(const BeamSpec& beam);

/// The beam with its mass per length so many times as large, whatever it follows from.
BeamSpec with_mass(BeamSpec beam, double factor);

}  // namespace vlbeam
