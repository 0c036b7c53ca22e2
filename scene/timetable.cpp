#include "scene/timetable.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "scene/assembly.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/derived.hpp"
#include "scene/scene_options.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

constexpr double steps_in_a_change = 10, steps_in_a_period = 10;
constexpr double automatic_steps_a_change = 80;  // of generalized-alpha at the usual accuracy, by its root at others

/// Something changes from one instant to another [s].
struct Change {
  double from, to;
  bool rests = false;  ///< it does not: a table says the same twice
};
/// Something oscillates until then [s].
struct Swing {
  double until, period;
};

/// Notes when the functions of time of a scene change. It looks at nothing else in the table of options.
class Course {
 public:
  explicit Course(const Scene& scene) {
    if (scene.assembly) {
      for (std::size_t i = 0; i < scene.assembly->beams.size(); ++i) look_at(beam_scene(scene, i));
      for (const BodySpec& body : scene.assembly->bodies) {
        for (const BodyLoadSpec& load : body.loads) time_function("", load.magnitude);
      }
    } else {
      look_at(scene);
    }
  }
  void look_at(const Scene& scene) {
    visit_options(*this, scene);
    add(0, scene.gravity_ramp);
    for (const LoadSpec& load : scene.loads) {
      if (load.at == LoadPlace::point && scene.analysis == Analysis::dynamics) add_arrivals(scene, load.x, 0);
      if (load.turn.rate != 0) swings.push_back({Timetable::never, 2 * std::numbers::pi / std::abs(load.turn.rate)});
    }
    for (const VehicleSpec& vehicle : scene.vehicles) {
      for (const AxleSpec& axle : vehicle.axles) add_arrivals(scene, vehicle.x, axle.distance);
    }
  }

  template <class T>
  void operator()(const Option& /*option*/, const T& /*member*/) const {}
  template <class T>
  bool present(const Option& /*option*/, const std::optional<T>& part) const {
    return part.has_value();
  }
  template <class T>
  bool number_or(const Option& /*option*/, double /*number*/, const std::optional<T>& part) const {
    return part.has_value();
  }
  template <class T>
  void list(const Option& /*option*/, const std::vector<T>& /*entries*/) const {}
  void section(const Option& /*option*/) const {}

  void time_function(const std::string& /*at*/, const TimeSpec& f) {
    for (std::size_t i = 1; i < f.table.size(); ++i) {
      add(f.table[i - 1][0], f.table[i][0], f.table[i - 1][1] == f.table[i][1]);
    }
    add(0, f.ramp);
    add(0, f.rate_ramp);
    const bool oscillates = f.amplitude != 0 && f.frequency != 0;
    if (f.until && (oscillates || f.rate != 0 || f.acceleration != 0)) add(0, *f.until);
    if (oscillates) swings.push_back({f.until.value_or(Timetable::never), 1 / std::abs(f.frequency)});
  }

  std::vector<Change> changes;
  std::vector<Swing> swings;

 private:
  /// When what travels so far behind `place` comes onto the beam, and when it leaves.
  void add_arrivals(const Scene& scene, const TimeSpec& place, double distance) {
    constexpr int instants = 2000;
    const TimeFunction x = vlbeam::time_function(place);
    for (const double end : {0.0, beam_length(scene)}) {
      const auto beyond = [&](double t) { return x(t).value - distance - end; };
      double before = beyond(0);
      for (int i = 1; i <= instants; ++i) {
        const double t = scene.duration * i / instants, from = scene.duration * (i - 1) / instants, now = beyond(t);
        if (before * now < 0) {
          std::uintmax_t most = 100;
          const auto at = boost::math::tools::toms748_solve(beyond, from, t, before, now,
                                                            boost::math::tools::eps_tolerance<double>(), most);
          add(0, at.second, true);
        }
        before = now;
      }
    }
  }
  void add(double from, double to, bool rests = false) {
    if (to > std::max(from, 0.0)) changes.push_back({from, to, rests});
  }
};

}  // namespace

Timetable timetable(const Scene& scene) {
  const IntegratorSpec& integrator = scene.integrator;
  double steps = steps_in_a_change;
  if (integrator.automatic && integrator.type == IntegratorType::generalized_alpha) {
    steps = std::max(steps, automatic_steps_a_change * std::sqrt(usual_accuracy / integrator.accuracy));
  }
  const Course course(scene);
  std::vector<Timetable::Stretch> stretches;
  for (const auto& [from, to, rests] : course.changes) {
    stretches.push_back({from, to, rests ? Timetable::never : (to - from) / steps});
  }
  for (const auto& [until, period] : course.swings) stretches.push_back({0, until, period / steps_in_a_period});
  return Timetable(stretches);
}

double shortest_change(const Scene& scene) {
  double shortest = Timetable::never;
  for (const auto& [from, to, rests] : Course(scene).changes) {
    if (!rests) shortest = std::min(shortest, to - from);
  }
  return shortest;
}

}  // namespace vlbeam
