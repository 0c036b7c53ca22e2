#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/scene/options.hpp"

namespace vlbeam {

/// Visits the options of a scene, part by part: see visit_options(), which names what a visitor has to know.
template <class Visitor, class SceneT>
struct SceneOptions {
  Visitor& visitor;
  SceneT& scene;

  void all() {
    whole();
    beam_parts();
    axis();
    cross_section();
    material();
    elements();
    supports();
    joints();
    contact();
    spin();
    flow();
    loads();
    point_masses();
    initial_velocity();
    drag();
    equations();
    length_control();
    statics();
    integrator();
    output();
  }

 private:
  static constexpr std::string_view paper = "Ding & Ouyang 2022";
  static constexpr std::string_view example1 = "Ding & Ouyang 2022, §6.1";
  static constexpr std::string_view analysis = "/analysis";
  static constexpr std::string_view initial_shape = "/initial_shape";
  static constexpr std::string_view section_type = "/beam/section/type";

  bool in_time() const { return scene.analysis == Analysis::dynamics; }
  Condition of_analysis(Analysis which) const { return only_if(analysis, scene.analysis, which); }
  void section(std::string_view pointer, std::string_view description) {
    visitor.section(Option{.pointer = pointer, .unit = "", .description = description});
  }
  /// What there is not in statics, where there is no time.
  template <class Member>
  void timed(Option option, Member& member) {
    if (!in_time()) option.when = of_analysis(Analysis::dynamics);
    visitor(option, member);
  }
  /// A function of time: value, rate, ... below the pointer `at`.
  template <class Function>
  void time_function(const std::string& at, const std::string& unit, const Condition& when, Function& f) {
    const auto part = [&](const char* key, const std::string& part_unit, const char* description, const Range& range,
                          auto& member) {
      const std::string pointer = at + "/" + key;
      visitor(Option{.pointer = pointer, .unit = part_unit, .description = description, .range = range, .when = when},
              member);
    };
    section(at, "a function of time, S(t/ramp) (value + rate t + acceleration t^2/2 + oscillation)");
    part("value", unit, "of a function of time: its constant part", {}, f.value);
    part("rate", unit + "/s", "its part that grows evenly", {}, f.rate);
    part("acceleration", unit + "/s^2", "its part that grows with t^2/2", {}, f.acceleration);
    part("amplitude", unit, "of its part that oscillates", {}, f.amplitude);
    part("frequency", "Hz", "of its part that oscillates", {}, f.frequency);
    part("phase_degrees", "degrees", "of its part that oscillates, a sine", {}, f.phase_degrees);
    part("ramp", "s", "time over which it grows smoothly from 0; 0 is at once", Range::non_negative(), f.ramp);
    part("until", "s", "time from which on it goes on evenly, at the rate it has then; if not given it never does",
         Range::non_negative(), f.until);
  }
  template <class Support>
  void support(const std::string& entry, Support& at) {
    const std::string type = entry + "/type", clamp = entry + "/clamp", motion = entry + "/motion",
                      direction = motion + "/direction", angle = motion + "/angle";
    visitor(Option{.pointer = type,
                   .unit = "",
                   .description =
                       "how the end is held: clamp, position and slope; pin, position; slide, all of the position but "
                       "along the axis's tangent at t = 0; or free",
                   .required = true},
            at.type);
    visitor(Option{.pointer = clamp,
                   .unit = "",
                   .description = "what a clamp holds: the slope's direction, or the whole slope vector",
                   .when = only_if(type, at.type, SupportType::clamp)},
            at.clamp);
    if (visitor.present(
            Option{.pointer = motion,
                   .unit = "",
                   .description = "displacement of a clamp or a pin as a function of time, from where it is "
                                  "at t = 0 and from rest, and the angle of a clamp"},
            at.motion)) {
      const bool turns = visitor.present(
          Option{.pointer = angle,
                 .unit = "",
                 .description = "by which a clamp turns about its point, in the plane, from how it stands at t = 0"},
          at.motion->angle);
      if (turns) time_function(angle, "rad", {}, *at.motion->angle);
      visitor(Option{.pointer = direction,
                     .unit = "-",
                     .description = "of the displacement; it need not have unit length; needed without an angle",
                     .components = scene.dimension,
                     .required = !turns,
                     .instead = "angle"},
              at.motion->direction);
      time_function(motion, "m", {}, at.motion->displacement);
    }
    const std::string feed = entry + "/feed";
    if (visitor.present(Option{.pointer = feed,
                               .unit = "",
                               .description = "length of beam that has come in through this clamp or pin since t = 0, "
                                              "straight and unstrained, as a winch pays it out; less than 0 where it "
                                              "draws in"},
                        at.feed)) {
      time_function(feed, "m", {}, *at.feed);
    }
  }
  template <class Joint>
  void joint_options(const std::string& at, bool massless, Joint& mass) {
    const std::string mass_at = at + "/mass", position = at + "/position", velocity = at + "/velocity",
                      slopes = at + "/slopes", friction = at + "/friction", coefficient = friction + "/coefficient",
                      fades = friction + "/velocity", separation = at + "/separation_distance",
                      at_support = at + "/at_support", restitution = at + "/restitution";
    visitor(Option{.pointer = mass_at,
                   .unit = "kg",
                   .description = "mass",
                   .source = example1,
                   .range = massless ? Range::non_negative() : Range::positive(),
                   .required = !massless},
            mass.mass);
    visitor(Option{.pointer = position,
                   .unit = "m",
                   .description = "material coordinate at t = 0, measured along the beam from its start",
                   .source = example1,
                   .range = Range::positive(),
                   .required = true},
            mass.position);
    visitor(Option{.pointer = velocity, .unit = "m/s", .description = "rate of the material coordinate at t = 0"},
            mass.velocity);
    visitor(Option{.pointer = slopes,
                   .unit = "",
                   .description = "the beam's slopes before and behind the mass: one vector, one direction with two "
                                  "magnitudes, a kink with one magnitude, or independent",
                   .source = "Ding & Ouyang 2022, Eq. 39-40"},
            mass.slopes);
    if (visitor.present(
            Option{.pointer = friction,
                   .unit = "",
                   .description = "Coulomb friction along the beam, mu N tanh(v/velocity); around a kink of a cable by "
                                  "Euler and Eytelwein, tensions in the ratio e^(mu angle)"},
            mass.friction)) {
      visitor(Option{.pointer = coefficient,
                     .unit = "-",
                     .description =
                         "mu, friction over the contact force normal to the beam (of what is held, its reaction)",
                     .range = Range::non_negative(),
                     .required = true},
              mass.friction->coefficient);
      visitor(Option{.pointer = fades,
                     .unit = "m/s",
                     .description = "relative velocity below which friction fades",
                     .range = Range::positive()},
              mass.friction->velocity);
    }
    visitor(
        Option{.pointer = separation,
               .unit = "m",
               .description = "distance from a free end where the mass leaves; 1e-3 of the beam's length if not given",
               .range = Range::positive()},
        mass.separation_distance);
    visitor(Option{.pointer = at_support,
                   .unit = "",
                   .description = "what becomes of the mass at an end that it cannot leave: the run stops there, or it "
                                  "rests until the contact force turns, or it rebounds"},
            mass.at_support);
    visitor(Option{.pointer = restitution,
                   .unit = "-",
                   .description = "of a rebound: speed along the beam after it over that before",
                   .range = Range::closed(0, 1),
                   .when = only_if(at_support, mass.at_support, AtSupport::rebound)},
            mass.restitution);
  }

  void whole() {
    SceneSchema schema = SceneSchema::v1;
    visitor(Option{.pointer = "/schema", .unit = "", .description = "what this file is, and its version"}, schema);
    visitor(Option{.pointer = "/title", .unit = "", .description = "what the scene shows"}, scene.title);
    visitor(Option{.pointer = analysis, .unit = "", .description = "a motion, or equilibria under loads that grow"},
            scene.analysis);
    const Condition dynamics = of_analysis(Analysis::dynamics);
    visitor(Option{.pointer = initial_shape,
                   .unit = "",
                   .description = "what a motion starts from: the beam as built, or its equilibrium under what acts at "
                                  "t = 0, found as /statics says; velocities come on top of it",
                   .when = dynamics},
            scene.initial_shape);
    visitor(Option{.pointer = "/setting",
                   .unit = "",
                   .description = "what keys left out stand for: by default what measurements speak for, or what the "
                                  "paper does, as far as it says so"},
            scene.setting);
    visitor(Option{.pointer = "/dimension",
                   .unit = "-",
                   .description = "2 for a planar scene, 3 for a spatial one",
                   .range = Range::closed(2, 3)},
            scene.dimension);
    visitor(Option{.pointer = "/gravity",
                   .unit = "m/s^2",
                   .description = "gravitational acceleration",
                   .source = example1,
                   .components = scene.dimension},
            scene.gravity);
    visitor(Option{.pointer = "/gravity_ramp",
                   .unit = "s",
                   .description = "time over which gravity grows smoothly from 0; 0 applies it at once",
                   .range = Range::non_negative()},
            scene.gravity_ramp);
  }

  void beam_parts() {
    visitor.section(Option{.pointer = "/beam", .unit = "", .description = "the beam", .required = true});
    section("/beam/curve", "the beam's axis at t = 0");
    section("/beam/section", "cross section");
    section("/beam/material", "material");
    section("/length_control", "how the mesh follows the sliding mass");
    section("/integrator", "integration in time");
    section("/output", "what is kept of the motion");
  }

  void axis() {
    auto& beam = scene.beam;
    constexpr std::string_view curve_type = "/beam/curve/type";
    visitor(Option{.pointer = curve_type, .unit = "", .description = "kind of the beam's initial axis"},
            beam.curve.type);
    const Condition line = only_if(curve_type, beam.curve.type, CurveType::line);
    const Condition arc = only_if(curve_type, beam.curve.type, CurveType::arc);
    const Condition nurbs = only_if(curve_type, beam.curve.type, CurveType::nurbs);
    visitor(Option{.pointer = "/beam/curve/start",
                   .unit = "m",
                   .description = "where the beam starts",
                   .source = example1,
                   .components = scene.dimension,
                   .when = line},
            beam.curve.start);
    visitor(Option{.pointer = "/beam/curve/end",
                   .unit = "m",
                   .description = "where the beam ends",
                   .source = example1,
                   .components = scene.dimension,
                   .when = line},
            beam.curve.end);
    visitor(Option{.pointer = "/beam/curve/center",
                   .unit = "m",
                   .description = "center of the circle; in 3D it lies in a plane parallel to the first two axes",
                   .source = "Ding & Ouyang 2022, §6.3",
                   .components = scene.dimension,
                   .when = arc,
                   .required = true},
            beam.curve.center);
    visitor(Option{.pointer = "/beam/curve/radius",
                   .unit = "m",
                   .description = "radius of the circle",
                   .range = Range::positive(),
                   .when = arc,
                   .required = true},
            beam.curve.radius);
    visitor(Option{.pointer = "/beam/curve/from_degrees",
                   .unit = "degrees",
                   .description = "where the beam starts, from the first axis towards the second",
                   .when = arc,
                   .required = true},
            beam.curve.from_degrees);
    visitor(Option{.pointer = "/beam/curve/to_degrees",
                   .unit = "degrees",
                   .description = "where the beam ends",
                   .when = arc,
                   .required = true},
            beam.curve.to_degrees);
    visitor(Option{.pointer = "/beam/curve/degree",
                   .unit = "-",
                   .description = "degree of the NURBS curve",
                   .range = Range::closed(1, 3),
                   .when = nurbs,
                   .required = true},
            beam.curve.degree);
    visitor(Option{.pointer = "/beam/curve/knots",
                   .unit = "-",
                   .description = "knots, not decreasing: as many as control points, degree and 1 together",
                   .when = nurbs,
                   .required = true},
            beam.curve.knots);
    visitor(Option{.pointer = "/beam/curve/weights",
                   .unit = "-",
                   .description = "weights of the control points; none are equal weights",
                   .range = Range::positive(),
                   .when = nurbs},
            beam.curve.weights);
    visitor(Option{.pointer = "/beam/curve/control_points",
                   .unit = "m",
                   .description = "control points",
                   .components = scene.dimension,
                   .when = nurbs,
                   .required = true},
            beam.curve.control_points);
  }

  void cross_section() {
    auto& beam = scene.beam;
    visitor(Option{.pointer = section_type, .unit = "", .description = "how the section is given"}, beam.section.type);
    const Condition circle = only_if(section_type, beam.section.type, Section::Type::circle);
    const Condition stiffness = only_if(section_type, beam.section.type, Section::Type::stiffness);
    visitor(Option{.pointer = "/beam/section/radius",
                   .unit = "m",
                   .description = "radius of the full circular section",
                   .source = example1,
                   .range = Range::positive(),
                   .when = circle},
            beam.section.radius);
    visitor(Option{.pointer = "/beam/section/EA",
                   .unit = "N",
                   .description = "axial stiffness",
                   .range = Range::positive(),
                   .when = stiffness,
                   .required = true},
            beam.section.EA);
    visitor(Option{.pointer = "/beam/section/EI",
                   .unit = "N m^2",
                   .description = "bending stiffness; 0 is a cable",
                   .range = Range::non_negative(),
                   .when = stiffness,
                   .required = true},
            beam.section.EI);
    visitor(Option{.pointer = "/beam/section/rhoA",
                   .unit = "kg/m",
                   .description = "mass per unstretched length",
                   .range = Range::positive(),
                   .when = stiffness,
                   .required = true},
            beam.section.rhoA);
    visitor(Option{.pointer = "/beam/section/GIp",
                   .unit = "N m^2",
                   .description = "torsional stiffness, needed by spin",
                   .range = Range::non_negative(),
                   .when = stiffness},
            beam.section.GIp);
    visitor(Option{.pointer = "/beam/section/rhoIp",
                   .unit = "kg m",
                   .description = "moment of inertia per length about the axis, needed by spin",
                   .range = Range::non_negative(),
                   .when = stiffness},
            beam.section.rhoIp);
  }

  void material() {
    auto& beam = scene.beam;
    const Condition circle = only_if(section_type, beam.section.type, Section::Type::circle);
    visitor(Option{.pointer = "/beam/material/density",
                   .unit = "kg/m^3",
                   .description = "density",
                   .source = example1,
                   .range = Range::positive(),
                   .when = circle},
            beam.material.density);
    visitor(Option{.pointer = "/beam/material/youngs_modulus",
                   .unit = "Pa",
                   .description = "Young's modulus",
                   .source = example1,
                   .range = Range::positive(),
                   .when = circle},
            beam.material.youngs_modulus);
    visitor(Option{.pointer = "/beam/material/poisson_ratio",
                   .unit = "-",
                   .description = "Poisson's ratio, of the torsional stiffness",
                   .range = {.low = -1, .high = 0.5, .low_open = true, .high_open = true},
                   .when = circle},
            beam.material.poisson_ratio);
    visitor(Option{.pointer = "/beam/material/damping",
                   .unit = "s",
                   .description = "Kelvin-Voigt time c: stresses E (strain + c strain rate)",
                   .source = "Ding & Ouyang 2022, Eq. 19",
                   .range = Range::non_negative()},
            beam.material.damping);
    visitor(
        Option{.pointer = "/beam/material/mass_damping",
               .unit = "1/s",
               .description = "alpha of damping in proportion to the beam's mass: a force -alpha times the momentum",
               .range = Range::non_negative()},
        beam.material.mass_damping);
    visitor(Option{.pointer = "/beam/material/curvature_regularization",
                   .unit = "1/m",
                   .description =
                       "kappa_reg of bending damping and of a curved rest shape in 3D, which have no direction on a "
                       "straight beam",
                   .range = Range::non_negative()},
            beam.material.curvature_regularization);
  }

  void elements() {
    auto& beam = scene.beam;
    visitor(Option{.pointer = "/beam/elements",
                   .unit = "-",
                   .description = "number of elements N",
                   .source = example1,
                   .range = Range::closed(2, 1e6)},
            beam.elements);
    visitor(Option{.pointer = "/beam/element",
                   .unit = "",
                   .description = "element family; ALE elements let nodes move along the beam",
                   .source = paper},
            beam.element);
    visitor(
        Option{.pointer = "/beam/axis",
               .unit = "",
               .description =
                   "how elements follow a curved axis: evenly, material coordinate and arc length the same to a high "
                   "order, or exactly, at an uneven speed (ALE-RANCF; conics with the paper's weights); if not given "
                   "even, in the setting ding-ouyang-2022 exact where the scene allows it",
               .source = "Ding & Ouyang 2022, Eq. 43 is exact"},
        beam.axis);
    visitor(Option{.pointer = "/beam/rest_shape",
                   .unit = "",
                   .description = "where strains are measured from: the initial shape, or a straight beam"},
            beam.rest_shape);
    visitor(Option{.pointer = "/beam/strain_law", .unit = "", .description = "how stretch and curvature are measured"},
            beam.strain_law);
    visitor(
        Option{.pointer = "/beam/rotary_inertia",
               .unit = "",
               .description = "inertia of sections that turn as the beam bends, and that spin, too: for small slopes",
               .source = "Katz 2001"},
        beam.rotary_inertia);
    visitor(
        Option{.pointer = "/beam/out_of_plane",
               .unit = "",
               .description = "what resists loads across the plane of a beam that is curved at rest, in space: to be "
                              "written there, for nothing does"},
        beam.out_of_plane);
    visitor(
        Option{.pointer = "/beam/axial_strain",
               .unit = "",
               .description = "where an element's axial strain is summed: at all its quadrature points (full), or at "
                              "both nodes and the middle (lobatto), which bends slender beams without locking"},
        beam.axial_strain);
    visitor(Option{.pointer = "/beam/quadrature_points",
                   .unit = "-",
                   .description = "Gauss points an element, 3 to 25; 0 takes the element's default",
                   .range = Range::closed(0, 25)},
            beam.quadrature_points);
    visitor(Option{.pointer = "/beam/weights",
                   .unit = "-",
                   .description = "initial rational weights of every element",
                   .source = "Ding & Ouyang 2022, Eq. 5",
                   .range = Range::positive()},
            beam.weights);
  }

  void supports() {
    support("/supports/at=start", scene.start);
    support("/supports/at=end", scene.end);
    section("/supports", "what holds the ends of the beam; one that is not listed is free");
  }

  void joints() {
    if (visitor.present(
            Option{.pointer = "/sliding_mass", .unit = "", .description = "a lumped mass that slides along the beam"},
            scene.sliding_mass)) {
      joint_options("/sliding_mass", false, *scene.sliding_mass);
    }
    visitor.list(
        Option{.pointer = "/sliding_joints",
               .unit = "",
               .description = "what slides along the beam, in order from its start: masses, and rings and sleeves that "
                              "are held in space"},
        scene.sliding_joints);
    for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
      auto& joint = scene.sliding_joints[i];
      const std::string at = "/sliding_joints/" + std::to_string(i), held = at + "/support";
      visitor(Option{.pointer = held,
                     .unit = "",
                     .description =
                         "free, with a mass; pin: a ring, held where the beam is at t = 0; clamp: a sleeve, which "
                         "holds the beam's direction, too",
                     .without = "slide",
                     .standard = "free"},
              joint.support);
      const std::string motion = at + "/motion", direction = motion + "/direction";
      if (visitor.present(
              Option{.pointer = motion,
                     .unit = "",
                     .description = "displacement of a ring or a sleeve as a function of time, from where it "
                                    "is at t = 0 and from rest"},
              joint.motion)) {
        visitor(Option{.pointer = direction,
                       .unit = "-",
                       .description = "of the displacement; it need not have unit length",
                       .components = scene.dimension,
                       .required = true},
                joint.motion->direction);
        time_function(motion, "m", {}, joint.motion->displacement);
      }
      const bool guided = visitor.present(
          Option{.pointer = at + "/x",
                 .unit = "",
                 .description = "its way along the beam as a function of time, counted from where it is at t = 0: what "
                                "guides it does the work"},
          joint.x);
      if (guided) time_function(at + "/x", "m", {}, *joint.x);
      visitor(Option{.pointer = at + "/pitch",
                     .unit = "m",
                     .description = "of a nut on a beam that spins: its way along the beam at one turn of the section, "
                                    "backwards at a positive angle where the thread is right-handed, > 0; it does not "
                                    "turn itself"},
              joint.pitch);
      joint_options(at, guided || joint.support != SupportType::free, joint);
    }
  }

  void contact() {
    if (visitor.present(
            Option{.pointer = "/contact",
                   .unit = "",
                   .description = "how several joints touch: each other, and the supports that they strike"},
            scene.contact)) {
      auto& contact = *scene.contact;
      visitor(Option{.pointer = "/contact/joints",
                     .unit = "",
                     .description = "what becomes of two joints that meet: the run stops there, or they stay together "
                                    "until the force between them turns, or they rebound"},
              contact.joints);
      visitor(Option{.pointer = "/contact/restitution",
                     .unit = "-",
                     .description = "of their rebound: relative speed after it over that before",
                     .range = Range::closed(0, 1),
                     .when = only_if("/contact/joints", contact.joints, AtSupport::rebound)},
              contact.restitution);
      visitor(Option{.pointer = "/contact/distance",
                     .unit = "-",
                     .description = "between the nodes of what touches, over the uniform element length: results "
                                    "converge as it falls, and steps get shorter",
                     .range = Range::closed(1e-3, 0.1)},
              contact.distance);
    }
  }

  void spin() {
    if (visitor.present(Option{.pointer = "/spin", .unit = "", .description = "the section's rotation about the axis"},
                        scene.spin)) {
      auto& spin = *scene.spin;
      visitor(Option{.pointer = "/spin/angles",
                     .unit = "",
                     .description = "how the section's angle runs between the nodes",
                     .source = "linear is the shaft element VLBSE, 2017"},
              spin.angles);
      visitor(Option{.pointer = "/spin/rate",
                     .unit = "rad/s",
                     .description = "of the whole beam at t = 0; if not given that of the first drive, or 0"},
              spin.rate);
      visitor.list(Option{.pointer = "/spin/drives", .unit = "", .description = "nodes whose angle is prescribed"},
                   spin.drives);
      for (std::size_t i = 0; i < spin.drives.size(); ++i) {
        const std::string at = "/spin/drives/" + std::to_string(i), node = at + "/node";
        visitor(Option{.pointer = node,
                       .unit = "-",
                       .description = "number of the node, from 0",
                       .range = Range::non_negative(),
                       .required = true},
                spin.drives[i].node);
        time_function(at + "/angle", "rad", {}, spin.drives[i].angle);
      }
    }
  }

  void flow() {
    if (visitor.present(Option{.pointer = "/flow",
                               .unit = "",
                               .description = "nodes that move along the beam as prescribed; without it they rest"},
                        scene.flow)) {
      auto& flow = *scene.flow;
      visitor(Option{.pointer = "/flow/tension", .unit = "N", .description = "initial axial force"}, flow.tension);
      visitor(Option{.pointer = "/flow/velocity",
                     .unit = "m/s",
                     .description = "of the matter along the axis at t = 0; if not given, node 0 stands still"},
              flow.velocity);
      visitor(Option{.pointer = "/flow/steady",
                     .unit = "",
                     .description = "whether to start from the steady flow under the loads at t = 0"},
              flow.steady);
      visitor.list(
          Option{.pointer = "/flow/nodes",
                 .unit = "",
                 .description = "nodes whose material coordinates are given, the first and the last among them; "
                                "those between two of them are equally spaced"},
          flow.nodes);
      for (std::size_t i = 0; i < flow.nodes.size(); ++i) {
        auto& guide = flow.nodes[i];
        const std::string at = "/flow/nodes/" + std::to_string(i), node = at + "/node",
                          support_pointer = at + "/support";
        visitor(Option{.pointer = node,
                       .unit = "-",
                       .description = "number of the node, from 0",
                       .range = Range::non_negative(),
                       .required = true},
                guide.node);
        time_function(at + "/x", "m", {}, guide.x);
        visitor(Option{.pointer = support_pointer,
                       .unit = "",
                       .description = "of an inner node, through which the beam then flows; those of the ends are in "
                                      "/supports"},
                guide.support);
      }
    }
  }

  void loads() {
    visitor.list(Option{.pointer = "/loads", .unit = "", .description = "forces and torques as functions of time"},
                 scene.loads);
    for (std::size_t i = 0; i < scene.loads.size(); ++i) {
      auto& load = scene.loads[i];
      const std::string at = "/loads/" + std::to_string(i), type = at + "/type", place = at + "/at",
                        node = at + "/node", direction = at + "/direction";
      visitor(Option{.pointer = type,
                     .unit = "",
                     .description = "force in a direction of its own, force along the tangent, moment that turns the "
                                    "tangent (in the plane), or torque about the axis"},
              load.type);
      visitor(Option{.pointer = place, .unit = "", .description = "a node, a material point, or the whole beam"},
              load.at);
      visitor(Option{.pointer = node,
                     .unit = "-",
                     .description = "number of the node, from 0",
                     .range = Range::non_negative(),
                     .when = only_if(place, load.at, LoadPlace::node),
                     .required = true},
              load.node);
      time_function(at + "/x", "m", only_if(place, load.at, LoadPlace::point), load.x);
      time_function(at + "/magnitude", "N, N m, or these per m", {}, load.magnitude);
      const Condition has_direction = only_if(type, load.type, LoadType::force);
      visitor(Option{.pointer = direction,
                     .unit = "-",
                     .description = "of the force; it need not have unit length",
                     .components = scene.dimension,
                     .when = has_direction,
                     .required = true},
              load.direction);
      time_function(at + "/turn", "rad", has_direction, load.turn);
    }
  }

  void point_masses() {
    visitor.list(Option{.pointer = "/point_masses", .unit = "", .description = "lumped masses on material points"},
                 scene.point_masses);
    for (std::size_t i = 0; i < scene.point_masses.size(); ++i) {
      const std::string at = "/point_masses/" + std::to_string(i), node = at + "/node", mass = at + "/mass";
      visitor(Option{.pointer = node,
                     .unit = "-",
                     .description = "number of the node, from 0, that marks the material point at t = 0",
                     .range = Range::non_negative(),
                     .required = true},
              scene.point_masses[i].node);
      visitor(
          Option{.pointer = mass, .unit = "kg", .description = "mass", .range = Range::positive(), .required = true},
          scene.point_masses[i].mass);
    }
  }

  void initial_velocity() {
    if (visitor.present(Option{.pointer = "/initial_velocity",
                               .unit = "",
                               .description = "of a rigid motion at t = 0, without what supports hold of slopes"},
                        scene.initial_velocity)) {
      auto& velocity = *scene.initial_velocity;
      visitor(Option{.pointer = "/initial_velocity/translation",
                     .unit = "m/s",
                     .description = "velocity of the point that it turns about",
                     .components = scene.dimension},
              velocity.translation);
      visitor(Option{.pointer = "/initial_velocity/rotation",
                     .unit = "rad/s",
                     .description = "how fast it turns, in the plane from the first axis towards the second"},
              velocity.rotation);
      visitor(Option{.pointer = "/initial_velocity/axis",
                     .unit = "-",
                     .description = "of the rotation, in space; it need not have unit length",
                     .components = 3},
              velocity.axis);
      visitor(Option{.pointer = "/initial_velocity/about",
                     .unit = "m",
                     .description = "the point that it turns about",
                     .components = scene.dimension},
              velocity.about);
    }
  }

  void drag() {
    if (visitor.present(
            Option{.pointer = "/drag",
                   .unit = "",
                   .description = "of still air: a force per unstretched length against the beam's velocity"},
            scene.drag)) {
      auto& drag = *scene.drag;
      const auto coefficient = [&](std::string_view pointer, std::string_view unit, std::string_view description,
                                   auto& member) {
        visitor(Option{.pointer = pointer, .unit = unit, .description = description, .range = Range::non_negative()},
                member);
      };
      section("/drag/linear", "in proportion to the velocity");
      section("/drag/quadratic", "in proportion to the square of the velocity");
      coefficient("/drag/linear/normal", "N s/m^2", "of the velocity across the axis", drag.linear.normal);
      coefficient("/drag/linear/tangential", "N s/m^2", "of the velocity along the axis", drag.linear.tangential);
      coefficient("/drag/quadratic/normal", "N s^2/m^3",
                  "of the velocity across the axis: half the density of the air "
                  "times the coefficient of drag and the width",
                  drag.quadratic.normal);
      coefficient("/drag/quadratic/tangential", "N s^2/m^3", "of the velocity along the axis",
                  drag.quadratic.tangential);
    }
  }

  void equations() {
    visitor(Option{.pointer = "/formulation",
                   .unit = "",
                   .description = "equations of motion at a moving node: Lagrange's, or the paper's virtual work",
                   .source = "Ding & Ouyang 2022, Eq. 17 is virtual-work"},
            scene.formulation);
    visitor(Option{.pointer = "/weights",
                   .unit = "",
                   .description = "how the rational weights follow the moving ends of an element; if not given "
                                  "transported with an as-built arc or NURBS curve, frozen otherwise",
                   .source = "Ding & Ouyang 2022 is frozen"},
            scene.weights);
  }

  void length_control() {
    visitor(Option{.pointer = "/length_control/enabled",
                   .unit = "",
                   .description = "whether elements beside the mass are segmented and merged"},
            scene.length_control.enabled);
    visitor(Option{.pointer = "/length_control/upper",
                   .unit = "-",
                   .description = "length that triggers a segmentation, over the uniform element length",
                   .source = "Ding & Ouyang 2022, §4",
                   .range = Range::positive()},
            scene.length_control.upper);
    visitor(Option{.pointer = "/length_control/hysteresis",
                   .unit = "-",
                   .description = "the trigger is upper (1 + hysteresis), in [1.5, 2): no event re-fires at once",
                   .range = Range::non_negative()},
            scene.length_control.hysteresis);
    visitor(
        Option{.pointer = "/length_control/cut",
               .unit = "",
               .description = "new node of a cut element: on its curve (exact), or at the least strain energy of the "
                              "two halves (relaxed); if not given, relaxed with sampled axial strain",
               .source = "Ding & Ouyang 2022, Eq. 21-28 is exact"},
        scene.length_control.cut);
    visitor(
        Option{.pointer = "/length_control/merge",
               .unit = "",
               .description =
                   "shape of a merged element: weights by the paper's fit, unit weights, weights of the arc that its "
                   "rest shape turns by, or weights and slopes by the least change at constant strain energy, or "
                   "(own) weights by a rule of the program that links the library, or (relaxed) weights as by default "
                   "and the outer nodes at the least strain energy; if not given, relaxed with sampled axial strain, "
                   "else rest-arc with an as-built arc or NURBS curve, point-fit otherwise",
               .source = "Ding & Ouyang 2022, Eq. 31-38 is point-fit"},
        scene.length_control.merge);
    visitor(
        Option{.pointer = "/length_control/velocities",
               .unit = "",
               .description = "velocities after length control: nodes keep theirs, or the old field is projected, or "
                              "projected and scaled to the old total energy",
               .source = "Ding & Ouyang 2022 is nodal"},
        scene.length_control.velocities);
    visitor(
        Option{.pointer = "/length_control/end_merge",
               .unit = "-",
               .description =
                   "length of the element between the mass and an end of the beam, over the uniform element length, "
                   "below which the mass rides inside an element without a node of its own; 0 never; 0.5 if not "
                   "given, but 0 without length control, and for a kinked mass that stops at supports",
               .range = {.low = 0, .high = 0.9}},
        scene.length_control.end_merge);

    visitor(
        Option{.pointer = "/length_control/lower",
               .unit = "-",
               .description =
                   "length over the uniform element length below which an element beside a joint is merged with the "
                   "next one, even where the other side is not cut; 0, with one joint only: never; if not given 2 - "
                   "upper (1 + hysteresis) "
                   "with several joints or a feed, where both fall together on even elements, and 0 with one joint",
               .range = {.low = 0, .high = 1}},
        scene.length_control.lower);

    visitor(Option{.pointer = "/constraints",
                   .unit = "",
                   .description =
                       "supports and the beam's continuity at the mass: eliminated coordinates, or equations with "
                       "multipliers (generalized-alpha and ida only)"},
            scene.constraints);
  }

  void statics() {
    const Condition statics = of_analysis(Analysis::statics);
    const Condition equilibrium =
        either(statics, only_if(initial_shape, scene.initial_shape, InitialShape::equilibrium));
    section("/statics", "how equilibria are found");
    visitor(
        Option{.pointer = "/statics/steps",
               .unit = "-",
               .description = "equal steps in which loads, gravity and displacements of supports grow to what they are "
                              "after all ramps, or, where a motion starts from the equilibrium, at t = 0; with "
                              "arc-length the first step has that size",
               .range = Range::closed(1, 1e5),
               .when = equilibrium},
        scene.statics.steps);
    visitor(Option{.pointer = "/statics/control",
                   .unit = "",
                   .description =
                       "whether the load factor grows evenly, or steps go along the path of equilibria, on which "
                       "it may also fall, until it is 1",
                   .source = "Riks 1979 is arc-length",
                   .when = equilibrium},
            scene.statics.control);
    visitor(
        Option{.pointer = "/statics/tolerance",
               .unit = "-",
               .description = "where Newton's iteration ends: its last correction, of positions over the beam's length "
                              "and of slopes; rounding ends it, too",
               .range = {.low = 1e-15, .high = 1e-4},
               .when = equilibrium},
        scene.statics.tolerance);
    visitor(Option{.pointer = "/statics/frequencies",
                   .unit = "-",
                   .description = "how many of the lowest natural frequencies about the last equilibrium are reported",
                   .range = Range::closed(0, 1000),
                   .when = statics},
            scene.statics.frequencies);
    visitor(
        Option{.pointer = "/statics/joints",
               .unit = "",
               .description = "what becomes of a ring, a sleeve or a sliding mass, which keeps its place on the beam "
                              "while the load grows: it is released and slides to where it is in equilibrium, or "
                              "held, in the natural frequencies, too; if not given released in statics, and held "
                              "until t = 0 where a motion starts from the equilibrium",
               .when = equilibrium},
        scene.statics.joints);
  }

  void integrator() {
    const std::string_view integrator_type = "/integrator/type";
    timed(Option{.pointer = "/integrator/accuracy",
                 .unit = "-",
                 .description =
                     "of positions in time, over the beam's length, and over its motion where that is smaller: "
                     "what else the integrator needs is chosen for it; excludes all other keys",
                 .range = Range::closed(1e-10, 1e-2),
                 .when = {.pointer = {}, .values = {}, .holds = scene.integrator.automatic, .or_else = {}}},
          scene.integrator.accuracy);
    timed(Option{.pointer = integrator_type,
                 .unit = "",
                 .description = "time integrator; ida, cvode and arkode need a build with SUNDIALS"},
          scene.integrator.type);
    timed(Option{.pointer = "/integrator/rtol",
                 .unit = "-",
                 .description = "relative tolerance of a step, of the methods that choose their step",
                 .range = Range::closed(1e-14, 1)},
          scene.integrator.rtol);
    if (!in_time()) {
      timed(Option{.pointer = "/integrator/atol", .unit = "m", .description = "absolute tolerance of a step"},
            scene.integrator.atol);
    } else if (visitor.number_or(
                   Option{.pointer = "/integrator/atol",
                          .unit = "m, m/s, rad, rad/s, -, 1/s",
                          .description =
                              "absolute tolerance of a step, of the methods that choose their step: a number for all "
                              "of the state in its own units, or an object with one for each kind",
                          .range = Range::positive()},
                   scene.integrator.atol, scene.integrator.atol_by_kind)) {
      auto& atol = *scene.integrator.atol_by_kind;
      visitor(
          Option{.pointer = "/integrator/atol/length",
                 .unit = "m",
                 .description = "of positions and material coordinates, and over the uniform element length of slopes",
                 .range = Range::positive(),
                 .required = true},
          atol.length);
      visitor(Option{.pointer = "/integrator/atol/velocity",
                     .unit = "m/s",
                     .description = "of their rates",
                     .range = Range::positive(),
                     .required = true},
              atol.velocity);
      visitor(Option{.pointer = "/integrator/atol/angle",
                     .unit = "rad",
                     .description = "of angles about the axis, and over the uniform element length of twist; if not "
                                    "given that of slopes",
                     .range = Range::positive()},
              atol.angle);
      visitor(Option{.pointer = "/integrator/atol/spin",
                     .unit = "rad/s",
                     .description = "of their rates; if not given that of the rates of slopes",
                     .range = Range::positive()},
              atol.spin);
      visitor(
          Option{.pointer = "/integrator/atol/motion",
                 .unit = "m",
                 .description = "displacement from which these tolerances hold in full: until something has moved as "
                                "far they are smaller in proportion, down to a thousandth, and the first step is "
                                "one in which a wave crosses the shortest element; if not given they always hold",
                 .range = Range::positive(),
                 .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)},
          atol.motion);
    }
    timed(Option{.pointer = "/integrator/step",
                 .unit = "s",
                 .description = "length of a step, of the methods that do not choose it; at most the duration",
                 .range = Range::positive(),
                 .when = only_if(integrator_type, scene.integrator.type, IntegratorType::adams_bashforth_moulton,
                                 IntegratorType::generalized_alpha, IntegratorType::energy_momentum)},
          scene.integrator.step);
    timed(Option{.pointer = "/integrator/rho_inf",
                 .unit = "-",
                 .description = "spectral radius at infinity: 1 keeps energy, 0 damps high frequencies most",
                 .source = "Arnold & Bruels 2007",
                 .range = {.low = 0, .high = 1},
                 .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)},
          scene.integrator.rho_inf);
    timed(Option{.pointer = "/integrator/newton",
                 .unit = "",
                 .description = "a new tangent at every iteration (full) or when one converges too slowly (modified)",
                 .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)},
          scene.integrator.newton);
    timed(
        Option{.pointer = "/integrator/newton_tolerance",
               .unit = "-",
               .description = "where Newton's iteration ends: its estimated error over the step's own increment, field "
                              "by field; rounding ends it, too",
               .range = {.low = 1e-15, .high = 1e-2},
               .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)},
        scene.integrator.newton_tolerance);
    timed(Option{.pointer = "/integrator/adaptive",
                 .unit = "",
                 .description = "the step follows rtol and atol of the positions, up to the length given",
                 .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)},
          scene.integrator.adaptive);
    timed(
        Option{.pointer = "/integrator/error_estimate",
               .unit = "",
               .description = "what of the estimated error limits an adaptive step: all of it, or what the method does "
                              "not damp by itself (filtered)",
               .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)},
        scene.integrator.error_estimate);
    timed(Option{.pointer = "/integrator/locate_events",
                 .unit = "",
                 .description = "whether events happen when they are due, or at the end of the step in which they are, "
                                "which leaves every method of first order"},
          scene.integrator.locate_events);
  }

  void output() {
    timed(Option{.pointer = "/duration",
                 .unit = "s",
                 .description = "simulated time",
                 .range = Range::positive(),
                 .when = of_analysis(Analysis::dynamics),
                 .required = true},
          scene.duration);
    timed(Option{.pointer = "/output/interval",
                 .unit = "s",
                 .description = "time between samples",
                 .range = Range::positive()},
          scene.output.interval);
    timed(Option{.pointer = "/output/configurations",
                 .unit = "s",
                 .description = "times, ascending, at which the whole shape is kept",
                 .range = Range::non_negative()},
          scene.output.configurations);
    visitor(
        Option{.pointer = "/output/points",
               .unit = "-",
               .description = "intervals an element: the report then has, for each shape that is kept, points along "
                              "the axis with velocity, strain, curvature and tension; 0 for none",
               .range = {.low = 0, .high = 1000}},
        scene.output.points);
  }
};

/// Calls the visitor for every option of a scene, each after the options it depends on:
///   visitor(option, member)           for an option; `member` is a reference into the scene;
///   visitor.section(option)           for an object whose options follow, and which every scene needs if it is
///   required; visitor.present(option, optional) for a part that may be absent; the part's options follow if it says
///   true; visitor.list(option, vector)      for a list of any length; the options of its entries follow,
///   "/loads/0/type";
///   visitor.number_or(option, number, optional)  for a number that may be a part instead, whose options follow if it
///   says true.
template <class Visitor, class SceneT>
requires std::same_as<std::remove_const_t<SceneT>, Scene>
void visit_options(Visitor&& visitor, SceneT& scene) {
  SceneOptions<std::remove_reference_t<Visitor>, SceneT>{visitor, scene}.all();
}

}  // namespace vlbeam
