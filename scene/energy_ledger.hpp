#pragma once

#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Where the energy of a run came from and went [J]: change = supplied + at_events + at_contacts + unexplained. The
/// total includes what is dissipated. It is summed by a 25-point rule, independent of the model's own points.
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

/// All energy at a sample [J], by magnitudes: stored (that of gravity since the sample `first`), dissipated and
/// supplied.
double energy_there_is(const Sample& first, const Sample& now);

/// Ends an unstable computation: a run that gains more than half of all its energy, at the instant when that is most,
/// from nowhere. `gain` is what the model's own energy has gained between events until `t`, beyond what was supplied
/// [J]. Throws ComputationFailed.
void check_source_of_energy(const Scene& scene, double most, double gain, double t);

/// A warning for each of these that exceeds 1 % of the energy that moves (kinetic, strain and height from the start):
/// energy at events, energy between them, energy that nothing explains. And one for events that should have kept the
/// energy and could not.
std::vector<Warning> energy_warnings(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
