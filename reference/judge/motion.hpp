// A motion from t = 0 on, by an integrator of Boost.Odeint.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace judge {

enum class Method { fehlberg78, bulirsch_stoer };

/// How a motion is computed: a degree for each stretch, Gauss points per degree, and the integrator's tolerance.
struct Level {
  std::vector<int> degrees;
  double points = 1.5;
  double tolerance = 1e-11;
  Method method = Method::fehlberg78;
  std::vector<double> between = {};  ///< marks that rest
};

struct Motion {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;  ///< a row for each time, in the order of the names
  double energy_drift = 0;                  ///< largest change of the sum of energies; its meaning is the scene's
  std::size_t steps = 0, unknowns = 0;
  double length = 0;  ///< of the beam [m]
  double seconds = 0;
};

/// Coordinates are right to the tolerance, in m, and rates to the tolerance over 10 ms: axial waves of no account would
/// otherwise be followed to their last digit.
Motion move(const nlohmann::json& scene, const Level& level, const std::vector<double>& times);

}  // namespace judge
