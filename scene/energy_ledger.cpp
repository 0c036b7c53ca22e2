#include "scene/energy_ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/names.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

constexpr double large = 0.01;           // of the energy that moves
constexpr double unjudged_share = 1e-9;  // of the energies there are
constexpr double noise_strain = 1e-10;   // of a beam at rest
constexpr double from_nowhere = 0.5;     // of all energy: more of it is an unstable computation

double supplied(const Sample& sample) {
  double energy = sample.energy.supplied;
  if (sample.flow) {
    energy += sample.flow->ledger.ends + sample.flow->ledger.loads + sample.flow->ledger.mesh;
  }
  return energy;
}

/// Of a beam at rest [J].
double energy_noise(const Scene& scene) {
  return noise_strain * noise_strain * build_section(scene.beam).stiffness.EA * beam_length(scene);
}

/// What its tolerances let a method that chooses its step do to a beam at rest, where nothing else happens [J].
double tolerated_energy(const Scene& scene) {
  const IntegratorSpec& integrator = scene.integrator;
  if (has_fixed_step(integrator.type)) return 0;
  const auto& by_kind = integrator.atol_by_kind;
  const double strain = by_kind ? by_kind->length / standard_length(scene) : integrator.atol;
  const double velocity = by_kind ? by_kind->velocity : integrator.atol;
  const BeamSection section = build_section(scene.beam);
  return beam_length(scene) * (section.stiffness.EA * strain * strain + section.rhoA * velocity * velocity);
}

std::string joules(double energy) {
  std::ostringstream text;
  text.precision(3);
  text << energy << " J";
  return text.str();
}

/// The energy that moves: the largest kinetic energy, with what is stored in strain and height otherwise than at the
/// start [J]. A load that is lowered slowly has next to no kinetic energy.
double moved_energy(const RunResult& result) {
  const auto strained = [](const Energy& e) { return e.axial + e.bending + e.torsion; };
  const Energy& first = result.samples.front().energy;
  double most = result.max_kinetic;
  for (const Sample& sample : result.samples) {
    const Energy& e = sample.energy;
    most = std::max(most, e.kinetic + std::abs(strained(e) - strained(first)) + std::abs(e.gravity - first.gravity));
  }
  return most;
}

/// "1.2 J (34 % of the energy that moves)".
std::string in_proportion(double energy, double moved) {
  std::ostringstream text;
  text.precision(2);
  text << joules(energy);
  if (moved > 0) text << " (" << 100 * energy / moved << " % of the energy that moves)";
  return text.str();
}

/// Whether the scene allows this: advice must not be refused.
bool allowed(const Scene& scene) {
  try {
    validate(scene);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

std::string better_transfer(const Scene& scene) {
  std::string text;
  Scene conserving = scene, least = scene;
  conserving.length_control.velocities = VelocityTransfer::conservative;
  least.length_control.merge = MergePolicy::least_change;
  if (scene.length_control.velocities != VelocityTransfer::conservative && allowed(conserving)) {
    text += "/length_control/velocities \"conservative\", which keeps the total energy; ";
  }
  // it keeps the strain energy that is summed at all points
  const bool full = axial_strain(scene) == AxialStrain::full;
  if (full && merge_policy(scene) != MergePolicy::least_change && allowed(least)) {
    text += "/length_control/merge \"least-change\", which keeps the strain energy; ";
  }
  return text + "more elements, which make each event smaller";
}

std::string better_integration(const Scene& scene) {
  if (scene.formulation == Formulation::virtual_work) {
    return "the formulation \"variational\" conserves energy, \"virtual-work\" does not";
  }
  if (scene.integrator.automatic) {
    return "a finer accuracy: {\"accuracy\": " + six_digits(scene.integrator.accuracy / 10) + "} for /integrator";
  }
  if (!has_fixed_step(scene.integrator.type)) return "smaller /integrator/rtol and atol";
  std::string text = "a smaller /integrator/step";
  if (scene.integrator.type == IntegratorType::generalized_alpha) text += ", rho_inf nearer to 1";
  return text;
}

}  // namespace

EnergyLedger energy_ledger(const RunResult& result) {
  EnergyLedger ledger;
  ledger.largest_drift = result.max_energy_drift;
  if (result.samples.empty()) return ledger;
  const double start = result.samples.front().energy.total();
  auto next = result.events.begin();
  for (const Sample& sample : result.samples) {
    for (; next != result.events.end() && next->t <= sample.t; ++next) {
      const double jump = next->energy_jump.total();
      if (next->type == EventType::contact) {
        ledger.at_contacts += jump;
      } else {
        ledger.at_events += jump;
        ledger.event_jumps += std::abs(jump);
      }
    }
    ledger.change = sample.energy.total() - start;
    ledger.supplied = supplied(sample);
    ledger.unexplained = ledger.change - ledger.supplied - ledger.at_events - ledger.at_contacts;
    ledger.largest_unexplained = std::max(ledger.largest_unexplained, std::abs(ledger.unexplained));
  }
  ledger.dissipated = result.samples.back().energy.dissipated;
  return ledger;
}

double energy_there_is(const Sample& first, const Sample& now) {
  const Energy& e = now.energy;
  return e.kinetic + e.axial + e.bending + e.torsion + std::abs(e.gravity - first.energy.gravity) + e.dissipated +
         std::abs(supplied(now));
}

void check_source_of_energy(const Scene& scene, double most, double gain, double t) {
  if (!(gain > from_nowhere * most + energy_noise(scene) + tolerated_energy(scene))) return;
  throw ComputationFailed("the computation is unstable: of " + joules(most) + " stored, dissipated and supplied, " +
                              joules(gain) + " come from nowhere; try: " + better_integration(scene),
                          t);
}

std::vector<Warning> energy_warnings(const Scene& scene, const RunResult& result) {
  if (result.samples.empty()) return {};
  double size = 0;
  for (const Sample& sample : result.samples) {
    const Energy& e = sample.energy;
    size = std::max(size, e.kinetic + e.axial + e.bending + e.torsion + std::abs(e.gravity) + e.dissipated);
  }
  const double least = unjudged_share * size + energy_noise(scene), moved = moved_energy(result);
  const auto counts = [&](double energy) { return energy > large * moved + least; };
  const auto shown = [&](double energy) { return in_proportion(energy, moved); };

  const EnergyLedger ledger = energy_ledger(result);
  std::vector<Warning> warnings;
  if (counts(ledger.event_jumps)) {
    const auto worst = std::ranges::max_element(result.events, {}, [](const Event& event) {
      return event.type == EventType::contact ? 0 : std::abs(event.energy_jump.total());
    });
    std::ostringstream message;
    message << "length-control events changed the total energy by " << shown(ledger.event_jumps) << "; one of them, at "
            << worst->t << " s, by " << joules(worst->energy_jump.total());
    warnings.push_back({WarningKind::energy_at_events, message.str(), better_transfer(scene)});
  }
  const auto lossy = std::ranges::count_if(result.events, [](const Event& event) { return !event.restored; });
  if (lossy > 0) {
    double worst = 0;
    for (const Event& event : result.events) {
      if (!event.restored) worst = std::max(worst, std::abs(event.discrete_jump));
    }
    warnings.push_back({WarningKind::energy_not_restored,
                        std::to_string(lossy) + " of " + std::to_string(result.events.size()) +
                            " events could not keep the total energy although velocities are \"conservative\": they "
                            "changed it by up to " +
                            shown(worst) + ", more than scaling velocities can make up for",
                        better_transfer(scene)});
  }
  if (counts(ledger.largest_drift)) {
    warnings.push_back(
        {WarningKind::energy_between_events,
         "the total energy " + std::string(scene.integrator.type == IntegratorType::generalized_alpha &&
                                                   scene.integrator.rho_inf < 1 && ledger.unexplained < 0
                                               ? "falls between events by up to " + shown(ledger.largest_drift) +
                                                     ", numerical damping and errors of the steps"
                                               : "drifts between events by up to " + shown(ledger.largest_drift)),
         better_integration(scene)});
  } else if (counts(ledger.largest_unexplained)) {
    warnings.push_back({WarningKind::energy_unexplained,
                        "by a 25-point rule the total energy changes by up to " + shown(ledger.largest_unexplained) +
                            " that nothing explains: the model's own points are too few to see it",
                        "more /beam/quadrature_points, and /beam/polynomial_points, or more elements"});
  }
  return warnings;
}

}  // namespace vlbeam
