#pragma once

#include <string>
#include <vector>

#include "studies/harness/study.hpp"

/// Integrators on problems: which runs there are, and making them.
namespace vlbeam::work_precision {

/// An integrator with the rungs it is tried at.
struct Integrator {
  std::string name;
  std::string family;
  Json scene;                  ///< /integrator of the scene, without step and tolerances
  bool fixed_step = false;     ///< the rungs are steps [s], not tolerances
  std::vector<double> values;  ///< coarse to fine
  double most_steps = 0;       ///< beyond which a run is capped
  double fine_below = 0;       ///< rungs below it use `fine`
  Json fine = Json::object();  ///< patch of `scene`

  /// "rtol = atol = 1e-6" or "step = 1e-3 s".
  std::string setting(double value) const;
};

/// Where the integrators of a sweep stand in `config`; `problem` picks the rungs where they differ by problem, "others"
/// those of a problem that is not named.
std::vector<Integrator> read_integrators(const Json& config, const std::string& problem);

/// A position of everything at one time, to measure errors against.
struct State {
  std::optional<double> joint_position;  ///< [m]
  std::optional<Point> mass_position;    ///< [m]
  Point end{};                           ///< [m]
  double error = 0;                      ///< its own [m]
};
State state_of(const RunResult& result);
/// As reference/work_precision.json has them.
State state_from_json(const Json& json);

/// max(|dx_i|, |dr_end|, |dr_mass|) / L; NaN where one of them alone has lost its mass.
double position_error(const State& a, const State& b);

/// One integrator on one scene, from its coarsest rung on.
struct Ladder {
  std::string problem;
  std::string element;
  Json scene;
  Integrator integrator;
};

enum class Ending { completed, capped, failed };
constexpr auto names(Ending) {
  return std::to_array<Named<Ending>>(
      {{Ending::completed, "completed"}, {Ending::capped, "capped"}, {Ending::failed, "failed"}});
}

struct Rung {
  double value = 0;  ///< step or tolerance
  Ending ending = Ending::completed;
  State state;
  std::size_t events = 0;
  SolverCounters solver;
  double reached = 0;  ///< simulated time [s]
  double seconds = 0;  ///< processor time, the fastest of a few runs where these are short
};

/// Climbs until a run is capped: after the integrator's own number of steps, or after `most_element_steps`, steps times
/// elements. Both are work, not time, so that the same runs are capped on machines of any speed.
std::vector<Rung> climb(const Ladder& ladder, double most_element_steps);

/// "3.2 ms"
std::string milliseconds(double seconds);

/// RFC 7396.
Json merged(Json target, const Json& patch);

}  // namespace vlbeam::work_precision
