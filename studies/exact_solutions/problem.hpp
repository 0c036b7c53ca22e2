#pragma once

#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam::exact_solutions {

inline constexpr double pi = std::numbers::pi, degree = pi / 180;

/// What a run gives.
struct Found {
  std::vector<double> values;  ///< as the reference has them
  /// Of the axis: L2 norm of the displacement that it is off over the beam's length, and seminorm of H1. NaN: not
  /// measured.
  double displacement = std::numeric_limits<double>::quiet_NaN(), slope = displacement;
};

/// Values that are known, with their errors.
struct Known {
  std::vector<std::string> names;
  std::vector<double> values, errors;
};

/// A problem whose solution is known, and how it is run.
struct Problem {
  std::string family, name;
  std::string refined;         ///< what its levels are: "elements", "steps", "stiffness"
  std::vector<double> levels;  ///< coarse to fine
  Known known;
  /// On a level; with `share` times the steps in time, where it takes some.
  std::function<Found(double level, double share)> run;
  bool steps = false;     ///< whether it does
  double scale = 1;       ///< errors are over this
  double order = 0;       ///< that theory states of the values; 0 where it states none
  bool at_least = false;  ///< the order is a lower bound, of the slope over all levels: pairs scatter
  double floor = 0;       ///< of errors over the scale: below it they are rounding, or of the steps
  double cost = 1;        ///< of a level, over it
};

using Problems = std::vector<Problem>;

/// The cases of reference/exact/exact.json.
class References {
 public:
  explicit References(Json file) : file_(std::move(file)) {}

  /// Throws InvalidInput where there is none.
  const Json& of(const std::string& name) const;
  double number(const std::string& name, const char* key) const { return of(name).at("values").at(key); }
  std::vector<double> list(const std::string& name, const char* key) const {
    return of(name).at("values").at(key).get<std::vector<double>>();
  }
  double parameter(const std::string& name, const char* key) const { return of(name).at("parameters").at(key); }
  /// Some of its values, lists member by member; of lists up to `most` members.
  Known known(const std::string& name, const std::vector<std::string>& keys, std::size_t most = 1000) const;

 private:
  Json file_;
};

/// What a study is given of a family: its data, and all references.
struct FamilyData {
  const References& exact;
  const Json& config;

  std::vector<double> levels(const char* key = "elements") const { return config.at(key).get<std::vector<double>>(); }
  double number(const char* key) const { return config.at(key); }
};

/// Judges a problem in motion by the order and the floor that its family states. Its steps are refined with its levels.
void judge_in_motion(Problem& problem, const FamilyData& data, double cost);

/// 2 b - a: where a and b hold at a stiffness and at its double, what falls as 1/stiffness is gone.
inline double beyond(double a, double b) { return 2 * b - a; }

// The families. Each function gives those problems of its families that the data of the study names.
Problems roll_ups(const FamilyData&);
Problems elasticae(const FamilyData&);
Problems arm_scales(const FamilyData&);
Problems rods_in_sleeves(const FamilyData&);
Problems catenaries(const FamilyData&);
Problems sliding_weights(const FamilyData&);
Problems three_weights(const FamilyData&);
Problems hanging_chains(const FamilyData&);
Problems beck_columns(const FamilyData&);
Problems moving_strings(const FamilyData&);
Problems moving_beams(const FamilyData&);
Problems torsional_frequencies(const FamilyData&);
Problems point_torques(const FamilyData&);
Problems moving_torques(const FamilyData&);
Problems rotating_loads(const FamilyData&);
Problems straight_wires(const FamilyData&);
Problems circular_wires(const FamilyData&);
Problems rotating_wires(const FamilyData&);
Problems moving_forces(const FamilyData&);
Problems moving_masses(const FamilyData&);
Problems capstans(const FamilyData&);
Problems elastic_pendulums(const FamilyData&);
Problems hoisted_pendulums(const FamilyData&);

}  // namespace vlbeam::exact_solutions
