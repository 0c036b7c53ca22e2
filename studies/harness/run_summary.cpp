#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "scene/derived.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "studies/harness/messages.hpp"
#include "studies/harness/run_report.hpp"

namespace vlbeam {
namespace {

std::string short_number(double value, int digits = 6) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

std::string point_text(const Point& point, int dimension) {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
    text += (i > 0 ? ", " : "(") + short_number(point[i], 8);
  }
  return text + ") m";
}

std::string beam_text(const Scene& scene) {
  std::string text = std::to_string(scene.beam.elements) + " elements " + std::string(to_string(scene.beam.element)) +
                     ", " + std::string(to_string(scene.formulation)) + ", " + short_number(beam_length(scene)) + " m";
  for (const SlidingJointSpec& joint : sliding_joints(scene)) {
    text += joint.support == SupportType::pin     ? "; runs through a ring"
            : joint.support == SupportType::clamp ? "; runs through a sleeve"
                                                  : "; " + short_number(joint.mass) + " kg slides on it";
  }
  if (scene.spin) text += "; spins";
  if (scene.flow) text += "; flows";
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
  const std::string atol = by_kind ? short_number(by_kind->length) + " m, " + short_number(by_kind->velocity) + " m/s"
                                   : short_number(integrator.atol);
  const std::string longest = integrator.adaptive ? ", steps up to " + short_number(integrator.step) + " s" : "";
  return type + ", rtol " + short_number(integrator.rtol) + ", atol " + atol + longest;
}

/// What was asked of an automatic run, what error that means, and why this method was taken.
std::string choice_text(const Scene& scene) {
  const IntegratorSpec& integrator = scene.integrator;
  return "for an accuracy of " + short_number(integrator.accuracy) + ", in time, so " +
         short_number(integrator.accuracy * beam_length(scene), 2) + " m: " + integrator.reason;
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
  if (result.status == RunStatus::failed) return " at t = " + short_number(result.failure_time) + " s";
  std::string text;
  for (const Event& event : result.events) {
    if (event.type == EventType::separation) text += (text.empty() ? " at t = " : ", ") + short_number(event.t) + " s";
  }
  return text;
}

/// How many steps there were and what made them as short as they are.
std::string steps_text(const Scene& scene, const RunResult& result) {
  const SolverCounters& s = result.solver;
  std::string text = std::to_string(s.steps) + ", " + std::to_string(s.rejected) + " rejected, the shortest " +
                     short_number(s.smallest_step, 3) + " s; limited by ";
  if (!has_fixed_step(scene.integrator.type)) return text + "the error tolerance";
  if (scene.integrator.type == IntegratorType::generalized_alpha && scene.integrator.adaptive) {
    return text + "the error tolerance and the longest step";
  }
  return text + "the step given" + (s.rejected > 0 ? " and, where rejected, by Newton's iteration" : "");
}

/// Energy [J] beside others, the largest of which is `size`: what is rounding of those is shown as 0.
std::string energy_text(double energy, double size, int digits) {
  constexpr double shown = 1e-14;
  return short_number(std::abs(energy) > shown * size ? energy : 0, digits) + " J";
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

std::string ledger_text(const EnergyLedger& ledger, double size) {
  const auto joules = [size](double energy) { return energy_text(energy, size, 4); };
  return "changed by " + joules(ledger.change) + " = supplied " + joules(ledger.supplied) + ", at events " +
         joules(ledger.at_events) + (ledger.at_contacts != 0 ? ", at contacts " + joules(ledger.at_contacts) : "") +
         ", unexplained " + joules(ledger.unexplained) + " (at most " + joules(ledger.largest_unexplained) +
         "); dissipated " + joules(ledger.dissipated);
}

std::string stability_text(const StaticSample& at) {
  const int falls = at.negative_pivots;
  return falls == 0 ? ", stable" : ", not stable: the energy falls in " + std::to_string(falls) + " directions";
}

/// What a motion starts from.
std::string start_text(const StaticSample& at, bool with_joint) {
  const std::string held =
      at.holding_force == 0 ? "" : ", held until then by " + short_number(at.holding_force, 8) + " N";
  return "equilibrium" + stability_text(at) + (with_joint ? "; joint free" + held : "");
}

std::string static_summary(const Scene& scene, const RunResult& result) {
  std::ostringstream text;
  const auto line = [&text](const char* name, const std::string& value) {
    text << "  " << name << std::string(16 - std::string_view(name).size(), ' ') << value << '\n';
  };
  text << (scene.title.empty() ? "Untitled scene" : printable(scene.title)) << '\n';
  line("status",
       std::string(to_string(result.status)) +
           (result.status == RunStatus::failed ? " at load factor " + short_number(result.failure_time) : ""));
  line("beam", beam_text(scene));
  line("equilibria", std::to_string(result.samples.size()) + ", control by " +
                         std::string(to_string(scene.statics.control)) + ", " +
                         std::to_string(result.solver.newton.iterations) + " iterations");
  if (!result.samples.empty()) {
    const Sample& last = result.samples.back();
    const StaticSample& at = *last.equilibrium;
    line("last", "load factor " + short_number(at.load_factor, 8) + stability_text(at));
    line("end of beam", point_text(last.end, scene.dimension));
    if (last.joint_position) {
      const double holding = last.equilibrium->holding_force;
      line("joint", "at " + short_number(*last.joint_position, 10) + " m along the beam" +
                        (holding == 0 ? ", free" : ", held by " + short_number(holding, 8) + " N"));
    }
    line("energy", short_number(last.energy.total(), 8) + " J");
  }
  for (const double frequency : result.frequencies) line("frequency", short_number(frequency, 8) + " Hz");
  line("wall time", short_number(result.timing.motion, 3) + " s");
  return text.str();
}

}  // namespace

std::string run_summary(const Scene& scene, const RunResult& result) {
  if (scene.analysis == Analysis::statics) return static_summary(scene, result);
  std::ostringstream text;
  text.precision(8);
  const auto line = [&text](const char* name, const std::string& value) {
    text << "  " << name << std::string(16 - std::string_view(name).size(), ' ') << value << '\n';
  };
  text << (scene.title.empty() ? "Untitled scene" : printable(scene.title)) << '\n';
  line("status", std::string(to_string(result.status)) + when_text(result));
  line("beam", beam_text(scene));
  line("integrator", integrator_text(scene.integrator));
  if (!scene.integrator.reason.empty()) line("", choice_text(scene));
  if (!result.samples.empty()) {
    const Sample &first = result.samples.front(), &last = result.samples.back();
    if (first.equilibrium) line("start", start_text(*first.equilibrium, sliding_joint(scene) != nullptr));
    line("time reached", short_number(last.t, 8) + " s of " + short_number(scene.duration, 8) + " s");
    line("end of beam", point_text(last.end, scene.dimension));
    if (last.joint_position) line("joint position", short_number(*last.joint_position, 8) + " m");
    if (last.mass_position) line("mass position", point_text(*last.mass_position, scene.dimension));
    const double size = largest_energy(result);
    line("total energy", energy_text(last.energy.total(), size, 8) + ", at the start " +
                             energy_text(result.samples.front().energy.total(), size, 8) + ", kinetic up to " +
                             energy_text(result.max_kinetic, size, 4));
    line("energy ledger", ledger_text(energy_ledger(result), size));
  }
  line("events", events_text(result.events));
  line("steps", steps_text(scene, result));
  line("wall time", short_number(result.timing.motion, 3) + " s motion, " +
                        short_number(result.timing.length_control, 3) + " s length control");
  for (const Warning& warning : result.warnings) {
    line("warning", warning.message);
    line("", "try: " + warning.remedy);
  }
  return text.str();
}

}  // namespace vlbeam
