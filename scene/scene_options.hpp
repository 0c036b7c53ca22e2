#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "scene/automatic_integrator.hpp"
#include "scene/beam_options.hpp"
#include "scene/joint_options.hpp"
#include "scene/option_lines.hpp"

namespace vlbeam {

/// Visits the options of a scene, part by part: see visit_options(), which names what a visitor has to know.
template <class Visitor, class SceneT>
struct SceneOptions : OptionLines<Visitor, SceneT> {
  void all() {
    whole();
    beam_parts();
    BeamOptions<Visitor, SceneT>{{visitor, scene}}.all();
    JointOptions<Visitor, SceneT>{{visitor, scene}}.all();
    contact();
    spin();
    flow();
    loads();
    vehicles();
    point_masses();
    places();
    initial_velocity();
    drag();
    fluid();
    ground();
    equations();
    length_control();
    statics();
    integrator();
    output();
  }

 private:
  using Lines = OptionLines<Visitor, SceneT>;
  using Lines::scene, Lines::number, Lines::vector, Lines::choice, Lines::section, Lines::present, Lines::list,
      Lines::time_function, Lines::in_time, Lines::of_analysis, Lines::in_motion, Lines::paper, Lines::example1,
      Lines::analysis, Lines::initial_shape, Lines::visitor;

  void whole() {
    SceneSchema schema = SceneSchema::v1;
    choice("/schema", "what this file is, and its version", schema);
    choice("/title", "what the scene shows", scene.title);
    choice(analysis, "a motion, or equilibria under loads that grow", scene.analysis);
    const Condition dynamics = of_analysis(Analysis::dynamics);
    choice(initial_shape,
           "what a motion starts from: the beam as built, or its equilibrium under what acts at t = 0, found as "
           "/statics says; velocities come on top of it",
           scene.initial_shape, {.when = dynamics});
    choice("/setting",
           "what keys left out stand for: by default what measurements speak for, or what the paper does, as far as it "
           "says so",
           scene.setting);
    number("/dimension", "-", Range::closed(2, 3), "2 for a planar scene, 3 for a spatial one", scene.dimension);
    vector("/gravity", "m/s^2", "gravitational acceleration", scene.gravity, {.source = example1});
    number("/gravity_ramp", "s", Range::non_negative(),
           "time over which gravity grows smoothly from 0; 0 applies it at once", scene.gravity_ramp);
  }

  void beam_parts() {
    section("/beam", "the beam", {.required = true});
    section("/beam/curve", "the beam's axis at t = 0");
    section("/beam/section", "cross section");
    section("/beam/material", "material");
    section("/length_control", "how the mesh follows the sliding mass");
    section("/integrator", "integration in time");
    section("/output", "what is kept of the motion");
  }

  void contact() {
    if (present("/contact", "how several joints touch: each other, and the supports that they strike", scene.contact)) {
      auto& contact = *scene.contact;
      choice("/contact/joints",
             "what becomes of two joints that meet: the run stops there, or they stay together until the force between "
             "them turns, or they rebound",
             contact.joints);
      number("/contact/restitution", "-", Range::closed(0, 1),
             "of their rebound: relative speed after it over that before", contact.restitution,
             {.when = only_if("/contact/joints", contact.joints, AtSupport::rebound)});
      number("/contact/distance", "-", Range::closed(1e-4, 0.3),
             "between the nodes of what touches, over the uniform element length: results converge as it falls, and "
             "steps get shorter",
             contact.distance);
    }
  }

  void spin() {
    if (present("/spin", "the section's rotation about the axis", scene.spin)) {
      auto& spin = *scene.spin;
      choice("/spin/angles", "how the section's angle runs between the nodes", spin.angles,
             {.source = "linear is the shaft element VLBSE, 2017"});
      number("/spin/rate", "rad/s", {}, "of the whole beam at t = 0; if not given that of the first drive, or 0",
             spin.rate);
      list("/spin/drives", "nodes whose angle is prescribed", spin.drives);
      for (std::size_t i = 0; i < spin.drives.size(); ++i) {
        const std::string at = "/spin/drives/" + std::to_string(i), node = at + "/node";
        number(node, "-", Range::non_negative(), "number of the node, from 0", spin.drives[i].node, {.required = true});
        time_function(at + "/angle", "rad", spin.drives[i].angle);
      }
    }
  }

  void flow() {
    if (present("/flow", "nodes that move along the beam as prescribed; without it they rest", scene.flow)) {
      auto& flow = *scene.flow;
      number("/flow/tension", "N", {}, "initial axial force", flow.tension);
      number("/flow/velocity", "m/s", {}, "of the matter along the axis at t = 0; if not given, node 0 stands still",
             flow.velocity);
      choice("/flow/steady", "whether to start from the steady flow under the loads at t = 0", flow.steady);
      list("/flow/nodes",
           "nodes whose material coordinates are given, the first and the last among them; those between two of them "
           "are equally spaced",
           flow.nodes);
      for (std::size_t i = 0; i < flow.nodes.size(); ++i) {
        auto& guide = flow.nodes[i];
        const std::string at = "/flow/nodes/" + std::to_string(i), node = at + "/node",
                          support_pointer = at + "/support";
        number(node, "-", Range::non_negative(), "number of the node, from 0", guide.node, {.required = true});
        time_function(at + "/x", "m", guide.x);
        choice(support_pointer,
               "of an inner node, through which the beam then flows; those of the ends are in /supports",
               guide.support);
      }
    }
  }

  void loads() {
    list("/loads", "forces and torques as functions of time", scene.loads);
    for (std::size_t i = 0; i < scene.loads.size(); ++i) {
      auto& load = scene.loads[i];
      const std::string at = "/loads/" + std::to_string(i), type = at + "/type", place = at + "/at",
                        node = at + "/node", direction = at + "/direction", follows = at + "/follows";
      choice(
          type,
          "force in a direction of its own, force along the tangent, moment that turns the section (in the plane, or "
          "with frames), or torque about the axis",
          load.type);
      choice(place, "a node, a material point, or the whole beam", load.at);
      number(node, "-", Range::non_negative(), "number of the node, from 0", load.node,
             {.when = only_if(place, load.at, LoadPlace::node), .required = true});
      time_function(at + "/x", "m", load.x, only_if(place, load.at, LoadPlace::point));
      time_function(at + "/magnitude", "N, N m, or these per m", load.magnitude);
      const Condition is_force = only_if(type, load.type, LoadType::force),
                      is_moment = only_if(type, load.type, LoadType::moment);
      vector(direction, "-", "of the force, or in space the axis of the moment; it need not have unit length",
             load.direction, {.when = scene.dimension == 3 ? either(is_force, is_moment) : is_force, .required = true});
      choice(follows, "whether a moment in space turns with the section; else its axis stays as it is", load.follows,
             {.when = is_moment});
      time_function(at + "/turn", "rad", load.turn, is_force);
    }
  }

  void vehicles() {
    list("/vehicles", "what rolls along the beam, onto it and off it", scene.vehicles);
    for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
      auto& vehicle = scene.vehicles[i];
      const std::string at = "/vehicles/" + std::to_string(i);
      choice(at + "/name", "letters, digits and underscores, another one for each vehicle", vehicle.name,
             {.required = true});
      time_function(at + "/x", "m", vehicle.x);
      list(at + "/axles", "its wheels, from the first", vehicle.axles);
      for (std::size_t k = 0; k < vehicle.axles.size(); ++k) {
        auto& axle = vehicle.axles[k];
        const std::string wheel = at + "/axles/" + std::to_string(k);
        number(wheel + "/distance", "m", Range::non_negative(), "behind the first axle", axle.distance);
        number(wheel + "/force", "N", {}, "down, on the wheel", axle.force);
        number(wheel + "/mass", "kg", Range::non_negative(), "of the wheel, which stays on the beam", axle.mass);
        number(wheel + "/sprung_mass", "kg", Range::non_negative(), "of what the wheel carries on a spring",
               axle.sprung_mass);
        number(wheel + "/stiffness", "N/m", Range::non_negative(), "of that spring", axle.stiffness);
        number(wheel + "/damping", "N s/m", Range::non_negative(), "of a damper beside it", axle.damping);
      }
    }
  }

  void places() {
    list("/places", "places on the beam whose motion and section forces the samples have, by their names",
         scene.places);
    for (std::size_t i = 0; i < scene.places.size(); ++i) {
      auto& place = scene.places[i];
      const std::string at = "/places/" + std::to_string(i);
      choice(at + "/name", "letters, digits and underscores, another one for each place", place.name,
             {.required = true});
      number(at + "/x", "m", Range::non_negative(),
             "material coordinate; or one of the keys below. Where something acts the forces are those just before it",
             place.x);
      choice(at + "/end", "an end of the beam", place.end);
      number(at + "/joint", "-", Range::non_negative(), "number of a sliding joint, from 0; the sliding mass is 0",
             place.joint);
      number(at + "/point_mass", "-", Range::non_negative(), "number of a point mass, from 0", place.point_mass);
    }
  }

  void point_masses() {
    list("/point_masses", "lumped masses on material points", scene.point_masses);
    for (std::size_t i = 0; i < scene.point_masses.size(); ++i) {
      const std::string at = "/point_masses/" + std::to_string(i), node = at + "/node", mass = at + "/mass";
      number(at + "/position", "m", Range::non_negative(),
             "in place of node: material coordinate of the mass; the nearest node moves there",
             scene.point_masses[i].position);
      number(node, "-", Range::non_negative(), "number of the node, from 0, that marks the material point at t = 0",
             scene.point_masses[i].node, {.required = !scene.point_masses[i].position, .instead = "position"});
      number(mass, "kg", Range::positive(), "mass", scene.point_masses[i].mass, {.required = true});
    }
  }

  void initial_velocity() {
    if (present("/initial_velocity", "of a rigid motion at t = 0, without what supports hold of slopes",
                scene.initial_velocity)) {
      auto& velocity = *scene.initial_velocity;
      vector("/initial_velocity/translation", "m/s", "velocity of the point that it turns about", velocity.translation);
      number("/initial_velocity/rotation", "rad/s", {},
             "how fast it turns, in the plane from the first axis towards the second", velocity.rotation);
      vector("/initial_velocity/axis", "-", "of the rotation, in space; it need not have unit length", velocity.axis,
             {.components = 3});
      vector("/initial_velocity/about", "m", "the point that it turns about", velocity.about);
    }
  }

  void drag() {
    if (present("/drag", "of still air: a force per unstretched length against the beam's velocity", scene.drag)) {
      this->drag_at("/drag", *scene.drag);
    }
  }

  void fluid() {
    if (present("/fluid", "what surrounds the beam and flows evenly; without it, air that is light and still",
                scene.fluid)) {
      auto& fluid = *scene.fluid;
      number(
          "/fluid/density", "kg/m^3", Range::non_negative(),
          "of the fluid, whose weight the beam displaces: buoyancy, but neither added mass nor that of lumped masses",
          fluid.density);
      vector("/fluid/velocity", "m/s", "of the fluid, against which /drag counts", fluid.velocity);
      number("/fluid/area", "m^2", Range::positive(),
             "what the beam displaces per length; if not given, a circle's own", fluid.area);
    }
  }

  void ground() {
    if (present("/ground", "a floor that bears the beam from below, against gravity", scene.ground)) {
      auto& ground = *scene.ground;
      number("/ground/height", "m", {}, "of the floor, against gravity from the origin", ground.height);
      number("/ground/stiffness", "N/m^2", Range::positive(),
             "push per unstretched length over the depth under the floor", ground.stiffness, {.required = true});
      number("/ground/depth", "m", Range::positive(),
             "over which the push sets in, with its square; if not given, that at which it bears the beam's weight",
             ground.depth);
      number("/ground/damping", "N s/m^2", Range::non_negative(), "of the velocity into the floor, per length",
             ground.damping);
      if (present("/ground/friction", "Coulomb friction against the velocity along the floor", ground.friction)) {
        number("/ground/friction/coefficient", "-", Range::non_negative(), "mu, friction over the push",
               ground.friction->coefficient, {.required = true});
        number("/ground/friction/velocity", "m/s", Range::positive(), "velocity below which friction fades",
               ground.friction->velocity);
      }
    }
  }

  void equations() {
    choice("/formulation", "equations of motion at a moving node: Lagrange's, or the paper's virtual work",
           scene.formulation, {.source = "Ding & Ouyang 2022, Eq. 17 is virtual-work"});
    choice("/weights",
           "how the rational weights follow the moving ends of an element; if not given transported with an as-built "
           "arc or NURBS curve, frozen otherwise",
           scene.weights, {.source = "Ding & Ouyang 2022 is frozen"});
  }

  void length_control() {
    choice("/length_control/enabled", "whether elements beside the mass are segmented and merged",
           scene.length_control.enabled);
    number("/length_control/upper", "-", Range::positive(),
           "length that triggers a segmentation, over the uniform element length", scene.length_control.upper,
           {.source = "Ding & Ouyang 2022, §4"});
    number("/length_control/hysteresis", "-", Range::non_negative(),
           "the trigger is upper (1 + hysteresis), in [1.5, 2): no event re-fires at once",
           scene.length_control.hysteresis);
    choice("/length_control/cut",
           "new node of a cut element: on its curve (exact), or at the least strain energy of the two halves "
           "(relaxed); if not given, relaxed with sampled axial strain",
           scene.length_control.cut, {.source = "Ding & Ouyang 2022, Eq. 21-28 is exact"});
    choice("/length_control/merge",
           "shape of a merged element: weights by the paper's fit, unit weights, weights of the arc that its rest "
           "shape turns by, or weights and slopes by the least change at constant strain energy, or (own) weights by a "
           "rule of the program that links the library, or (relaxed) weights as by default and the outer nodes at the "
           "least strain energy; if not given, relaxed with sampled axial strain (of ropes with unit weights), else "
           "rest-arc with an as-built arc or NURBS curve, unit with frames and of ropes, point-fit otherwise",
           scene.length_control.merge, {.source = "Ding & Ouyang 2022, Eq. 31-38 is point-fit"});
    choice("/length_control/velocities",
           "velocities after length control: nodes keep theirs, or the old field is projected, or projected and scaled "
           "to the old total energy",
           scene.length_control.velocities, {.source = "Ding & Ouyang 2022 is nodal"});
    number("/length_control/end_merge", "-", {.low = 0, .high = 0.9},
           "length of the element between the mass and an end of the beam, over the uniform element length, below "
           "which the mass rides inside an element without a node of its own; 0 never; 0.5 if not given, but 0 without "
           "length control, and for a kinked mass that stops at supports",
           scene.length_control.end_merge);

    number("/length_control/lower", "-", {.low = 0, .high = 1},
           "length over the uniform element length below which an element beside a joint is merged with the next one, "
           "even where the other side is not cut; 0, with one joint only: never; if not given 2 - upper (1 + "
           "hysteresis) with several joints or a feed, where both fall together on even elements, and 0 with one joint",
           scene.length_control.lower);

    choice("/constraints",
           "supports: eliminated coordinates, or equations with multipliers (generalized-alpha and ida only)",
           scene.constraints);
  }

  void statics() {
    const Condition statics = of_analysis(Analysis::statics);
    const Condition equilibrium =
        either(statics, only_if(initial_shape, scene.initial_shape, InitialShape::equilibrium));
    section("/statics", "how equilibria are found");
    number("/statics/steps", "-", Range::closed(1, 1e5),
           "equal steps in which loads, gravity and displacements of supports grow to what they are after all ramps, "
           "or, where a motion starts from the equilibrium, at t = 0; with arc-length the first step has that size",
           scene.statics.steps, {.when = equilibrium});
    choice("/statics/control",
           "whether the load factor grows evenly, or steps go along the path of equilibria, on which it may also fall, "
           "until it is 1",
           scene.statics.control, {.source = "Riks 1979 is arc-length", .when = equilibrium});
    number("/statics/tolerance", "-", {.low = 1e-15, .high = 1e-4},
           "where Newton's iteration ends: its last correction, of positions over the beam's length and of slopes; "
           "rounding ends it, too",
           scene.statics.tolerance, {.when = equilibrium});
    number("/statics/frequencies", "-", Range::closed(0, 1000),
           "how many of the lowest natural frequencies about the last equilibrium are reported",
           scene.statics.frequencies, {.when = statics});
    choice("/statics/joints",
           "what becomes of a ring, a sleeve or a sliding mass, which keeps its place on the beam while the load "
           "grows: it is released and slides to where it is in equilibrium, or held, in the natural frequencies, too; "
           "if not given released in statics; where a motion starts from the equilibrium held until t = 0, but "
           "released if the beam is a rope and rings without friction are all that slides on it",
           scene.statics.joints, {.when = equilibrium});
  }

  void integrator() {
    const std::string_view integrator_type = "/integrator/type";
    number("/integrator/accuracy", "-", Range::closed(finest_accuracy, coarsest_accuracy),
           "of positions in time, over the beam's length; what moves by less than a tenth of that is followed in "
           "proportion, down to 1e-6 of the length; what else the integrator needs is chosen for it; excludes all "
           "other keys",
           scene.integrator.accuracy,
           in_motion({.when = {.pointer = {}, .values = {}, .holds = scene.integrator.automatic, .or_else = {}}}));
    choice(integrator_type, "time integrator; ida, cvode and arkode need a build with SUNDIALS", scene.integrator.type,
           in_motion());
    number("/integrator/rtol", "-", Range::closed(1e-14, 1),
           "relative tolerance of a step, of the methods that choose their step", scene.integrator.rtol, in_motion());
    if (!in_time()) {
      number("/integrator/atol", "m", {}, "absolute tolerance of a step", scene.integrator.atol, in_motion());
    } else if (visitor.number_or(
                   Option{.pointer = "/integrator/atol",
                          .unit = "m, m/s, rad, rad/s, -, 1/s",
                          .description =
                              "absolute tolerance of a step, of the methods that choose their step: a number for all "
                              "of the state in its own units, or an object with one for each kind",
                          .range = Range::positive()},
                   scene.integrator.atol, scene.integrator.atol_by_kind)) {
      auto& atol = *scene.integrator.atol_by_kind;
      number("/integrator/atol/length", "m", Range::positive(),
             "of positions and material coordinates, and over the uniform element length of slopes", atol.length,
             {.required = true});
      number("/integrator/atol/velocity", "m/s", Range::positive(), "of their rates", atol.velocity,
             {.required = true});
      number("/integrator/atol/angle", "rad", Range::positive(),
             "of angles about the axis, and over the uniform element length of twist; if not given that of slopes",
             atol.angle);
      number("/integrator/atol/spin", "rad/s", Range::positive(),
             "of their rates; if not given that of the rates of slopes", atol.spin);
      number("/integrator/atol/motion", "m", Range::positive(),
             "displacement from which these tolerances hold in full: until something has moved as far they are smaller "
             "in proportion, down to 1e-5 of them, and the first step is one in which a wave crosses the shortest "
             "element; if not given they always hold",
             atol.motion, {.when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)});
    }
    number("/integrator/step", "s", Range::positive(),
           "length of a step, of the methods that do not choose it; at most the duration", scene.integrator.step,
           in_motion({.when = only_if(integrator_type, scene.integrator.type, IntegratorType::adams_bashforth_moulton,
                                      IntegratorType::generalized_alpha, IntegratorType::energy_momentum)}));
    number("/integrator/rho_inf", "-", {.low = 0, .high = 1},
           "spectral radius at infinity: 1 keeps energy, 0 damps high frequencies most", scene.integrator.rho_inf,
           in_motion({.source = "Arnold & Bruels 2007",
                      .when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)}));
    choice("/integrator/newton", "a new tangent at every iteration (full) or when one converges too slowly (modified)",
           scene.integrator.newton,
           in_motion({.when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)}));
    number("/integrator/newton_tolerance", "-", {.low = 0, .high = 1e-2},
           "where Newton's iteration ends: its estimated error over the step's own increment, field by field; 0 for "
           "3e-4 of what the method itself errs in a step, from 1e-10 to 1e-5; rounding ends it, too",
           scene.integrator.newton_tolerance,
           in_motion({.when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)}));
    choice("/integrator/adaptive", "the step follows rtol and atol of the positions, up to the length given",
           scene.integrator.adaptive,
           in_motion({.when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)}));
    choice("/integrator/error_estimate",
           "what of the estimated error limits an adaptive step: all of it, or what the method does not damp by itself "
           "(filtered)",
           scene.integrator.error_estimate,
           in_motion({.when = only_if(integrator_type, scene.integrator.type, IntegratorType::generalized_alpha)}));
    choice("/integrator/locate_events",
           "whether events happen when they are due, or at the end of the step in which they are, which leaves every "
           "method of first order",
           scene.integrator.locate_events, in_motion());
  }

  void output() {
    number("/duration", "s", Range::positive(), "simulated time", scene.duration,
           in_motion({.when = of_analysis(Analysis::dynamics), .required = true}));
    number("/output/interval", "s", Range::positive(), "time between samples", scene.output.interval, in_motion());
    number("/output/configurations", "s", Range::non_negative(), "times, ascending, at which the whole shape is kept",
           scene.output.configurations, in_motion());
    number("/output/points", "-", {.low = 0, .high = 1000},
           "intervals an element: the report then has, for each shape that is kept, points along the axis with "
           "velocity, strain, curvature and tension; 0 for none",
           scene.output.points);
    choice("/output/extremes",
           "whether the largest and the least value of each quantity of the samples is looked for at every step, with "
           "its time",
           scene.output.extremes, in_motion());
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
  SceneOptions<std::remove_reference_t<Visitor>, SceneT>{{visitor, scene}}.all();
}

}  // namespace vlbeam
