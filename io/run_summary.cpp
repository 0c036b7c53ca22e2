#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "io/messages.hpp"
#include "io/quantity.hpp"
#include "io/run_report.hpp"
#include "scene/assembly.hpp"
#include "scene/assembly_names.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"
#include "scene/slack.hpp"

namespace vlbeam {
namespace {

std::string point_text(const Point& point, int dimension) {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
    text += (i > 0 ? ", " : "(") + in_digits(point[i], 8);
  }
  return text + ") m";
}

/// "a ring", "3 rings".
std::string count_text(int count, const std::string& thing) {
  return count == 1 ? "a " + thing : std::to_string(count) + " " + thing + "s";
}

std::string beam_text(const Scene& scene) {
  std::string text = std::to_string(scene.beam.elements) + " elements " + std::string(to_string(scene.beam.element)) +
                     ", " + std::string(to_string(scene.formulation)) + ", " + six_digits(beam_length(scene)) + " m";
  const auto joints = sliding_joints(scene);
  int rings = 0, sleeves = 0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const SlidingJointSpec& joint = joints[i];
    if (in_block(scene, i)) continue;
    if (joint.support == SupportType::pin) {
      ++rings;
    } else if (joint.support == SupportType::clamp) {
      ++sleeves;
    } else {
      text += "; " + six_digits(joint.mass) + (joint.x ? " kg is guided along it" : " kg slides on it");
    }
  }
  if (rings > 0) text += "; runs through " + count_text(rings, "ring");
  if (sleeves > 0) text += "; runs through " + count_text(sleeves, "sleeve");
  for (const BlockSpec& block : scene.blocks) {
    text += "; a block of " + six_digits(block.mass) + " kg with " + std::to_string(block.joints.size()) + " sheaves";
  }
  if (scene.spin) text += "; spins";
  if (scene.flow) text += "; flows";
  if (may_have_corners(scene.beam.curve)) {
    const auto round = rounded_corners(scene, drawn_axis<3>(scene.beam.curve)).size();
    if (round > 0) text += "; " + std::to_string(round) + (round == 1 ? " corner is" : " corners are") + " rounded off";
  }
  if (const auto count = knots(scene).size(); count > 0) {
    text += "; " + std::to_string(count) + (count == 1 ? " node" : " nodes") +
            " with two slopes, at masses, loads, corners and changes of section";
  }
  if (const auto count = scene.bearings.size(); count > 0) {
    text += "; " + std::to_string(count) + (count == 1 ? " support" : " supports") + " between its ends";
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    text += "; " + vehicle.name + " with " + std::to_string(vehicle.axles.size()) +
            (vehicle.axles.size() == 1 ? " axle" : " axles") + " crosses it";
  }
  if (const auto count = scene.point_masses.size(); count > 0) {
    text += "; " + std::to_string(count) + (count == 1 ? " point mass" : " point masses");
  }
  if (const auto count = scene.loads.size(); count > 0) {
    text += "; bears " + std::to_string(count) + (count == 1 ? " load" : " loads");
  }
  return text;
}

std::string integrator_text(const IntegratorSpec& integrator) {
  const std::string type = std::string(to_string(integrator.type)) + (integrator.automatic ? " (auto)" : "");
  const bool fixed = has_fixed_step(integrator.type) && !integrator.adaptive;
  if (fixed) return type + ", steps of " + number_text(integrator.step) + " s";
  const auto& by_kind = integrator.atol_by_kind;
  const std::string atol = by_kind ? six_digits(by_kind->length) + " m, " + six_digits(by_kind->velocity) + " m/s"
                                   : six_digits(integrator.atol);
  const std::string longest = integrator.adaptive ? ", steps up to " + six_digits(integrator.step) + " s" : "";
  return type + ", rtol " + six_digits(integrator.rtol) + ", atol " + atol + longest;
}

/// What was asked of an automatic run, what error that means, and why this method was taken.
std::string choice_text(const Scene& scene) {
  const IntegratorSpec& integrator = scene.integrator;
  return "for an accuracy of " + six_digits(integrator.accuracy) + ", in time, so " +
         in_digits(integrator.accuracy * beam_length(scene), 2) + " m: " + integrator.reason;
}

std::string events_text(const std::vector<Event>& events) {
  std::map<std::string_view, int> counts;
  for (const Event& event : events) ++counts[to_string(event.type)];
  std::string text;
  for (const auto& [type, count] : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(type);
  return text.empty() ? "none" : text;
}

/// When the run failed, or what slides left the beam.
std::string when_text(const RunResult& result) {
  if (result.status == RunStatus::failed) return " at t = " + six_digits(result.failure_time) + " s";
  std::string text;
  for (const Event& event : result.events) {
    if (event.type == EventType::separation) text += (text.empty() ? " at t = " : ", ") + six_digits(event.t) + " s";
  }
  return text;
}

/// How many steps there were, and what kept them from being longer.
std::string steps_text(const Scene& scene, const RunResult& result) {
  const SolverCounters& s = result.solver;
  const char* const longest = !has_fixed_step(scene.integrator.type) ? "the end of the run"
                              : scene.integrator.adaptive            ? "the longest step"
                                                                     : "the step given";
  const std::array<const char*, step_limits> limits{longest, "the error tolerance", "Newton's iteration", "events"};
  const auto counted = [&](const StepsByLimit& counts, const std::string& verb) {
    std::string text;
    for (std::size_t i = 0; i < step_limits; ++i) {
      if (counts[i] == 0) continue;
      text += (text.empty() ? "; " : ", ") + std::to_string(counts[i]) + (text.empty() ? " " + verb : "") + " by " +
              limits[i];
    }
    return text;
  };
  return std::to_string(s.steps) + ", the shortest " + in_digits(s.smallest_step, 3) + " s" +
         counted(s.limited_by, "limited") + counted(s.rejected_by, "rejected");
}

/// Energy [J] beside others, the largest of which is `size`: what is rounding of those is shown as 0.
std::string energy_text(double energy, double size, int digits) {
  constexpr double shown = 1e-14;
  return in_digits(std::abs(energy) > shown * size ? energy : 0, digits) + " J";
}

/// The largest of all energies of a run [J].
double largest_energy(const RunResult& result) {
  double size = 0;
  for (const Sample& sample : result.samples) {
    const Energy& e = sample.energy;
    for (const double part : {e.kinetic, e.axial, e.bending, e.torsion, e.gravity, e.dissipated, e.supplied}) {
      size = std::max(size, std::abs(part));
    }
  }
  return size;
}

/// What the elements may make wrong of a natural frequency, where companions have told.
std::string error_of_frequency(const RunResult& result, std::size_t which) {
  if (!result.error) return "";
  const auto& told = result.error->quantities;
  const auto row = std::ranges::find(told, "frequencies." + std::to_string(which), &QuantityError::quantity);
  if (row == told.end() || !row->mesh) return "";
  return ", of the mesh " + in_digits(*row->mesh, 2) + " Hz";
}

std::string ledger_text(const EnergyLedger& ledger, double size) {
  const auto joules = [size](double energy) { return energy_text(energy, size, 4); };
  return "changed by " + joules(ledger.change) + " = supplied " + joules(ledger.supplied) + ", at events " +
         joules(ledger.at_events) + (ledger.at_contacts != 0 ? ", at contacts " + joules(ledger.at_contacts) : "") +
         ", unexplained " + joules(ledger.unexplained) + " (at most " + joules(ledger.largest_unexplained) +
         "); dissipated " + joules(ledger.dissipated);
}

std::string stability_text(const StaticSample& at) {
  const int falls = at.negative_pivots;
  if (falls == 0 && at.hidden_pivots > 0) return ", as far as rounding tells stable";
  return falls == 0 ? ", stable" : ", not stable: the energy falls in " + std::to_string(falls) + " directions";
}

/// Whether the first joint goes where its guide leads it: what it needs is the guide's force, and it is not held.
bool first_is_guided(const Scene& scene) {
  const auto joints = sliding_joints(scene);
  return !joints.empty() && joints.front().x.has_value();
}

/// What a motion starts from.
std::string start_text(const Scene& scene, const StaticSample& at) {
  const std::string force = in_digits(at.holding_force, 8) + " N";
  const std::string held = at.holding_force == 0 ? "" : ", held until then by " + force;
  return "equilibrium" + stability_text(at) +
         (sliding_joint(scene) == nullptr ? ""
          : first_is_guided(scene)        ? "; joint guided by " + force
                                          : "; joint free" + held);
}

/// What companions tell of a run's error.
std::string error_text(const Scene& scene, const RunResult& result) {
  const RunError& error = *result.error;
  const auto part = [](const std::optional<double>& value, const std::string& why) {
    return value ? in_digits(*value, 2) + " m" : "not known (" + why + ")";
  };
  std::string text;
  if (scene.analysis == Analysis::dynamics) text += "in time " + part(error.time, error.no_time) + ", ";
  text += "of the mesh " + part(error.mesh, error.no_mesh) + "; places move by " + in_digits(error.motion, 3) + " m";
  if (scene.analysis == Analysis::statics || result.samples.empty()) return text;
  if (error.trusted_until == result.samples.back().t) return text + "; trusted to the end";
  return text + "; trusted until " + in_digits(error.trusted_until, 4) + " s";
}

/// What the places of a scene bear at a sample.
template <class Line>
void place_lines(const Scene& scene, const Sample& last, const Line& line) {
  for (std::size_t i = 0; i < scene.places.size(); ++i) {
    const std::optional<PlaceSample>& place = last.sections->places[i];
    const std::string name = scene.places[i].name + ": ";
    if (!place) {
      line(i == 0 ? "places" : "", name + "off the beam");
      continue;
    }
    std::string text = name + point_text(place->position, scene.dimension) + ", axial force " +
                       in_digits(place->force.axial, 6) + " N";
    if (last.sections->moment) text += ", moment " + in_digits(place->force.moment, 6) + " N m";
    if (last.sections->shear) text += ", shear " + in_digits(place->force.shear, 6) + " N";
    if (last.sections->torque) text += ", torque " + in_digits(place->force.torque, 6) + " N m";
    line(i == 0 ? "places" : "", text);
  }
}

/// Of the forces that people ask for: the least and the largest over all steps.
template <class Line>
void extreme_lines(const Scene& scene, const Sample& last, const Line& line) {
  if (!last.extremes) return;
  const char* label = "least, largest";
  for (const Quantity& quantity : quantities(scene)) {
    const std::string part = quantity.name.substr(0, quantity.name.find('.'));
    const bool along = (part == "bending_moment" || part == "axial_force" || part == "stress") &&
                       (quantity.name.ends_with(".min") || quantity.name.ends_with(".max"));
    if (!along && part != "tension" && part != "angles") continue;
    const Extreme& of = (*last.extremes)[quantity.number];
    line(label, quantity.name + " " + in_digits(of.least, 5) + " at " + in_digits(of.at_least, 4) + " s, " +
                    in_digits(of.largest, 5) + " " + quantity.unit + " at " + in_digits(of.at_largest, 4) + " s");
    label = "";
  }
}

template <class Line>
void warning_lines(const RunResult& result, const Line& line) {
  for (const Warning& warning : result.warnings) {
    line("warning", warning.message);
    line("", "try: " + warning.remedy);
  }
}

/// Several beams and bodies: what there is.
template <class Line>
void assembly_lines(const Scene& scene, const Line& line) {
  for (std::size_t i = 0; i < scene.assembly->beams.size(); ++i) {
    const Scene beam = beam_scene(scene, i);
    const std::string section = beam.beam.sections.empty() ? section_in_words(beam.beam) : "";
    line(i == 0 ? "beams" : "", scene.assembly->beams[i].name + ": " + beam_text(beam));
    line("", (section.empty() ? "" : section + "; ") + law_in_words(beam));
  }
  const char* label = "bodies";
  for (const BodySpec& body : scene.assembly->bodies) {
    line(label, body.name + ": " + six_digits(body.mass) + " kg" + (body.inertia.empty() ? ", a point mass" : ""));
    label = "";
  }
  label = "links";
  for (const LinkSpec& link : scene.assembly->links) {
    line(label, link.name + ": " + std::string(to_string(link.type)));
    label = "";
  }
}

/// What there is: a beam, or several and bodies.
template <class Line>
void beam_lines(const Scene& scene, const Line& line) {
  if (scene.assembly) return assembly_lines(scene, line);
  line("beam", beam_text(scene));
  if (scene.beam.sections.empty()) {
    if (const std::string section = section_in_words(scene.beam); !section.empty()) line("section", section);
  }
  const char* label = "sections";
  for (const std::string& piece : pieces_in_words(scene.beam)) {
    line(label, piece);
    label = "";
  }
  line("law", law_in_words(scene));
}

/// Where its parts are.
template <class Line>
void part_lines(const Scene& scene, const Sample& last, const Line& line) {
  const AssemblySpec& parts = *scene.assembly;
  for (std::size_t i = 0; i < parts.beams.size(); ++i) {
    const Sample& beam = last.assembly->beams[i];
    line(i == 0 ? "ends of beams" : "", parts.beams[i].name + ": " + point_text(beam.end, scene.dimension));
    const auto position = [&](const std::optional<double>& at) {
      return at ? in_digits(*at, 8) + " m along it" : std::string("off the beam");
    };
    const std::size_t joints = sliding_joints(parts.beams[i].scene).size();
    for (std::size_t k = 0; k < joints; ++k) {
      line("", parts.beams[i].name + ", joint " + std::to_string(k) + ": " +
                   position(joints > 1 ? beam.joints[k].position : beam.joint_position));
    }
  }
  for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
    const BodySample& body = last.assembly->bodies[i];
    const bool turns = !parts.bodies[i].inertia.empty();
    line(i == 0 ? "bodies at" : "",
         parts.bodies[i].name + ": " + point_text(body.position, scene.dimension) +
             (turns && scene.dimension == 2 ? ", turned by " + in_digits(body.rotation[2], 6) + " degrees" : ""));
  }
  for (std::size_t i = 0; i < parts.links.size(); ++i) {
    double size = 0;
    for (const double part : last.assembly->links[i].force) size += part * part;
    line(i == 0 ? "forces of links" : "", parts.links[i].name + ": " + in_digits(std::sqrt(size), 6) + " N");
  }
}

std::string static_summary(const Scene& scene, const RunResult& result) {
  std::ostringstream text;
  const auto line = [&text](const char* name, const std::string& value) {
    text << "  " << name << std::string(16 - std::string_view(name).size(), ' ') << value << '\n';
  };
  text << (scene.title.empty() ? "Untitled scene" : printable(scene.title)) << '\n';
  line("status", std::string(to_string(result.status)) +
                     (result.status == RunStatus::failed ? " at load factor " + six_digits(result.failure_time) : ""));
  beam_lines(scene, line);
  line("equilibria", std::to_string(result.samples.size()) + ", control by " +
                         std::string(to_string(scene.statics.control)) + ", " +
                         std::to_string(result.solver.newton.iterations) + " iterations");
  if (!result.samples.empty()) {
    const Sample& last = result.samples.back();
    const StaticSample& at = *last.equilibrium;
    line("last", "load factor " + in_digits(at.load_factor, 8) + stability_text(at));
    if (scene.assembly) {
      part_lines(scene, last, line);
    } else {
      line("end of beam", point_text(last.end, scene.dimension));
    }
    if (last.joint_position) {
      const double holding = last.equilibrium->holding_force;
      const bool guided = first_is_guided(scene);
      line("joint",
           "at " + in_digits(*last.joint_position, 10) + " m along the beam" +
               (holding == 0 ? ", free" : (guided ? ", guided by " : ", held by ") + in_digits(holding, 8) + " N"));
    }
    if (!scene.assembly) place_lines(scene, last, line);
    line("energy", in_digits(last.energy.total(), 8) + " J");
  }
  for (std::size_t k = 0; k < result.frequencies.size(); ++k) {
    line("frequency", in_digits(result.frequencies[k], 8) + " Hz" + error_of_frequency(result, k));
  }
  if (result.error) line("error", error_text(scene, result));
  line("wall time", in_digits(result.timing.motion, 3) + " s");
  warning_lines(result, line);
  return text.str();
}

/// Where joints are along the beam, and the first one in space.
template <class Line>
void joint_lines(const Scene& scene, const Sample& last, const Line& line) {
  if (last.joints.size() > 1) {
    std::string places;
    for (const SlidingSample& joint : last.joints) {
      places += (places.empty() ? "" : ", ") + (joint.position ? in_digits(*joint.position, 8) + " m" : "off the beam");
    }
    line("joints at", places);
    return;
  }
  if (last.joint_position) line("joint position", in_digits(*last.joint_position, 8) + " m");
  if (!last.mass_position) return;
  const auto joints = sliding_joints(scene);
  const SupportType held = joints.empty() ? SupportType::free : joints.front().support;
  line(held == SupportType::pin     ? "ring position"
       : held == SupportType::clamp ? "sleeve position"
                                    : "mass position",
       point_text(*last.mass_position, scene.dimension));
}

}  // namespace

std::string law_in_words(const Scene& scene) {
  const std::string law = scene.beam.strain_law == StrainLaw::engineering
                              ? "force = EA x elongation (engineering strain)"
                              : "force = EA x Green's strain x stretch";
  return law + (compression(scene) == Compression::none ? ", no compression" : "");
}

std::string run_summary(const Scene& scene, const RunResult& result) {
  if (scene.analysis == Analysis::statics) return static_summary(scene, result);
  std::ostringstream text;
  text.precision(8);
  const auto line = [&text](const char* name, const std::string& value) {
    text << "  " << name << std::string(16 - std::string_view(name).size(), ' ') << value << '\n';
  };
  text << (scene.title.empty() ? "Untitled scene" : printable(scene.title)) << '\n';
  line("status", std::string(to_string(result.status)) + when_text(result));
  beam_lines(scene, line);
  line("integrator", integrator_text(scene.integrator));
  if (!scene.integrator.reason.empty()) line("", choice_text(scene));
  if (!result.samples.empty()) {
    const Sample &first = result.samples.front(), &last = result.samples.back();
    if (first.equilibrium) line("start", start_text(scene, *first.equilibrium));
    line("time reached", in_digits(last.t, 8) + " s of " + in_digits(scene.duration, 8) + " s");
    if (scene.assembly) {
      part_lines(scene, last, line);
    } else {
      line("end of beam", point_text(last.end, scene.dimension));
      joint_lines(scene, last, line);
      place_lines(scene, last, line);
    }
    extreme_lines(scene, last, line);
    const double size = largest_energy(result);
    line("total energy", energy_text(last.energy.total(), size, 8) + ", at the start " +
                             energy_text(result.samples.front().energy.total(), size, 8) + ", kinetic up to " +
                             energy_text(result.max_kinetic, size, 4));
    line("energy ledger", ledger_text(energy_ledger(result), size));
  }
  if (result.error) line("error", error_text(scene, result));
  line("events", events_text(result.events));
  line("steps", steps_text(scene, result));
  line("wall time", in_digits(result.timing.motion, 3) + " s motion, " + in_digits(result.timing.length_control, 3) +
                        " s length control");
  warning_lines(result, line);
  return text.str();
}

}  // namespace vlbeam
