#pragma once

#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Where the energy of a run came from and went [J]: change = supplied + at_events + at_contacts + unexplained, of the
/// total that counts what is dissipated as still there. By a 25-point rule, independent of the model's own points.
struct EnergyLedger {
  double change = 0;       ///< of the total, from the first sample to the last
  double supplied = 0;     ///< by supports that move, gravity that grows, loads, and through the ends
  double dissipated = 0;   ///< by damping and friction
  double at_events = 0;    ///< jumps at length-control events
  double event_jumps = 0;  ///< the same, added up by their magnitudes
  double at_contacts = 0;  ///< what impacts of the mass on supports took, negative
  double unexplained = 0;  ///< what is left

  // Over all samples, in magnitude.
  double largest_unexplained = 0;
  double largest_drift = 0;  ///< of the model's own energy between events
};
EnergyLedger energy_ledger(const RunResult& result);

/// All the energy there is at a sample [J]: stored (of gravity what has changed since the `first` one), dissipated and
/// supplied, in magnitude.
double energy_there_is(const Sample& first, const Sample& now);

/// Ends a run that gains more than half of the energy there is, at the instant when it is most, from nowhere: an
/// unstable computation. `gain` is that of the model's own energy between events at `t`, over what is supplied [J].
/// Throws ComputationFailed.
void check_source_of_energy(const Scene& scene, double most, double gain, double t);

/// A warning for each of: energy at events, energy between them, energy that nothing explains, that is more than 1 % of
/// the largest kinetic energy; and for events that should have kept the energy and could not.
std::vector<Warning> energy_warnings(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
