#pragma once

#include <array>
#include <vector>

#include "scene/result.hpp"

namespace vlbeam {

// What is measured of runs with a sliding mass.

inline constexpr double beam_length_m = 1;  ///< L [m]; positions are compared in units of it

/// Between two points [m].
double distance(const Point& a, const Point& b);

/// The sample at time t [s], or nothing.
const Sample* sample_at(const RunResult& result, double t);

/// max(|dx_i|, |dr_end|, |dr_mass|) / L at one time. NaN if one of the runs has no sample then, or if only one of them
/// has lost its mass.
double position_error(const RunResult& run, const RunResult& reference, double t);
double position_error(const Sample& a, const Sample& b);

/// Number of length-control events up to time t. The separation does not count.
std::vector<const Event*> merges_until(const RunResult& result, double t);

/// When the mass leaves the beam [s]; NaN if it does not.
double separation_time(const RunResult& result);

/// Largest material coordinate of the mass over the samples up to time t [m].
double furthest_joint_position(const RunResult& result, double t);

/// The set of weights of the paper's Table 2: three unit weights of segmented elements once, then k_0, k_1, k_2 of
/// every merge.
struct WeightSet {
  std::size_t size = 0;
  double maximum = 1;
  double minimum = 1;
  double sigma = 0;           ///< Eq. 42
  std::size_t fallbacks = 0;  ///< merges that took unit weights because a k_i was not positive (Eq. 38)
};
WeightSet weight_set(const RunResult& result, double t);

/// Total energy at a sample [J], by the 25-point rule, less the jumps of all length-control events before it.
double energy_without_jumps(const RunResult& result, const Sample& sample);

/// Largest |E - E_0 - jumps| over the samples up to time t, by the 25-point rule, over the largest kinetic energy.
double ledger_gap(const RunResult& result, double t);

/// Jumps of the total energy at length-control events, by the 25-point rule. That rule is finer than any model's own,
/// so that `conservative` velocities do not restore it by construction.
struct EventEnergy {
  double largest = 0;  ///< largest |jump| at one event [J]
  double sum = 0;      ///< of the jumps' magnitudes [J]
};
EventEnergy event_energy(const RunResult& result);

/// Largest change of the total energy over the samples, by the 25-point rule, in parts of the largest kinetic energy.
/// Dissipated and supplied energy are accounted for; jumps at events count as changes.
double energy_change(const RunResult& result);

/// The range of material coordinates that an event changes.
struct Stretch {
  double begin = 0;
  double cut = 0;  ///< the joint: segmented on one side, merged on the other
  double end = 0;
  bool forward = true;
};

Stretch changed_by(const Event& event);

/// Largest displacement of a material point by a length-control event [m].
struct Displacement {
  double segmented = 0;  ///< on the side that is cut
  double merged = 0;     ///< on the side that loses a node
};
Displacement displacement_by(const Event& event);

/// Point of the beam with material coordinate x [m].
std::array<double, 2> point_at(const Configuration& shape, double x);

}  // namespace vlbeam
