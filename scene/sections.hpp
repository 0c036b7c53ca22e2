#pragma once

#include <string>
#include <vector>

#include "mechanics/motion/system/beam_model.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

// A beam of several sections, piece by piece: the model has the section of the longest piece, and shares of it.

/// The section of a beam, or of its longest piece; of those that resist bending, where one does.
const Section& main_section(const BeamSpec& beam);
/// The sections of a beam, in order.
std::vector<const Section*> sections_of(const BeamSpec& beam);
/// Whether all have sizes, so that there are stresses.
bool knows_stress(const BeamSpec& beam);
/// That at a material coordinate.
const Section& section_at(const BeamSpec& beam, double x);

/// Checks `/beam/sections`; nothing without them.
void validate_sections(const Scene& scene);

/// Material coordinates at which the section changes; empty for a beam of one.
std::vector<double> section_changes(const BeamSpec& beam);
/// Shares of the main section, piece by piece; empty for a beam of one.
SectionPieces build_pieces(const Scene& scene);
/// The largest axial stiffness along a beam [N].
double stiffest_EA(const BeamSpec& beam);
/// Mean of the mass per length over a beam of that length [kg/m].
double mean_mass(const BeamSpec& beam, double length);

/// Gives the model drag and what pushes along it, load by load, where its sections change.
template <int D>
void add_laws_along(const Scene& scene, BeamModel<D>& model);

/// The pieces in words, for a summary: one line each.
std::vector<std::string> pieces_in_words(const BeamSpec& beam);

}  // namespace vlbeam
