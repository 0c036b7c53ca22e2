#pragma once

#include "scene/option_lines.hpp"

namespace vlbeam {

/// Visits the options of a scene's beam: axis, cross section, material, elements.
template <class Visitor, class SceneT>
struct BeamOptions : OptionLines<Visitor, SceneT> {
  void all() {
    axis();
    cross_section();
    material();
    elements();
  }

 private:
  using Lines = OptionLines<Visitor, SceneT>;
  using Lines::scene, Lines::number, Lines::vector, Lines::choice, Lines::section, Lines::paper, Lines::example1,
      Lines::list, Lines::present, Lines::drag_at;
  static constexpr std::string_view section_type = "/beam/section/type";

  void axis() {
    auto& beam = scene.beam;
    constexpr std::string_view curve_type = "/beam/curve/type";
    choice(curve_type, "kind of the beam's initial axis", beam.curve.type);
    const Condition line = only_if(curve_type, beam.curve.type, CurveType::line);
    const Condition arc = only_if(curve_type, beam.curve.type, CurveType::arc);
    const Condition nurbs = only_if(curve_type, beam.curve.type, CurveType::nurbs);
    const Condition polyline = only_if(curve_type, beam.curve.type, CurveType::polyline);
    vector("/beam/curve/start", "m", "where the beam starts", beam.curve.start, {.source = example1, .when = line});
    vector("/beam/curve/end", "m", "where the beam ends", beam.curve.end, {.source = example1, .when = line});
    vector("/beam/curve/center", "m", "center of the circle; in 3D it lies in a plane parallel to the first two axes",
           beam.curve.center, {.source = "Ding & Ouyang 2022, §6.3", .when = arc, .required = true});
    number("/beam/curve/radius", "m", Range::positive(), "radius of the circle", beam.curve.radius,
           {.when = arc, .required = true});
    number("/beam/curve/from_degrees", "degrees", {}, "where the beam starts, from the first axis towards the second",
           beam.curve.from_degrees, {.when = arc, .required = true});
    number("/beam/curve/to_degrees", "degrees", {}, "where the beam ends", beam.curve.to_degrees,
           {.when = arc, .required = true});
    number("/beam/curve/pitch", "m", {}, "in space: by which the axis rises in a turn, along the third axis: a helix",
           beam.curve.pitch, {.when = arc});
    number("/beam/curve/degree", "-", Range::closed(1, 3), "degree of the NURBS curve", beam.curve.degree,
           {.when = nurbs, .required = true});
    number("/beam/curve/knots", "-", {}, "knots, not decreasing: as many as control points, degree and 1 together",
           beam.curve.knots, {.when = nurbs, .required = true});
    number("/beam/curve/weights", "-", Range::positive(), "weights of the control points; none are equal weights",
           beam.curve.weights, {.when = nurbs});
    vector("/beam/curve/control_points", "m", "control points", beam.curve.control_points,
           {.when = nurbs, .required = true});
    vector("/beam/curve/points", "m",
           "where the axis starts, its corners, where it ends; a corner is for a joint whose slopes are free or "
           "equal-stretch, and any other of a rope (EI = 0) becomes round",
           beam.curve.points, {.when = polyline, .required = true});
  }

  void cross_section() {
    auto& beam = scene.beam;
    section_at("/beam/section", beam.section);
    list("/beam/sections",
         "in place of section: the sections of a beam that has several, piece by piece from its start; each ends at a "
         "node, and a joint passes from one to the next",
         beam.sections);
    for (std::size_t i = 0; i < beam.sections.size(); ++i) {
      auto& piece = beam.sections[i];
      const std::string at = "/beam/sections/" + std::to_string(i);
      number(at + "/to", "m", Range::positive(),
             "material coordinate where the piece ends; that of the last one, the length of the beam, may be left out",
             piece.to);
      section(at + "/section", "the section of the piece, of the beam's material");
      section_at(at + "/section", piece.section);
      number(at + "/area", "m^2", Range::positive(),
             "what it displaces of /fluid per length, where the section does not say it", piece.area);
      if (present(at + "/drag", "of the piece, in place of that of the scene", piece.drag)) {
        drag_at(at + "/drag", *piece.drag);
      }
    }
  }

  template <class SectionT>
  void section_at(const std::string& at, SectionT& of) {
    const std::string type = at + "/type";
    choice(type, "how the section is given", of.type);
    const auto is = [&](auto... types) { return only_if(type, of.type, types...); };
    using enum Section::Type;
    const Condition given = is(stiffness);
    number(at + "/radius", "m", Range::positive(), "radius of the full circular section; outer radius of a tube",
           of.radius, {.source = example1, .when = is(circle, tube)});
    choice(at + "/standard", "a rolled profile by its name, in place of its sizes", of.standard,
           {.source = "EN 10365", .when = is(profile)});
    Condition sizes = is(rectangle, box, profile), plates = is(profile);
    if (of.standard) sizes.holds = plates.holds = false;
    const bool asked = !of.standard;
    number(at + "/width", "m", Range::positive(), "of a rectangle, a box or a profile, along the section's axis y",
           of.width, {.when = sizes, .required = asked, .instead = "standard"});
    number(at + "/height", "m", Range::positive(),
           "of a rectangle, a box or a profile, along the section's axis z; in the plane it lies in it", of.height,
           {.when = sizes, .required = asked, .instead = "standard"});
    number(at + "/wall", "m", Range::positive(), "thickness of the wall of a tube or a box", of.wall,
           {.when = is(tube, box), .required = true});
    number(at + "/web", "m", Range::positive(), "thickness of the web of a profile", of.web,
           {.when = plates, .required = asked, .instead = "standard"});
    number(at + "/flange", "m", Range::positive(), "thickness of the flanges of a profile", of.flange,
           {.when = plates, .required = asked, .instead = "standard"});
    number(at + "/fillet", "m", Range::non_negative(), "radius between web and flanges of a profile", of.fillet,
           {.when = plates});
    number(at + "/diameter", "m", Range::positive(), "nominal diameter of a rope; of the bar of a chain's links",
           of.diameter, {.when = is(rope, chain), .required = true});
    choice(at + "/construction", "of a rope, by which its stiffness and mass follow from the diameter", of.construction,
           {.source = "OrcaFlex documentation, line type wizard", .when = is(rope)});
    choice(at + "/links", "of a chain, by which its stiffness and mass follow from the diameter", of.links,
           {.source = "OrcaFlex documentation, line type wizard", .when = is(chain)});
    number(at + "/EA", "N", Range::positive(), "axial stiffness", of.EA, {.when = given, .required = true});
    number(at + "/EI_y", "N m^2", Range::positive(),
           "in place of EI, together with EI_z: resists bending about the section's axis y", of.EI_y, {.when = given});
    number(at + "/EI_z", "N m^2", Range::positive(), "resists bending about the section's axis z", of.EI_z,
           {.when = given});
    number(at + "/EI", "N m^2", Range::non_negative(), "bending stiffness; 0 is a cable", of.EI,
           {.when = given, .required = !of.EI_y, .instead = "EI_y"});
    number(at + "/rhoA", "kg/m", Range::positive(), "mass per unstretched length", of.rhoA,
           {.when = given, .required = true});
    number(at + "/GIp", "N m^2", Range::non_negative(), "torsional stiffness, needed by spin and by frames", of.GIp,
           {.when = given});
    number(at + "/rhoIp", "kg m", Range::non_negative(),
           "moment of inertia per length about the axis, needed by spin and by frames that move", of.rhoIp,
           {.when = given});
    vector(at + "/orientation", "-",
           "a direction that is the section's axis y, as far as it is across the beam, all along it; needed where the "
           "two bending stiffnesses differ",
           of.orientation, {.components = 3, .when = is(stiffness, rectangle, box, profile)});
  }

  void material() {
    auto& beam = scene.beam;
    using enum Section::Type;
    Condition sized = only_if(section_type, beam.section.type, circle, rectangle, tube, box, profile);
    if (!beam.sections.empty()) {
      sized.holds = false;
      for (const auto& piece : beam.sections) {
        const Section::Type type = piece.section.type;
        sized.holds =
            sized.holds || type == circle || type == rectangle || type == tube || type == box || type == profile;
      }
    }
    const std::string_view name = "/beam/material/name";
    choice(name,
           "steel (7850 kg/m^3, 2.1e11 Pa, 0.3), aluminium (2700, 7e10, 0.33) or timber (420, 1.1e10 along the grain, "
           "0.3); own is what the next keys say",
           beam.material.name, {.when = sized});
    const Condition solid =
        beam.material.name == MaterialName::own ? sized : only_if(name, beam.material.name, MaterialName::own);
    number("/beam/material/density", "kg/m^3", Range::positive(), "density", beam.material.density,
           {.source = example1, .when = solid});
    number("/beam/material/youngs_modulus", "Pa", Range::positive(), "Young's modulus", beam.material.youngs_modulus,
           {.source = example1, .when = solid});
    number("/beam/material/poisson_ratio", "-", {.low = -1, .high = 0.5, .low_open = true, .high_open = true},
           "Poisson's ratio, of the torsional stiffness", beam.material.poisson_ratio, {.when = solid});
    number("/beam/material/damping", "s", Range::non_negative(),
           "Kelvin-Voigt time c: stresses E (strain + c strain rate)", beam.material.damping,
           {.source = "Ding & Ouyang 2022, Eq. 19"});
    number("/beam/material/mass_damping", "1/s", Range::non_negative(),
           "alpha of damping in proportion to the beam's mass: a force -alpha times the momentum",
           beam.material.mass_damping);
    number("/beam/material/curvature_regularization", "1/m", Range::non_negative(),
           "kappa_reg of bending damping and of a curved rest shape in 3D, which have no direction on a straight beam; "
           "frames "
           "need none",
           beam.material.curvature_regularization);
  }

  void elements() {
    auto& beam = scene.beam;
    number("/beam/elements", "-", Range::closed(2, 1e6), "number of elements N", beam.elements, {.source = example1});
    choice("/beam/element", "element family; ALE elements let nodes move along the beam", beam.element,
           {.source = paper});
    choice("/beam/axis",
           "how elements follow a curved axis: evenly, material coordinate and arc length the same to a high order, or "
           "exactly, at an uneven speed (ALE-RANCF; conics with the paper's weights); if not given even, in the "
           "setting ding-ouyang-2022 exact where the scene allows it",
           beam.axis, {.source = "Ding & Ouyang 2022, Eq. 43 is exact"});
    choice("/beam/rest_shape",
           "where strains are measured from: the initial shape, or a straight beam (paper is its old name)",
           beam.rest_shape);
    choice("/beam/strain_law",
           "how stretch and curvature are measured: as data sheets do, the force is EA times the elongation over the "
           "length (engineering), or by Green's strain, as the papers do",
           beam.strain_law);
    choice(
        "/beam/compression",
        "whether a beam bears compression as it bears tension (full), or goes slack, as a rope does (none, EI = 0); if "
        "not given a rope does not, but with the integrator energy-momentum",
        beam.compression);
    number(
        "/beam/slack_over", "-", {.low = 0, .high = 1, .low_open = true},
        "strain, by the scene's law, beyond which a rope pulls in full, and below minus that not at all; if not given "
        "three hundredths of what all weights and loads strain it, together, at most 1e-3; where these grow from "
        "nothing a 1e-6th, and 1e-9 where there are none",
        beam.slack_over);
    choice("/beam/rotary_inertia",
           "inertia of sections that turn as the beam bends, and that spin, too: for small slopes", beam.rotary_inertia,
           {.source = "Katz 2001"});
    choice("/beam/space_law",
           "how a beam bends in space: about two axes of its sections, which twist, or by the size of its curvature "
           "alone; if not given frames where it is curved at rest and out_of_plane does not say that this does not "
           "matter, or where two bending stiffnesses differ",
           beam.space_law);
    choice("/beam/out_of_plane",
           "what resists loads across the plane of a beam that is curved at rest, in space, with the scalar law: to be "
           "written there, for nothing does",
           beam.out_of_plane);
    choice("/beam/axial_strain",
           "where an element's axial strain is summed: at all its quadrature points (full), or at both nodes and the "
           "middle (lobatto), which bends slender beams and ropes without locking",
           beam.axial_strain);
    number("/beam/quadrature_points", "-", Range::closed(0, 25),
           "Gauss points an element, 3 to 25; 0 takes the element's default", beam.quadrature_points);
    number("/beam/polynomial_points", "-", Range::closed(0, 25),
           "the same for stress and mass of an element whose weights are all 1; 0 takes quadrature_points, or 5 where "
           "these are 0, too, and no rope goes slack",
           beam.polynomial_points);
    number("/beam/weights", "-", Range::positive(), "initial rational weights of every element", beam.weights,
           {.source = "Ding & Ouyang 2022, Eq. 5"});
  }
};

}  // namespace vlbeam
