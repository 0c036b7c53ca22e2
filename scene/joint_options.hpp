#pragma once

#include <string>

#include "scene/derived.hpp"
#include "scene/option_lines.hpp"

namespace vlbeam {

/// Visits the options of a scene's supports, with their winches, and of what slides along the beam.
template <class Visitor, class SceneT>
struct JointOptions : OptionLines<Visitor, SceneT> {
  void all() {
    supports();
    joints();
  }

 private:
  using Lines = OptionLines<Visitor, SceneT>;
  using Lines::scene, Lines::number, Lines::vector, Lines::choice, Lines::section, Lines::present, Lines::list,
      Lines::time_function, Lines::example1;

  template <class Way>
  void along(const std::string& axis, Way& way) {
    if (present(axis, "displacement along this axis, beside the others", way)) time_function(axis, "m", *way);
  }
  /// How something is displaced: along the axes, and along one direction.
  template <class Motion>
  void ways(const std::string& motion, Motion& of, bool turns) {
    along(motion + "/x", of.x);
    along(motion + "/y", of.y);
    if (scene.dimension == 3) along(motion + "/z", of.z);
    const bool other = turns || of.along_axes();
    vector(motion + "/direction", "-",
           "of one displacement more, which stands beside it; it need not have unit length; needed without an angle "
           "and displacements along axes",
           of.direction, {.required = !other, .instead = "angle x y z"});
    time_function(motion, "m", of.displacement);
  }

  template <class Support>
  void support(const std::string& entry, Support& at) {
    const std::string type = entry + "/type", clamp = entry + "/clamp", motion = entry + "/motion",
                      angle = motion + "/angle";
    choice(type,
           "how the end is held: clamp, position and slope; pin, position; slide, all of the position but along the "
           "axis's tangent at t = 0; or free",
           at.type, {.required = true});
    choice(clamp, "what a clamp holds: the slope's direction, or the whole slope vector", at.clamp,
           {.when = only_if(type, at.type, SupportType::clamp)});
    if (present(motion,
                "displacement of a clamp or a pin as a function of time, from where it is at t = 0 and from rest, and "
                "the angle of a clamp",
                at.motion)) {
      const bool turns = present(angle,
                                 "by which a clamp turns from how it stands at t = 0: about its point, in the plane; "
                                 "about the beam's tangent, "
                                 "in space with frames",
                                 at.motion->angle);
      if (turns) time_function(angle, "rad", *at.motion->angle);
      ways(motion, *at.motion, turns);
    }
    const std::string feed = entry + "/feed";
    if (present(feed,
                "length of beam that has come in through this clamp or pin since t = 0, straight and unstrained, as a "
                "winch pays it out; less than 0 where it draws in",
                at.feed)) {
      time_function(feed, "m", *at.feed);
    }
    const std::string held_tension = entry + "/held_tension", drum = entry + "/drum";
    if (present(
            held_tension,
            "pull of a winch on the beam, at this clamp or pin, that pays out or draws in what it takes to keep it, "
            "in place of feed",
            at.held_tension)) {
      time_function(held_tension, "N", *at.held_tension);
    }
    if (present(drum, "a drum that a motor turns, at this clamp or pin, in place of feed: the length is an unknown",
                at.drum)) {
      number(drum + "/radius", "m", Range::positive(), "of the drum", at.drum->radius, {.required = true});
      number(drum + "/inertia", "kg m^2", Range::non_negative(),
             "moment of inertia about its axis, with what is wound up at t = 0; it falls as beam runs off",
             at.drum->inertia, {.required = true});
      time_function(drum + "/torque", "N m", at.drum->torque);
      number(drum + "/wound", "m", Range::non_negative(),
             "length of beam wound up at t = 0: the run ends when all of it has run off; left out, as much as the "
             "inertia can be",
             at.drum->wound);
    }
    if (at.winds_freely()) {
      choice(entry + "/winds",
             "how beam lies on a winch with a drum or a held_tension: stretched as at the outlet, so that the winch "
             "holds the tension of the beam; or unstretched, so that it pulls in what is unstretched",
             at.winding);
    }
    const std::string stop = entry + "/end_stop";
    if (present(stop, "what stops a winch with a drum or a held_tension, smoothly, on either side", at.end_stop)) {
      number(stop + "/least", "m", {}, "that may have been paid out since t = 0", at.end_stop->least);
      number(stop + "/most", "m", {}, "that may have been paid out", at.end_stop->most);
      number(stop + "/stiffness", "N/m", Range::positive(), "beyond one of them", at.end_stop->stiffness,
             {.required = true});
      number(stop + "/depth", "m", Range::positive(), "beyond it over which the stiffness sets in", at.end_stop->depth,
             {.required = true});
      number(stop + "/damping", "N s/m", Range::non_negative(), "there", at.end_stop->damping);
    }
  }
  template <class Joint>
  void joint_options(const std::string& at, bool massless, Joint& mass) {
    const std::string friction = at + "/friction", at_support = at + "/at_support";
    number(at + "/mass", "kg", massless ? Range::non_negative() : Range::positive(), "mass", mass.mass,
           {.source = example1, .required = !massless});
    const std::string position = at + "/position";
    const Option line{.unit = "m", .source = example1, .range = Range::positive(), .required = true};
    const bool at_corner = this->visitor.number_or(
        Lines::named(
            line, position,
            "material coordinate at t = 0, measured along the beam from its start, or an object: the corner of "
            "the axis where it stands"),
        mass.position, mass.at_corner);
    if (at_corner) {
      number(position + "/corner", "-", Range::closed(1, 1e6),
             "which inner point of a polyline, or which kink of a NURBS curve, counted from the start",
             mass.at_corner->corner, {.required = true});
    }
    number(at + "/velocity", "m/s", {}, "rate of the material coordinate at t = 0", mass.velocity);
    choice(at + "/slopes",
           "the beam's slopes before and behind the mass: one vector, one direction with two magnitudes, a kink with "
           "one magnitude, or independent",
           mass.slopes, {.source = "Ding & Ouyang 2022, Eq. 39-40"});
    if (present(friction,
                "Coulomb friction along the beam, mu N tanh(v/velocity); around a kink of a cable by Euler and "
                "Eytelwein, tensions in the ratio e^(mu angle)",
                mass.friction)) {
      number(friction + "/coefficient", "-", Range::non_negative(),
             "mu, friction over the contact force normal to the beam (of what is held, its reaction)",
             mass.friction->coefficient, {.required = true});
      number(friction + "/velocity", "m/s", Range::positive(), "relative velocity below which friction fades",
             mass.friction->velocity);
    }
    number(at + "/separation_distance", "m", Range::positive(),
           "distance from a free end where the mass leaves; 1e-3 of the beam's length if not given",
           mass.separation_distance);
    choice(at_support,
           "what becomes of the mass at an end that it cannot leave: the run stops there, or it rests until the "
           "contact force turns, or it rebounds",
           mass.at_support);
    number(at + "/restitution", "-", Range::closed(0, 1),
           "of a rebound: speed along the beam after it over that before", mass.restitution,
           {.when = only_if(at_support, mass.at_support, AtSupport::rebound)});
  }

  void supports() {
    support("/supports/at=start", scene.start);
    support("/supports/at=end", scene.end);
    section("/supports", "what holds the ends of the beam, and points between them; an end that is not listed is free");
    bearings();
  }

  /// A file has them in /supports, by an object in place of the end's name.
  void bearings() {
    list("/bearings", "what holds material points between the ends", scene.bearings);
    for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
      auto& bearing = scene.bearings[i];
      const std::string at = "/bearings/" + std::to_string(i), type = at + "/type";
      number(at + "/at/x", "m", Range::non_negative(),
             "material coordinate of a point between the ends, that joints pass over; of a spring an end, too",
             bearing.x, {.required = true});
      choice(type,
             "how the point is held: pin, its place; roller, its place across the beam as it is drawn there; or by a "
             "spring to the ground",
             bearing.type, {.required = true});
      const Condition is_spring = only_if(type, bearing.type, BearingType::spring);
      choice(at + "/name", "letters, digits and underscores, for its quantities; if not given, its number from 0",
             bearing.name);
      number(at + "/stiffness", "N/m", Range::non_negative(), "of the spring", bearing.stiffness,
             {.when = is_spring, .required = true});
      number(at + "/damping", "N s/m", Range::non_negative(), "of a damper beside the spring", bearing.damping,
             {.when = is_spring});
      vector(at + "/direction", "-",
             "along which alone the spring bears, unstrained where the point is drawn; if not given, in all directions",
             bearing.direction, {.when = is_spring});
      const std::string to = at + "/to";
      vector(to, "m", "place in space of the spring's other end, of a hanger or a dropper: it bears along its own line",
             bearing.to, {.when = is_spring});
      number(at + "/length", "m", Range::non_negative(),
             "of such a spring when it bears nothing; if not given, its length as drawn", bearing.length,
             {.when = is_spring});
      choice(at + "/tension_only", "whether the spring goes slack where it would push", bearing.tension_only,
             {.when = is_spring});
    }
  }

  void joints() {
    if (present("/sliding_mass", "a lumped mass that slides along the beam", scene.sliding_mass)) {
      joint_options("/sliding_mass", false, *scene.sliding_mass);
    }
    list("/blocks", "joints that keep their distances in space, as sheaves of a block that does not turn",
         scene.blocks);
    for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
      const std::string at = "/blocks/" + std::to_string(i), tied = at + "/joints";
      number(tied, "-", Range::closed(0, 1e6), "which of sliding_joints, from 0: free ones", scene.blocks[i].joints,
             {.required = true});
      number(at + "/mass", "kg", Range::positive(), "of the block, beside those of its joints", scene.blocks[i].mass,
             {.required = true});
    }
    list("/sliding_joints",
         "what slides along the beam, in order from its start: masses, and rings and sleeves that are held in space",
         scene.sliding_joints);
    for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
      auto& joint = scene.sliding_joints[i];
      const std::string at = "/sliding_joints/" + std::to_string(i), held = at + "/support";
      choice(held,
             "free, with a mass; pin: a ring, held where the beam is at t = 0; clamp: a sleeve, which holds the beam's "
             "direction, too",
             joint.support, {.without = "slide", .standard = "free"});
      const std::string motion = at + "/motion";
      if (present(motion,
                  "displacement of a ring or a sleeve as a function of time, from where it is at t = 0 and from rest",
                  joint.motion)) {
        ways(motion, *joint.motion, false);
      }
      const bool guided = present(at + "/x",
                                  "its way along the beam as a function of time, counted from where it is at t = 0: "
                                  "what guides it does the work",
                                  joint.x);
      if (guided) time_function(at + "/x", "m", *joint.x);
      number(at + "/pitch", "m", {},
             "of a nut on a beam that spins: its way along the beam at one turn of the section, backwards at a "
             "positive angle where the thread is right-handed, > 0; it does not turn itself",
             joint.pitch);
      const std::string pulley = at + "/pulley";
      if (present(pulley, "of a ring that is a wheel, which the beam turns without slip", joint.pulley)) {
        number(pulley + "/radius", "m", Range::positive(),
               "of the wheel; the beam's path round it is not modelled: it bends at the ring", joint.pulley->radius,
               {.required = true});
        number(pulley + "/inertia", "kg m^2", Range::non_negative(), "moment of inertia of the wheel about its axis",
               joint.pulley->inertia, {.required = true});
      }
      joint_options(at, guided || joint.support != SupportType::free || in_block(scene, i), joint);
    }
  }
};

}  // namespace vlbeam
